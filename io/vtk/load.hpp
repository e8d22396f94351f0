/// Reads a VTK file or says which file is damaged. Private to io: this header shows VTK.
#pragma once

#include "core/error.hpp"

#include "io/atomic_file.hpp"
#include "io/vtk/session.hpp"

#include <filesystem>
#include <new>
#include <string>

namespace grainbench::io {

[[noreturn]] inline void throw_damaged(const std::filesystem::path& path,
                                       const std::string& reason) {
    throw_input_output({.what = "cannot read a VTK file: " + reason,
                        .where = path.string(),
                        .likely_cause = "the file is damaged, or another program wrote it",
                        .next_step = "write the file anew"});
}

/// Output of a VTK reader; it belongs to the reader.
template <class Reader>
auto* load(Reader* reader, const std::filesystem::path& path, const VtkSession& session) {
    if (!file_exists(path)) {
        throw_input_output({.what = "cannot read a VTK file: it does not exist",
                            .where = path.string(),
                            .likely_cause = "a part of the path is misspelt",
                            .next_step = "check the path"});
    }
    try {
        reader->SetFileName(path.c_str());
        reader->Update();
    } catch (const std::bad_alloc&) {
        throw_damaged(path, "it asks for more memory than there is");
    }
    if (!session.error().empty() || reader->GetErrorCode() != 0) {
        throw_damaged(path, session.error().empty() ? "VTK gives no reason" : session.error());
    }
    return reader->GetOutput();
}

}  // namespace grainbench::io
