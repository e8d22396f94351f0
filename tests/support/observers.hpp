/// Observers that keep what a run reports, bit by bit, so that two runs can be compared.
#pragma once

#include "core/simulation.hpp"

#include <bit>
#include <cstdint>
#include <vector>

namespace grainbench::test {

/// The bits of a row: rows may hold NaN, which equals nothing.
inline std::vector<std::uint64_t> bits(const std::vector<double>& row) {
    std::vector<std::uint64_t> result;
    for (const double x : row) {
        result.push_back(std::bit_cast<std::uint64_t>(x));
    }
    return result;
}

/// Keeps every row of the history, every point of the traces, and of all fields density and
/// pressure.
class Recorder : public Observer {
public:
    void on_history(const Simulation& simulation) override {
        rows.push_back(bits(simulation.history_row()));
    }

    void on_fields(const Simulation& simulation) override {
        const FieldFrame frame = simulation.field_frame();
        fields.push_back(bits(frame.density));
        fields.push_back(bits(frame.pressure));
    }

    void on_trace(const Simulation& simulation) override {
        std::vector<double> row{simulation.time()};
        for (const TracePoint& point : simulation.trace_points()) {
            row.insert(row.end(),
                       {point.position.x,
                        point.position.y,
                        point.position.z,
                        point.velocity.x,
                        point.velocity.y,
                        point.velocity.z});
        }
        traces.push_back(bits(row));
    }

    std::vector<std::vector<std::uint64_t>> rows;
    std::vector<std::vector<std::uint64_t>> traces;
    std::vector<std::vector<std::uint64_t>> fields;
};

}  // namespace grainbench::test
