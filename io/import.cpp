#include "io/import.hpp"

#include "core/error.hpp"

#include "io/csv_table.hpp"
#include "io/vtk/foreign_reader.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <string_view>
#include <tuple>

namespace grainbench::io {
namespace {

std::string extension_of(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) {
        return static_cast<char>(std::tolower(c));
    });
    return extension;
}

/// A scene may name any file that its user may read, but no device or pipe: those have no end, or
/// wait for ever.
void check_regular(const std::filesystem::path& path) {
    std::error_code error;
    if (std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error)) {
        throw_bad_input({.what = "this is no ordinary file",
                         .where = path.string(),
                         .likely_cause = "a folder, a device or a pipe",
                         .next_step = "name a file, or write what the pipe gives to one first"});
    }
}

// --- particles -----------------------------------------------------------------------------------

constexpr std::string_view species_column = "species";

/// Where a number of a row goes.
double* member_of(FileInsertion::Row& row, std::string_view name) {
    const std::array<std::pair<std::string_view, double*>, 10> members{
        {{"x", &row.position.x},
         {"y", &row.position.y},
         {"z", &row.position.z},
         {"radius", &row.radius},
         {"vx", &row.velocity.x},
         {"vy", &row.velocity.y},
         {"vz", &row.velocity.z},
         {"wx", &row.angular_velocity.x},
         {"wy", &row.angular_velocity.y},
         {"wz", &row.angular_velocity.z}}};
    const auto found = std::find_if(
        members.begin(), members.end(), [&](const auto& member) { return member.first == name; });
    return found == members.end() ? nullptr : found->second;
}

void check_header(const CsvTable& table) {
    const auto has = [&](std::string_view name) {
        return std::count(table.header.cells.begin(), table.header.cells.end(), name);
    };
    FileInsertion::Row row;
    for (const std::string& name : table.header.cells) {
        if (name != species_column && member_of(row, name) == nullptr) {
            throw_bad_input({.what = "unknown column '" + name + "'",
                             .where = table.place(table.header),
                             .likely_cause = "a typing error, or a file without a header line",
                             .next_step = "use x,y,z and, if needed, radius,vx,vy,vz,wx,wy,wz,"
                                          "species; delete other columns"});
        }
        if (has(name) > 1) {
            throw_bad_input({.what = "the column '" + name + "' is there twice",
                             .where = table.place(table.header),
                             .likely_cause = "a copying error",
                             .next_step = "delete one of them"});
        }
    }
    for (const std::string_view name : {"x", "y", "z"}) {
        if (has(name) == 0) {
            throw_bad_input({.what = "the column '" + std::string(name) + "' is missing",
                             .where = table.place(table.header),
                             .likely_cause = "other column names, or a file without a header line",
                             .next_step = "begin the file with a line such as x,y,z,radius"});
        }
    }
}

std::vector<FileInsertion::Row> read_csv_particles(const std::filesystem::path& path,
                                                   const std::string& default_species) {
    const CsvTable table = read_csv(path);
    check_header(table);
    std::vector<FileInsertion::Row> rows;
    for (const CsvRow& cells : table.rows) {
        FileInsertion::Row row;
        row.species = default_species;
        for (std::size_t k = 0; k < table.header.cells.size(); ++k) {
            const std::string& name = table.header.cells[k];
            if (name != species_column) {
                *member_of(row, name) = table.number(cells, k);
            } else if (!cells.cells[k].empty()) {
                row.species = cells.cells[k];
            }
            if (name == "radius") {
                check_radius(row.radius, table.place(cells));
            }
        }
        rows.push_back(std::move(row));
    }
    return rows;
}

