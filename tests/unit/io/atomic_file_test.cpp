#include "io/atomic_file.hpp"

#include "tests/unit/io/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>

namespace grainbench::io {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

/// Takes write permission away even from root, who would not notice a read-only folder.
class WithoutPrivilege {
public:
    WithoutPrivilege() : was_root_(geteuid() == 0) {
        if (was_root_ && seteuid(65534) != 0) {
            throw std::runtime_error("cannot drop the privileges of root");
        }
    }

    ~WithoutPrivilege() {
        if (was_root_ && seteuid(0) != 0) {
            std::abort();
        }
    }

private:
    bool was_root_;
};

/// Lets writes beyond a size fail, as a full disk would.
class FileSizeLimit {
public:
    explicit FileSizeLimit(rlim_t size) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit{size, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }

    ~FileSizeLimit() {
        setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }

private:
    rlimit before_{};
    void (*handler_)(int);
};

TEST(AtomicFile, ReadsBackEveryByte) {
    const TemporaryFolder folder;
    std::string bytes(100'000, '\0');
    for (std::size_t k = 0; k < bytes.size(); ++k) {
        bytes[k] = static_cast<char>(k * k % 251);
    }
    write_file(folder / "a file.v1.5 \xC3\xBC\xE7\xB2\x92.bin", bytes);
    EXPECT_EQ(read_file(folder / "a file.v1.5 \xC3\xBC\xE7\xB2\x92.bin"), bytes);
    EXPECT_EQ(folder.count(), 1U);
}

TEST(AtomicFile, FailedWriteKeepsTheOldFileAndLeavesNothingElse) {
    const TemporaryFolder folder;
    write_file(folder / "f", "old");
    {
        const FileSizeLimit limit(4096);
        EXPECT_THAT(error_of([&] { write_file(folder / "f", std::string(10'000, 'x')); }),
                    AllOf(StartsWith("input/output: cannot write a file: File too large"),
                          HasSubstr((folder / "f").string()),
                          HasSubstr("next step")));
    }
    EXPECT_EQ(read_file(folder / "f"), "old");
    EXPECT_EQ(folder.count(), 1U);
}

TEST(AtomicFile, FailedWriteLeavesThePreviousFileInPlace) {
    const TemporaryFolder folder;
    write_file(folder / "f", "first");
    write_file(folder / "f", "second", folder / "f-previous");
    {
        const FileSizeLimit limit(4096);
        EXPECT_THROW(write_file(folder / "f", std::string(10'000, 'x'), folder / "f-previous"),
                     Error);
    }
    EXPECT_EQ(read_file(folder / "f"), "second");
    EXPECT_EQ(read_file(folder / "f-previous"), "first");
    EXPECT_EQ(folder.count(), 2U);
}

TEST(AtomicFile, ReadOnlyFolderIsNamedWithCauseAndNextStep) {
    const TemporaryFolder folder;
    std::filesystem::permissions(
        folder.path(), std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
    std::string message;
    {
        const WithoutPrivilege unprivileged;
        message = error_of([&] { write_file(folder / "f", "x"); });
    }
    std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_all);
    EXPECT_THAT(message,
                AllOf(HasSubstr("Permission denied"),
                      HasSubstr((folder / "f").string()),
                      HasSubstr("choose another folder with -o")));
}

TEST(AtomicFile, MissingFolderIsNamedWithCauseAndNextStep) {
    const TemporaryFolder folder;
    EXPECT_THAT(error_of([&] { write_file(folder / "no" / "f", "x"); }),
                AllOf(HasSubstr("No such file"), HasSubstr("f"), HasSubstr("check the path")));
    EXPECT_THAT(error_of([&] { read_file(folder / "no"); }), HasSubstr("No such file"));
}

TEST(AtomicFile, FolderInTheWayIsNotReplaced) {
    const TemporaryFolder folder;
    make_folder(folder / "f" / "g");
    EXPECT_THAT(error_of([&] { write_file(folder / "f", "x"); }), HasSubstr("Is a directory"));
    write_file(folder / "plain", "x");
    EXPECT_THAT(error_of([&] { make_folder(folder / "plain" / "g"); }),
                HasSubstr("Not a directory"));
    EXPECT_EQ(folder.count(), 2U);
}

}  // namespace
}  // namespace grainbench::io
