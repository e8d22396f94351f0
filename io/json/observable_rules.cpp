#include "core/scene.hpp"

#include "io/json/scene_rules.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace grainbench::io {

namespace {

void add(Problems& problems,
         std::string pointer,
         std::string what,
         std::string likely_cause,
         std::string next_step) {
    problems.add(
        {std::move(pointer), std::move(what), std::move(likely_cause), std::move(next_step)});
}

void check_elevation(const Scene& scene, const ElevationObservable& wanted, Problems& problems) {
    const std::string at = "/observables/elevation";
    const auto groups = names_of(scene.groups);
    check_known(wanted.upper, groups, "group", at + "/upper", problems);
    check_known(wanted.lower, groups, "group", at + "/lower", problems);
    if (wanted.upper == wanted.lower) {
        add(problems,
            at + "/lower",
            fmt::format("'{}' over itself", wanted.lower),
            "the same group twice",
            "name two different groups");
    }
}

void check_region(const Scene& scene,
                  const RegionObservable& region,
                  const std::string& at,
                  Problems& problems) {
    if (region.name.find('.') != std::string::npos) {
        add(problems,
            at + "/name",
            fmt::format("'{}' holds a dot", region.name),
            "a dot ends the name of the region in the name of a column",
            "use another sign");
    }
    const auto sources = names_of(scene.particles.sources);
    const auto sinks = names_of(scene.particles.sinks);
    if (std::count(sources.begin(), sources.end(), region.name) > 0 ||
        std::count(sinks.begin(), sinks.end(), region.name) > 0) {
        add(problems,
            at + "/name",
            fmt::format("'{}' is also the name of a source or sink", region.name),
            "their columns of the history could not be told apart",
            "rename the region");
    }
    std::visit(Overloaded{[&](const BoxShape& box) {
                              check_box(box.low, box.high, at + "/shape", problems);
                          },
                          [&](const CylinderRegion& cylinder) {
                              check_direction(cylinder.axis, at + "/shape/axis", problems);
                          }},
               region.shape);
    if (region.by == CountBy::group && scene.groups.empty()) {
        add(problems,
            at + "/by",
            "there are no groups to count",
            "the scene has no 'groups'",
            "add groups, count by species, or remove this key");
    }
}

void check_mixing(const Scene& scene, const MixingObservable& wanted, Problems& problems) {
    const std::string at = "/observables/mixing";
    const auto groups = names_of(scene.groups);
    check_known(wanted.first, groups, "group", at + "/first", problems);
    check_known(wanted.second, groups, "group", at + "/second", problems);
    if (wanted.first == wanted.second) {
        add(problems,
            at + "/second",
            fmt::format("'{}' mixed with itself", wanted.second),
            "the same group twice",
            "name two different groups");
    }
}

/// \param at of the surface
void check_repose(const Scene& scene,
                  const ReposeObservable& wanted,
                  const std::string& at,
                  Problems& problems) {
    const auto* slope = std::get_if<SlopeSurface>(&wanted.surface);
    if (slope == nullptr) {
        const auto& heap = std::get<HeapSurface>(wanted.surface);
        if (!(heap.inner < heap.outer)) {
            add(problems,
                at + "/outer",
                fmt::format("{} m is not above 'inner', {} m", heap.outer, heap.inner),
                "the ends are swapped",
                "give inner < outer");
        }
        return;
    }
    if (!(slope->from < slope->to)) {
        add(problems,
            at + "/to",
            fmt::format("{} m is not above 'from', {} m", slope->to, slope->from),
            "the ends are swapped",
            "give from < to");
    }
    const Vec3 gravity = scene.gravity.value_or(Vec3{});
    const Vec3 up = norm(gravity) > 0.0 ? normalized(-gravity) : Vec3{0.0, 0.0, 1.0};
    const Vec3 along = normalized(slope->along);
    constexpr double least = 1e-6;  // a direction that is nearer to the vertical was meant as such
    if (norm(cross(along, up)) < least) {
        add(problems,
            at + "/along",
            "a direction without horizontal part",
            "it is parallel to gravity, or 0",
            "give the horizontal direction that the surface rises along");
    }
}

/// A kernel may meet each particle once beyond each end of a period.
void check_reach(const Scene& scene, double reach, const std::string& at, Problems& problems) {
    if (!scene.periodic) {
        return;
    }
    for (const auto& interval : {scene.periodic->x, scene.periodic->y, scene.periodic->z}) {
        const double period = interval ? interval->high - interval->low : reach;
        if (period > 0.0 && reach > period) {
            add(problems,
                at,
                fmt::format("{} m reach past a period of {} m", reach, period),
                "a particle would be seen more than once on one side",
                "give a shorter reach");
            return;
        }
    }
}

void check_coarse_graining(const Scene& scene,
                           const CoarseGrainingObservable& wanted,
                           Problems& problems) {
    const std::string at = "/observables/coarse_graining";
    check_box(wanted.box.low, wanted.box.high, at + "/box", problems);
    check_reach(scene, wanted.reach, at + "/reach", problems);
    if (wanted.counts.size() != 3) {
        add(problems,
            at + "/counts",
            fmt::format("{} numbers; expected 3", wanted.counts.size()),
            "one number for each axis is needed",
            "give [along x, along y, along z]");
        return;
    }
    constexpr double most = 1e8;  // 20 GB of numbers in a file
    const double cells = static_cast<double>(wanted.counts[0]) *
                         static_cast<double>(wanted.counts[1]) *
                         static_cast<double>(wanted.counts[2]);
    if (cells > most) {
        add(problems,
            at + "/counts",
            fmt::format("{:g} cells", cells),
            "a grid far finer than its kernel",
            "give smaller counts: cells of half the width of the kernel show all there is");
    }
}

}  // namespace

void check_observables(const Scene& scene, Problems& problems) {
    const Observables& wanted = scene.observables;
    if (wanted.elevation) {
        check_elevation(scene, *wanted.elevation, problems);
    }
    check_unique_names(names_of(wanted.regions), "/observables/regions", problems);
    for (std::size_t i = 0; i < wanted.regions.size(); ++i) {
        check_region(scene, wanted.regions[i], fmt::format("/observables/regions/{}", i), problems);
    }
    if (wanted.mixing) {
        check_mixing(scene, *wanted.mixing, problems);
    }
    check_unique_names(names_of(wanted.repose), "/observables/repose", problems);
    for (std::size_t i = 0; i < wanted.repose.size(); ++i) {
        check_repose(
            scene, wanted.repose[i], fmt::format("/observables/repose/{}/surface", i), problems);
    }
    if (wanted.coarse_graining) {
        check_coarse_graining(scene, *wanted.coarse_graining, problems);
    }
}

}  // namespace grainbench::io
