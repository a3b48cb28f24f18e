// SPDX-License-Identifier: Apache-2.0
#include "process.h"

#include "folder.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <poll.h>
#include <sstream>
#include <stdexcept>
#include <sys/wait.h>
#include <unistd.h>

namespace gnomon::test {
namespace {

/// In the child, after fork: only calls that are safe there, and exec.
[[noreturn]] void become(const std::vector<std::string>& arguments, const How& how, const char* cache, int out, int err)
{
    if (how.stdout_to != nullptr) {
        out = ::open(how.stdout_to, O_WRONLY);
    }
    ::dup2(out, STDOUT_FILENO);
    ::dup2(err, STDERR_FILENO);
    if (::chdir(how.folder.c_str()) != 0) {
        ::_exit(126);
    }
    ::setenv("XDG_CACHE_HOME", cache, 1);
    for (const auto& [name, value] : how.environment) {
        ::setenv(name.c_str(), value.c_str(), 1);
    }
    if (how.max_file_bytes != RLIM_INFINITY) {
        const rlimit limit{how.max_file_bytes, how.max_file_bytes};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    std::vector<char*> argv{const_cast<char*>(GNOMON_PROGRAM)};
    for (const std::string& argument : arguments) {
        argv.push_back(const_cast<char*>(argument.c_str()));
    }
    argv.push_back(nullptr);
    ::execv(GNOMON_PROGRAM, argv.data());
    ::_exit(127);
}

/// Both pipes at once, so that neither can fill up and block the program.
template <typename Read>
void drain(std::array<pollfd, 2> pipes, std::array<std::string*, 2> texts, const Read& on_read)
{
    std::array<char, 4096> buffer{};
    int open = 2;
    while (open > 0) {
        ::poll(pipes.data(), pipes.size(), -1);
        for (std::size_t i = 0; i < pipes.size(); ++i) {
            if (pipes[i].fd < 0 || pipes[i].revents == 0) {
                continue;
            }
            const ssize_t count = ::read(pipes[i].fd, buffer.data(), buffer.size());
            if (count > 0) {
                texts[i]->append(buffer.data(), static_cast<std::size_t>(count));
                on_read();
            } else if (count == 0 || errno != EINTR) {
                ::close(pipes[i].fd);
                pipes[i].fd = -1;
                --open;
            }
        }
    }
}

} // namespace

std::vector<std::string> Ran::errorLines() const
{
    std::vector<std::string> lines;
    std::istringstream in(err);
    for (std::string line; std::getline(in, line);) {
        if (line.find("no GPU found") == std::string::npos) {
            lines.push_back(line);
        }
    }
    return lines;
}

Ran gnomon(const std::vector<std::string>& arguments, const How& how)
{
    std::array<int, 2> out{};
    std::array<int, 2> err{};
    if (::pipe2(out.data(), O_CLOEXEC) != 0 || ::pipe2(err.data(), O_CLOEXEC) != 0) {
        throw std::runtime_error("no pipe");
    }
    static const Folder cache;
    const std::string cache_path = cache.path().string(); // made before the fork
    const pid_t child = ::fork();
    if (child < 0) {
        throw std::runtime_error("no process");
    }
    if (child == 0) {
        become(arguments, how, cache_path.c_str(), out[1], err[1]);
    }
    ::close(out[1]);
    ::close(err[1]);
    Ran ran;
    bool sent = how.signal_at.empty();
    drain({pollfd{out[0], POLLIN, 0}, pollfd{err[0], POLLIN, 0}}, {&ran.out, &ran.err}, [&] {
        if (!sent && ran.err.find(how.signal_at) != std::string::npos) {
            ::kill(child, how.signal);
            sent = true;
        }
    });
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    ran.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return ran;
}

} // namespace gnomon::test
