/// Named columns of plain numbers: what a checkpoint holds, without knowing how it is stored
/// (io/hdf5/checkpoint.hpp). Every bit that steers the next step goes through here.
#pragma once

#include "core/error.hpp"

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace grainbench {

class Archive {
public:
    using Column = std::variant<std::vector<double>,
                                std::vector<std::uint32_t>,
                                std::vector<std::uint64_t>,
                                std::vector<std::uint8_t>>;

    using Sink = std::function<void(const std::string& name, const Column& values)>;

    Archive() = default;

    /// Hands each column on and keeps none: a large state is never in memory twice.
    explicit Archive(Sink sink) : sink_(std::move(sink)) {}

    template <class T>
    void put(const std::string& name, std::vector<T> values) {
        put_column(name, std::move(values));
    }

    void put(const std::string& name, double value) { put(name, std::vector<double>{value}); }

    void put(const std::string& name, std::uint64_t value) {
        put(name, std::vector<std::uint64_t>{value});
    }

    /// Column of that name and type; an Error names what is missing or of another type.
    template <class T>
    const std::vector<T>& get(const std::string& name) const {
        const auto found = columns_.find(name);
        if (found == columns_.end() || !std::holds_alternative<std::vector<T>>(found->second)) {
            throw_input_output({.what = "the checkpoint has no usable column '" + name + "'",
                                .where = "checkpoint",
                                .likely_cause = "written by another version of grainbench",
                                .next_step = "run the scene again without --resume"});
        }
        return std::get<std::vector<T>>(found->second);
    }

    /// Column of that length.
    template <class T>
    const std::vector<T>& get(const std::string& name, std::size_t length) const {
        const std::vector<T>& column = get<T>(name);
        require(column.size() == length, name);
        return column;
    }

    double number(const std::string& name) const { return get<double>(name, 1)[0]; }

    std::uint64_t count(const std::string& name) const { return get<std::uint64_t>(name, 1)[0]; }

    /// Refuses a column whose content cannot be of this scene. Sums over the bytes tell damage;
    /// this is for files of other versions, and for what somebody made up.
    static void require(bool fits, const std::string& name) {
        if (!fits) {
            throw_input_output({.what = "the column '" + name + "' does not fit the scene",
                                .where = "checkpoint",
                                .likely_cause = "written by another version of grainbench",
                                .next_step = "run the scene again without --resume"});
        }
    }

    const std::map<std::string, Column>& columns() const { return columns_; }

    /// All of them; none are left.
    std::map<std::string, Column> take_columns() { return std::exchange(columns_, {}); }

    void put_column(const std::string& name, Column column) {
        if (sink_) {
            sink_(name, column);
        } else {
            columns_[name] = std::move(column);
        }
    }

private:
    Sink sink_;
    std::map<std::string, Column> columns_;
};

}  // namespace grainbench
