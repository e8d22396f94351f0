#include "core/contact/wall_candidates.hpp"

#include <algorithm>

namespace grainbench {

namespace {

/// Particles whose patches are collected by one part of the work.
constexpr Index collected_particles = 4096;

/// Way of a particle, over the smallest radius, for which its candidates are found in advance.
constexpr double spare_per_radius = 1.25;

}  // namespace

void WallCandidates::build(const ListClock& clock,
                           const ParticleState& particles,
                           const WallBody& wall,
                           const Workers& workers) {
    const SearchSettings& settings = clock.settings();
    // Lists that depend on when they were made would show in what a search counts as late.
    const double spare =
        settings.widest > 0.0 ? spare_per_radius * particles.smallest_radius() : 0.0;
    clearances_.resize(particles.size());
    std::vector<PairList> found((particles.size() + collected_particles - 1) / collected_particles);
    workers.for_each(found.size(), [&](std::size_t part) {
        const auto first = static_cast<Index>(part) * collected_particles;
        const Index last = std::min(first + collected_particles, particles.size());
        std::vector<Index> patches;
        Index before = list_.first_of(first);
        for (Index slot = first; slot < last; ++slot) {
            const Index first_before = before;
            before = list_.end_of(slot, before);
            Clearance& clearance = clearances_[slot];
            if (particles.is_driven(slot)) {
                clearance = {};
                continue;
            }
            const double reach = settings.brute_force
                                     ? 1e300
                                     : (1.0 + clock.candidate_reach()) * particles.radius(slot) +
                                           clock.candidate_slack();
            const Vec3 centre = wall.to_wall(particles.position(slot));
            if (clearance.exceeds(centre, reach)) {
                for (Index k = first_before; k < before; ++k) {
                    found[part].append(slot, list_.j[k]);
                }
                continue;
            }
            patches.clear();
            const double others = wall.surface().collect(centre, reach + spare, patches);
            clearance = {centre, patches.empty() || spare > 0.0 ? others : 0.0};
            for (const Index patch : patches) {
                found[part].append(slot, patch);
            }
        }
    });
    list_.clear();
    for (const PairList& part : found) {
        list_.i.insert(list_.i.end(), part.i.begin(), part.i.end());
        list_.j.insert(list_.j.end(), part.j.begin(), part.j.end());
        list_.count += part.count;
    }
    list_.pad();
}

void WallCandidates::forget() {
    list_.clear();
    list_.pad();
    clearances_.clear();
}

std::vector<double> WallCandidates::packed_clearances() const {
    std::vector<double> packed;
    packed.reserve(4 * clearances_.size());
    for (const Clearance& c : clearances_) {
        packed.insert(packed.end(), {c.centre.x, c.centre.y, c.centre.z, c.distance});
    }
    return packed;
}

void WallCandidates::load_clearances(std::span<const double> packed, std::size_t size) {
    Archive::require(packed.empty() || packed.size() == 4 * size, "clearances");
    for (std::size_t k = 0; k < packed.size(); k += 4) {
        clearances_.push_back({{packed[k], packed[k + 1], packed[k + 2]}, packed[k + 3]});
    }
}

void WallCandidates::save(Archive& archive, const std::string& name) const {
    archive.put(name + "/candidate_particle",
                std::vector<Index>(list_.i.begin(), list_.i.begin() + list_.count));
    archive.put(name + "/candidate_patch",
                std::vector<Index>(list_.j.begin(), list_.j.begin() + list_.count));
    archive.put(name + "/clearances", packed_clearances());
}

void WallCandidates::load(const Archive& archive,
                          const std::string& name,
                          std::size_t particle_count,
                          std::size_t patch_count) {
    list_.load(archive,
               name + "/candidate_particle",
               name + "/candidate_patch",
               particle_count,
               patch_count);
    clearances_.clear();
    if (archive.columns().contains(name + "/clearances")) {  // older checkpoints have none
        load_clearances(archive.get<double>(name + "/clearances"), particle_count);
    }
}

}  // namespace grainbench
