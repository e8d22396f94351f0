#include "io/atomic_file.hpp"
#include "io/vtk/frame_reader.hpp"
#include "io/vtk/frame_writer.hpp"
#include "io/vtk/pvd.hpp"

#include "tests/unit/io/frames.hpp"
#include "tests/unit/io/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

namespace grainbench::io {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

/// What VTK itself finds in a file.
template <class Reader, class Data>
vtkSmartPointer<Data> vtk_read(const std::filesystem::path& path) {
    vtkNew<Reader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    EXPECT_EQ(reader->GetErrorCode(), 0U);
    return reader->GetOutput();
}

auto vtk_read_vtu(const std::filesystem::path& path) {
    return vtk_read<vtkXMLUnstructuredGridReader, vtkUnstructuredGrid>(path);
}

auto vtk_read_vtp(const std::filesystem::path& path) {
    return vtk_read<vtkXMLPolyDataReader, vtkPolyData>(path);
}

/// "name type components tuples" of each array.
std::vector<std::string> summary_of(vtkFieldData* arrays) {
    std::vector<std::string> lines;
    for (int k = 0; k < arrays->GetNumberOfArrays(); ++k) {
        vtkAbstractArray* array = arrays->GetAbstractArray(k);
        lines.push_back(std::string(array->GetName()) + " " + array->GetDataTypeAsString() + " " +
                        std::to_string(array->GetNumberOfComponents()) + " " +
                        std::to_string(array->GetNumberOfTuples()));
    }
    return lines;
}

std::vector<std::string> particle_arrays(const std::string& count) {
    return {"id long long 1 " + count,
            "radius float 1 " + count,
            "diameter float 1 " + count,
            "species int 1 " + count,
            "group int 1 " + count,
            "layer int 1 " + count,
            "current_layer int 1 " + count,
            "velocity float 3 " + count,
            "angular_velocity float 3 " + count,
            "force float 3 " + count,
            "contacts int 1 " + count};
}

std::string text_field(vtkFieldData* fields, const char* name) {
    auto* array = vtkStringArray::SafeDownCast(fields->GetAbstractArray(name));
    return array == nullptr ? "(absent)" : array->GetValue(0);
}

void expect_same(const ParticleFrame& a, const ParticleFrame& b) {
    EXPECT_EQ(a.time, b.time);
    EXPECT_EQ(a.cycle, b.cycle);
    EXPECT_EQ(a.id, b.id);
    EXPECT_EQ(a.position, b.position);
    EXPECT_EQ(a.radius, b.radius);
    EXPECT_EQ(a.species, b.species);
    EXPECT_EQ(a.group, b.group);
    EXPECT_EQ(a.layer, b.layer);
    EXPECT_EQ(a.current_layer, b.current_layer);
    EXPECT_EQ(a.velocity, b.velocity);
    EXPECT_EQ(a.angular_velocity, b.angular_velocity);
    EXPECT_EQ(a.force, b.force);
    EXPECT_EQ(a.contacts, b.contacts);
    EXPECT_EQ(a.orientation, b.orientation);
}

TEST(ParticleFile, HoldsTheArraysThatUsersRelyOn) {
    const TemporaryFolder folder;
    write_particles(folder / "p.vtu", some_particles(5), some_provenance());
    const auto grid = vtk_read_vtu(folder / "p.vtu");
    EXPECT_EQ(summary_of(grid->GetPointData()), particle_arrays("5"));
    ASSERT_EQ(grid->GetNumberOfCells(), 5);
    for (vtkIdType k = 0; k < 5; ++k) {
        EXPECT_EQ(grid->GetCellType(k), VTK_VERTEX);
    }
    EXPECT_EQ(grid->GetPointData()->GetArray("diameter")->GetRange()[1], 3.0);
    EXPECT_EQ(grid->GetBounds()[1], 1.0);
    EXPECT_EQ(grid->GetBounds()[4], -1.0);
}

TEST(ParticleFile, HeaderNamesTheEncodingThatParaViewReads) {
    const TemporaryFolder folder;
    write_particles(folder / "p.vtu", some_particles(5), some_provenance());
    const std::string bytes = read_file(folder / "p.vtu");
    EXPECT_THAT(bytes,
                AllOf(StartsWith("<VTKFile type=\"UnstructuredGrid\""),
                      HasSubstr("header_type=\"UInt64\""),
                      HasSubstr("compressor=\"vtkZLibDataCompressor\""),
                      HasSubstr("<AppendedData encoding=\"raw\">"),
                      HasSubstr("type=\"Int64\" Name=\"connectivity\" format=\"appended\""),
                      HasSubstr("type=\"Int64\" Name=\"offsets\" format=\"appended\"")));
}

TEST(ParticleFile, HoldsTimeAndProvenance) {
    const TemporaryFolder folder;
    write_particles(folder / "p.vtu", some_particles(1), some_provenance());
    const auto grid = vtk_read_vtu(folder / "p.vtu");
    vtkFieldData* fields = grid->GetFieldData();
    EXPECT_EQ(fields->GetArray("TimeValue")->GetComponent(0, 0), 0.1);
    EXPECT_EQ(fields->GetArray("cycle")->GetComponent(0, 0), 1234567890123.0);
    EXPECT_EQ(fields->GetArray("seed")->GetComponent(0, 0), 10001.0);
    EXPECT_EQ(text_field(fields, "program"), "grainbench 1.2.3");
    EXPECT_EQ(text_field(fields, "scene_title"), some_provenance().scene_title);
    EXPECT_EQ(text_field(fields, "scene_hash"), "0123456789abcdef");
}

TEST(ParticleFile, ReadsBackTheSame) {
    const TemporaryFolder folder;
    // More than one block of the compressor.
    for (const std::size_t count : {1U, 5U, 20'000U}) {
        write_particles(folder / "p.vtu", some_particles(count), some_provenance());
        expect_same(read_particles_frame(folder / "p.vtu"), some_particles(count));
    }
}

TEST(ParticleFile, HoldsOrientationsWhereTheFrameDoes) {
    const TemporaryFolder folder;
    ParticleFrame frame = some_particles(2);
    frame.orientation = {{1.0, 0.0, 0.0, 0.0}, {0.5, -0.5, 0.5, -0.5}};
    write_particles(folder / "p.vtu", frame, some_provenance());
    const auto grid = vtk_read_vtu(folder / "p.vtu");
    EXPECT_EQ(summary_of(grid->GetPointData()).back(), "orientation float 4 2");
    expect_same(read_particles_frame(folder / "p.vtu"), frame);
}

TEST(ParticleFile, ZeroParticlesKeepTheirArrays) {
    const TemporaryFolder folder;
    write_particles(folder / "p.vtu", some_particles(0), some_provenance());
    write_particles(folder / "p.vtp", some_particles(0), some_provenance());
    EXPECT_EQ(summary_of(vtk_read_vtu(folder / "p.vtu")->GetPointData()), particle_arrays("0"));
    EXPECT_EQ(summary_of(vtk_read_vtp(folder / "p.vtp")->GetPointData()), particle_arrays("0"));
    expect_same(read_particles_frame(folder / "p.vtu"), some_particles(0));
}

TEST(ParticleFile, SameFrameGivesSameBytes) {
    const TemporaryFolder folder;
    write_particles(folder / "a.vtu", some_particles(1000), some_provenance());
    write_particles(folder / "b.vtu", some_particles(1000), some_provenance());
    write_walls(folder / "a.vtp", some_walls(), some_provenance());
    write_walls(folder / "b.vtp", some_walls(), some_provenance());
    EXPECT_EQ(read_file(folder / "a.vtu"), read_file(folder / "b.vtu"));
    EXPECT_EQ(read_file(folder / "a.vtp"), read_file(folder / "b.vtp"));
}

TEST(ParticleFile, NameMayHoldDotsSpacesAndUnicode) {
    const TemporaryFolder folder;
    const auto path = folder / "run 1.5 \xC3\xBC\xE7\xB2\x92.d";
    make_folder(path);
    write_particles(path / "p.0 \xC3\xA9.vtu", some_particles(3), some_provenance());
    expect_same(read_particles_frame(path / "p.0 \xC3\xA9.vtu"), some_particles(3));
}

TEST(ParticleFile, BecomesPolygonalDataWithTheSameArrays) {
    const TemporaryFolder folder;
    write_particles(folder / "p.vtu", some_particles(5), some_provenance());
    convert_particles(folder / "p.vtu", folder / "p.vtp");
    const auto data = vtk_read_vtp(folder / "p.vtp");
    EXPECT_EQ(summary_of(data->GetPointData()), particle_arrays("5"));
    EXPECT_EQ(data->GetNumberOfVerts(), 5);
    EXPECT_EQ(data->GetFieldData()->GetArray("TimeValue")->GetComponent(0, 0), 0.1);
    EXPECT_EQ(text_field(data->GetFieldData(), "program"), "grainbench 1.2.3");
}

TEST(ParticleFile, DamagedOneIsAnErrorThatNamesItAndPrintsNothing) {
    const TemporaryFolder folder;
    write_particles(folder / "p.vtu", some_particles(500), some_provenance());
    const std::string whole = read_file(folder / "p.vtu");
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    for (const double part : {0.0, 0.02, 0.2, 0.6, 0.9}) {
        const auto length = static_cast<std::size_t>(part * static_cast<double>(whole.size()));
        write_file(folder / "p.vtu", whole.substr(0, length));
        EXPECT_THAT(error_of([&] { read_particles_frame(folder / "p.vtu"); }),
                    AllOf(StartsWith("input/output: "), HasSubstr((folder / "p.vtu").string())))
            << "cut at " << part;
    }
    write_walls(folder / "w.vtp", some_walls(), some_provenance());
    EXPECT_THAT(error_of([&] { read_particles_frame(folder / "w.vtp"); }),
                HasSubstr((folder / "w.vtp").string()));
    EXPECT_THAT(error_of([&] { read_particles_frame(folder / "absent.vtu"); }),
                HasSubstr("No such file"));
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(ParticleFile, OneFlippedBitIsFound) {
    const TemporaryFolder folder;
    write_particles(folder / "p.vtu", some_particles(5), some_provenance());
    const std::string whole = read_file(folder / "p.vtu");
    for (std::size_t place = 0; place < whole.size(); place += 101) {
        std::string bytes = whole;
        bytes[place] = static_cast<char>(bytes[place] ^ 1);
        write_file(folder / "p.vtu", bytes);
        EXPECT_THAT(error_of([&] { read_particles_frame(folder / "p.vtu"); }),
                    AllOf(StartsWith("input/output: "), HasSubstr("p.vtu")))
            << "at " << place;
    }
}

TEST(WallFile, ReadsBackTheSame) {
    const TemporaryFolder folder;
    write_walls(folder / "w.vtp", some_walls(), some_provenance());
    const WallFrame expected = some_walls();
    const WallFrame found = read_walls_frame(folder / "w.vtp");
    EXPECT_EQ(found.time, expected.time);
    EXPECT_EQ(found.cycle, expected.cycle);
    ASSERT_EQ(found.walls.size(), 2U);
    for (std::size_t k = 0; k < 2; ++k) {
        EXPECT_EQ(found.walls[k].name, expected.walls[k].name);
        EXPECT_EQ(found.walls[k].points, expected.walls[k].points);
        EXPECT_EQ(found.walls[k].polygons, expected.walls[k].polygons);
        EXPECT_EQ(found.walls[k].velocity, expected.walls[k].velocity);
        EXPECT_EQ(found.walls[k].force, expected.walls[k].force);
    }
    EXPECT_THAT(summary_of(vtk_read_vtp(folder / "w.vtp")->GetCellData()),
                ElementsAre("wall int 1 3", "velocity float 3 3", "force float 3 3"));
}

TEST(WallFile, SceneWithoutWallsGivesAValidFile) {
    const TemporaryFolder folder;
    write_walls(folder / "w.vtp", {}, some_provenance());
    EXPECT_THAT(read_walls_frame(folder / "w.vtp").walls, IsEmpty());
}

TEST(ContactFile, HoldsOneLinePerContact) {
    const TemporaryFolder folder;
    for (const std::size_t count : {0U, 3U}) {
        write_contacts(folder / "c.vtp", some_contacts(count), some_provenance());
        const auto data = vtk_read_vtp(folder / "c.vtp");
        const std::string n = std::to_string(count);
        EXPECT_EQ(data->GetNumberOfLines(), static_cast<vtkIdType>(count));
        EXPECT_THAT(summary_of(data->GetCellData()),
                    ElementsAre("overlap float 1 " + n,
                                "force_normal float 1 " + n,
                                "force_tangential float 1 " + n,
                                "i_id long long 1 " + n,
                                "j_id long long 1 " + n,
                                "wall int 1 " + n,
                                "force float 3 " + n,
                                "branch float 3 " + n,
                                "point float 3 " + n,
                                "i_species int 1 " + n,
                                "j_species int 1 " + n));
        EXPECT_EQ(data->GetFieldData()->GetArray("TimeValue")->GetComponent(0, 0), 0.1);
    }
    const auto data = vtk_read_vtp(folder / "c.vtp");
    EXPECT_EQ(data->GetCellData()->GetArray("force_tangential")->GetRange()[1], 1.5);
    EXPECT_EQ(data->GetBounds()[3], 1.0);
}

TEST(FieldFile, HoldsOneCellPerCellOfTheGrid) {
    const TemporaryFolder folder;
    write_fields(folder / "f.vti", some_fields({3, 1, 2}), some_provenance());
    const auto data = vtk_read<vtkXMLImageDataReader, vtkImageData>(folder / "f.vti");
    ASSERT_EQ(data->GetNumberOfCells(), 6);
    EXPECT_THAT(summary_of(data->GetCellData()),
                ElementsAre("density float 1 6",
                            "solid_fraction float 1 6",
                            "velocity float 3 6",
                            "granular_temperature float 1 6",
                            "pressure float 1 6",
                            "contact_stress float 9 6",
                            "kinetic_stress float 9 6"));
    double bounds[6];
    data->GetBounds(bounds);
    EXPECT_THAT(bounds, ElementsAre(-1.0, 0.5, 2.0, 2.25, 0.5, 4.5));
    // The last cell is the one with the largest coordinates, and x runs first.
    data->GetCellBounds(1, bounds);
    EXPECT_EQ(bounds[0], -0.5);
    EXPECT_EQ(data->GetCellData()->GetArray("density")->GetComponent(5, 0), 1.25);
    EXPECT_EQ(data->GetCellData()->GetArray("contact_stress")->GetComponent(1, 5), 5.0);
    EXPECT_EQ(data->GetFieldData()->GetArray("TimeValue")->GetComponent(0, 0), 0.1);
    EXPECT_EQ(text_field(data->GetFieldData(), "scene_hash"), "0123456789abcdef");
}

TEST(TraceFile, HoldsOnePolylinePerParticle) {
    const TemporaryFolder folder;
    write_traces(folder / "t.vtp", some_traces(2, {0.0, 0.1, 0.2}), some_provenance());
    const auto data = vtk_read_vtp(folder / "t.vtp");
    ASSERT_EQ(data->GetNumberOfLines(), 2);
    EXPECT_THAT(summary_of(data->GetPointData()),
                ElementsAre("time double 1 6", "velocity float 3 6", "id long long 1 6"));
    vtkNew<vtkIdList> line;
    data->GetLines()->GetCellAtId(1, line);
    ASSERT_EQ(line->GetNumberOfIds(), 3);
    for (vtkIdType k = 0; k < 3; ++k) {
        EXPECT_EQ(data->GetPointData()->GetArray("id")->GetComponent(line->GetId(k), 0), 2.0);
        EXPECT_EQ(data->GetPointData()->GetArray("time")->GetComponent(line->GetId(k), 0),
                  0.1 * static_cast<double>(k));
    }
}

TEST(TraceFile, NoPointsAndSinglePointsGiveValidFiles) {
    const TemporaryFolder folder;
    write_traces(folder / "none.vtp", {}, some_provenance());
    EXPECT_THAT(summary_of(vtk_read_vtp(folder / "none.vtp")->GetPointData()),
                ElementsAre("time double 1 0", "velocity float 3 0", "id long long 1 0"));
    write_traces(folder / "one.vtp", some_traces(2, {0.5}), some_provenance());
    EXPECT_EQ(vtk_read_vtp(folder / "one.vtp")->GetNumberOfVerts(), 2);
}

TEST(PvdFile, ReadsBackTimesToTheBitAndNames) {
    const TemporaryFolder folder;
    const std::vector<PvdEntry> entries{{0.0, "particles_000000.vtu"},
                                        {0.1 + 0.2, "a b.c <&\">.vtu"},
                                        {1e-7 / 3.0, "\xC3\xBC\xE7\xB2\x92.vtu"}};
    write_pvd(folder / "p.pvd", entries);
    const std::vector<PvdEntry> found = read_pvd(folder / "p.pvd");
    ASSERT_EQ(found.size(), entries.size());
    for (std::size_t k = 0; k < entries.size(); ++k) {
        EXPECT_EQ(found[k].time, entries[k].time);
        EXPECT_EQ(found[k].file, entries[k].file);
    }
    write_pvd(folder / "p.pvd", {});
    EXPECT_THAT(read_pvd(folder / "p.pvd"), IsEmpty());
}

TEST(PvdFile, DamagedOneIsAnErrorThatNamesItAndPrintsNothing) {
    const TemporaryFolder folder;
    testing::internal::CaptureStderr();
    for (const char* text : {"",
                             "garbage",
                             "<VTKFile><Collection><DataSet timestep=\"1\"",
                             "<VTKFile/>",
                             "<VTKFile><Collection><DataSet file=\"a\"/></Collection></VTKFile>"}) {
        write_file(folder / "p.pvd", text);
        EXPECT_THAT(error_of([&] { read_pvd(folder / "p.pvd"); }),
                    AllOf(StartsWith("input/output: "), HasSubstr((folder / "p.pvd").string())))
            << text;
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace grainbench::io
