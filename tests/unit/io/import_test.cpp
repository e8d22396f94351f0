#include "io/import.hpp"

#include "io/atomic_file.hpp"
#include "io/vtk/frame_writer.hpp"

#include "tests/unit/io/frames.hpp"
#include "tests/unit/io/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

namespace grainbench::io {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

std::string csv_error(const std::string& text) {
    const TemporaryFolder folder;
    write_file(folder / "balls.csv", text);
    return error_of([&] { read_particles(folder / "balls.csv", "glass"); });
}

TEST(CsvParticles, AllColumnsInAnyOrderAreRead) {
    const TemporaryFolder folder;
    write_file(folder / "balls 1.5.csv",
               "\xEF\xBB\xBFspecies, z,y,x,wx,wy,wz,vx,vy,vz,radius\r\n"
               "\r\n"
               "\"steel, \"\"hard\"\"\",3,+2,1e0,4,5,6,7,8,9,0.5\r\n"
               ",-3,-2,-1,0,0,0,0,0,0,.25");
    const auto rows = read_particles(folder / "balls 1.5.csv", "glass");
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_EQ(rows[0].species, "steel, \"hard\"");
    EXPECT_EQ(rows[0].position, (Vec3{1, 2, 3}));
    EXPECT_EQ(rows[0].angular_velocity, (Vec3{4, 5, 6}));
    EXPECT_EQ(rows[0].velocity, (Vec3{7, 8, 9}));
    EXPECT_EQ(rows[0].radius, 0.5);
    EXPECT_EQ(rows[1].species, "glass");
    EXPECT_EQ(rows[1].radius, 0.25);
}

TEST(CsvParticles, AbsentColumnsKeepTheirDefaults) {
    const TemporaryFolder folder;
    write_file(folder / "balls.csv", "x,y,z\n1,2,3\n");
    const auto rows = read_particles(folder / "balls.csv", "glass");
    ASSERT_EQ(rows.size(), 1U);
    EXPECT_EQ(rows[0].species, "glass");
    EXPECT_EQ(rows[0].radius, 0.0);
    EXPECT_EQ(rows[0].velocity, Vec3{});
    write_file(folder / "balls.csv", "x,y,z\n");
    EXPECT_TRUE(read_particles(folder / "balls.csv", "glass").empty());
}

TEST(CsvParticles, BrokenCellsAreNamedByLineAndColumn) {
    for (const char* cell : {"1,5m", "", "nan", "inf", "1e999", "0x10", "1 2", "-"}) {
        EXPECT_THAT(csv_error("x,y,z\n0,0,0\n\n0," + std::string("\"") + cell + "\",0\n"),
                    AllOf(StartsWith("bad input: "), HasSubstr("balls.csv:4"), HasSubstr("'y'")))
            << cell;
    }
    EXPECT_THAT(csv_error("x,y,z,radius\n0,0,0,0\n"),
                AllOf(HasSubstr("balls.csv:2"), HasSubstr("radius")));
}

TEST(CsvParticles, BrokenLinesAreNamed) {
    EXPECT_THAT(csv_error("x,y,z\n0,0,0\n1,2\n"),
                AllOf(HasSubstr("balls.csv:3"), HasSubstr("2 cells"), HasSubstr("header has 3")));
    EXPECT_THAT(csv_error("x,y,z\n\"0,0,0\n"),
                AllOf(HasSubstr("balls.csv:2"), HasSubstr("quotes")));
    EXPECT_THAT(csv_error("x,y\n0,0\n"), AllOf(HasSubstr("balls.csv:1"), HasSubstr("'z'")));
    EXPECT_THAT(csv_error("\nx,y,z,diameter\n"),
                AllOf(HasSubstr("balls.csv:2"), HasSubstr("'diameter'")));
    EXPECT_THAT(csv_error("x,y,z,x\n0,0,0,0\n"), HasSubstr("twice"));
    EXPECT_THAT(csv_error(""), HasSubstr("empty"));
}

TEST(CsvParticles, MissingFileAndUnknownFormatAreToldApart) {
    const TemporaryFolder folder;
    EXPECT_THAT(error_of([&] { read_particles(folder / "a.csv", "glass"); }),
                StartsWith("input/output: "));
    EXPECT_THAT(error_of([&] { read_particles(folder / "a.xlsx", "glass"); }),
                AllOf(StartsWith("bad input: "), HasSubstr("'.xlsx'"), HasSubstr(".csv")));
}

TEST(VtpParticles, OwnFramesCanBeReadBackWithTheirSpecies) {
    const TemporaryFolder folder;
    const ParticleFrame frame = some_particles(3);
    write_particles(folder / "p.vtp", frame, some_provenance());
    const auto rows = read_particles(folder / "p.vtp", "sand");
    ASSERT_EQ(rows.size(), 3U);
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(rows[k].position, frame.position[k]);
        EXPECT_EQ(rows[k].velocity, frame.velocity[k]);
        EXPECT_EQ(rows[k].angular_velocity, frame.angular_velocity[k]);
        EXPECT_EQ(rows[k].radius, frame.radius[k]);
        EXPECT_EQ(rows[k].species, k % 2 == 0 ? "glass" : "steel");
    }
}

