/// What a scene measures beside its frames. Each observable is off, and costs nothing, where its
/// key is absent; share/doc/observables.md says what each means. SI units.
#pragma once

#include "core/box.hpp"
#include "core/describe.hpp"
#include "core/types.hpp"
#include "core/walls/shapes.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace grainbench {

/// Mean height of one group over another, as the example's intruder elevation, in metres.
struct ElevationObservable {
    std::string upper;
    std::string lower;
    std::int64_t sample_cycles = 10;
    double average_interval = 0.1;

    static constexpr auto fields() {
        return std::tuple{required(&ElevationObservable::upper,
                                   "upper",
                                   "",
                                   any_number(),
                                   "group whose mean height is taken"),
                          required(&ElevationObservable::lower,
                                   "lower",
                                   "",
                                   any_number(),
                                   "group whose mean height is subtracted"),
                          field(&ElevationObservable::sample_cycles,
                                "sample_cycles",
                                "1",
                                at_least(1),
                                "cycles between two samples"),
                          field(&ElevationObservable::average_interval,
                                "average_interval",
                                "s",
                                positive(),
                                "interval of the running average; a stage may change it")};
    }
};

/// Ledger of all energies. Costs a pass over the touching contacts; absent = nothing is summed.
struct EnergyObservable {
    static constexpr auto fields() { return std::tuple{}; }
};

/// Force and torque on each wall, as columns of the history.
struct WallForceObservable {
    static constexpr auto fields() { return std::tuple{}; }
};

/// Contacts per particle.
struct CoordinationObservable {
    bool walls = true;
    std::int64_t least_contacts = 4;

    static constexpr auto fields() {
        return std::tuple{field(&CoordinationObservable::walls,
                                "walls",
                                "",
                                any_number(),
                                "a contact with a wall counts for its particle"),
                          field(&CoordinationObservable::least_contacts,
                                "least_contacts",
                                "1",
                                between(1, 12),
                                "particles with fewer contacts are rattlers, which the mechanical "
                                "number leaves out; 2 is Thornton's")};
    }
};

/// The space within a cylinder, ends included.
struct CylinderRegion {
    static constexpr std::string_view key = "cylinder";
    Vec3 base{};
    Vec3 axis{0.0, 0.0, 1.0};
    double radius = 1.0;
    double height = 1.0;

    static constexpr auto fields() {
        return std::tuple{
            required(&CylinderRegion::base, "base", "m", any_number(), "centre of the base"),
            field(&CylinderRegion::axis, "axis", "1", any_number(), "direction from base to top"),
            required(&CylinderRegion::radius, "radius", "m", positive(), "radius"),
            required(&CylinderRegion::height, "height", "m", positive(), "height along the axis")};
    }
};

using RegionShape = std::variant<BoxShape, CylinderRegion>;

enum class CountBy { species, group };

template <>
struct EnumNames<CountBy> {
    static constexpr std::array<std::pair<CountBy, std::string_view>, 2> value{
        {{CountBy::species, "species"}, {CountBy::group, "group"}}};
};

/// Part of space whose particles are counted at each row of the history.
struct RegionObservable {
    std::string name;
    RegionShape shape;
    std::optional<CountBy> by;

    static constexpr auto fields() {
        return std::tuple{required(&RegionObservable::name,
                                   "name",
                                   "",
                                   any_number(),
                                   "name, unique among regions: the columns start with it"),
                          required(&RegionObservable::shape,
                                   "shape",
                                   "",
                                   any_number(),
                                   "holds the particles whose centre is in it"),
                          field(&RegionObservable::by,
                                "by",
                                "",
                                any_number(),
                                "also count each species, or each group, by itself")};
    }
};

/// How well two groups are mixed, over a grid of cubic cells.
struct MixingObservable {
    std::string first;
    std::string second;
    double cell = 0.0;

    static constexpr auto fields() {
        return std::tuple{
            required(&MixingObservable::first, "first", "", any_number(), "one group"),
            required(&MixingObservable::second, "second", "", any_number(), "the other group"),
            required(&MixingObservable::cell,
                     "cell",
                     "m",
                     positive(),
                     "edge of the cells, whose corners are multiples of it: the scale on which "
                     "mixing is judged")};
    }
};

/// A heap about a vertical line: its height falls with the distance from the line.
struct HeapSurface {
    static constexpr std::string_view key = "heap";
    Vec3 centre{};
    double inner = 0.0;
    double outer = 0.0;

