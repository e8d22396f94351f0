/// Reads a VTK file or says which file is damaged. Private to io: this header shows VTK.
#pragma once

#include "core/error.hpp"

#include "io/atomic_file.hpp"
#include "io/vtk/session.hpp"
#include "io/vtk/xml_seal.hpp"

#include <exception>
#include <filesystem>
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
    // Read here first: VTK does not tell a missing file from a damaged one.
    if (!seal_fits(read_file(path))) {
        throw_damaged(path, "its bytes differ from those that were written");
    }
    try {
        reader->SetFileName(path.c_str());
        reader->Update();
    } catch (const std::exception& failure) {  // bad_alloc, length_error: sizes out of reason
        throw_damaged(path, failure.what());
    }
    if (!session.error().empty() || reader->GetErrorCode() != 0) {
        throw_damaged(path, session.error().empty() ? "VTK gives no reason" : session.error());
    }
    return reader->GetOutput();
}

}  // namespace grainbench::io
