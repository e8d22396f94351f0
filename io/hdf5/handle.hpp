/// HDF5 held by the hand: ids that close themselves, one mutex around all calls, failures as
/// exceptions, files as images in memory. Private to io: this header shows HDF5.
///
/// Files are built and read in memory and go to the disk whole (io/atomic_file.hpp). So a full disk
/// is met by plain writes, whose errors are clear, and never by HDF5 in the middle of a flush.
#pragma once

#include <hdf5.h>

#include <cstdint>
#include <mutex>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace grainbench::io {

/// What HDF5 refused; readers and writers turn it into an Error that names the file.
struct Hdf5Failure : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// One use of HDF5: keeps other threads out and HDF5's own error printing off.
class Hdf5Session {
public:
    Hdf5Session();
    ~Hdf5Session();
    Hdf5Session(const Hdf5Session&) = delete;
    Hdf5Session& operator=(const Hdf5Session&) = delete;

private:
    std::scoped_lock<std::mutex> lock_;
    H5E_auto2_t print_before_ = nullptr;
    void* data_before_ = nullptr;
};

class Handle {
public:
    using Close = herr_t (*)(hid_t);

    /// \param action what was tried, for the message: "open the group 'x'"
    Handle(hid_t id, Close close, const std::string& action) : id_(id), close_(close) {
        if (id < 0) {
            throw Hdf5Failure("cannot " + action);
        }
    }

    ~Handle() {
        if (id_ >= 0) {
            close_(id_);
        }
    }

    Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}

    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    Handle& operator=(Handle&&) = delete;

    hid_t id() const { return id_; }

private:
    hid_t id_;
    Close close_;
};

/// Throws if a call failed; returns its result.
template <class Result>
Result must(Result result, const std::string& action) {
    if (result < 0) {
        throw Hdf5Failure("cannot " + action);
    }
    return result;
}

Handle create_file_image();

/// The bytes of the file where HDF5 holds them, until the file changes or is closed.
std::string_view bytes_of(const Handle& file);

Handle open_file_image(std::string& bytes);

Handle create_group(const Handle& parent, const std::string& name);
Handle open_group(const Handle& parent, const std::string& name);

/// Names of the members in the order in which they were made.
std::vector<std::string> members_of(const Handle& group);
bool has_member(const Handle& group, const std::string& name);

// Names may hold any character: those with a meaning in HDF5 paths are stored as %2F and the like.
std::string encode_link(std::string_view name);
std::string decode_link(std::string_view link);

void put_attribute(const Handle& object, const char* name, const std::string& text);
void put_attribute(const Handle& object, const char* name, std::int64_t value);
std::string text_attribute(const Handle& object, const char* name);
std::int64_t integer_attribute(const Handle& object, const char* name);

/// The type in which T is stored, the same on every machine.
template <class T>
hid_t stored_type();

/// Makes a data set of rows of `width` numbers (1: a plain column).
Handle put_dataset(const Handle& group,
                   const std::string& name,
                   hid_t type,
                   const void* data,
                   std::size_t rows,
                   std::size_t width);
Handle open_dataset(const Handle& group, const std::string& name);
std::size_t element_count(const Handle& dataset);
void read_dataset(const Handle& dataset, hid_t type, void* data);

template <class T>
Handle put_column(const Handle& group,
                  const std::string& name,
                  std::span<const T> values,
                  std::size_t width = 1) {
    return put_dataset(group, name, stored_type<T>(), values.data(), values.size() / width, width);
}

template <class T>
std::vector<T> column_of(const Handle& dataset) {
    std::vector<T> values(element_count(dataset));
    read_dataset(dataset, stored_type<T>(), values.data());
    return values;
}

template <class T>
std::vector<T> column_of(const Handle& group, const std::string& name) {
    return column_of<T>(open_dataset(group, name));
}

}  // namespace grainbench::io
