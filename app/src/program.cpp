// SPDX-License-Identifier: Apache-2.0
#include "app/command_line.h"

#include "interrupt.h"
#include "streams.h"
#include "subcommands.h"

#include "files/files.h"

#include <fmt/format.h>

#include <array>
#include <csignal>
#include <new>
#include <string_view>

namespace gnomon::app {
namespace {

constexpr std::array kSubcommands{
    Subcommand{"render", kRender, "[SCENE] [options]",
               "Draws a picture, or one light's visibility mask, to PNG or EXR.", runRender},
    Subcommand{"view", kView, "[SCENE] [options]", "Shows a scene in a window, where everything can be changed.",
               runView},
    Subcommand{"compare", kCompare, "[SCENE...] [options]",
               "Holds techniques against ray-traced truth, and times them.", runCompare},
    Subcommand{"metrics", kMetrics, "TEST TRUTH [options]", "Says how far one image is from another, PNG or EXR.",
               runMetrics},
    Subcommand{"plan", kPlan, "[SCENE] [options]",
               "Prints a frame's plan as JSON, or draws it; found layers need a GPU.", runPlan},
    Subcommand{"bench", kBench, "[SCENE] [options]", "Times every stage of techniques against the unshadowed frame.",
               runBench},
    Subcommand{"list", kList, "[NAME] [options]",
               "Prints the choices and what is refused and why, or one NAME in full.", runList},
    Subcommand{"gpus", kGpus, "[options]", "Lists this machine's GPUs: what each can, what is left out and why.",
               runGpus},
    Subcommand{"calibrate", kCalibrate, "[options]",
               "Measures how fast this device is, by which auto weighs error against time.", runCalibrate},
    Subcommand{"completion", kCompletion, "bash|zsh|fish", "Prints the shell's completion of gnomon's command lines.",
               runCompletion},
    Subcommand{"man", kMan, "", "Prints the manual page, for man to show.", runMan},
};

int complain(std::string_view line, int status)
{
    notice(line);
    return status;
}

int dispatch(std::span<const std::string> arguments)
{
    const Command command = parseCommandLine(arguments);
    switch (command.kind) {
    case Command::Kind::help:
        writeStdout(helpText(command.subcommand));
        return 0;
    case Command::Kind::version:
        writeStdout(fmt::format("gnomon {}\n", GNOMON_VERSION));
        return 0;
    case Command::Kind::run:
        break;
    }
    for (const std::string& sentence : command.notices) {
        notice(sentence);
    }
    return command.subcommand->run(command.settings);
}

} // namespace

std::span<const Subcommand> subcommands()
{
    return kSubcommands;
}

int runProgram(std::span<const std::string> arguments)
{
    holdStandardStreams();
    // A closed pipe and a file size limit are to come back as errors of the call, not to end the process half way.
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
    watchForInterrupts();
    callWhileWaiting(requireNotInterrupted);
    constexpr int kFailure = 1;
    constexpr int kWrongUsage = 2;
    constexpr int kClosedPipe = 128 + SIGPIPE; // that of a program which the signal ends, as shells have it
    try {
        return dispatch(arguments);
    } catch (const Interrupted& interrupted) {
        return complain(interrupted.what(), interruptStatus());
    } catch (const ClosedPipe&) {
        return kClosedPipe;
    } catch (const UsageError& error) {
        return complain(error.what(), kWrongUsage);
    } catch (const std::bad_alloc&) {
        return complain("out of memory; a smaller --size or --map-size, or a smaller scene, needs less", kFailure);
    } catch (const std::exception& error) {
        return complain(error.what(), kFailure);
    }
}

} // namespace gnomon::app
