/// Memory that a scene will take, estimated before anything is built: a slip of the keys in a count
/// must end in a message, not in a machine out of memory.
#pragma once

#include "core/scene.hpp"

#include <string>

namespace grainbench {

struct MemoryNeed {
    double bytes = 0.0;         ///< [bytes] of all realisations
    std::string largest_where;  ///< JSON pointer to what takes most of it
};

MemoryNeed estimate_memory(const Scene& scene);

/// Refuses a scene that needs more than this process may have.
void require_memory(const Scene& scene);

/// The least of the memory of this machine, of its control group, and of the limits of this process
/// [bytes].
double available_memory();

}  // namespace grainbench
