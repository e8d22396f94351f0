#include "cli/program.hpp"

#include <unistd.h>

#include <iostream>

int main(int count, char** arguments) {
    const grainbench::cli::Streams streams{
        .out = std::cout, .err = std::cerr, .err_is_terminal = isatty(STDERR_FILENO) == 1};
    return grainbench::cli::run_program({arguments + 1, arguments + count}, streams);
}
