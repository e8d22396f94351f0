#include "io/json/scene_json.hpp"

#include "io/import.hpp"
#include "io/json/document.hpp"
#include "io/json/field_check.hpp"
#include "io/json/field_reader.hpp"
#include "io/json/field_writer.hpp"
#include "io/json/file_kind.hpp"
#include "io/json/problems.hpp"
#include "io/json/scene_rules.hpp"

namespace grainbench::io {

namespace {

namespace fs = std::filesystem;

void import_files(Scene& scene, const fs::path& directory) {
    for (Insertion& insertion : scene.particles.insertion) {
        if (auto* file = std::get_if<FileInsertion>(&insertion)) {
            file->imported = read_particles(directory / file->path, file->species);
        }
    }
    for (Wall& wall : scene.walls) {
        if (auto* mesh = std::get_if<MeshFile>(&wall.shape)) {
            mesh->vertices.clear();
            mesh->triangles.clear();
            read_mesh(directory / mesh->path, mesh->scale, mesh->vertices, mesh->triangles);
        }
    }
}

Problems find_problems(const Scene& scene) {
    Problems problems;
    check_domains(scene, Place{}, any_number(), "", problems);
    check_bodies(scene, problems);
    check_contact(scene, scene.contact, "/contact", problems);
    check_procedure(scene, problems);
    return problems;
}

Scene scene_of(const Document& document, const fs::path& directory) {
    refuse_other_kinds(document, Scene::format_name);
    Scene scene;
    Problems problems;
    FieldReader(problems).read_struct(document.json, Place{}, {}, scene);
    problems.raise_if_any(document.name);
    import_files(scene, directory);
    find_problems(scene).raise_if_any(document.name);
    return scene;
}

}  // namespace

Scene read_scene(const fs::path& file, std::span<const std::string> overrides) {
    Document document = load_document(file);
    for (const std::string& assignment : overrides) {
        apply_override(document.json, assignment);
    }
    return scene_of(document, file.parent_path());
}

Scene parse_scene(std::string_view json_text,
                  const fs::path& base_directory,
                  std::string_view name) {
    return scene_of(load_document(json_text, base_directory, std::string(name)), base_directory);
}

std::string write_scene(const Scene& scene, const fs::path& base_directory) {
    Json json = write_value(scene);
    if (!base_directory.empty()) {
        rewrite_paths(json, [&](const std::string& path) {
            return fs::absolute(base_directory / path).lexically_normal().generic_string();
        });
    }
    return pretty_text(json);
}

void validate_scene(const Scene& scene) {
    find_problems(scene).raise_if_any("");
}

}  // namespace grainbench::io
