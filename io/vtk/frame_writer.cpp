#include "io/vtk/frame_writer.hpp"

#include "core/error.hpp"

#include "io/atomic_file.hpp"
#include "io/vtk/arrays.hpp"
#include "io/vtk/load.hpp"
#include "io/vtk/session.hpp"
#include "io/vtk/xml_seal.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <map>

namespace grainbench::io {
namespace {

/// The bytes go through memory, so that the file itself is written whole or not at all.
template <class Writer>
std::string encode(vtkDataObject* data,
                   const std::filesystem::path& path,
                   const VtkSession& session) {
    vtkNew<Writer> writer;
    writer->SetInputData(data);
    writer->SetDataModeToAppended();
    writer->EncodeAppendedDataOff();
    writer->SetCompressorTypeToZLib();
    writer->SetCompressionLevel(1);  // levels above cost seconds a frame and save little
    writer->SetHeaderTypeToUInt64();
    writer->SetIdTypeToInt64();
    writer->WriteToOutputStringOn();
    if (writer->Write() == 0 || !session.error().empty()) {
        throw_input_output({.what = "VTK cannot encode a frame: " + session.error(),
                            .where = path.string(),
                            .likely_cause = "not enough memory",
                            .next_step = "write fewer particles or use a larger machine"});
    }
    std::string bytes = writer->GetOutputString();
    seal_xml(bytes);
    return bytes;
}

void put_provenance(vtkFieldData* fields, const Provenance& provenance) {
    put_field(fields, "program", {provenance.program});
    put_field(fields, "scene_title", {provenance.scene_title});
    put_field(fields, "scene_hash", {provenance.scene_hash});
    put_field(fields, "seed", provenance.seed);
}

template <class Frame>
void put_instant(vtkFieldData* fields, const Frame& frame) {
    put_field(fields, "TimeValue", frame.time);
    put_field(fields, "cycle", static_cast<std::int64_t>(frame.cycle));
}

void put_particle_arrays(vtkPointData* arrays, const ParticleFrame& frame) {
    arrays->AddArray(int64_array("id", frame.id));
    arrays->AddArray(float_array("radius", frame.radius));
    arrays->AddArray(float_array("diameter", frame.radius, 2.0));
    arrays->AddArray(int32_array("species", frame.species));
    arrays->AddArray(int32_array("group", frame.group));
    arrays->AddArray(int32_array("layer", frame.layer));
    arrays->AddArray(int32_array("current_layer", frame.current_layer));
    arrays->AddArray(vector_array("velocity", frame.velocity));
    arrays->AddArray(vector_array("angular_velocity", frame.angular_velocity));
    arrays->AddArray(vector_array("force", frame.force));
    arrays->AddArray(int32_array("contacts", frame.contacts));
    if (!frame.orientation.empty()) {
        arrays->AddArray(quaternion_array("orientation", frame.orientation));
    }
}

template <class DataSet>
void put_particles(DataSet* data, const ParticleFrame& frame, const Provenance& provenance) {
    data->SetPoints(make_points(frame.position));
    put_particle_arrays(data->GetPointData(), frame);
    put_instant(data->GetFieldData(), frame);
    put_field(data->GetFieldData(), "species_names", provenance.species_names);
    put_provenance(data->GetFieldData(), provenance);
}

/// Points and arrays of one polygonal file as they are gathered.
struct Outline {
    std::vector<Vec3> points;
    vtkNew<vtkCellArray> polygons;
    std::vector<std::int32_t> wall;
    std::vector<Vec3> velocity;
    std::vector<Vec3> force;

