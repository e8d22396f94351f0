/// Which effects a scene turns on and where it says so, and which of them cannot act. A scene costs
/// only what is listed here.
#pragma once

#include "core/scene.hpp"

#include <string>
#include <vector>

namespace grainbench {

struct Effect {
    std::string name;     ///< key of the law, motion or scheme
    std::string pointer;  ///< place in the scene, as a JSON pointer
};

/// In the order of the scene; an effect named in several places is listed for each.
std::vector<Effect> effects_of(const Scene& scene);

/// Keys of the laws that act in a contact, in the order in which they are evaluated.
std::vector<std::string> laws_of(const Contact& contact);

/// Gap over which the cohesion of these laws acts [m]; names of pairs must be known.
double reach_of(const Scene& scene, const Contact& contact);

/// An effect that is on but changes nothing.
struct IdleEffect {
    std::string pointer;
    std::string reason;
};

std::vector<IdleEffect> idle_effects(const Scene& scene);

}  // namespace grainbench
