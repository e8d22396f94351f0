/// A simulation under observation, through nothing but its public interface: frames when asked,
/// rows of the history as they come.
#pragma once

#include "core/simulation.hpp"

#include <string_view>
#include <utility>
#include <vector>

namespace grainbench::verify {

/// One sphere at a full step.
struct Ball {
    Vec3 position{};  ///< [m]
    Vec3 velocity{};  ///< [m/s]
    Vec3 spin{};      ///< [rad/s]
    Vec3 force{};     ///< [N] of its contacts
};

class Run : private Observer {
public:
    explicit Run(const Scene& scene) : simulation_(scene, 0) {}

    /// Makes `cycles` cycles, or fewer where the last stage ends. True when it has ended.
    bool advance(std::uint64_t cycles) { return simulation_.advance(cycles, *this); }

    /// To the end of the last stage, calling visit() after every cycle.
    template <class Visit>
    void each_cycle(Visit&& visit) {
        advance(0);
        while (!simulation_.finished()) {
            const std::uint64_t before = simulation_.cycle();
            advance(1);
            if (simulation_.cycle() != before) {
                visit();
            }
        }
    }

    void finish() {
        while (!advance(1U << 20U)) {
        }
    }

    const Simulation& simulation() const { return simulation_; }

    /// Goes on from the state of another run of a scene that differs in what comes later.
    void load(const Archive& archive) { simulation_.load(archive); }

    /// Sphere by its place in the scene, from 0.
    Ball ball(std::size_t place = 0) const;

    /// The present value of a column of the history.
    double now(std::string_view column) const;

    /// A column of the rows observed so far.
    std::vector<double> series(std::string_view column) const;

private:
    void on_history(const Simulation& simulation) override {
        rows_.push_back(simulation.history_row());
    }

    std::size_t place_of(std::string_view column) const;

    Simulation simulation_;
    std::vector<std::vector<double>> rows_;
};

}  // namespace grainbench::verify
