/// A sum over the bytes of a VTK file, in a comment behind its last element. VTK crashes on some
/// damaged files, so damage has to be found before VTK sees it. Other programs skip the comment.
#pragma once

#include <string>

namespace grainbench::io {

void seal_xml(std::string& bytes);

/// False if the file has a seal that does not fit; true for files without one, as others write
/// them.
bool seal_fits(const std::string& bytes);

}  // namespace grainbench::io
