// VTP files of other programs: every way to write their arrays, and every lie about sizes that
// VTK's own reader believed (the fuzzer found the first of them; tests/fuzz/corpus/vtp keeps its
// files).
#include "io/atomic_file.hpp"
#include "io/import.hpp"

#include "tests/unit/io/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataWriter.h>

namespace grainbench::io {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::SizeIs;
using testing::StartsWith;

constexpr int point_count = 12;

/// Points on two rows, a strip of ten triangles between them and a quadrangle.
vtkSmartPointer<vtkPolyData> some_polygons() {
    auto data = vtkSmartPointer<vtkPolyData>::New();
    vtkNew<vtkPoints> points;
    vtkNew<vtkFloatArray> velocity;
    velocity->SetName("velocity");
    velocity->SetNumberOfComponents(3);
    vtkNew<vtkDoubleArray> radius;
    radius->SetName("radius");
    vtkNew<vtkIntArray> species;
    species->SetName("species");
    std::vector<vtkIdType> strip;
    for (int k = 0; k < point_count; ++k) {
        points->InsertNextPoint(0.5 * (k / 2), k % 2, 0.0);
        velocity->InsertNextTuple3(0.25 * k, -k, 3.0);
        radius->InsertNextValue(1.0 / (k + 3));
        species->InsertNextValue(k % 2);
        strip.push_back(k);
    }
    data->SetPoints(points);
    data->GetPointData()->AddArray(velocity);
    data->GetPointData()->AddArray(radius);
    data->GetPointData()->AddArray(species);
    vtkNew<vtkStringArray> names;
    names->SetName("species_names");
    names->InsertNextValue("glass");
    names->InsertNextValue("st\xC3\xA4hle");
    data->GetFieldData()->AddArray(names);
    vtkNew<vtkCellArray> strips;
    strips->InsertNextCell(point_count, strip.data());
    data->SetStrips(strips);
    vtkNew<vtkCellArray> polygons;
    const std::array<vtkIdType, 4> corners{0, 2, 3, 1};
    polygons->InsertNextCell(4, corners.data());
    data->SetPolys(polygons);
    return data;
}

void expect_same(const std::filesystem::path& path) {
    const std::vector<FileInsertion::Row> rows = read_particles(path, "sand");
    ASSERT_EQ(rows.size(), std::size_t{point_count});
    for (int k = 0; k < point_count; ++k) {
        const FileInsertion::Row& row = rows[static_cast<std::size_t>(k)];
        EXPECT_EQ(row.position, (Vec3{0.5 * (k / 2), static_cast<double>(k % 2), 0.0}));
        EXPECT_EQ(row.velocity, (Vec3{0.25 * k, static_cast<double>(-k), 3.0}));
        // As text a number has eleven digits.
        EXPECT_NEAR(row.radius, 1.0 / (k + 3), 1e-10);
        EXPECT_EQ(row.species, k % 2 == 0 ? "glass" : "st\xC3\xA4hle");
    }
    std::vector<Vec3> vertices;
    std::vector<std::array<Index, 3>> triangles;
    read_mesh(path, 1.0, vertices, triangles);
    EXPECT_THAT(vertices, SizeIs(point_count));
    EXPECT_THAT(triangles, SizeIs(2 + point_count - 2));
}

TEST(Vtp, IsReadHoweverItsArraysAreWritten) {
    const TemporaryFolder folder;
    vtkNew<vtkXMLPolyDataWriter> writer;
    const vtkSmartPointer<vtkPolyData> data = some_polygons();
    writer->SetInputData(data);
    writer->SetBlockSize(32);  // bytes; several blocks for each array
    for (const int mode : {vtkXMLWriter::Ascii, vtkXMLWriter::Binary, vtkXMLWriter::Appended}) {
        for (const int encoded : {0, 1}) {
            for (const int compressor :
                 {vtkXMLWriter::NONE, vtkXMLWriter::ZLIB, vtkXMLWriter::LZ4, vtkXMLWriter::LZMA}) {
                for (const int order : {vtkXMLWriter::LittleEndian, vtkXMLWriter::BigEndian}) {
                    for (const int header : {vtkXMLWriter::UInt32, vtkXMLWriter::UInt64}) {
                        SCOPED_TRACE(testing::Message()
                                     << "mode " << mode << ", encoded " << encoded
                                     << ", compressor " << compressor << ", order " << order
                                     << ", header " << header);
                        writer->SetDataMode(mode);
                        writer->SetEncodeAppendedData(encoded);
                        writer->SetCompressorType(compressor);
                        writer->SetByteOrder(order);
                        writer->SetHeaderType(header);
                        writer->SetFileName((folder / "data.vtp").c_str());
                        ASSERT_EQ(writer->Write(), 1);
                        expect_same(folder / "data.vtp");
                    }
                }
            }
        }
    }
}

/// A file of one piece.
std::string file_of(const std::string& count,
                    const std::string& corners,
                    const std::string& ends,
                    const std::string& more = "") {
    return R"(<VTKFile type="PolyData" byte_order="LittleEndian"><PolyData>)" + more +
           R"(<Piece NumberOfPoints=")" + count +
           R"("><Points><DataArray type="Float64" NumberOfComponents="3">)"
           "0 0 0  1 0 0  +0.5 1e0 0</DataArray></Points>"
           R"(<Polys><DataArray type="Int64" Name="connectivity">)" +
           corners + R"(</DataArray><DataArray type="Int64" Name="offsets">)" + ends +
           "</DataArray></Polys></Piece></PolyData></VTKFile>";
}

