#include "io/vtk/frame_reader.hpp"

#include "io/vtk/arrays.hpp"
#include "io/vtk/load.hpp"
#include "io/vtk/session.hpp"

#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace grainbench::io {
namespace {

template <class Frame>
void take_instant(vtkFieldData* fields, Frame& frame) {
    frame.time = doubles_of(fields->GetArray("TimeValue"), "TimeValue", 1).front();
    frame.cycle =
        static_cast<std::uint64_t>(int64_of(fields->GetArray("cycle"), "cycle", 1).front());
}

ParticleFrame particles_of(vtkUnstructuredGrid* grid) {
    ParticleFrame frame;
    take_instant(grid->GetFieldData(), frame);
    frame.position = positions_of(grid->GetPoints());
    const std::size_t count = frame.position.size();
    vtkPointData* arrays = grid->GetPointData();
    const auto integers = [&](const char* name) {
        return int32_of(arrays->GetArray(name), name, count);
    };
    const auto vectors = [&](const char* name) {
        return vectors_of(arrays->GetArray(name), name, count);
    };
    frame.id = int64_of(arrays->GetArray("id"), "id", count);
    frame.radius = doubles_of(arrays->GetArray("radius"), "radius", count);
    frame.species = integers("species");
    frame.group = integers("group");
    frame.layer = integers("layer");
    frame.current_layer = integers("current_layer");
    frame.velocity = vectors("velocity");
    frame.angular_velocity = vectors("angular_velocity");
    frame.force = vectors("force");
    frame.contacts = integers("contacts");
    if (arrays->HasArray("orientation") != 0) {
        frame.orientation = quaternions_of(arrays->GetArray("orientation"), "orientation", count);
    }
    return frame;
}

std::vector<std::string> texts_of(vtkFieldData* fields, const char* name) {
    auto* array = vtkStringArray::SafeDownCast(fields->GetAbstractArray(name));
    std::vector<std::string> texts;
    for (vtkIdType k = 0; array != nullptr && k < array->GetNumberOfValues(); ++k) {
        texts.push_back(array->GetValue(k));
    }
    return texts;
}

std::string text_of(vtkFieldData* fields, const char* name) {
    const std::vector<std::string> texts = texts_of(fields, name);
    if (texts.empty()) {
        throw std::runtime_error("it has no array '" + std::string(name) + "'");
    }
    return texts.front();
}

Provenance provenance_of(vtkFieldData* fields) {
    return {.program = text_of(fields, "program"),
            .scene_title = text_of(fields, "scene_title"),
            .scene_hash = text_of(fields, "scene_hash"),
            .seed = int64_of(fields->GetArray("seed"), "seed", 1).front(),
            .species_names = texts_of(fields, "species_names")};
}

PointArray array_of(vtkDataArray* array) {
    PointArray result{.name = array->GetName() == nullptr ? "" : array->GetName(),
                      .components = static_cast<std::size_t>(array->GetNumberOfComponents()),
                      .values = {}};
    result.values.reserve(static_cast<std::size_t>(array->GetNumberOfValues()));
    for (vtkIdType k = 0; k < array->GetNumberOfTuples(); ++k) {
        for (int c = 0; c < array->GetNumberOfComponents(); ++c) {
            result.values.push_back(array->GetComponent(k, c));
        }
    }
    return result;
}

ParticleFile file_of(vtkUnstructuredGrid* grid) {
    ParticleFile file{particles_of(grid), provenance_of(grid->GetFieldData()), {}};
    vtkPointData* arrays = grid->GetPointData();
    for (int k = 0; k < arrays->GetNumberOfArrays(); ++k) {
        if (vtkDataArray* array = arrays->GetArray(k)) {  // null for texts
            file.arrays.push_back(array_of(array));
        }
    }
    return file;
}

TraceTable traces_of(vtkPolyData* data) {
    const std::vector<Vec3> position = positions_of(data->GetPoints());
    vtkPointData* arrays = data->GetPointData();
    const std::size_t count = position.size();
    const std::vector<double> time = doubles_of(arrays->GetArray("time"), "time", count);
    const std::vector<Vec3> velocity = vectors_of(arrays->GetArray("velocity"), "velocity", count);
    const std::vector<std::int64_t> id = int64_of(arrays->GetArray("id"), "id", count);
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return std::pair(id[a], time[a]) < std::pair(id[b], time[b]);
    });
    TraceTable traces;
    for (const std::size_t k : order) {
        traces.time.push_back(time[k]);
        traces.points.push_back({.id = id[k], .position = position[k], .velocity = velocity[k]});
    }
    return traces;
}

