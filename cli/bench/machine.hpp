/// What the machine can do at best: the roof of the roofline in `grainbench bench`.
#pragma once

#include <cstddef>
#include <string_view>

namespace grainbench::cli {

/// The loops of one instruction set.
struct MachineLoops {
    void (*triad)(double* a, const double* b, const double* c, std::size_t count);
    double (*multiply_add)(std::size_t rounds);
    double operations_per_round;  ///< floating-point operations
};

struct MachineSpeed {
    double bandwidth = 0.0;  ///< [B/s] of a triad, counting 24 bytes per element
    double peak = 0.0;       ///< [1/s] floating-point operations, a multiply-add counting two
};

/// Best of several tries on one core.
/// \param isa as Simulation::isa() names it
/// \param working_set [B] that the three columns of the triad take together
MachineSpeed measure_speed(std::string_view isa, double working_set);

}  // namespace grainbench::cli
