// The example as a whole: what must come out of presets/scenes/bne.json in every realisation. Slow:
// minutes, by `ctest --preset release -L slow`.

#include "core/ensemble.hpp"
#include "core/simulation.hpp"

#include "io/json/scene_json.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <thread>
#include <vector>

namespace grainbench {
namespace {

Scene preset(const std::string& name) {
    return io::read_scene(std::string(GRAINBENCH_SOURCE_DIR) + "/presets/scenes/" + name);
}

/// Keeps the running average of the elevation [m] by time, and small spheres' vertical displacement
/// over whole periods by distance from the axis.
class Recorder : public Observer {
public:
    void on_history(const Simulation& simulation) override {
        const std::vector<double> row = simulation.history_row();
        const auto& columns = simulation.history_columns();
        for (std::size_t c = 0; c < columns.size(); ++c) {
            if (columns[c].name == "elevation_average" && std::isfinite(row[c])) {
                elevation_[row[0]] = row[c];
            }
        }
    }

    void on_frame(const Simulation& simulation) override {
        const ParticleFrame now = simulation.particle_frame();
        if (now.time > settled_time && before_.size() == now.size()) {
            for (std::size_t n = 0; n < now.size(); ++n) {
                const double distance = std::hypot(now.position[n].x, now.position[n].y);
                const double rise = now.position[n].z - before_.position[n].z;
                if (now.species[n] == 0 && distance < axis_radius) {
                    axis_rise_ += rise;
                    ++axis_count_;
                }
                if (now.species[n] == 0 && distance > wall_radius) {
                    wall_rise_ += rise;
                    ++wall_count_;
                }
            }
        }
        before_ = now;
    }

    /// Last average at or before t [m].
    double elevation_at(double t) const {
        const auto after = elevation_.upper_bound(t);
        return after == elevation_.begin() ? std::nan("") : std::prev(after)->second;
    }

    bool rises_above(double height, double until) const {
        return std::any_of(elevation_.begin(), elevation_.end(), [&](const auto& point) {
            return point.first <= until && point.second > height;
        });
    }

    /// Mean rise over a period of small spheres near the axis and near the wall [m].
    double axis_rise() const { return axis_rise_ / static_cast<double>(axis_count_); }

    double wall_rise() const { return wall_rise_ / static_cast<double>(wall_count_); }

private:
    static constexpr double settled_time = 2.0;    // s: the loose packing has fallen by then
    static constexpr double axis_radius = 0.015;   // m, of 0.05
    static constexpr double wall_radius = 0.0425;  // m: centres of the outermost layer

    std::map<double, double> elevation_;
    ParticleFrame before_;
    double axis_rise_ = 0.0, wall_rise_ = 0.0;
    std::size_t axis_count_ = 0, wall_count_ = 0;
};

std::vector<Recorder> run(const Scene& scene) {
    std::vector<Simulation> simulations;
    for (int r = 0; r < scene.realisations.count; ++r) {
        simulations.emplace_back(scene, r);
    }
    std::vector<Recorder> recorders(simulations.size());
    std::vector<Observer*> observers;
    for (Recorder& recorder : recorders) {
        observers.push_back(&recorder);
    }
    const std::atomic<bool> stop = false;
    run_ensemble(
        simulations, observers, {.threads = std::thread::hardware_concurrency()}, stop, {});
    return recorders;
}

TEST(BrazilNut, IntrudersRiseAtTenHertzAndSinkAtAHundred) {
    const Scene scene = preset("bne.json");
    for (const Recorder& recorder : run(scene)) {
        const double convective = recorder.elevation_at(20.0);
        const double fluidised = recorder.elevation_at(40.0);
        std::printf(
            "elevation at 20 s %.2f mm, at 40 s %.2f mm\n", 1e3 * convective, 1e3 * fluidised);
        EXPECT_TRUE(recorder.rises_above(0.0, 20.0));
        EXPECT_GT(convective, 0.004);
        EXPECT_LT(fluidised, convective - 0.007);
    }
}

TEST(BrazilNut, WithoutWallFrictionIntrudersStay) {
    Scene rough = preset("bne.json");
    rough.stages.resize(1);
    rough.stages[0].duration = 5.0;
    rough.output = {};
    rough.output.history_interval = 0.1;
    rough.traces.clear();
    Scene smooth = preset("bne-frictionless-wall.json");
    smooth.output = rough.output;
    smooth.traces.clear();
    const std::vector<Recorder> with = run(rough);
    const std::vector<Recorder> without = run(smooth);
    for (std::size_t r = 0; r < with.size(); ++r) {
        const double rise = with[r].elevation_at(5.0) - with[r].elevation_at(1.0);
        const double rise_without = without[r].elevation_at(5.0) - without[r].elevation_at(1.0);
        std::printf(
            "realisation %zu: rise from 1 s to 5 s %.2f mm, without wall friction %.2f mm\n",
            r + 1,
            1e3 * rise,
            1e3 * rise_without);
        EXPECT_LT(rise_without, 0.25 * rise);
    }
}

TEST(BrazilNut, SmallSpheresGoUpOnTheAxisAndDownAtTheWall) {
    Scene scene = preset("bne.json");
    scene.stages.resize(1);
    scene.stages[0].duration = 8.0;
    scene.output = {};
    scene.output.frame_interval = 0.1;  // one period
    scene.traces.clear();
    const std::vector<Recorder> recorders = run(scene);
    for (std::size_t r = 0; r < recorders.size(); ++r) {
        std::printf("realisation %zu: rise per period %.3f mm on the axis, %.3f mm at the wall\n",
                    r + 1,
                    1e3 * recorders[r].axis_rise(),
                    1e3 * recorders[r].wall_rise());
        EXPECT_GT(recorders[r].axis_rise(), 0.0);
        EXPECT_LT(recorders[r].wall_rise(), 0.0);
    }
}

}  // namespace
}  // namespace grainbench
