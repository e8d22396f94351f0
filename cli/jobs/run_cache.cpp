#include "cli/jobs/run_cache.hpp"

#include "io/atomic_file.hpp"
#include "io/json/scene_json.hpp"
#include "io/run_folder.hpp"
#include "io/text.hpp"

#include "cli/build_info.hpp"

#include <fmt/format.h>

namespace grainbench::cli {
namespace {

std::string program_identity() {
    const BuildInfo build = build_info();
    const bool is_known = build.git_hash != "unknown" && !build.git_hash.ends_with("-dirty");
    return fmt::format("{} {} {}",
                       build.version,
                       build.git_hash,
                       is_known ? "" : io::to_hex(io::fnv1a(io::read_file("/proc/self/exe"))));
}

}  // namespace

std::filesystem::path RunCache::folder_of(const Scene& scene,
                                          const std::filesystem::path& directory,
                                          bool timed) const {
    static const std::string program = program_identity();
    const std::string json = io::write_scene(scene, std::filesystem::current_path() / directory);
    std::string identity = program + " " + io::scene_hash(json, scene);
    if (timed) {
        identity += " timed on " + cpu_model();
    }
    return root_ / io::to_hex(io::fnv1a(identity));
}

std::optional<io::Manifest> RunCache::ended(const std::filesystem::path& folder) {
    const std::filesystem::path file = folder / "manifest.json";
    if (!io::file_exists(file)) {
        return std::nullopt;
    }
    io::Manifest manifest = io::read_manifest(file);
    if (manifest.outcome == "interrupted") {
        return std::nullopt;
    }
    return manifest;
}

}  // namespace grainbench::cli