std::vector<FileInsertion::Row> read_vtp_particles(const std::filesystem::path& path,
                                                   const std::string& default_species) {
    std::vector<FileInsertion::Row> rows = read_point_rows(path);
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const std::string place = path.string() + ", point " + std::to_string(k + 1);
        FileInsertion::Row& row = rows[k];
        if (row.species.empty()) {
            row.species = default_species;
        }
        if (!is_finite(row.position) || !is_finite(row.velocity) ||
            !is_finite(row.angular_velocity)) {
            throw_bad_input({.what = "a position, velocity or angular velocity is not finite",
                             .where = place,
                             .likely_cause = "a fault of the program that wrote the file",
                             .next_step = "delete the point or correct it"});
        }
    }
    return rows;
}

// --- meshes --------------------------------------------------------------------------------------

/// Joins points that coincide to the bit; the first of them fixes the number of the vertex.
class VertexMerger {
public:
    explicit VertexMerger(std::vector<Vec3>& vertices) : vertices_(&vertices) {}

    Index number_of(const Vec3& point) {
        // -0.0 + 0.0 is 0.0, which makes the two zeros one point.
        const Vec3 vertex{point.x + 0.0, point.y + 0.0, point.z + 0.0};
        const auto [entry, is_new] = numbers_.try_emplace(std::tuple{vertex.x, vertex.y, vertex.z},
                                                          static_cast<Index>(vertices_->size()));
        if (is_new) {
            vertices_->push_back(vertex);
        }
        return entry->second;
    }

private:
    std::vector<Vec3>* vertices_;
    std::map<std::tuple<double, double, double>, Index> numbers_;
};

/// True if the height of a triangle vanishes against its longest edge in double precision.
bool is_degenerate(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double longest = std::max({norm(b - a), norm(c - b), norm(a - c)});
    return !(norm(cross(b - a, c - a)) > 1e-12 * longest * longest);
}

void check_corner(const Vec3& corner, const std::string& place) {
    if (!is_finite(corner)) {
        throw_bad_input({.what = "a corner of a triangle is not finite",
                         .where = place,
                         .likely_cause = "a damaged file",
                         .next_step = "export the mesh again"});
    }
}

}  // namespace

std::vector<FileInsertion::Row> read_particles(const std::filesystem::path& path,
                                               const std::string& default_species) {
    check_regular(path);
    const std::string extension = extension_of(path);
    if (extension == ".csv") {
        return read_csv_particles(path, default_species);
    }
    if (extension == ".vtp") {
        return read_vtp_particles(path, default_species);
    }
    throw_bad_input({.what = "particles cannot be read from a '" + extension + "' file",
                     .where = path.string(),
                     .likely_cause = "another format, or a name without its ending",
                     .next_step = "give a .csv or a .vtp file"});
}

void read_mesh(const std::filesystem::path& path,
               double scale,
               std::vector<Vec3>& vertices,
               std::vector<std::array<Index, 3>>& triangles) {
    const std::string extension = extension_of(path);
    if (extension != ".stl" && extension != ".vtp") {
        throw_bad_input({.what = "a mesh cannot be read from a '" + extension + "' file",
                         .where = path.string(),
                         .likely_cause = "another format, or a name without its ending",
                         .next_step = "give an .stl or a .vtp file"});
    }
    check_regular(path);
    const std::vector<std::array<Vec3, 3>> corners =
        extension == ".stl" ? read_stl_triangles(path) : read_vtp_triangles(path);
    vertices.clear();
    triangles.clear();
    VertexMerger merger(vertices);
    for (const std::array<Vec3, 3>& triangle : corners) {
        const std::string place =
            path.string() + ", triangle " + std::to_string(triangles.size() + 1);
        std::array<Index, 3> numbers{};
        for (std::size_t k = 0; k < 3; ++k) {
            check_corner(triangle[k], place);
            numbers[k] = merger.number_of(scale * triangle[k]);
        }
        if (is_degenerate(vertices[numbers[0]], vertices[numbers[1]], vertices[numbers[2]])) {
            throw_bad_input(
                {.what = "a triangle has no area",
                 .where = place,
                 .likely_cause = "a mesh that was not cleaned",
                 .next_step = "remove degenerate triangles in the program that made it"});
        }
        triangles.push_back(numbers);
    }
}

}  // namespace grainbench::io
