/// One realisation of a scene: builds the state, steps it, and says when output is due.
#pragma once

#include "core/archive.hpp"
#include "core/frame.hpp"
#include "core/insertion/insert.hpp"
#include "core/phases.hpp"
#include "core/scene.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace grainbench {

class Simulation;

/// Called when output is due. The simulation is at a full step and may be asked for its frames.
class Observer {
public:
    virtual ~Observer() = default;

    virtual void on_history(const Simulation&) {}

    virtual void on_trace(const Simulation&) {}

    virtual void on_frame(const Simulation&) {}

    virtual void on_fields(const Simulation&) {}

    virtual void on_checkpoint(const Simulation&) {}
};

struct SimulationOptions {
    /// Instruction set of the passes: "" = the best this processor has, else "scalar", "sse4",
    /// "avx2", "avx512".
    std::string isa;
    /// Slow and obvious: one lane and every pair looked at in every step. The oracle of the tests.
    bool reference = false;
    /// Threads that share the work on one large scene; the bits do not depend on it.
    unsigned threads = 1;
};

/// Scalars known at the end of (or during) a run.
struct Summary {
    std::uint64_t cycles = 0;
    double time = 0.0;                        ///< [s]
    double mean_timestep = 0.0;               ///< [s]
    double smallest_timestep = 0.0;           ///< [s]
    double largest_timestep = 0.0;            ///< [s]
    std::optional<double> entrainment_time;   ///< [s] first sample with elevation > 0
    std::optional<double> average_elevation;  ///< [m] of the last complete averaging interval
    std::uint64_t late_contacts = 0;          ///< contacts found already overlapping
    double largest_overlap_ratio = 0.0;       ///< [1] overlap over the smaller radius, sampled
    std::uint64_t searches = 0;               ///< contact list renewals
    std::uint64_t candidate_builds = 0;       ///< candidate list renewals
    std::vector<std::string> warnings;        ///< of guards, one line each
};

class Simulation {
public:
    /// Builds realisation `index` (from 0). Throws Error(bad_input) on what the scene cannot mean.
    Simulation(const Scene& scene, int index, const SimulationOptions& options = {});
    ~Simulation();
    Simulation(Simulation&&) noexcept;
    Simulation& operator=(Simulation&&) noexcept;
    Simulation(const Simulation&) = delete;
    Simulation& operator=(const Simulation&) = delete;

    /// Steps at most `cycles` cycles and reports due output. True when the last stage has ended.
    /// The very first call also reports the initial state, the last one the final state.
    /// Throws Error(unstable) when a guard stops it.
    bool advance(std::uint64_t cycles, Observer& observer);

    /// Who is told from now on which part of a cycle begins; null = nobody, the default.
    void watch_phases(PhaseWatch* watch);

    int index() const;
    double time() const;      ///< [s]
    double end_time() const;  ///< [s]
    double timestep() const;  ///< [s] of the last cycle
    std::uint64_t cycle() const;
    std::size_t stage() const;  ///< index of the current stage
    bool finished() const;
    std::size_t particle_count() const;
    std::size_t candidate_count() const;  ///< pairs in the candidate list
    std::size_t contact_count() const;    ///< contact objects, touching or near, with walls
    std::size_t touching_count() const;   ///< active contacts, with walls
    std::span<const InsertionReport> insertion_reports() const;
    std::string isa() const;

    ParticleFrame particle_frame() const;
    WallFrame wall_frame() const;
    /// Throws Error(bad_input) unless a frame of contacts is due, at on_frame(), or the scene has
    /// an energy ledger.
    ContactFrame contact_frame() const;
    /// Throws Error(bad_input) unless fields are due, at on_fields().
    FieldFrame field_frame() const;
    std::vector<TracePoint> trace_points() const;

    const std::vector<HistoryColumn>& history_columns() const;
    std::vector<double> history_row() const;

    Summary summary() const;

    /// FNV-1a over every bit that steers the next step.
    std::uint64_t state_hash() const;

    void save(Archive& archive) const;
    /// Continues from a saved state of the same scene and realisation, to the same bits.
    void load(const Archive& archive);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace grainbench