TEST(VtpParticles, BrokenOnesAreBadInput) {
    const TemporaryFolder folder;
    ParticleFrame frame = some_particles(3);
    Provenance nameless = some_provenance();
    nameless.species_names.clear();
    write_particles(folder / "p.vtp", frame, nameless);
    EXPECT_THAT(error_of([&] { read_particles(folder / "p.vtp", "sand"); }),
                AllOf(StartsWith("bad input: "), HasSubstr("species_names")));
    frame.radius[1] = -1.0;
    write_particles(folder / "p.vtp", frame, some_provenance());
    EXPECT_THAT(error_of([&] { read_particles(folder / "p.vtp", "sand"); }),
                AllOf(StartsWith("bad input: "), HasSubstr("point 2")));
    write_file(folder / "p.vtp", "garbage");
    EXPECT_THAT(error_of([&] { read_particles(folder / "p.vtp", "sand"); }),
                AllOf(StartsWith("bad input: "), HasSubstr((folder / "p.vtp").string())));
}

// --- meshes --------------------------------------------------------------------------------------

using Corners = std::array<Vec3, 3>;

const std::vector<Corners> square{{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 1, 0}},
                                  {Vec3{-0.0, 0, 0}, Vec3{1, 1, 0}, Vec3{0, 1, 0}}};

std::string text_stl(const std::vector<Corners>& triangles) {
    std::string text = "solid made by hand\n";
    for (const Corners& corners : triangles) {
        text += "facet normal 0 0 1\n outer loop\n";
        for (const Vec3& p : corners) {
            text += "  vertex " + std::to_string(p.x) + " " + std::to_string(p.y) + " " +
                    std::to_string(p.z) + "\n";
        }
        text += " endloop\nendfacet\n";
    }
    return text + "endsolid made by hand\n";
}

