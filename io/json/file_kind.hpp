/// What a file is handed in for, told by its "format". Internal to io and the layers above it.
#pragma once

#include "io/json/document.hpp"

#include <string_view>

namespace grainbench::io {

/// Throws Error(bad_input) if the document is of another kind than the format asked for and says
/// so itself: its keys would make a long list of unknown ones. Other versions pass.
void refuse_other_kinds(const Document& document, std::string_view format);

}  // namespace grainbench::io
