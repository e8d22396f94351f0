#include "io/hdf5/history.hpp"

#include "core/error.hpp"

#include "io/atomic_file.hpp"
#include "io/hdf5/handle.hpp"
#include "io/hdf5/seal.hpp"
#include "io/text.hpp"

namespace grainbench::io {
namespace {

std::string group_name(std::size_t realisation) {
    return "realisation-" + std::to_string(realisation + 1);
}

constexpr const char* traces_group = "traces";

void put_traces(const Handle& group, const TraceTable& traces) {
    std::vector<std::int64_t> ids;
    std::vector<double> positions;
    std::vector<double> velocities;
    for (const TracePoint& point : traces.points) {
        ids.push_back(point.id);
        positions.insert(positions.end(), {point.position.x, point.position.y, point.position.z});
        velocities.insert(velocities.end(), {point.velocity.x, point.velocity.y, point.velocity.z});
    }
    put_attribute(put_column<double>(group, "time", traces.time), "unit", "s");
    put_attribute(put_column<std::int64_t>(group, "id", ids), "unit", "");
    put_attribute(put_column<double>(group, "position", positions, 3), "unit", "m");
    put_attribute(put_column<double>(group, "velocity", velocities, 3), "unit", "m/s");
}

TraceTable traces_of(const Handle& group) {
    TraceTable traces;
    traces.time = column_of<double>(group, "time");
    const auto ids = column_of<std::int64_t>(group, "id");
    const auto positions = column_of<double>(group, "position");
    const auto velocities = column_of<double>(group, "velocity");
    const std::size_t count = traces.time.size();
    if (ids.size() != count || positions.size() != 3 * count || velocities.size() != 3 * count) {
        throw Hdf5Failure("the columns of the traces differ in length");
    }
    for (std::size_t k = 0; k < count; ++k) {
        traces.points.push_back(
            {.id = ids[k],
             .position = {positions[3 * k], positions[3 * k + 1], positions[3 * k + 2]},
             .velocity = {velocities[3 * k], velocities[3 * k + 1], velocities[3 * k + 2]}});
    }
    return traces;
}

RealisationHistory realisation_of(const Handle& group) {
    RealisationHistory result;
    result.seed = integer_attribute(group, "seed");
    for (const std::string& name : members_of(group)) {
        if (name == traces_group) {
            result.traces = traces_of(open_group(group, name));
            continue;
        }
        const Handle dataset = open_dataset(group, name);
        result.history.columns.push_back({.name = name,
                                          .unit = text_attribute(dataset, "unit"),
                                          .doc = text_attribute(dataset, "description")});
        result.history.values.push_back(column_of<double>(dataset));
        if (result.history.values.back().size() != result.history.rows()) {
            throw Hdf5Failure("the columns of '" + name + "' and of the time differ in length");
        }
    }
    return result;
}

Handle encode(const History& history) {
    Handle file = create_file_image();
    put_attribute(file, "format", history_format);
    put_attribute(file, "program", history.program);
    put_attribute(file, "scene", history.scene);
    put_attribute(file, "scene_hash", history.scene_hash);
    for (std::size_t k = 0; k < history.realisations.size(); ++k) {
        const RealisationHistory& realisation = history.realisations[k];
        const Handle group = create_group(file, group_name(k));
        put_attribute(group, "seed", realisation.seed);
        for (std::size_t c = 0; c < realisation.history.columns.size(); ++c) {
            const HistoryColumn& column = realisation.history.columns[c];
            const Handle dataset =
                put_column<double>(group, column.name, realisation.history.values[c]);
            put_attribute(dataset, "unit", column.unit);
            put_attribute(dataset, "description", column.doc);
        }
        put_traces(create_group(group, traces_group), realisation.traces);
    }
    return file;
}

History decode(std::string bytes) {
    const Hdf5Session session;
    const Handle file = open_file_image(bytes);
    History history;
    history.program = text_attribute(file, "program");
    history.scene = text_attribute(file, "scene");
    history.scene_hash = text_attribute(file, "scene_hash");
    for (std::size_t k = 0; has_member(file, group_name(k)); ++k) {
        history.realisations.push_back(realisation_of(open_group(file, group_name(k))));
    }
    return history;
}

}  // namespace

void write_history(const std::filesystem::path& path, const History& history) {
    try {
        const Hdf5Session session;
        const Handle file = encode(history);
        const std::string_view bytes = bytes_of(file);
        write_file(path, {seal_of(history_format, bytes), bytes});
    } catch (const Hdf5Failure& failure) {
        throw_input_output({.what = "HDF5 cannot build a history: " + std::string(failure.what()),
                            .where = path.string(),
                            .likely_cause = "not enough memory, or two columns of the same name",
                            .next_step = "record fewer rows, or give the observables other names"});
    }
}

History read_history(const std::filesystem::path& path) {
    try {
        return decode(unsealed(history_format, read_file(path)));
    } catch (const Hdf5Failure& failure) {
        throw_input_output({.what = "cannot read a history: " + std::string(failure.what()),
                            .where = path.string(),
                            .likely_cause = "the file is damaged, or another program wrote it",
                            .next_step = "run the scene again to write it anew"});
    }
}

void write_history_csv(const std::filesystem::path& path, const History& history) {
    std::string text;
    for (std::size_t k = 0; k < history.realisations.size(); ++k) {
        const HistoryTable& table = history.realisations[k].history;
        if (text.empty() && !table.columns.empty()) {
            text = "realisation";
            for (const HistoryColumn& column : table.columns) {
                text += ',';
                text += csv_field(column.name);
            }
            text += '\n';
        }
        for (std::size_t row = 0; row < table.rows(); ++row) {
            text += std::to_string(k + 1);
            for (const std::vector<double>& column : table.values) {
                text += ',';
                text += to_text(column[row]);
            }
            text += '\n';
        }
    }
    write_file(path, text);
}

}  // namespace grainbench::io
