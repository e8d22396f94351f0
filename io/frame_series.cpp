#include "io/frame_series.hpp"

#include "io/atomic_file.hpp"
#include "io/text.hpp"

#include <charconv>
#include <optional>
#include <string_view>

namespace grainbench::io {
namespace {

/// Number in a name such as particles_000012.vtu; nothing if the name is of another kind.
std::optional<std::size_t> frame_of(std::string_view file,
                                    std::string_view prefix,
                                    std::string_view extension) {
    if (!file.starts_with(prefix) || !file.ends_with(extension) ||
        file.size() < prefix.size() + extension.size()) {
        return std::nullopt;
    }
    file.remove_prefix(prefix.size());
    file.remove_suffix(extension.size());
    std::size_t frame = 0;
    const auto [end, code] = std::from_chars(file.data(), file.data() + file.size(), frame);
    const bool is_number = code == std::errc{} && end == file.data() + file.size();
    return is_number ? std::optional(frame) : std::nullopt;
}

}  // namespace

FrameSeries::FrameSeries(std::filesystem::path folder, std::string name, std::string extension)
    : folder_(std::move(folder)), name_(std::move(name)), extension_(std::move(extension)) {}

std::string FrameSeries::file_of(std::size_t frame) const {
    return name_ + "_" + padded(frame) + extension_;
}

std::filesystem::path FrameSeries::pvd() const {
    return folder_ / (name_ + ".pvd");
}

std::filesystem::path FrameSeries::path_of(std::size_t frame) const {
    return folder_ / file_of(frame);
}

void FrameSeries::add(std::size_t frame, double time) {
    entries_.push_back({.time = time, .file = file_of(frame)});
    write_pvd(pvd(), entries_);
}

void FrameSeries::resume(std::size_t frame_count) {
    const std::string prefix = name_ + "_";
    const auto is_later = [&](std::string_view file) {
        const std::optional<std::size_t> frame = frame_of(file, prefix, extension_);
        return frame && *frame >= frame_count;
    };
    if (file_exists(pvd())) {
        entries_ = read_pvd(pvd());
        if (std::erase_if(entries_, [&](const PvdEntry& e) { return is_later(e.file); }) > 0) {
            write_pvd(pvd(), entries_);
        }
    }
    std::vector<std::filesystem::path> later;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
        if (is_later(entry.path().filename().string())) {
            later.push_back(entry.path());
        }
    }
    for (const std::filesystem::path& path : later) {
        remove_file(path);
    }
}

}  // namespace grainbench::io