    void add(const WallSurface& surface, std::int32_t number) {
        const std::size_t first = points.size();
        points.insert(points.end(), surface.points.begin(), surface.points.end());
        for (const std::vector<Index>& polygon : surface.polygons) {
            polygons->InsertNextCell(static_cast<int>(polygon.size()));
            for (const Index corner : polygon) {
                polygons->InsertCellPoint(static_cast<vtkIdType>(first + corner));
            }
            wall.push_back(number);
            velocity.push_back(surface.velocity);
            force.push_back(surface.force);
        }
    }
};

/// Rows of each traced particle, by id.
std::map<std::int64_t, std::vector<vtkIdType>> rows_by_particle(const TraceTable& traces) {
    std::map<std::int64_t, std::vector<vtkIdType>> rows;
    for (std::size_t k = 0; k < traces.points.size(); ++k) {
        rows[traces.points[k].id].push_back(static_cast<vtkIdType>(k));
    }
    return rows;
}

}  // namespace

void write_particles(const std::filesystem::path& path,
                     const ParticleFrame& frame,
                     const Provenance& provenance) {
    std::string bytes;
    {
        const VtkSession session;
        if (path.extension() == ".vtp") {
            vtkNew<vtkPolyData> data;
            put_particles(data.Get(), frame, provenance);
            data->SetVerts(vertex_cells(frame.size()));
            bytes = encode<vtkXMLPolyDataWriter>(data, path, session);
        } else {
            vtkNew<vtkUnstructuredGrid> data;
            put_particles(data.Get(), frame, provenance);
            data->SetCells(VTK_VERTEX, vertex_cells(frame.size()));
            bytes = encode<vtkXMLUnstructuredGridWriter>(data, path, session);
        }
    }
    write_file(path, bytes);
}

void write_walls(const std::filesystem::path& path,
                 const WallFrame& frame,
                 const Provenance& provenance) {
    std::string bytes;
    {
        const VtkSession session;
        Outline outline;
        std::vector<std::string> names;
        for (const WallSurface& surface : frame.walls) {
            names.push_back(surface.name);
            outline.add(surface, static_cast<std::int32_t>(names.size()));
        }
        vtkNew<vtkPolyData> data;
        data->SetPoints(make_points(outline.points));
        data->SetPolys(outline.polygons);
        data->GetCellData()->AddArray(int32_array("wall", outline.wall));
        data->GetCellData()->AddArray(vector_array("velocity", outline.velocity));
        data->GetCellData()->AddArray(vector_array("force", outline.force));
        put_instant(data->GetFieldData(), frame);
        put_field(data->GetFieldData(), "wall_names", names);
        put_provenance(data->GetFieldData(), provenance);
        bytes = encode<vtkXMLPolyDataWriter>(data, path, session);
    }
    write_file(path, bytes);
}

void write_contacts(const std::filesystem::path& path,
                    const ContactFrame& frame,
                    const Provenance& provenance) {
    std::string bytes;
    {
        const VtkSession session;
        std::vector<Vec3> ends;
        vtkNew<vtkCellArray> lines;
        for (std::size_t k = 0; k < frame.i_id.size(); ++k) {
            const auto first = static_cast<vtkIdType>(ends.size());
            lines->InsertNextCell({first, first + 1});
            ends.push_back(frame.i_position[k]);
            ends.push_back(frame.j_position[k]);
        }
        vtkNew<vtkPolyData> data;
        data->SetPoints(make_points(ends));
        data->SetLines(lines);
        vtkCellData* arrays = data->GetCellData();
        arrays->AddArray(float_array("overlap", frame.overlap));
        arrays->AddArray(float_array("force_normal", frame.force_normal));
        arrays->AddArray(float_array("force_tangential", frame.force_tangential));
        arrays->AddArray(int64_array("i_id", frame.i_id));
        arrays->AddArray(int64_array("j_id", frame.j_id));
        arrays->AddArray(int32_array("wall", frame.wall));
        arrays->AddArray(vector_array("force", frame.force));
        arrays->AddArray(vector_array("branch", frame.branch));
        arrays->AddArray(vector_array("point", frame.point));
        arrays->AddArray(int32_array("i_species", frame.i_species));
        arrays->AddArray(int32_array("j_species", frame.j_species));
        put_instant(data->GetFieldData(), frame);
        put_provenance(data->GetFieldData(), provenance);
        bytes = encode<vtkXMLPolyDataWriter>(data, path, session);
    }
    write_file(path, bytes);
}

void write_fields(const std::filesystem::path& path,
                  const FieldFrame& frame,
                  const Provenance& provenance) {
    std::string bytes;
    {
        const VtkSession session;
        vtkNew<vtkImageData> data;
        data->SetOrigin(frame.low.x, frame.low.y, frame.low.z);
        data->SetSpacing(frame.spacing.x, frame.spacing.y, frame.spacing.z);
        const auto points = [&](std::size_t axis) {
            return static_cast<int>(frame.counts[axis]) + 1;
        };
        data->SetDimensions(points(0), points(1), points(2));
        vtkCellData* arrays = data->GetCellData();
        arrays->AddArray(float_array("density", frame.density));
        arrays->AddArray(float_array("solid_fraction", frame.solid_fraction));
        arrays->AddArray(vector_array("velocity", frame.velocity));
        arrays->AddArray(float_array("granular_temperature", frame.granular_temperature));
        arrays->AddArray(float_array("pressure", frame.pressure));
        arrays->AddArray(tensor_array("contact_stress", frame.contact_stress));
        arrays->AddArray(tensor_array("kinetic_stress", frame.kinetic_stress));
        put_instant(data->GetFieldData(), frame);
        put_provenance(data->GetFieldData(), provenance);
        bytes = encode<vtkXMLImageDataWriter>(data, path, session);
    }
    write_file(path, bytes);
}

void write_traces(const std::filesystem::path& path,
                  const TraceTable& traces,
                  const Provenance& provenance) {
    std::string bytes;
    {
        const VtkSession session;
        std::vector<Vec3> positions;
        std::vector<Vec3> velocities;
        std::vector<std::int64_t> ids;
        for (const TracePoint& point : traces.points) {
            positions.push_back(point.position);
            velocities.push_back(point.velocity);
            ids.push_back(point.id);
        }
        vtkNew<vtkCellArray> lines;
        vtkNew<vtkCellArray> single_points;
        for (const auto& [id, rows] : rows_by_particle(traces)) {
            // Filters that make tubes of lines complain about a line of one point.
            vtkCellArray* cells = rows.size() > 1 ? lines.Get() : single_points.Get();
            cells->InsertNextCell(static_cast<vtkIdType>(rows.size()), rows.data());
        }
        vtkNew<vtkPolyData> data;
        data->SetPoints(make_points(positions));
        data->SetVerts(single_points);
        data->SetLines(lines);
        data->GetPointData()->AddArray(double_array("time", traces.time));
        data->GetPointData()->AddArray(vector_array("velocity", velocities));
        data->GetPointData()->AddArray(int64_array("id", ids));
        put_provenance(data->GetFieldData(), provenance);
        bytes = encode<vtkXMLPolyDataWriter>(data, path, session);
    }
    write_file(path, bytes);
}

void convert_particles(const std::filesystem::path& vtu, const std::filesystem::path& vtp) {
    std::string bytes;
    {
        const VtkSession session;
        vtkNew<vtkXMLUnstructuredGridReader> reader;
        vtkUnstructuredGrid* grid = load(reader.Get(), vtu, session);
        vtkNew<vtkPolyData> data;
        data->SetPoints(grid->GetPoints());
        data->SetVerts(vertex_cells(static_cast<std::size_t>(grid->GetNumberOfPoints())));
        data->GetPointData()->ShallowCopy(grid->GetPointData());
        data->GetFieldData()->ShallowCopy(grid->GetFieldData());
        bytes = encode<vtkXMLPolyDataWriter>(data, vtp, session);
    }
    write_file(vtp, bytes);
}

}  // namespace grainbench::io
