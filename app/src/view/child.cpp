// SPDX-License-Identifier: Apache-2.0
#include "view/child.h"

#include <gnomon/error.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ; // NOLINT(readability-redundant-declaration): POSIX asks the program for it

namespace gnomon::app::view {

Child::Child(const std::vector<std::string>& command)
{
    const std::string tried = "starting " + command.front();
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) {
        throw Error(tried, std::strerror(errno));
    }
    pipe_ = ends[0];
    (void)fcntl(pipe_, F_SETFL, O_NONBLOCK);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&files, ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&files, ends[1], STDERR_FILENO);
    posix_spawnattr_t group; // of its own, so that what it starts can be ended with it
    posix_spawnattr_init(&group);
    posix_spawnattr_setflags(&group, POSIX_SPAWN_SETPGROUP);
    posix_spawnattr_setpgroup(&group, 0);
    std::vector<char*> arguments;
    arguments.reserve(command.size() + 1);
    for (const std::string& word : command) {
        arguments.push_back(const_cast<char*>(word.c_str())); // which posix_spawn() does not write to
    }
    arguments.push_back(nullptr);
    const int fault = posix_spawnp(&id_, arguments[0], &files, &group, arguments.data(), environ);
    posix_spawnattr_destroy(&group);
    posix_spawn_file_actions_destroy(&files);
    close(ends[1]);
    if (fault != 0) {
        close(pipe_);
        throw Error(tried, std::strerror(fault));
    }
}

Child::~Child()
{
    if (!status_) {
        kill(-id_, SIGTERM);
        (void)waitpid(id_, nullptr, 0);
    }
    close(pipe_);
}

void Child::hear()
{
    constexpr std::size_t kMost = std::size_t{1} << 20;
    std::array<char, 4096> part{};
    for (ssize_t count = 0; (count = read(pipe_, part.data(), part.size())) > 0;) {
        text_.append(part.data(), std::min(static_cast<std::size_t>(count), kMost - text_.size()));
    }
}

std::optional<int> Child::look()
{
    if (status_) {
        return status_;
    }
    hear();
    int status = 0;
    if (waitpid(id_, &status, WNOHANG) == id_) {
        hear(); // its last words
        status_ = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    return status_;
}

} // namespace gnomon::app::view
