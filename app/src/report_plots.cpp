// SPDX-License-Identifier: Apache-2.0
#include "report_plots.h"

#include "plot_script.h"

#include <cerrno>
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace gnomon::app {
namespace {

constexpr int kNotThere = 3; // what the script ends with when there is no matplotlib

/// Runs the script without a word; its exit status.
int plotWith(const char* python, const std::string& result, const std::string& folder)
{
    posix_spawn_file_actions_t quiet;
    posix_spawn_file_actions_init(&quiet);
    posix_spawn_file_actions_addopen(&quiet, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&quiet, STDOUT_FILENO, STDERR_FILENO);
    const char* const words[] = {python, "-c", kPlotScript, result.c_str(), folder.c_str(), nullptr};
    pid_t child = 0;
    const int failure = ::posix_spawnp(&child, python, &quiet, nullptr, const_cast<char* const*>(words), environ);
    posix_spawn_file_actions_destroy(&quiet);
    if (failure != 0) {
        return kNotThere;
    }
    int status = 0;
    while (::waitpid(child, &status, 0) < 0) {
        if (errno != EINTR) {
            return EXIT_FAILURE;
        }
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : EXIT_FAILURE;
}

} // namespace

std::optional<std::string> drawPlots(const std::filesystem::path& result, const std::filesystem::path& folder)
{
    int status = kNotThere;
    // The first python3 need not be the one that Debian's matplotlib belongs to.
    for (const char* python : {"python3", "/usr/bin/python3"}) {
        status = plotWith(python, result.string(), folder.string());
        if (status != kNotThere) {
            break;
        }
    }
    if (status == 0) {
        return std::nullopt;
    }
    return std::string(
               status == kNotThere
                   ? "there is no python3 with matplotlib (Debian: python3-matplotlib), so the report has no plots"
                   : "tools/plot.py failed, so the report has no plots") +
           "; tools/plot.py draws them from result.json";
}

} // namespace gnomon::app
