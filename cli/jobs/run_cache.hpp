/// Run folders that are kept and used again. A run is named by what determines it: the hash of the
/// effective scene (with what it imports) and the program, by version and git hash. So a changed
/// scene or program runs anew, an unfinished run goes on, a finished one is there. A build with
/// uncommitted changes counts as the program that its executable is.
///
///     <root>/<sixteen hex digits>/    one run folder each (io/run_folder.hpp)
///
/// Two programs at work in one cache at the same time is more than it can take.
#pragma once

#include "core/scene.hpp"

#include "io/manifest.hpp"

#include <filesystem>
#include <optional>

namespace grainbench::cli {

class RunCache {
public:
    explicit RunCache(std::filesystem::path root) : root_(std::move(root)) {}

    /// Where the run of this scene is, or will be.
    /// \param directory that file names in the scene are relative to
    /// \param timed it is wanted for its times, which are those of this processor and of a run that
    /// had the machine for itself
    std::filesystem::path folder_of(const Scene& scene,
                                    const std::filesystem::path& directory,
                                    bool timed) const;

    /// What a run was that has ended, finished or unstable.
    static std::optional<io::Manifest> ended(const std::filesystem::path& folder);

private:
    std::filesystem::path root_;
};

}  // namespace grainbench::cli
