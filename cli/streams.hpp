/// Where a command writes: data to `out`, talk to `err`.
#pragma once

#include <ostream>

namespace grainbench::cli {

struct Streams {
    std::ostream& out;
    std::ostream& err;
    bool err_is_terminal = false;  ///< a line may be drawn over
};

}  // namespace grainbench::cli
