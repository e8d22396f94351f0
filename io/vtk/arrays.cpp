#include "io/vtk/arrays.hpp"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkStringArray.h>
#include <vtkTypeInt32Array.h>
#include <vtkTypeInt64Array.h>

#include <stdexcept>

namespace grainbench::io {
namespace {

vtkIdType id(std::size_t number) {
    return static_cast<vtkIdType>(number);
}

template <class Array>
vtkSmartPointer<Array> make_array(const char* name, std::size_t count, int components) {
    auto array = vtkSmartPointer<Array>::New();
    array->SetName(name);
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(id(count));
    return array;
}

template <class Array, class T>
vtkSmartPointer<vtkDataArray> integer_array(const char* name, std::span<const T> values) {
    auto array = make_array<Array>(name, values.size(), 1);
    for (std::size_t k = 0; k < values.size(); ++k) {
        array->SetValue(id(k), values[k]);
    }
    return array;
}

vtkSmartPointer<vtkFloatArray> floats_of(const char* name, std::span<const Vec3> values) {
    auto array = make_array<vtkFloatArray>(name, values.size(), 3);
    for (std::size_t k = 0; k < values.size(); ++k) {
        array->SetValue(id(3 * k), static_cast<float>(values[k].x));
        array->SetValue(id(3 * k + 1), static_cast<float>(values[k].y));
        array->SetValue(id(3 * k + 2), static_cast<float>(values[k].z));
    }
    return array;
}

void check(vtkDataArray* array, const char* name, std::size_t count, int components) {
    if (array == nullptr) {
        throw std::runtime_error("it has no array '" + std::string(name) + "'");
    }
    if (array->GetNumberOfTuples() != id(count) || array->GetNumberOfComponents() != components) {
        throw std::runtime_error("the array '" + std::string(name) + "' has an unexpected size");
    }
}

template <std::size_t width>
vtkSmartPointer<vtkDataArray> tuple_array(const char* name,
                                          std::span<const std::array<double, width>> values) {
    auto array = make_array<vtkFloatArray>(name, values.size(), width);
    for (std::size_t k = 0; k < values.size(); ++k) {
        for (std::size_t c = 0; c < width; ++c) {
            array->SetValue(id(width * k + c), static_cast<float>(values[k][c]));
        }
    }
    return array;
}

template <class T>
std::vector<T> integers_of(vtkDataArray* array, const char* name, std::size_t count) {
    check(array, name, count, 1);
    std::vector<T> values(count);
    for (std::size_t k = 0; k < count; ++k) {
        // Ids above 2^53 do not fit in the double that GetComponent returns.
        values[k] = static_cast<T>(array->GetVariantValue(id(k)).ToLongLong());
    }
    return values;
}

}  // namespace

vtkSmartPointer<vtkDataArray> double_array(const char* name, std::span<const double> values) {
    auto array = make_array<vtkDoubleArray>(name, values.size(), 1);
    for (std::size_t k = 0; k < values.size(); ++k) {
        array->SetValue(id(k), values[k]);
    }
    return array;
}

vtkSmartPointer<vtkDataArray> float_array(const char* name,
                                          std::span<const double> values,
                                          double factor) {
    auto array = make_array<vtkFloatArray>(name, values.size(), 1);
    for (std::size_t k = 0; k < values.size(); ++k) {
        array->SetValue(id(k), static_cast<float>(factor * values[k]));
    }
    return array;
}

vtkSmartPointer<vtkDataArray> vector_array(const char* name, std::span<const Vec3> values) {
    return floats_of(name, values);
}

vtkSmartPointer<vtkDataArray> quaternion_array(const char* name,
                                               std::span<const std::array<double, 4>> values) {
    return tuple_array(name, values);
}

vtkSmartPointer<vtkDataArray> tensor_array(const char* name,
                                           std::span<const std::array<double, 9>> values) {
    return tuple_array(name, values);
}

vtkSmartPointer<vtkDataArray> int32_array(const char* name, std::span<const std::int32_t> values) {
    return integer_array<vtkTypeInt32Array>(name, values);
}

vtkSmartPointer<vtkDataArray> int64_array(const char* name, std::span<const std::int64_t> values) {
    return integer_array<vtkTypeInt64Array>(name, values);
}

vtkSmartPointer<vtkPoints> make_points(std::span<const Vec3> positions) {
    auto points = vtkSmartPointer<vtkPoints>::New();
    points->SetData(floats_of("position", positions));
    return points;
}

vtkSmartPointer<vtkCellArray> vertex_cells(std::size_t count) {
    auto cells = vtkSmartPointer<vtkCellArray>::New();
    cells->AllocateExact(id(count), id(count));
    for (vtkIdType k = 0; k < id(count); ++k) {
        cells->InsertNextCell(1, &k);
    }
    return cells;
}

void put_field(vtkFieldData* fields, const char* name, double value) {
    fields->AddArray(double_array(name, {&value, 1}));
}

void put_field(vtkFieldData* fields, const char* name, std::int64_t value) {
    fields->AddArray(int64_array(name, {&value, 1}));
}

void put_field(vtkFieldData* fields, const char* name, const std::vector<std::string>& values) {
    vtkNew<vtkStringArray> array;
    array->SetName(name);
    for (const std::string& value : values) {
        array->InsertNextValue(value);
    }
    fields->AddArray(array);
}

std::vector<double> doubles_of(vtkDataArray* array, const char* name, std::size_t count) {
    check(array, name, count, 1);
    std::vector<double> values(count);
    for (std::size_t k = 0; k < count; ++k) {
        values[k] = array->GetComponent(id(k), 0);
    }
    return values;
}

std::vector<std::array<double, 4>> quaternions_of(vtkDataArray* array,
                                                  const char* name,
                                                  std::size_t count) {
    check(array, name, count, 4);
    std::vector<std::array<double, 4>> values(count);
    for (std::size_t k = 0; k < count; ++k) {
        for (int c = 0; c < 4; ++c) {
            values[k][static_cast<std::size_t>(c)] = array->GetComponent(id(k), c);
        }
    }
    return values;
}

std::vector<Vec3> vectors_of(vtkDataArray* array, const char* name, std::size_t count) {
    check(array, name, count, 3);
    std::vector<Vec3> values(count);
    for (std::size_t k = 0; k < count; ++k) {
        values[k] = {array->GetComponent(id(k), 0),
                     array->GetComponent(id(k), 1),
                     array->GetComponent(id(k), 2)};
    }
    return values;
}

std::vector<std::int32_t> int32_of(vtkDataArray* array, const char* name, std::size_t count) {
    return integers_of<std::int32_t>(array, name, count);
}

std::vector<std::int64_t> int64_of(vtkDataArray* array, const char* name, std::size_t count) {
    return integers_of<std::int64_t>(array, name, count);
}

std::vector<Vec3> positions_of(vtkPoints* points) {
    if (points == nullptr) {
        return {};
    }
    return vectors_of(
        points->GetData(), "position", static_cast<std::size_t>(points->GetNumberOfPoints()));
}

}  // namespace grainbench::io
