/// Polygonal data of a VTP file that anybody may have made. Private to io: this header shows VTK.
#pragma once

#include <vtkSmartPointer.h>

#include <string>

class vtkPolyData;

namespace grainbench::io {

/// Points with the point arrays radius, velocity, angular_velocity and species, polygons, strips,
/// and the field array species_names, as far as they are there; all pieces in one. Corners of cells
/// are points of the data. Throws std::runtime_error, which says what is wrong.
vtkSmartPointer<vtkPolyData> polygons_of_vtp(const std::string& bytes);

}  // namespace grainbench::io