/// Adds a polygon to its wall and maps points of the file to points of the wall.
class WallBuilder {
public:
    explicit WallBuilder(WallSurface& wall) : wall_(&wall) {}

    void add(const std::vector<Vec3>& points, vtkIdType count, const vtkIdType* corners) {
        std::vector<Index> polygon;
        for (vtkIdType k = 0; k < count; ++k) {
            const auto [entry, is_new] =
                numbers_.try_emplace(corners[k], static_cast<Index>(wall_->points.size()));
            if (is_new) {
                wall_->points.push_back(points.at(static_cast<std::size_t>(corners[k])));
            }
            polygon.push_back(entry->second);
        }
        wall_->polygons.push_back(std::move(polygon));
    }

private:
    WallSurface* wall_;
    std::map<vtkIdType, Index> numbers_;
};

WallFrame walls_of(vtkPolyData* data) {
    WallFrame frame;
    take_instant(data->GetFieldData(), frame);
    auto* names =
        vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray("wall_names"));
    if (names == nullptr) {
        throw std::runtime_error("it has no array 'wall_names'");
    }
    frame.walls.resize(static_cast<std::size_t>(names->GetNumberOfValues()));
    std::vector<WallBuilder> builders;
    for (std::size_t k = 0; k < frame.walls.size(); ++k) {
        frame.walls[k].name = names->GetValue(static_cast<vtkIdType>(k));
        builders.emplace_back(frame.walls[k]);
    }
    const std::vector<Vec3> points = positions_of(data->GetPoints());
    const auto count = static_cast<std::size_t>(data->GetNumberOfPolys());
    vtkCellData* arrays = data->GetCellData();
    const std::vector<std::int32_t> wall = int32_of(arrays->GetArray("wall"), "wall", count);
    const std::vector<Vec3> velocity = vectors_of(arrays->GetArray("velocity"), "velocity", count);
    const std::vector<Vec3> force = vectors_of(arrays->GetArray("force"), "force", count);
    auto polygons = vtk::TakeSmartPointer(data->GetPolys()->NewIterator());
    std::size_t cell = 0;
    for (polygons->GoToFirstCell(); !polygons->IsDoneWithTraversal(); polygons->GoToNextCell()) {
        const std::size_t k = static_cast<std::size_t>(wall[cell]) - 1;
        vtkIdType corner_count = 0;
        const vtkIdType* corners = nullptr;
        polygons->GetCurrentCell(corner_count, corners);
        frame.walls.at(k).velocity = velocity[cell];
        frame.walls.at(k).force = force[cell];
        builders.at(k).add(points, corner_count, corners);
        ++cell;
    }
    return frame;
}

/// Runs `convert` on what `Reader` reads and names the file in its errors.
template <class Reader, class Convert>
auto read_with(const std::filesystem::path& path, Convert convert) {
    const VtkSession session;
    vtkNew<Reader> reader;
    auto* data = load(reader.Get(), path, session);
    try {
        return convert(data);
    } catch (const Error&) {
        throw;
    } catch (const std::exception& failure) {
        throw_damaged(path, failure.what());
    }
}

}  // namespace

ParticleFrame read_particles_frame(const std::filesystem::path& path) {
    return read_with<vtkXMLUnstructuredGridReader>(path, particles_of);
}

ParticleFile read_particles_file(const std::filesystem::path& path) {
    return read_with<vtkXMLUnstructuredGridReader>(path, file_of);
}

TraceTable read_traces(const std::filesystem::path& path) {
    return read_with<vtkXMLPolyDataReader>(path, traces_of);
}

WallFrame read_walls_frame(const std::filesystem::path& path) {
    return read_with<vtkXMLPolyDataReader>(path, walls_of);
}

}  // namespace grainbench::io
