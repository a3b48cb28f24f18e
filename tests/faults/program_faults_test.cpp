// SPDX-License-Identifier: Apache-2.0
// Calls of Vulkan's that fail, or fences that nobody hears of, while the program runs: a line, a status, nothing left.
#include "folder.h"
#include "process.h"
#include "sweep.h"
#include "vulkan_faults.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <thread>
#include <unistd.h>

namespace gnomon::test {
namespace {

struct Command {
    const char* name;
    std::vector<std::string> arguments;
    std::uint64_t most; // points, where not all are asked for
};

const Command kRender{"render", {"render", "planes", "--size", "16x16", "--map-size", "32", "-o", "a.png"}, 12};
const Command kCompare{"compare",
                       {"compare", "planes", "--size", "32x32", "--map-size", "32", "--techniques", "hard,vsm",
                        "--samples", "4", "--repetitions", "1", "--warmup", "0", "--report", "report", "--json",
                        "a.json"},
                       12};

using Fault = std::tuple<Command, VkResult>;

/// A folder to run in, whose contents go after each run, and a cache of truths that stays.
class Place {
public:
    struct Outcome {
        Ran ran;
        std::vector<std::string> names; // that were left, in alphabetical order
    };

    [[nodiscard]] Outcome run(const Command& command) const
    {
        Outcome outcome;
        outcome.ran = gnomon(command.arguments,
                             {.folder = folder_.path(), .environment = {{"XDG_CACHE_HOME", cache_.path().string()}}});
        outcome.names = folder_.names();
        std::sort(outcome.names.begin(), outcome.names.end());
        for (const std::string& name : outcome.names) {
            std::filesystem::remove_all(folder_ / name);
        }
        return outcome;
    }

private:
    Folder folder_;
    Folder cache_;
};

class ProgramFaults : public testing::TestWithParam<Fault> {};

TEST_P(ProgramFaults, AreALineAndLeaveNothing)
{
    const auto& [command, result] = GetParam();
    const Place place;
    (void)place.run(command); // what is cached is
    const std::uint64_t before = fallibleVulkanCalls();
    const std::int64_t live = liveVulkanObjects();
    const Place::Outcome whole = place.run(command);
    ASSERT_EQ(whole.ran.status, 0) << whole.ran.err;
    ASSERT_FALSE(whole.names.empty());
    const std::uint64_t calls = fallibleVulkanCalls() - before;
    std::size_t survived = 0; // failures that nothing depends on
    for (const std::uint64_t point :
         sweepPoints(std::string(command.name) + ", result " + std::to_string(result), calls, command.most)) {
        SCOPED_TRACE("call " + std::to_string(point));
        Place::Outcome outcome;
        {
            const FailingCall failing(point, result);
            outcome = place.run(command);
        }
        EXPECT_EQ(liveVulkanObjects(), live);
        if (outcome.ran.status == 0) {
            ++survived;
            EXPECT_EQ(outcome.names, whole.names);
        } else {
            EXPECT_EQ(outcome.ran.status, 1);
            EXPECT_EQ(outcome.ran.out, "");
            EXPECT_EQ(outcome.ran.errorLines().size(), 1U) << outcome.ran.err;
            EXPECT_EQ(outcome.names, std::vector<std::string>{});
        }
        ASSERT_FALSE(HasFailure()) << outcome.ran.err;
    }
    EXPECT_LE(survived, 3U) << "the pipeline cache is not stored, and that is all";
    EXPECT_EQ(place.run(command).names, whole.names);
}

INSTANTIATE_TEST_SUITE_P(Runs, ProgramFaults,
                         testing::Combine(testing::Values(kRender, kCompare),
                                          testing::Values(VK_ERROR_OUT_OF_DEVICE_MEMORY, VK_ERROR_DEVICE_LOST)),
                         [](const auto& one) {
                             return std::string(std::get<0>(one.param).name) +
                                    (std::get<1>(one.param) == VK_ERROR_DEVICE_LOST ? "_lost" : "_memory");
                         });

/// In a process of its own: what the GPU may be at work with is left as it is, and signals stay set.
void beTerminatedWhileWaiting(const std::filesystem::path& folder)
{
    const DeafFences deaf;
    std::thread([] {
        while (DeafFences::waits() < 2) {
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        ::kill(::getpid(), SIGTERM);
    }).detach();
    const Ran ran = gnomon(kRender.arguments, {.folder = folder});
    std::fputs(ran.err.c_str(), stderr);
    std::_Exit(ran.status);
}

TEST(DeafProgramDeathTest, EndsAtASignalAndLeavesNothing)
{
    const Folder folder;
    EXPECT_EXIT(beTerminatedWhileWaiting(folder.path()), testing::ExitedWithCode(128 + SIGTERM), "interrupted\n$");
    EXPECT_EQ(folder.names(), std::vector<std::string>{});
}

} // namespace
} // namespace gnomon::test
