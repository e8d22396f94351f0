#include "io/vtk/foreign_reader.hpp"

#include "core/error.hpp"

#include "io/atomic_file.hpp"
#include "io/vtk/arrays.hpp"
#include "io/vtk/load.hpp"
#include "io/vtk/session.hpp"
#include "io/vtk/vtp_reader.hpp"
#include "io/vtk/xml_seal.hpp"

#include <vtkAbstractArray.h>
#include <vtkCell.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSTLReader.h>
#include <vtkStringArray.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace grainbench::io {
namespace {

/// Foreign files are input, so what is wrong with them is bad input rather than a fault of the
/// disk.
[[noreturn]] void throw_unusable(const std::filesystem::path& path, const std::string& reason) {
    throw_bad_input({.what = "cannot use a file: " + reason,
                     .where = path.string(),
                     .likely_cause = "the file is damaged, cut off or of another format",
                     .next_step = "export it again from the program that made it"});
}

vtkSmartPointer<vtkPolyData> read_vtp(const std::filesystem::path& path) {
    const std::string bytes = read_file(path);
    if (!seal_fits(bytes)) {
        throw_unusable(path, "its bytes differ from those that were written");
    }
    try {
        return polygons_of_vtp(bytes);
    } catch (const std::exception& failure) {
        throw_unusable(path, failure.what());
    }
}

/// A binary STL file says in bytes 80 to 83 how many records of 50 bytes follow. The length is the
/// only safe sign of one: many binary files begin with "solid" too.
bool is_complete_binary_stl(const std::string& bytes) {
    constexpr std::size_t header = 84;
    constexpr std::size_t record = 50;
    if (bytes.size() < header) {
        return false;
    }
    std::uint32_t count = 0;
    std::memcpy(&count, bytes.data() + 80, sizeof count);
    return bytes.size() == header + record * count;
}

bool is_complete_text_stl(const std::string& bytes) {
    const std::size_t start = bytes.find_first_not_of(" \t\r\n");
    return start != std::string::npos && bytes.compare(start, 5, "solid") == 0 &&
           bytes.find("endsolid", start) != std::string::npos &&
           bytes.find('\0') == std::string::npos;
}

/// VTK takes a file for binary where one of twenty among its first 256 bytes is no ASCII text, and
/// then believes whatever number of triangles stands in bytes 80 to 83.
bool is_text_to_vtk(const std::string& bytes) {
    const auto end =
        bytes.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(bytes.size(), 256));
    const auto binary = std::count_if(bytes.begin(), end, [](signed char c) {
        return c < ' ' && c != '\n' && c != '\r' && c != '\t';  // 0x80 and more are negative
    });
    return 20 * binary < end - bytes.begin();
}

Vec3 point_of(vtkPoints* points, vtkIdType number) {
    Vec3 point;
    points->GetPoint(number, &point.x);
    return point;
}

std::vector<std::array<Vec3, 3>> triangles_of(vtkPolyData* data,
                                              const std::filesystem::path& path) {
    std::vector<std::array<Vec3, 3>> triangles;
    vtkNew<vtkIdList> ids;
    vtkNew<vtkPoints> corners;
    for (vtkIdType k = 0; k < data->GetNumberOfCells(); ++k) {
        vtkCell* cell = data->GetCell(k);
        if (cell->GetCellDimension() != 2) {
            continue;
        }
        // A triangle is taken as it is, so that one without area is found and named later.
        const bool is_triangle = cell->GetCellType() == VTK_TRIANGLE;
        if (!is_triangle &&
            (cell->Triangulate(0, ids, corners) == 0 || corners->GetNumberOfPoints() == 0)) {
            throw_unusable(path,
                           "polygon " + std::to_string(k + 1) + " cannot be cut into triangles");
        }
        vtkPoints* points = is_triangle ? cell->GetPoints() : corners.Get();
        for (vtkIdType p = 0; p + 2 < points->GetNumberOfPoints(); p += 3) {
            triangles.push_back(
                {point_of(points, p), point_of(points, p + 1), point_of(points, p + 2)});
        }
    }
    if (triangles.empty()) {
        throw_unusable(path, "it holds no triangles");
    }
    return triangles;
}

