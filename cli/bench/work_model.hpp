/// How many bytes and floating-point operations a particle-step needs at least, by a model of what
/// each pass touches and computes (share/doc/performance.md, The roofline).
#pragma once

#include "core/scene.hpp"

namespace grainbench::cli {

/// What happens in a scene; all per particle and cycle where not said otherwise.
struct WorkCounts {
    double particles = 0.0;
    double touching = 0.0;    ///< contacts, walls included
    double loaded = 0.0;      ///< fraction of the particles that touch anything
    double objects = 0.0;     ///< contact objects, walls included; lists may hold more
    double candidates = 0.0;  ///< pairs in the candidate list
    double renewals = 0.0;    ///< of the contact objects, per cycle
    double builds = 0.0;      ///< of the candidates, per cycle
};

struct Work {
    double bytes = 0.0;        ///< per particle-step, each packet counted once for each pass
    double operations = 0.0;   ///< per particle-step; a division or root counts as one
    double working_set = 0.0;  ///< [B] of the whole scene
};

/// \param contact laws of the stage that is timed
/// \param automatic_step whether sums for the stable step are kept
Work work_of(const WorkCounts& counts, const Contact& contact, bool automatic_step);

}  // namespace grainbench::cli
