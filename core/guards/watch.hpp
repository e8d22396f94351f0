/// The guards of one realisation: they look at its state now and then and stop it, or keep a
/// warning, where numbers can no longer be trusted.
///
/// Model    every cycle: way of the fastest particle, work of the walls. Every 256th: finiteness,
///          energy, late contacts, particles that left. Every 512th: a step that was not chosen by
///          the contacts. Every 8192nd, and in the first cycles of a stage: whether small motions
///          grow. Overlaps as often as the fastest may have come half of the bound.
///          budget := min(budget + wall work, E) in each interval between looks              (1)
///          trouble if E - budget > bound (kinetic + elastic + recent work and falls)         (2)
///          with E = kinetic + elastic + potential: what grows faster than walls supply is made by
///          the integration. A fiftieth of E - budget is forgiven at each look, so that scheme
///          errors of either sign do not add up in a long run.
/// Source   the work of a wall over a cycle is its velocity times the mean of the forces at the
///          ends of the cycle: exact in the leapfrog (core/measure/energy_ledger.hpp, (2)).
/// Limits   energy made in steady balance with damping does not grow and is not seen: what makes it
///          is, where motions grow by more than a fifth per cycle. Scaled inertia switches both
///          off, for time has no meaning there.
#pragma once

#include "core/archive.hpp"
#include "core/engine.hpp"
#include "core/guards/guards.hpp"

#include <string>
#include <utility>
#include <vector>

namespace grainbench {

class GuardWatch {
public:
    /// Call before the engine's first stage begins.
    GuardWatch(const Scene& scene, Engine& engine);

    /// The laws or the scheme changed: energies before and after do not compare.
    void begin_stage() {
        has_budget_ = false;
        early_looks_ = 2;
    }

    void before_step(Engine& engine) const;

    /// Call after particles came or went.
    void change_population(const Engine& engine, const PopulationChange& change);

    /// Throws Error(unstable) if a guard says stop.
    void after_step(Engine& engine);

    /// Slots, in ascending order, of particles that the last after_step() found lost and that the
    /// scene wants deleted.
    std::vector<Index> take_lost() { return std::exchange(leaving_, {}); }

    /// Particles that left so far.
    std::uint64_t lost_count() const { return lost_count_; }

    /// Looks at everything but energy now: before a state is kept as a good one.
    void look(const Engine& engine);

    /// What was warned of, one line each; counts are those of now.
    std::vector<std::string> warnings(const Engine& engine) const;

    void save(Archive& archive) const;
    void load(const Archive& archive);

private:
    /// A closed wall, or a plane, that holds what started inside.
    struct Hold {
        std::size_t wall = 0;
        bool is_plane = false;
        Vec3 low{};   ///< of the box around the wall, in its frame [m]; of a plane: a point
        Vec3 high{};  ///< [m]; of a plane: its unit normal [1]
        std::vector<std::int8_t> side;  ///< by id - 1: 1 inside or above, -1 below, 0 outside
    };

    /// Sums and extremes of the particles.
    struct Energy {
        double motion = 0.0;     ///< [J] kinetic and elastic
        double potential = 0.0;  ///< [J] in gravity, from where the run began
    };

    std::int8_t side_of(const Hold& hold, const Vec3& position) const;

    bool is_due(std::uint64_t cycle) const { return cycle % interval == 0; }

    bool watches_energy(const Engine& engine) const;
    void add_wall_work(const Engine& engine);
    void add_work(std::size_t place, const GroupLoad& load, double timestep);
    void check_travel(const Engine& engine);
    void check_finite(const Engine& engine) const;
    void check_overlap(const Engine& engine);
    void check_timestep(Engine& engine);
    double check_estimate(Engine& engine);
    void check_growth(const Engine& engine);
    void check_late(const Engine& engine);
    void check_lost(const Engine& engine);
    void check_energy(const Engine& engine);
    Energy energy_of(const Engine& engine) const;
    bool is_lost(const Engine& engine, Index slot) const;
    void act(GuardAction action, const Engine& engine, Diagnosis diagnosis, std::string& warning);

    static constexpr std::uint64_t interval = 256;        ///< cycles
    static constexpr std::uint64_t long_interval = 8192;  ///< cycles

    Guards guards_;
    std::vector<double> density_;  ///< [kg/m^3] by species
    bool population_changes_ = false;
    Vec3 gravity_{};
    Vec3 origin_{};              ///< [m] where potential energy is zero
    double least_energy_ = 0.0;  ///< [J] below which motion is no matter
    std::vector<Hold> holds_;

    bool has_budget_ = false;
    double budget_ = 0.0;            ///< [J]
    double supplied_ = 0.0;          ///< [J] wall work since the last look
    double turnover_ = 0.0;          ///< [J] recent work and falls
    double potential_ = 0.0;         ///< [J] at the last look
    bool grows_ = false;             ///< motions grew at the last look
    std::uint64_t early_looks_ = 0;  ///< at small motions, in the first cycles of a stage
    double way_ = 0.0;  ///< [m] bound on what anything came since the last look at overlaps
    /// By wall, then by driven group: force [N] and torque [N m] of the last cycle.
    std::vector<double> wall_load_;
    std::vector<std::uint8_t> lost_;  ///< by id - 1
    std::uint64_t lost_count_ = 0;
    std::vector<Index> leaving_;  ///< slots, to be deleted
    std::string overlap_warning_, speed_warning_, timestep_warning_, energy_warning_;
};

}  // namespace grainbench