/// Names of species for each point; empty if the file has none.
std::vector<std::string> species_of(vtkPolyData* data, std::size_t count) {
    vtkAbstractArray* array = data->GetPointData()->GetAbstractArray("species");
    std::vector<std::string> names;
    if (array == nullptr) {
        return names;
    }
    if (auto* texts = vtkStringArray::SafeDownCast(array)) {
        for (vtkIdType k = 0; k < texts->GetNumberOfValues(); ++k) {
            names.push_back(texts->GetValue(k));
        }
        return names;
    }
    auto* known =
        vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray("species_names"));
    for (const std::int32_t number :
         int32_of(vtkDataArray::SafeDownCast(array), "species", count)) {
        if (known == nullptr || number < 0 || number >= known->GetNumberOfValues()) {
            throw std::runtime_error(
                "the array 'species' holds numbers, but the field array "
                "'species_names' does not say what they stand for");
        }
        names.push_back(known->GetValue(number));
    }
    return names;
}

std::vector<FileInsertion::Row> rows_of(vtkPolyData* data, const std::filesystem::path& path) {
    const std::vector<Vec3> positions = positions_of(data->GetPoints());
    const std::size_t count = positions.size();
    vtkPointData* arrays = data->GetPointData();
    const auto vectors = [&](const char* name) {
        vtkDataArray* array = arrays->GetArray(name);
        return array == nullptr ? std::vector<Vec3>(count) : vectors_of(array, name, count);
    };
    const std::vector<Vec3> velocities = vectors("velocity");
    const std::vector<Vec3> spins = vectors("angular_velocity");
    std::vector<double> radii(count);
    if (vtkDataArray* array = arrays->GetArray("radius")) {
        radii = doubles_of(array, "radius", count);
        for (std::size_t k = 0; k < count; ++k) {
            check_radius(radii[k], path.string() + ", point " + std::to_string(k + 1));
        }
    }
    const std::vector<std::string> species = species_of(data, count);
    std::vector<FileInsertion::Row> rows;
    for (std::size_t k = 0; k < count; ++k) {
        rows.push_back({.species = species.empty() ? "" : species.at(k),
                        .position = positions[k],
                        .velocity = velocities[k],
                        .angular_velocity = spins[k],
                        .radius = radii[k]});
    }
    return rows;
}

}  // namespace

void check_radius(double radius, const std::string& place) {
    if (!(radius > 0.0)) {
        throw_bad_input({.what = "the radius must be greater than 0",
                         .where = place,
                         .likely_cause = "a typing error, or a file in other units",
                         .next_step = "give the radius in metres, or no radii at all to take those "
                                      "of the species"});
    }
}

std::vector<std::array<Vec3, 3>> read_stl_triangles(const std::filesystem::path& path) {
    // VTK drops the torn record at the end of a cut file without a word; so look before it does.
    const std::string bytes = read_file(path);
    if (!is_complete_binary_stl(bytes) && !is_complete_text_stl(bytes)) {
        throw_unusable(path, "it is no complete STL file");
    }
    if (!is_complete_binary_stl(bytes) && !is_text_to_vtk(bytes)) {
        throw_unusable(path,
                       "too much of its beginning, such as the name of the solid, is not ASCII");
    }
    const VtkSession session;
    vtkNew<vtkSTLReader> reader;
    reader->MergingOff();
    try {
        return triangles_of(load(reader.Get(), path, session), path);
    } catch (const Error& failure) {
        throw_unusable(path, failure.diagnosis().what);
    }
}

std::vector<std::array<Vec3, 3>> read_vtp_triangles(const std::filesystem::path& path) {
    const VtkSession session;
    return triangles_of(read_vtp(path), path);
}

std::vector<FileInsertion::Row> read_point_rows(const std::filesystem::path& path) {
    const VtkSession session;
    const vtkSmartPointer<vtkPolyData> data = read_vtp(path);
    try {
        return rows_of(data, path);
    } catch (const Error&) {
        throw;
    } catch (const std::exception& failure) {
        throw_unusable(path, failure.what());
    }
}

}  // namespace grainbench::io
