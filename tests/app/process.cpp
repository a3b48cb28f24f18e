// SPDX-License-Identifier: Apache-2.0
#include "process.h"

#include "app/command_line.h"
#include "case_costs.h"
#include "folder.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <optional>
#include <poll.h>
#include <sstream>
#include <stdexcept>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

namespace gnomon::test {
namespace {

using Variables = std::vector<std::pair<std::string, std::string>>;

/// The variables that a run's environment has besides ours.
Variables variablesOf(const How& how)
{
    static const Folder cache;
    // Mesa's compiled shaders are kept from run to run: they are not under test, and take long.
    Variables variables{{"XDG_CACHE_HOME", cache.path().string()}, {"MESA_SHADER_CACHE_DIR", GNOMON_DRIVER_CACHE}};
    variables.insert(variables.end(), how.environment.begin(), how.environment.end());
    return variables;
}

/// Our own variables, with those of `changed` in place of ones of the same names; the last one of a name counts.
std::vector<std::string> environmentWith(const Variables& changed)
{
    std::vector<std::string> lines;
    for (char** line = environ; *line != nullptr; ++line) {
        lines.emplace_back(*line);
    }
    for (const auto& [name, value] : changed) {
        std::erase_if(lines, [&prefix = name](const std::string& line) { return line.starts_with(prefix + "="); });
        lines.push_back(name + "=" + value);
    }
    return lines;
}

/// As exec takes them; they are valid as long as `lines`.
std::vector<char*> pointersTo(std::vector<std::string>& lines)
{
    std::vector<char*> pointers;
    for (std::string& line : lines) {
        pointers.push_back(line.data());
    }
    pointers.push_back(nullptr);
    return pointers;
}

/// In the child, after fork; a broken pipe is one whose reader has gone.
void send(int descriptor, Stream stream, int caught)
{
    std::array<int, 2> pipe{};
    switch (stream) {
    case Stream::caught:
        ::dup2(caught, descriptor);
        break;
    case Stream::closed:
        ::close(descriptor);
        break;
    case Stream::full:
        ::dup2(::open("/dev/full", O_WRONLY | O_CLOEXEC), descriptor);
        break;
    case Stream::broken:
        if (::pipe2(pipe.data(), O_CLOEXEC) != 0) {
            ::_exit(126);
        }
        ::close(pipe[0]);
        ::dup2(pipe[1], descriptor);
        break;
    case Stream::unread:
        if (::pipe2(pipe.data(), O_CLOEXEC) != 0) {
            ::_exit(126);
        }
        ::fcntl(pipe[0], F_SETFD, 0); // the program has it open, and knows nothing of it
        ::dup2(pipe[1], descriptor);
        break;
    }
}

/// In the child, after fork. Other threads may have held any lock, that of the heap too, so nothing is called but what
/// POSIX calls async-signal-safe.
[[noreturn]] void become(const How& how, char* const* argv, char* const* environment, int out, int err)
{
    send(STDOUT_FILENO, how.out, out);
    send(STDERR_FILENO, how.err, err);
    if (::chdir(how.folder.c_str()) != 0) {
        ::_exit(126);
    }
    if (how.max_file_bytes != RLIM_INFINITY) {
        const rlimit limit{how.max_file_bytes, how.max_file_bytes};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    ::execve(GNOMON_PROGRAM, argv, environment);
    ::_exit(127);
}

/// Both pipes at once, so that neither can fill up and block the program. `waits` is asked after whatever happens, and
/// every few milliseconds while it says that there is something to wait for besides the pipes.
template <typename Waits>
void drain(std::array<pollfd, 2> pipes, std::array<std::string*, 2> texts, const Waits& waits)
{
    std::array<char, 4096> buffer{};
    int open = 2;
    while (open > 0) {
        constexpr int kAskEveryMs = 5;
        constexpr int kForEver = -1;
        if (::poll(pipes.data(), pipes.size(), waits() ? kAskEveryMs : kForEver) <= 0) {
            continue;
        }
        for (std::size_t i = 0; i < pipes.size(); ++i) {
            if (pipes[i].fd < 0 || pipes[i].revents == 0) {
                continue;
            }
            const ssize_t count = ::read(pipes[i].fd, buffer.data(), buffer.size());
            if (count > 0) {
                texts[i]->append(buffer.data(), static_cast<std::size_t>(count));
            } else if (count == 0 || errno != EINTR) {
                ::close(pipes[i].fd);
                pipes[i].fd = -1;
                --open;
            }
        }
    }
}

Ran spawn(const std::vector<std::string>& arguments, const How& how)
{
    noteDrawing();
    std::array<int, 2> out{};
    std::array<int, 2> err{};
    if (::pipe2(out.data(), O_CLOEXEC) != 0 || ::pipe2(err.data(), O_CLOEXEC) != 0) {
        throw std::runtime_error("no pipe");
    }
    std::vector<std::string> environment = environmentWith(variablesOf(how));
    std::vector<std::string> words{GNOMON_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    const std::vector<char*> argv = pointersTo(words);
    const std::vector<char*> envp = pointersTo(environment);
    const pid_t child = ::fork();
    if (child < 0) {
        throw std::runtime_error("no process");
    }
    if (child == 0) {
        become(how, argv.data(), envp.data(), out[1], err[1]);
    }
    ::close(out[1]);
    ::close(err[1]);
    Ran ran;
    bool sent = how.signal == 0;
    drain({pollfd{out[0], POLLIN, 0}, pollfd{err[0], POLLIN, 0}}, {&ran.out, &ran.err}, [&] {
        const bool now = !sent && ran.err.find(how.signal_at) != std::string::npos &&
                         (how.signal_when.empty() || std::filesystem::exists(how.signal_when));
        if (now) {
            ::kill(child, how.signal);
            sent = true;
        }
        return !sent && !how.signal_when.empty();
    });
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    ran.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return ran;
}

/// Sends what is written to a descriptor to memory, until it is taken or the object ends.
class Caught {
public:
    Caught(int descriptor, std::FILE* stream)
        : descriptor_(descriptor), stream_(stream), kept_(::fcntl(descriptor, F_DUPFD_CLOEXEC, 0)),
          memory_(::memfd_create("caught", MFD_CLOEXEC))
    {
        if (kept_ < 0 || memory_ < 0) {
            throw std::runtime_error("no descriptor");
        }
        std::fflush(stream_);
        ::dup2(memory_, descriptor_);
    }
    ~Caught()
    {
        std::fflush(stream_);
        ::dup2(kept_, descriptor_);
        ::close(kept_);
        ::close(memory_);
    }
    Caught(const Caught&) = delete;
    Caught& operator=(const Caught&) = delete;

    [[nodiscard]] std::string take()
    {
        std::fflush(stream_);
        std::string text;
        std::array<char, 4096> buffer{};
        for (ssize_t count = 0; (count = ::pread(memory_, buffer.data(), buffer.size(), ssize_t(text.size()))) > 0;) {
            text.append(buffer.data(), static_cast<std::size_t>(count));
        }
        return text;
    }

private:
    int descriptor_;
    std::FILE* stream_;
    int kept_;
    int memory_;
};

/// Sets variables of our environment, and puts back what they were.
class Environment {
public:
    explicit Environment(const Variables& variables)
    {
        for (const auto& [name, value] : variables) {
            const char* was = std::getenv(name.c_str());
            before_.emplace_back(name, was == nullptr ? std::nullopt : std::optional<std::string>(was));
            ::setenv(name.c_str(), value.c_str(), 1);
        }
    }
    ~Environment()
    {
        for (auto one = before_.rbegin(); one != before_.rend(); ++one) {
            one->second ? ::setenv(one->first.c_str(), one->second->c_str(), 1) : ::unsetenv(one->first.c_str());
        }
    }
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;

private:
    std::vector<std::pair<std::string, std::optional<std::string>>> before_;
};

/// Puts back the working folder at its end.
class WorkingFolder {
public:
    explicit WorkingFolder(const std::filesystem::path& folder) : before_(std::filesystem::current_path())
    {
        std::filesystem::current_path(folder);
    }
    ~WorkingFolder()
    {
        std::error_code ignored; // it was there before
        std::filesystem::current_path(before_, ignored);
    }
    WorkingFolder(const WorkingFolder&) = delete;
    WorkingFolder& operator=(const WorkingFolder&) = delete;

private:
    std::filesystem::path before_;
};

/// Puts back what signals do, so that a test run can be interrupted after the program was.
class Signals {
public:
    Signals()
    {
        for (std::size_t i = 0; i < kNumbers.size(); ++i) {
            ::sigaction(kNumbers[i], nullptr, &before_[i]);
        }
    }
    ~Signals()
    {
        for (std::size_t i = 0; i < kNumbers.size(); ++i) {
            ::sigaction(kNumbers[i], &before_[i], nullptr);
        }
    }
    Signals(const Signals&) = delete;
    Signals& operator=(const Signals&) = delete;

private:
    static constexpr std::array kNumbers{SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXFSZ};
    std::array<struct sigaction, kNumbers.size()> before_{};
};

Ran call(const std::vector<std::string>& arguments, const How& how)
{
    const Signals signals;
    const Environment environment(variablesOf(how));
    const WorkingFolder folder(how.folder);
    Caught out(STDOUT_FILENO, stdout);
    Caught err(STDERR_FILENO, stderr);
    Ran ran;
    ran.status = app::runProgram(arguments);
    ran.out = out.take();
    ran.err = err.take();
    return ran;
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
    const bool needs_its_own = how.max_file_bytes != RLIM_INFINITY || how.out != Stream::caught ||
                               how.err != Stream::caught || how.signal != 0 || !how.in_process;
    return needs_its_own ? spawn(arguments, how) : call(arguments, how);
}

} // namespace gnomon::test