std::string binary_stl(const std::vector<Corners>& triangles) {
    std::string bytes = "solid is how many binary files begin";
    bytes.resize(80, ' ');
    const auto put = [&](const auto& value) {
        bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    };
    put(static_cast<std::uint32_t>(triangles.size()));
    for (const Corners& corners : triangles) {
        put(std::array<float, 3>{0, 0, 1});
        for (const Vec3& p : corners) {
            put(std::array<float, 3>{
                static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
        }
        put(std::uint16_t{0});
    }
    return bytes;
}

std::string mesh_error(const std::string& name, const std::string& bytes) {
    const TemporaryFolder folder;
    write_file(folder / name, bytes);
    std::vector<Vec3> vertices;
    std::vector<std::array<Index, 3>> triangles;
    testing::internal::CaptureStderr();
    const std::string error = error_of([&] { read_mesh(folder / name, 1.0, vertices, triangles); });
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    return error;
}

void expect_square(const std::filesystem::path& path) {
    std::vector<Vec3> vertices{{9, 9, 9}};
    std::vector<std::array<Index, 3>> triangles{{9, 9, 9}};
    read_mesh(path, 0.5, vertices, triangles);
    EXPECT_THAT(vertices,
                ElementsAre(Vec3{0, 0, 0}, Vec3{0.5, 0, 0}, Vec3{0.5, 0.5, 0}, Vec3{0, 0.5, 0}));
    EXPECT_THAT(triangles,
                ElementsAre(std::array<Index, 3>{0, 1, 2}, std::array<Index, 3>{0, 2, 3}));
}

TEST(MeshImport, TextAndBinaryStlMergeEqualVerticesAndScale) {
    const TemporaryFolder folder;
    write_file(folder / "text.STL", text_stl(square));
    write_file(folder / "binary 1.5 \xC3\xBC.stl", binary_stl(square));
    expect_square(folder / "text.STL");
    expect_square(folder / "binary 1.5 \xC3\xBC.stl");
}

TEST(MeshImport, VtpPolygonsAreCutIntoTriangles) {
    const TemporaryFolder folder;
    write_walls(folder / "w.vtp", some_walls(), some_provenance());
    std::vector<Vec3> vertices;
    std::vector<std::array<Index, 3>> triangles;
    read_mesh(folder / "w.vtp", 1.0, vertices, triangles);
    EXPECT_EQ(vertices.size(), 8U);
    ASSERT_EQ(triangles.size(), 4U);
    double area = 0.0;
    for (const auto& [a, b, c] : triangles) {
        const Vec3 normal = cross(vertices[b] - vertices[a], vertices[c] - vertices[a]);
        EXPECT_GT(normal.z, 0.0);  // the order of the corners is kept
        area += 0.5 * normal.z;
    }
    EXPECT_EQ(area, 2.0);
}

TEST(MeshImport, DegenerateTriangleIsNamedByNumber) {
    std::vector<Corners> triangles = square;
    triangles.push_back({Vec3{0, 0, 0}, Vec3{1, 1, 0}, Vec3{2, 2, 0}});
    EXPECT_THAT(mesh_error("m.stl", binary_stl(triangles)),
                AllOf(StartsWith("bad input: "), HasSubstr("triangle 3"), HasSubstr("m.stl")));
    triangles[1] = {Vec3{0, 0, 0}, Vec3{0, 0, 0}, Vec3{1, 0, 0}};
    EXPECT_THAT(mesh_error("m.stl", text_stl(triangles)), HasSubstr("triangle 2"));
}

TEST(MeshImport, CutAndForeignFilesAreBadInput) {
    const std::string binary = binary_stl(square);
    const std::string text = text_stl(square);
    for (const std::string& bytes :
         {std::string(),
          std::string("garbage"),
          binary.substr(0, binary.size() - 20),
          binary.substr(0, 60),
          text.substr(0, text.size() / 2),
          text_stl({}),
          binary_stl({}),
          std::string("solid\nfacet normal 0 0 1\nouter loop\nvertex a b c\nendsolid\n")}) {
        EXPECT_THAT(mesh_error("m.stl", bytes), StartsWith("bad input: ")) << bytes;
    }
    // VTK takes a text for binary where many of its first bytes are no ASCII, and then asks for as
    // much memory as four letters of it say.
    std::string cyrillic = text_stl(square);
    for (int k = 0; k < 10; ++k) {
        cyrillic.insert(6, "\xD1\x82\xD0\xB5\xD0\xBB\xD0\xBE ");
    }
    EXPECT_THAT(mesh_error("m.stl", cyrillic),
                AllOf(StartsWith("bad input: "), HasSubstr("not ASCII")));
    EXPECT_THAT(mesh_error("m.vtp", "garbage"), StartsWith("bad input: "));
    EXPECT_THAT(mesh_error("m.obj", text), AllOf(StartsWith("bad input: "), HasSubstr("'.obj'")));
}

}  // namespace
}  // namespace grainbench::io
