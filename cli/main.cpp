#include "cli/program.hpp"

#include <malloc.h>
#include <unistd.h>

#include <iostream>

int main(int count, char** arguments) {
    // What is as large as a column goes back to the system when it is freed. Without this, the C
    // library keeps ever larger holes for later, a fifth of the memory of a run that writes.
    constexpr int large = 1 << 20;  // bytes
    mallopt(M_MMAP_THRESHOLD, large);
    const grainbench::cli::Streams streams{
        .out = std::cout, .err = std::cerr, .err_is_terminal = isatty(STDERR_FILENO) == 1};
    return grainbench::cli::run_program({arguments + 1, arguments + count}, streams);
}
