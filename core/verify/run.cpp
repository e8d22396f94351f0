#include "core/verify/run.hpp"

namespace grainbench::verify {

Ball Run::ball(std::size_t place) const {
    const ParticleFrame frame = simulation_.particle_frame();
    return {.position = frame.position.at(place),
            .velocity = frame.velocity.at(place),
            .spin = frame.angular_velocity.at(place),
            .force = frame.force.at(place)};
}

double Run::now(std::string_view column) const {
    return simulation_.history_row().at(place_of(column));
}

std::vector<double> Run::series(std::string_view column) const {
    const std::size_t place = place_of(column);
    std::vector<double> values;
    for (const std::vector<double>& row : rows_) {
        values.push_back(row.at(place));
    }
    return values;
}

std::size_t Run::place_of(std::string_view column) const {
    const std::vector<HistoryColumn>& columns = simulation_.history_columns();
    for (std::size_t place = 0; place < columns.size(); ++place) {
        if (columns[place].name == column) {
            return place;
        }
    }
    throw_bad_input({.what = "the history has no column '" + std::string(column) + "'",
                     .where = "verification case",
                     .likely_cause = "a column was renamed, or its observable is off in the scene",
                     .next_step = "compare with Simulation::history_columns()"});
}

}  // namespace grainbench::verify
