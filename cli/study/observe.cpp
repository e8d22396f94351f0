#include "cli/study/observe.hpp"

#include "core/error.hpp"

#include "io/hdf5/history.hpp"
#include "io/vtk/frame_reader.hpp"
#include "io/vtk/pvd.hpp"

#include "cli/study/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace grainbench::cli {
namespace {

io::History history_of(const JobResult& result) {
    return io::read_history(result.folder / "history.h5");
}

/// Means of a column over equal parts of the run; a row belongs to the part that ends with it.
std::vector<double> means_over_parts(const io::HistoryTable& table,
                                     const std::string& column,
                                     double duration,
                                     std::size_t parts) {
    const std::vector<double>& time = table.column("time");
    const std::vector<double>& values = table.column(column);
    std::vector<double> sums(parts, 0.0);
    std::vector<double> counts(parts, 0.0);
    for (std::size_t row = 0; row < time.size(); ++row) {
        // A row comes with the first step at or after its time: some steps late at most.
        const double place = std::round(1e6 * time[row] / duration) * 1e-6;
        const double part = std::ceil(place * static_cast<double>(parts)) - 1.0;
        const auto k =
            static_cast<std::size_t>(std::clamp(part, 0.0, static_cast<double>(parts) - 1.0));
        sums[k] += values[row];
        counts[k] += 1.0;
    }
    for (std::size_t k = 0; k < parts; ++k) {
        if (counts[k] == 0.0) {
            throw_bad_input(
                {.what = fmt::format("the history has no row of '{}' in part {} of "
                                     "{} of the run",
                                     column,
                                     k + 1,
                                     parts),
                 .where = "/observable/points",
                 .likely_cause = "history_interval of the scene is longer than that part",
                 .next_step = "ask for fewer points, or for a shorter interval"});
        }
        sums[k] /= counts[k];
    }
    return sums;
}

Observation history_curves(const std::string& column,
                           std::int64_t points,
                           const Scene& scene,
                           const JobResult& result) {
    Observation observation;
    const auto parts = static_cast<std::size_t>(points);
    const double duration = duration_of(scene);
    for (std::size_t k = 0; k < parts; ++k) {
        observation.x.push_back((static_cast<double>(k) + 0.5) * duration /
                                static_cast<double>(parts));
    }
    const io::History history = history_of(result);
    for (const io::RealisationHistory& realisation : history.realisations) {
        observation.curves.push_back(
            means_over_parts(realisation.history, column, duration, parts));
    }
    return observation;
}

double reduced(const std::vector<double>& all, io::Reduction reduction) {
    std::vector<double> values;
    std::copy_if(all.begin(), all.end(), std::back_inserter(values), [](double v) {
        return std::isfinite(v);
    });
    if (values.empty()) {
        return std::numeric_limits<double>::quiet_NaN();
    }
    switch (reduction) {
        case io::Reduction::final_value:
            return values.back();
        case io::Reduction::mean:
            return statistics::sample_of(values).mean;
        case io::Reduction::largest:
            return *std::max_element(values.begin(), values.end());
        case io::Reduction::smallest:
            return *std::min_element(values.begin(), values.end());
    }
    return 0.0;
}

double coordinate(const Vec3& position, io::ProfileAxis axis) {
    switch (axis) {
        case io::ProfileAxis::x:
            return position.x;
        case io::ProfileAxis::y:
            return position.y;
        case io::ProfileAxis::z:
            return position.z;
        case io::ProfileAxis::radius:
            return std::hypot(position.x, position.y);
    }
    return 0.0;
}

ParticleFrame last_frame(const JobResult& result, std::size_t realisation) {
    const std::filesystem::path folder =
        result.folder / ("realisation-" + std::to_string(realisation + 1));
    return io::read_particles_frame(folder / io::read_pvd(folder / "particles.pvd").back().file);
}

/// Share of the volume of all particles whose centre lies in each bin [1].
std::vector<double> volume_shares(const ParticleFrame& frame, const io::FinalProfile& profile) {
    const auto bins = static_cast<std::size_t>(profile.bins);
    std::vector<double> shares(bins, 0.0);
    double all = 0.0;
    for (std::size_t k = 0; k < frame.size(); ++k) {
        const double volume = std::pow(frame.radius[k], 3);
        const double place = (coordinate(frame.position[k], profile.axis) - profile.low) /
                             (profile.high - profile.low);
        all += volume;
        if (place >= 0.0 && place < 1.0) {
            shares[static_cast<std::size_t>(place * static_cast<double>(bins))] += volume;
        }
    }
    for (double& share : shares) {
        share = all > 0.0 ? share / all : 0.0;
    }
    return shares;
}

/// A single number of each realisation; what is not finite is missing.
Observation numbers(const std::vector<double>& values) {
    Observation observation;
    observation.x = {0.0};
    for (const double value : values) {
        if (std::isfinite(value)) {
            observation.curves.push_back({value});
        } else {
            ++observation.missing;
        }
    }
    return observation;
}

Observation entrainment_times(const JobResult& result) {
    std::vector<double> values;
    for (const io::RealisationManifest& realisation : result.manifest.realisations) {
        values.push_back(realisation.summary.entrainment_time.value_or(
            std::numeric_limits<double>::quiet_NaN()));
    }
    return numbers(values);
}

Observation history_numbers(const io::HistoryNumber& wanted, const JobResult& result) {
    std::vector<double> values;
    const io::History history = history_of(result);
    for (const io::RealisationHistory& realisation : history.realisations) {
        values.push_back(reduced(realisation.history.column(wanted.column), wanted.reduction));
    }
    return numbers(values);
}

Observation final_profiles(const io::FinalProfile& wanted, const JobResult& result) {
    Observation observation;
    const double width = (wanted.high - wanted.low) / static_cast<double>(wanted.bins);
    for (std::int64_t k = 0; k < wanted.bins; ++k) {
        observation.x.push_back(wanted.low + (static_cast<double>(k) + 0.5) * width);
    }
    for (std::size_t n = 0; n < result.manifest.realisations.size(); ++n) {
        observation.curves.push_back(volume_shares(last_frame(result, n), wanted));
    }
    return observation;
}

std::string unit_of_column(const JobResult& result, const std::string& column) {
    const io::History history = history_of(result);
    for (const HistoryColumn& known : history.realisations.at(0).history.columns) {
        if (known.name == column) {
            return known.unit == "1" ? "" : known.unit;
        }
    }
    return "";
}

}  // namespace

