#include "io/atomic_file.hpp"

#include "core/error.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

namespace grainbench::io {
namespace {

struct Advice {
    std::string likely_cause;
    std::string next_step;
};

Advice advice_for(int code) {
    switch (code) {
        case ENOSPC:
        case EDQUOT:
            return {"the disk or the quota is full",
                    "free some space, or choose a folder on another disk with -o"};
        case EFBIG:
            return {"the file grew beyond the size limit of the process or the file system",
                    "raise the limit (ulimit -f), or choose a folder on another disk with -o"};
        case EACCES:
        case EPERM:
            return {"no permission for this file or its folder",
                    "change the permissions, or choose another folder with -o"};
        case EROFS:
            return {"the file system is mounted read-only",
                    "choose a folder on another disk with -o"};
        case ENOENT:
            return {"the file or its folder does not exist", "check the path for typing errors"};
        case ENOTDIR:
            return {"a part of the path is a file, not a folder",
                    "check the path for typing errors"};
        case EISDIR:
            return {"the path is a folder, not a file", "name a file"};
        case ENAMETOOLONG:
            return {"the name is too long for the file system", "choose a shorter path"};
        default:
            return {"a fault of the disk or the network file system",
                    "check the disk, or choose a folder on another one with -o"};
    }
}

[[noreturn]] void throw_system_error(const std::string& what,
                                     const std::filesystem::path& path,
                                     int code) {
    const Advice advice = advice_for(code);
    throw_input_output({.what = what + ": " + std::generic_category().message(code),
                        .where = path.string(),
                        .likely_cause = advice.likely_cause,
                        .next_step = advice.next_step});
}

/// A file descriptor that closes itself.
class Descriptor {
public:
    Descriptor(const std::filesystem::path& path, int flags)
        : value_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {}

    ~Descriptor() { close(); }

    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

    int value() const { return value_; }

    bool is_open() const { return value_ >= 0; }

    int close() {
        const int result = is_open() ? ::close(value_) : 0;
        value_ = -1;
        return result;
    }

private:
    int value_;
};

/// Errno of the first failure, 0 if the system has taken all bytes.
int write_all(const Descriptor& file, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(file.value(), bytes.data(), bytes.size());
        if (written < 0) {
            if (errno == EINTR) {
                continue;
            }
            return errno;
        }
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return 0;
}

/// Errno of the first failure, 0 if all bytes are on the disk.
int sync_and_close(Descriptor& file) {
    // Some special file systems have no fsync; there is nothing to wait for then.
    if (::fsync(file.value()) != 0 && errno != EINVAL && errno != ENOTSUP) {
        return errno;
    }
    return file.close() == 0 ? 0 : errno;
}

/// The rename itself must reach the disk, or a power cut could bring the old file back.
void sync_folder(const std::filesystem::path& folder) {
    Descriptor directory(folder.empty() ? "." : folder, O_RDONLY | O_DIRECTORY);
    if (directory.is_open()) {
        ::fsync(directory.value());
    }
}

}  // namespace

void write_file(const std::filesystem::path& path,
                std::string_view bytes,
                const std::filesystem::path& previous) {
    write_file(path, {bytes}, previous);
}

void write_file(const std::filesystem::path& path,
                std::initializer_list<std::string_view> pieces,
                const std::filesystem::path& previous) {
    std::filesystem::path temporary = path;
    temporary += ".tmp";
    Descriptor file(temporary, O_WRONLY | O_CREAT | O_TRUNC);
    if (!file.is_open()) {
        throw_system_error("cannot create a file", path, errno);
    }
    int failure = 0;
    for (auto piece = pieces.begin(); failure == 0 && piece != pieces.end(); ++piece) {
        failure = write_all(file, *piece);
    }
    failure = failure != 0 ? failure : sync_and_close(file);
    if (failure == 0 && !previous.empty() && std::rename(path.c_str(), previous.c_str()) != 0 &&
        errno != ENOENT) {
        failure = errno;
    }
    if (failure == 0 && std::rename(temporary.c_str(), path.c_str()) != 0) {
        failure = errno;
    }
    if (failure != 0) {
        ::unlink(temporary.c_str());
        throw_system_error("cannot write a file", path, failure);
    }
    sync_folder(path.parent_path());
}

std::string read_file(const std::filesystem::path& path) {
    Descriptor file(path, O_RDONLY);
    if (!file.is_open()) {
        throw_system_error("cannot open a file", path, errno);
    }

    struct stat status {};

    if (::fstat(file.value(), &status) != 0) {
        throw_system_error("cannot read a file", path, errno);
    }
    std::string bytes;
    bytes.reserve(static_cast<std::size_t>(status.st_size));
    std::string block(std::size_t{1} << 16, '\0');
    while (true) {
        const ssize_t count = ::read(file.value(), block.data(), block.size());
        if (count < 0 && errno == EINTR) {
            continue;
        }
        if (count < 0) {
            throw_system_error("cannot read a file", path, errno);
        }
        if (count == 0) {
            return bytes;
        }
        bytes.append(block, 0, static_cast<std::size_t>(count));
    }
}

bool file_exists(const std::filesystem::path& path) {
    std::error_code code;
    return std::filesystem::exists(path, code);
}

void make_folder(const std::filesystem::path& path) {
    std::error_code code;
    std::filesystem::create_directories(path, code);
    if (code || !std::filesystem::is_directory(path, code)) {
        throw_system_error("cannot make a folder", path, code ? code.value() : ENOTDIR);
    }
}

void remove_file(const std::filesystem::path& path) {
    if (::unlink(path.c_str()) != 0 && errno != ENOENT) {
        throw_system_error("cannot remove a file", path, errno);
    }
}

}  // namespace grainbench::io
