/// A folder for one test, empty at the start and gone at the end.
#pragma once

#include "core/error.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <string>

namespace grainbench {

class TemporaryFolder {
public:
    TemporaryFolder() {
        const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
        std::string name =
            std::string("grainbench-") + test->test_suite_name() + "-" + test->name();
        std::replace(name.begin(), name.end(), '/', '-');  // in names of parameterised tests
        // The number keeps apart two runs of the tests at the same time.
        path_ = std::filesystem::path(testing::TempDir()) / (name + "-" + std::to_string(getpid()));
        std::filesystem::remove_all(path_);
        std::filesystem::create_directories(path_);
    }

    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }

    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

    /// Number of entries in the folder itself.
    std::size_t count() const {
        return static_cast<std::size_t>(
            std::distance(std::filesystem::directory_iterator(path_), {}));
    }

private:
    std::filesystem::path path_;
};

/// The error that `action` throws, as "kind: text"; "nothing thrown" otherwise.
template <class Action>
std::string error_of(Action&& action) {
    try {
        action();
    } catch (const Error& error) {
        const char* kind = error.kind() == ErrorKind::bad_input      ? "bad input: "
                           : error.kind() == ErrorKind::input_output ? "input/output: "
                                                                     : "unstable: ";
        return kind + std::string(error.what());
    }
    return "nothing thrown";
}

}  // namespace grainbench