std::string mesh_error(const std::string& bytes) {
    const TemporaryFolder folder;
    write_file(folder / "m.vtp", bytes);
    std::vector<Vec3> vertices;
    std::vector<std::array<Index, 3>> triangles;
    return error_of([&] { read_mesh(folder / "m.vtp", 1.0, vertices, triangles); });
}

TEST(Vtp, JoinsItsPieces) {
    const TemporaryFolder folder;
    const std::string one = file_of("3", "0 1 2", "3");
    const std::string piece =
        R"(<Piece NumberOfPoints="3"><Points><DataArray type="Float64" NumberOfComponents="3">)"
        "0 0 7  1 0 7  0 1 7</DataArray></Points>"
        R"(<Polys><DataArray type="Int64" Name="connectivity">2 1 0</DataArray>)"
        R"(<DataArray type="Int64" Name="offsets">3</DataArray></Polys></Piece>)";
    write_file(folder / "m.vtp", file_of("3", "0 1 2", "3", piece));
    std::vector<Vec3> vertices;
    std::vector<std::array<Index, 3>> triangles;
    read_mesh(folder / "m.vtp", 1.0, vertices, triangles);
    ASSERT_THAT(triangles, SizeIs(2));
    EXPECT_EQ(vertices.at(triangles[0][0]), (Vec3{0, 1, 7}));
    EXPECT_EQ(vertices.at(triangles[1][2]), (Vec3{0.5, 1, 0}));
}

TEST(Vtp, LiesAboutSizesAreBadInput) {
    ASSERT_EQ(mesh_error(file_of("3", "0 1 2", "3")), "nothing thrown");
    const std::string corner = "corner that is no point";
    const std::string size = "unexpected size";
    const std::string many = "more corners than there are";
    for (const auto& [bytes, reason] :
         {std::pair{file_of("3", "0 1 3", "3"), corner},
          {file_of("3", "0 1 -1", "3"), corner},
          {file_of("3", "0 1 nan", "3"), corner},
          {file_of("3", "0 1 2", "4"), many},
          {file_of("3", "0 1 2", "1e300"), many},
          {file_of("3", "0 1 2 0 1 2", "6 3"), std::string("fewer than three")},
          {file_of("4", "0 1 2", "3"), size},
          {file_of("18446744073709551615", "0 1 2", "3"), size},
          {file_of("-3", "0 1 2", "3"), std::string("no count")}}) {
        EXPECT_THAT(mesh_error(bytes), AllOf(StartsWith("bad input: "), HasSubstr(reason)))
            << bytes;
    }
}

/// A file whose points are packed by zlib in one block; the words of its header are the argument.
std::string packed(std::vector<std::uint32_t> header) {
    std::string bytes =
        R"(<VTKFile type="PolyData" byte_order="LittleEndian" compressor="vtkZLibDataCompressor">)"
        R"(<PolyData><Piece NumberOfPoints="1"><Points><DataArray type="Float32" format="appended")"
        R"( NumberOfComponents="3" offset="0"/></Points></Piece></PolyData>)"
        R"(<AppendedData encoding="raw">_)";
    for (const std::uint32_t word : header) {
        bytes.append(reinterpret_cast<const char*>(&word), sizeof word);
    }
    // Three times 0.0, by compress().
    bytes.append("\x78\x9c\x63\x60\x40\x00\x00\x00\x0c\x00\x01", 11);
    return bytes + "</AppendedData></VTKFile>";
}

TEST(Vtp, LiesAboutBlocksAreBadInput) {
    const TemporaryFolder folder;
    const auto error_with = [&](const std::vector<std::uint32_t>& header) {
        write_file(folder / "p.vtp", packed(header));
        return error_of([&] { read_particles(folder / "p.vtp", "sand"); });
    };
    ASSERT_EQ(error_with({1, 12, 0, 11}), "nothing thrown");
    ASSERT_EQ(error_with({1, 99, 12, 11}), "nothing thrown");  // the last block is shorter
    constexpr std::uint32_t huge = 0xffffffffU;
    for (const auto& [header, reason] :
         {std::pair{std::vector<std::uint32_t>{1, 0, 0, 11}, std::string("unexpected size")},
          {{1, 24, 0, 11}, "cannot be decompressed"},
          {{1, huge, 0, 11}, "far larger than it can be"},
          {{1, 12, huge, 11}, "far larger than it can be"},
          {{1, 12, 0, huge}, "ends too early"},
          {{2, 12, 0, huge, huge}, "ends too early"},
          {{huge, 12, 0, 11}, "more blocks than the file could hold"}}) {
        EXPECT_THAT(error_with(header), AllOf(StartsWith("bad input: "), HasSubstr(reason)));
    }
}

}  // namespace
}  // namespace grainbench::io