    static constexpr auto fields() {
        return std::tuple{
            required(
                &HeapSurface::centre, "centre", "m", any_number(), "a point of the vertical line"),
            field(
                &HeapSurface::inner,
                "inner",
                "m",
                at_least(0.0),
                "distance from the line from which on the surface counts: beyond the rounded tip"),
            required(&HeapSurface::outer,
                     "outer",
                     "m",
                     positive(),
                     "distance up to which it counts: before the toe")};
    }
};

/// A free surface that rises along a horizontal direction.
struct SlopeSurface {
    static constexpr std::string_view key = "slope";
    Vec3 along{1.0, 0.0, 0.0};
    double from = 0.0;
    double to = 0.0;

    static constexpr auto fields() {
        return std::tuple{
            required(&SlopeSurface::along,
                     "along",
                     "1",
                     any_number(),
                     "direction up the slope; only its horizontal part matters"),
            required(&SlopeSurface::from,
                     "from",
                     "m",
                     any_number(),
                     "where the surface begins to count, along the direction, from the origin"),
            required(&SlopeSurface::to, "to", "m", any_number(), "where it ends to count")};
    }
};

using FreeSurface = std::variant<HeapSurface, SlopeSurface>;

/// Angle of a free surface, by least squares through the highest particles.
struct ReposeObservable {
    std::string name;
    FreeSurface surface;
    double cell = 0.0;

    static constexpr auto fields() {
        return std::tuple{
            required(&ReposeObservable::name,
                     "name",
                     "",
                     any_number(),
                     "name, unique among these surfaces: the columns start with it"),
            required(&ReposeObservable::surface, "surface", "", any_number(), "where to fit"),
            required(&ReposeObservable::cell,
                     "cell",
                     "m",
                     positive(),
                     "edge of the square columns that the plan is cut into; the highest particle "
                     "of each is on the surface: two diameters or more")};
    }
};

/// What a particle is smeared out with (core/measure/smoothing_kernel.hpp).
enum class Kernel { lucy, gaussian };

template <>
struct EnumNames<Kernel> {
    static constexpr std::array<std::pair<Kernel, std::string_view>, 2> value{
        {{Kernel::lucy, "lucy"}, {Kernel::gaussian, "gaussian"}}};
};

/// Coarse-grained density, velocity, granular temperature and stress on a grid.
struct CoarseGrainingObservable {
    Box box;
    std::vector<std::int64_t> counts;
    Kernel kernel = Kernel::lucy;
    double reach = 0.0;

    static constexpr auto fields() {
        return std::tuple{
            required(&CoarseGrainingObservable::box,
                     "box",
                     "m",
                     any_number(),
                     "box that the grid fills"),
            required(&CoarseGrainingObservable::counts,
                     "counts",
                     "1",
                     between(1, 10000),
                     "three numbers of cells, along x, y, z; fields are those at their centres"),
            field(&CoarseGrainingObservable::kernel,
                  "kernel",
                  "",
                  any_number(),
                  "what a particle is smeared out with: Lucy's polynomial or a Gaussian"),
            required(&CoarseGrainingObservable::reach,
                     "reach",
                     "m",
                     positive(),
                     "where the kernel ends: two diameters or more for a continuum; the standard "
                     "deviation of the Gaussian is a third of it")};
    }
};

struct Observables {
    std::optional<ElevationObservable> elevation;
    std::optional<EnergyObservable> energy;
    std::optional<WallForceObservable> wall_forces;
    std::optional<CoordinationObservable> coordination;
    std::vector<RegionObservable> regions;
    std::optional<MixingObservable> mixing;
    std::vector<ReposeObservable> repose;
    std::optional<CoarseGrainingObservable> coarse_graining;

    static constexpr auto fields() {
        return std::tuple{field(&Observables::elevation,
                                "elevation",
                                "",
                                any_number(),
                                "mean height of one group over another, with entrainment time"),
                          field(&Observables::energy, "energy", "", any_number(), "energy ledger"),
                          field(&Observables::wall_forces,
                                "wall_forces",
                                "",
                                any_number(),
                                "force and torque on each wall"),
                          field(&Observables::coordination,
                                "coordination",
                                "",
                                any_number(),
                                "mean number of contacts, with and without rattlers"),
                          field(&Observables::regions,
                                "regions",
                                "",
                                any_number(),
                                "particles and mass in parts of space"),
                          field(&Observables::mixing,
                                "mixing",
                                "",
                                any_number(),
                                "how well two groups are mixed: Lacey's index"),
                          field(&Observables::repose,
                                "repose",
                                "",
                                any_number(),
                                "angles of heaps and of free surfaces"),
                          field(&Observables::coarse_graining,
                                "coarse_graining",
                                "",
                                any_number(),
                                "density, velocity, granular temperature and stress on a grid, as "
                                "files fields_*.vti")};
    }
};

}  // namespace grainbench
