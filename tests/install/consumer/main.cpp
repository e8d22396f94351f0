// Uses the installed package as a stranger would: prints the peak speed of the example's shaking.
#include "core/scene.hpp"
#include "core/version.hpp"

#include <algorithm>
#include <cstdio>

int main() {
    const grainbench::SmoothedSquareMotion shaking{.frequency = 10.0, .amplitude = 0.35};
    const auto table = grainbench::smoothed_square_table(shaking.frequency, shaking.amplitude);
    double peak = 0.0;
    for (const auto& [time, speed] : table) {
        peak = std::max(peak, speed);
    }
    std::printf(
        "grainbench %s: %zu nodes, peak %.2f m/s\n", grainbench::version, table.size(), peak);
}