Observation observe(const io::StudyObservable& observable,
                    const Scene& scene,
                    const JobResult& result) {
    return std::visit(
        Overloaded{[&](const io::ElevationCurve& wanted) {
                       return history_curves("elevation", wanted.points, scene, result);
                   },
                   [&](const io::EntrainmentTime&) { return entrainment_times(result); },
                   [&](const io::HistoryCurve& wanted) {
                       return history_curves(wanted.column, wanted.points, scene, result);
                   },
                   [&](const io::HistoryNumber& wanted) { return history_numbers(wanted, result); },
                   [&](const io::FinalProfile& wanted) { return final_profiles(wanted, result); }},
        observable);
}

Quantity quantity_of(const io::StudyObservable& observable, const JobResult& result) {
    return std::visit(
        Overloaded{[](const io::ElevationCurve&) {
                       return Quantity{.name = "elevation",
                                       .unit = "cm",
                                       .scale = 100.0,
                                       .x_name = "time",
                                       .x_unit = "s"};
                   },
                   [](const io::EntrainmentTime&) {
                       return Quantity{.name = "entrainment time", .unit = "s"};
                   },
                   [&](const io::HistoryCurve& wanted) {
                       return Quantity{.name = wanted.column,
                                       .unit = unit_of_column(result, wanted.column),
                                       .x_name = "time",
                                       .x_unit = "s"};
                   },
                   [&](const io::HistoryNumber& wanted) {
                       return Quantity{
                           .name = fmt::format("{}, {}", wanted.column, name_of(wanted.reduction)),
                           .unit = unit_of_column(result, wanted.column)};
                   },
                   [](const io::FinalProfile& wanted) {
                       return Quantity{.name = "share of the volume",
                                       .unit = "%",
                                       .scale = 100.0,
                                       .x_name = wanted.axis == io::ProfileAxis::radius
                                                     ? "distance from the z axis"
                                                     : std::string(name_of(wanted.axis)),
                                       .x_unit = "m"};
                   }},
        observable);
}

}  // namespace grainbench::cli
