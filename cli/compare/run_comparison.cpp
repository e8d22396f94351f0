#include "cli/compare/run_comparison.hpp"

#include "io/hdf5/history.hpp"
#include "io/json/document.hpp"
#include "io/manifest.hpp"
#include "io/vtk/frame_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <set>

namespace grainbench::cli {
namespace {

namespace fs = std::filesystem;
using io::Json;

bool same_bits(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
    return std::equal(
        a.begin(), a.end(), b.begin(), b.end(), [](double x, double y) { return same_bits(x, y); });
}

class Comparer {
public:
    explicit Comparer(RunComparison& result) : result_(result) {}

    void compare(const io::History& a, const io::History& b) {
        const std::size_t count = std::min(a.realisations.size(), b.realisations.size());
        if (a.realisations.size() != b.realisations.size()) {
            note(fmt::format(
                "realisations: {} and {}", a.realisations.size(), b.realisations.size()));
        }
        for (std::size_t n = 0; n < count; ++n) {
            realisation_ = n + 1;
            compare(a.realisations[n].history, b.realisations[n].history);
        }
    }

    void compare(const fs::path& a, const fs::path& b) {
        const std::set<std::string> in_a = particle_files(a);
        const std::set<std::string> in_b = particle_files(b);
        std::set<std::string> of_one;
        std::set_symmetric_difference(in_a.begin(),
                                      in_a.end(),
                                      in_b.begin(),
                                      in_b.end(),
                                      std::inserter(of_one, of_one.begin()));
        if (!of_one.empty()) {
            note(fmt::format(
                "particle files: {} in one run only, first {}", of_one.size(), *of_one.begin()));
        }
        for (const std::string& file : in_a) {
            if (in_b.contains(file)) {
                ++result_.particle_files;
                compare_file(
                    file, io::read_particles_file(a / file), io::read_particles_file(b / file));
            }
        }
    }

private:
    void note(std::string text) { result_.structure.push_back(std::move(text)); }

    void compare(const io::HistoryTable& a, const io::HistoryTable& b) {
        if (a.rows() != b.rows()) {
            note(
                fmt::format("rows of realisation {}: {} and {}", realisation_, a.rows(), b.rows()));
        }
        for (std::size_t c = 0; c < a.columns.size(); ++c) {
            const auto same_name = [&](const HistoryColumn& column) {
                return column.name == a.columns[c].name;
            };
            const auto other = std::find_if(b.columns.begin(), b.columns.end(), same_name);
            if (other == b.columns.end()) {
                note("column of the first run only: " + a.columns[c].name);
                continue;
            }
            const auto place = static_cast<std::size_t>(other - b.columns.begin());
            compare_column(a, c, b.values[place]);
        }
        for (const HistoryColumn& column : b.columns) {
            if (std::none_of(a.columns.begin(), a.columns.end(), [&](const HistoryColumn& known) {
                    return known.name == column.name;
                })) {
                note("column of the second run only: " + column.name);
            }
        }
    }

    void compare_column(const io::HistoryTable& a, std::size_t c, const std::vector<double>& b) {
        ++result_.columns;
        const std::vector<double>& values = a.values[c];
        const std::vector<double>& time = a.values[0];
        ColumnDeviation deviation{
            .realisation = realisation_, .name = a.columns[c].name, .unit = a.columns[c].unit};
        double scale = 0.0;
        bool differs = false;
        for (std::size_t row = 0; row < std::min(values.size(), b.size()); ++row) {
            scale = std::max({scale, std::abs(values[row]), std::abs(b[row])});
            if (same_bits(values[row], b[row])) {
                continue;
            }
            const double gap = std::abs(values[row] - b[row]);
            // Not a number in one run is as far away as can be.
            if (!differs || gap > deviation.largest || std::isnan(gap)) {
                deviation.largest = gap;
                deviation.time = time[row];
            }
            if (!differs) {
                differs = true;
                keep_first_row({.realisation = realisation_,
                                .row = row,
                                .cycle = static_cast<std::uint64_t>(a.values[1][row]),
                                .time = time[row]});
            }
        }
        if (differs) {
            deviation.relative = scale > 0.0 ? deviation.largest / scale : 0.0;
            result_.deviations.push_back(std::move(deviation));
        }
    }

    void keep_first_row(const DifferingRow& row) {
        if (!result_.first_row || row.time < result_.first_row->time) {
            result_.first_row = row;
        }
    }

    void compare_file(const std::string& file,
                      const io::ParticleFile& a,
                      const io::ParticleFile& b) {
        bool same = a.frame.id == b.frame.id && a.frame.position == b.frame.position &&
                    a.arrays.size() == b.arrays.size();
        for (std::size_t k = 0; same && k < a.arrays.size(); ++k) {
            same = a.arrays[k].name == b.arrays[k].name &&
                   same_bits(a.arrays[k].values, b.arrays[k].values);
        }
        if (!same) {
            ++result_.differing_files;
            if (result_.first_differing_file.empty()) {
                result_.first_differing_file = file;
            }
        }
    }

