/// From columns of frames to VTK arrays and back. Private to io: this header shows VTK.
#pragma once

#include "core/types.hpp"

#include <vtkSmartPointer.h>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

class vtkCellArray;
class vtkDataArray;
class vtkFieldData;
class vtkPoints;

namespace grainbench::io {

// Columns to arrays. Numbers that are only looked at are stored with single precision.
vtkSmartPointer<vtkDataArray> double_array(const char* name, std::span<const double> values);
vtkSmartPointer<vtkDataArray> float_array(const char* name,
                                          std::span<const double> values,
                                          double factor = 1.0);
vtkSmartPointer<vtkDataArray> vector_array(const char* name, std::span<const Vec3> values);
vtkSmartPointer<vtkDataArray> quaternion_array(const char* name,
                                               std::span<const std::array<double, 4>> values);
vtkSmartPointer<vtkDataArray> tensor_array(const char* name,
                                           std::span<const std::array<double, 9>> values);
vtkSmartPointer<vtkDataArray> int32_array(const char* name, std::span<const std::int32_t> values);
vtkSmartPointer<vtkDataArray> int64_array(const char* name, std::span<const std::int64_t> values);
vtkSmartPointer<vtkPoints> make_points(std::span<const Vec3> positions);

/// Cells of one point each, as ParaView needs to draw points.
vtkSmartPointer<vtkCellArray> vertex_cells(std::size_t count);

/// Adds one number or text to the field data of a file.
void put_field(vtkFieldData* fields, const char* name, double value);
void put_field(vtkFieldData* fields, const char* name, std::int64_t value);
void put_field(vtkFieldData* fields, const char* name, const std::vector<std::string>& values);

// Arrays to columns. They throw std::runtime_error that names the array if it is missing, has other
// components, or another length; a null pointer counts as missing.
std::vector<double> doubles_of(vtkDataArray* array, const char* name, std::size_t count);
std::vector<std::array<double, 4>> quaternions_of(vtkDataArray* array,
                                                  const char* name,
                                                  std::size_t count);
std::vector<Vec3> vectors_of(vtkDataArray* array, const char* name, std::size_t count);
std::vector<std::int32_t> int32_of(vtkDataArray* array, const char* name, std::size_t count);
std::vector<std::int64_t> int64_of(vtkDataArray* array, const char* name, std::size_t count);
std::vector<Vec3> positions_of(vtkPoints* points);

}  // namespace grainbench::io
