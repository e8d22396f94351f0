#include "io/hdf5/checkpoint.hpp"

#include "core/error.hpp"

#include "io/atomic_file.hpp"
#include "io/hdf5/handle.hpp"
#include "io/hdf5/seal.hpp"

namespace grainbench::io {
namespace {

std::string group_name(std::size_t realisation) {
    return "realisation-" + std::to_string(realisation + 1);
}

/// Gives the memory of each column back once HDF5 has it.
void put_archive(const Handle& group, Archive& archive) {
    for (auto& [name, column] : archive.take_columns()) {
        std::visit([&group, &name = name]<class T>(
                       const std::vector<T>& values) { put_column<T>(group, name, values); },
                   column);
        column = Archive::Column();
    }
}

Archive::Column archived_column(const Handle& dataset, const std::string& name) {
    const Handle type(H5Dget_type(dataset.id()), H5Tclose, "read the type of '" + name + "'");
    const auto is = [&](hid_t other) { return H5Tequal(type.id(), other) > 0; };
    if (is(stored_type<double>())) {
        return column_of<double>(dataset);
    }
    if (is(stored_type<std::uint32_t>())) {
        return column_of<std::uint32_t>(dataset);
    }
    if (is(stored_type<std::uint64_t>())) {
        return column_of<std::uint64_t>(dataset);
    }
    if (is(stored_type<std::uint8_t>())) {
        return column_of<std::uint8_t>(dataset);
    }
    throw Hdf5Failure("cannot use the type of '" + name + "'");
}

Archive archive_of(const Handle& group) {
    Archive archive;
    for (const std::string& name : members_of(group)) {
        archive.put_column(name, archived_column(open_dataset(group, name), name));
    }
    return archive;
}

Handle encode(Checkpoint& checkpoint) {
    Handle file = create_file_image();
    put_attribute(file, "format", checkpoint_format);
    put_attribute(file, "scene_hash", checkpoint.scene_hash);
    put_attribute(file, "realisations", static_cast<std::int64_t>(checkpoint.realisations.size()));
    for (std::size_t k = 0; k < checkpoint.realisations.size(); ++k) {
        if (checkpoint.realisations[k]) {
            put_archive(create_group(file, group_name(k)), *checkpoint.realisations[k]);
        }
    }
    return file;
}

Checkpoint decode(const std::filesystem::path& path) {
    try {
        std::string content = unsealed(checkpoint_format, read_file(path));
        const Hdf5Session session;
        const Handle file = open_file_image(content);
        Checkpoint checkpoint;
        checkpoint.scene_hash = text_attribute(file, "scene_hash");
        checkpoint.realisations.resize(
            static_cast<std::size_t>(integer_attribute(file, "realisations")));
        for (std::size_t k = 0; k < checkpoint.realisations.size(); ++k) {
            if (has_member(file, group_name(k))) {
                checkpoint.realisations[k] = archive_of(open_group(file, group_name(k)));
            }
        }
        return checkpoint;
    } catch (const Hdf5Failure& failure) {
        throw_input_output({.what = "cannot read a checkpoint: " + std::string(failure.what()),
                            .where = path.string(),
                            .likely_cause = "the disk or a copy damaged the file",
                            .next_step = "run the scene again without --resume"});
    }
}

/// The newest readable of the two files.
std::optional<Checkpoint> newest_of(const std::filesystem::path& path,
                                    const std::filesystem::path& previous,
                                    std::string& warning) {
    const bool has_previous = file_exists(previous);
    std::string reason = "the newest checkpoint is missing";
    if (file_exists(path)) {
        try {
            return decode(path);
        } catch (const Error& failure) {
            if (!has_previous) {
                throw;
            }
            reason = failure.diagnosis().what + " (" + path.string() + ")";
        }
    }
    if (!has_previous) {
        return std::nullopt;
    }
    Checkpoint checkpoint;
    try {
        checkpoint = decode(previous);
    } catch (const Error& failure) {
        throw_input_output({.what = reason + ", and the one before it cannot be read either: " +
                                    failure.diagnosis().what,
                            .where = previous.string(),
                            .likely_cause = "the disk or a copy damaged the files",
                            .next_step = "run the scene again without --resume"});
    }
    warning = reason + "; going on from the one before it (" + previous.string() + ")";
    return checkpoint;
}

}  // namespace

std::filesystem::path previous_checkpoint(const std::filesystem::path& path) {
    std::filesystem::path previous = path.stem();
    previous += "-previous";
    previous += path.extension();
    return path.parent_path() / previous;
}

void write_checkpoint(const std::filesystem::path& path, Checkpoint checkpoint) {
    try {
        const Hdf5Session session;
        const Handle file = encode(checkpoint);
        const std::string_view bytes = bytes_of(file);
        write_file(path, {seal_of(checkpoint_format, bytes), bytes}, previous_checkpoint(path));
    } catch (const Hdf5Failure& failure) {
        throw_input_output(
            {.what = "HDF5 cannot build a checkpoint: " + std::string(failure.what()),
             .where = path.string(),
             .likely_cause = "not enough memory",
             .next_step = "run fewer realisations at a time"});
    }
}

std::optional<Checkpoint> read_checkpoint(const std::filesystem::path& path,
                                          const std::string& scene_hash,
                                          std::string& warning) {
    std::optional<Checkpoint> checkpoint = newest_of(path, previous_checkpoint(path), warning);
    if (checkpoint && checkpoint->scene_hash != scene_hash) {
        throw_bad_input(
            {.what = "the checkpoint belongs to another scene",
             .where = path.string(),
             .likely_cause = "the scene, or a file it reads, changed since the run began",
             .next_step = "resume with the scene.json of that folder, or choose another "
                          "folder with -o"});
    }
    return checkpoint;
}

}  // namespace grainbench::io