    /// Relative paths, so that names sort by realisation, then by frame.
    static std::set<std::string> particle_files(const fs::path& run) {
        std::set<std::string> files;
        for (const auto& folder : fs::directory_iterator(run)) {
            if (!folder.is_directory() ||
                !folder.path().filename().string().starts_with("realisation-")) {
                continue;
            }
            for (const auto& file : fs::directory_iterator(folder.path())) {
                const std::string name = file.path().filename().string();
                if (name.starts_with("particles_") && file.path().extension() == ".vtu") {
                    files.insert((folder.path().filename() / name).string());
                }
            }
        }
        return files;
    }

    RunComparison& result_;
    std::size_t realisation_ = 1;
};

bool same_last_states(const fs::path& first, const fs::path& second) {
    const io::Manifest a = io::read_manifest(first / "manifest.json");
    const io::Manifest b = io::read_manifest(second / "manifest.json");
    return std::equal(a.realisations.begin(),
                      a.realisations.end(),
                      b.realisations.begin(),
                      b.realisations.end(),
                      [](const auto& x, const auto& y) { return x.state_hash == y.state_hash; });
}

}  // namespace

double RunComparison::largest_relative() const {
    double largest = 0.0;
    for (const ColumnDeviation& deviation : deviations) {
        largest = std::isnan(deviation.relative) ? std::numeric_limits<double>::infinity()
                                                 : std::max(largest, deviation.relative);
    }
    return largest;
}

bool RunComparison::is_same() const {
    return structure.empty() && deviations.empty() && differing_files == 0 && same_last_state;
}

bool RunComparison::is_within(double threshold) const {
    return is_same() || (threshold > 0.0 && structure.empty() && largest_relative() <= threshold);
}

RunComparison compare_runs(const fs::path& first, const fs::path& second) {
    RunComparison result;
    Comparer comparer(result);
    comparer.compare(io::read_history(first / "history.h5"),
                     io::read_history(second / "history.h5"));
    comparer.compare(first, second);
    result.same_last_state = same_last_states(first, second);
    return result;
}

std::string to_text(const RunComparison& c, double threshold) {
    std::string text;
    for (const std::string& line : c.structure) {
        text += "differs     " + line + "\n";
    }
    text += fmt::format("history     {} of {} columns are the same bits\n",
                        c.columns - c.deviations.size(),
                        c.columns);
    for (const ColumnDeviation& d : c.deviations) {
        text += fmt::format(
            "  realisation {}  {:<28} {:.3g} {} apart at most, {:.3g} of its size, at {:.6g} s\n",
            d.realisation,
            d.name,
            d.largest,
            d.unit,
            d.relative,
            d.time);
    }
    if (c.first_row) {
        text += fmt::format("first       row {} of realisation {}, cycle {}, {:.6g} s\n",
                            c.first_row->row,
                            c.first_row->realisation,
                            c.first_row->cycle,
                            c.first_row->time);
    }
    text += fmt::format("particles   {} of {} files hold the same bits{}\n",
                        c.particle_files - c.differing_files,
                        c.particle_files,
                        c.differing_files > 0 ? ", first not in " + c.first_differing_file : "");
    text += fmt::format("last state  {}\n", c.same_last_state ? "the same bits" : "differs");
    if (c.is_same()) {
        return text + "the two runs are the same\n";
    }
    return text + fmt::format("the two runs differ, {} the threshold of {:g}\n",
                              c.is_within(threshold) ? "within" : "over",
                              threshold);
}

std::string to_json(const RunComparison& c, double threshold) {
    Json json{{"same", c.is_same()},
              {"within_threshold", c.is_within(threshold)},
              {"threshold", threshold},
              {"structure", c.structure},
              {"columns", c.columns},
              {"deviations", Json::array()}};
    for (const ColumnDeviation& d : c.deviations) {
        json["deviations"].push_back({{"realisation", d.realisation},
                                      {"column", d.name},
                                      {"unit", d.unit},
                                      {"largest", d.largest},
                                      {"relative", d.relative},
                                      {"time", d.time}});
    }
    if (c.first_row) {
        json["first_differing_row"] = {{"realisation", c.first_row->realisation},
                                       {"row", c.first_row->row},
                                       {"cycle", c.first_row->cycle},
                                       {"time", c.first_row->time}};
    }
    json["particle_files"] = c.particle_files;
    json["differing_particle_files"] = c.differing_files;
    if (c.differing_files > 0) {
        json["first_differing_particle_file"] = c.first_differing_file;
    }
    json["same_last_state"] = c.same_last_state;
    return io::pretty_text(json);
}

}  // namespace grainbench::cli
