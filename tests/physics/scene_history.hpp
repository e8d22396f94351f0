/// Presets run whole by the tests of scenes, with what they report kept: the history by column,
/// and frames as they come.
#pragma once

#include "core/ensemble.hpp"
#include "core/simulation.hpp"

#include "io/json/scene_json.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <string>
#include <thread>
#include <vector>

namespace grainbench::test {

/// A preset by its name without ".json", with changes as --set takes them.
struct PresetRun {
    std::string preset;
    std::vector<std::string> changes;
};

class SceneHistory : public Observer {
public:
    void on_history(const Simulation& simulation) override {
        const std::vector<double> row = simulation.history_row();
        const std::vector<HistoryColumn>& names = simulation.history_columns();
        for (std::size_t c = 0; c < names.size(); ++c) {
            columns_[names[c].name].push_back(row[c]);
        }
    }

    void on_frame(const Simulation& simulation) override {
        frames.push_back(simulation.particle_frame());
    }

    const std::vector<double>& column(const std::string& name) const { return columns_.at(name); }

    /// Mean of a column over the rows with low < time <= high [s].
    double mean(const std::string& name, double low, double high) const {
        double sum = 0.0;
        int rows = 0;
        for (std::size_t n = 0; n < column("time").size(); ++n) {
            if (low < column("time")[n] && column("time")[n] <= high) {
                sum += column(name)[n];
                ++rows;
            }
        }
        return sum / rows;
    }

    std::vector<ParticleFrame> frames;

private:
    std::map<std::string, std::vector<double>> columns_;
};

/// Runs the first realisation of each, side by side on all processors.
inline std::vector<SceneHistory> run_presets(const std::vector<PresetRun>& runs) {
    std::vector<Simulation> simulations;
    for (const PresetRun& run : runs) {
        simulations.emplace_back(io::read_scene(std::string(GRAINBENCH_SOURCE_DIR) +
                                                    "/presets/scenes/" + run.preset + ".json",
                                                run.changes),
                                 0);
    }
    std::vector<SceneHistory> histories(runs.size());
    std::vector<Observer*> observers;
    for (SceneHistory& history : histories) {
        observers.push_back(&history);
    }
    const std::atomic<bool> stop = false;
    run_ensemble(
        simulations, observers, {.threads = std::thread::hardware_concurrency()}, stop, {});
    return histories;
}

/// The straight line of least squares.
struct Line {
    double slope = 0.0;
    double intercept = 0.0;
};

inline Line line_through(const std::vector<double>& x, const std::vector<double>& y) {
    const double n = static_cast<double>(x.size());
    double mean_x = 0.0, mean_y = 0.0;
    for (std::size_t k = 0; k < x.size(); ++k) {
        mean_x += x[k] / n;
        mean_y += y[k] / n;
    }
    double covariance = 0.0, variance = 0.0;
    for (std::size_t k = 0; k < x.size(); ++k) {
        covariance += (x[k] - mean_x) * (y[k] - mean_y);
        variance += (x[k] - mean_x) * (x[k] - mean_x);
    }
    const double slope = covariance / variance;
    return {slope, mean_y - slope * mean_x};
}

}  // namespace grainbench::test
