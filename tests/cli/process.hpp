/// The program as a process of its own, for what only processes meet: signals, limits, full disks.
#pragma once

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace grainbench::cli {

/// `grainbench` with these arguments; what it says goes into files.
class Process {
public:
    /// \param prepare called in the new process before the program begins
    Process(std::vector<std::string> arguments,
            const std::filesystem::path& err,
            const std::function<void()>& prepare = {}) {
        std::vector<char*> pointers{const_cast<char*>(GRAINBENCH_PROGRAM)};
        for (std::string& argument : arguments) {
            pointers.push_back(argument.data());
        }
        pointers.push_back(nullptr);
        id_ = fork();
        if (id_ == 0) {
            const int file = open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
            dup2(file, STDOUT_FILENO);
            dup2(file, STDERR_FILENO);
            if (prepare) {
                prepare();
            }
            execv(GRAINBENCH_PROGRAM, pointers.data());
            _exit(127);
        }
    }

    ~Process() {
        if (id_ > 0) {
            kill(id_, SIGKILL);
            waitpid(id_, nullptr, 0);
        }
    }

    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    void send(int signal) const { kill(id_, signal); }

    bool is_running() {
        if (id_ > 0 && waitpid(id_, &status_, WNOHANG) == id_) {
            id_ = -1;
        }
        return id_ > 0;
    }

    /// Exit code, or minus the signal that ended it.
    int wait() {
        if (id_ > 0) {
            waitpid(id_, &status_, 0);
            id_ = -1;
        }
        return WIFEXITED(status_) ? WEXITSTATUS(status_) : -WTERMSIG(status_);
    }

private:
    pid_t id_ = -1;
    int status_ = 0;
};

}  // namespace grainbench::cli
