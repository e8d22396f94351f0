#include "core/verify/recurrence.hpp"

#include <algorithm>
#include <cmath>

namespace grainbench::verify {

void BounceRecurrence::step(double dt) {
    velocity += (force / mass - gravity) * (0.5 * (timestep + dt));  // (1)
    height += velocity * dt;
    timestep = dt;
    force = 0.0;
    if (touches()) {
        force = stiffness * (radius - height) -
                2.0 * damping * std::sqrt(mass * stiffness) * velocity;  // (2)
        force = tension ? force : std::max(force, 0.0);
    }
}

}  // namespace grainbench::verify
