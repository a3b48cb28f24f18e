// SPDX-License-Identifier: Apache-2.0
// Runs that are told to stop.
#include "folder.h"
#include "interrupt.h"
#include "lights_and_cameras.h"
#include "process.h"

#include "image/image_io.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <csignal>
#include <cstdlib>
#include <sys/stat.h>

namespace gnomon {
namespace {

/// A file without lights, of which the program says so before it traces: the moment to interrupt it.
std::string lightless()
{
    auto gltf = nlohmann::json::parse(test::kLightsAndCameras);
    gltf.erase("extensions");
    gltf.erase("extensionsUsed");
    gltf["nodes"][1].erase("extensions");
    return gltf.dump();
}

TEST(Interrupt, EndsATraceInOrder)
{
    const test::Folder folder;
    const test::Folder cache;
    test::spill(folder / "a.gltf", lightless());
    for (const auto& [number, status] : {std::pair{SIGINT, 130}, std::pair{SIGTERM, 143}}) {
        for (const bool frames : {false, true}) {
            std::vector<std::string> arguments{"render", "a.gltf",  "--truth",  "area",      "--mask",
                                               "--size", "900x900", "--ground", "--samples", "65536"};
            if (frames) {
                arguments.insert(arguments.end(), {"--frames", "0-9"});
            }
            test::How how{.folder = folder.path(), .environment = {{"XDG_CACHE_HOME", cache.path().string()}}};
            how.signal_at = "a sun is put in";
            how.signal = number;
            const test::Ran ran = test::gnomon(arguments, how);
            EXPECT_EQ(ran.status, status);
            EXPECT_EQ(ran.out, "");
            EXPECT_TRUE(ran.err.ends_with("gnomon: interrupted\n")) << ran.err;
            EXPECT_EQ(folder.names(), std::vector<std::string>{"a.gltf"});
            EXPECT_TRUE(cache.names().empty());
        }
    }
}

TEST(Interrupt, EndsFramesAndKeepsTheWholeOnes)
{
    const test::Folder folder;
    const test::Ran ran =
        test::gnomon({"render", "planes", "--size", "64x64", "--map-size", "64", "--frames", "0-99999", "-o", "out"},
                     {.folder = folder.path(), .signal = SIGINT, .signal_when = folder / "out/frame_0001.png"});
    EXPECT_EQ(ran.status, 130);
    EXPECT_TRUE(ran.err.ends_with("gnomon: interrupted\n")) << ran.err;
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "out")) {
        EXPECT_EQ(readImage(entry.path()).width, 64U) << entry.path();
        ++count;
    }
    EXPECT_GE(count, 2U);
    EXPECT_LT(count, 100000U);
}

/// The reader of the program's output has stopped reading, or never starts.
TEST(Interrupt, EndsAWaitForAReader)
{
    const test::Folder folder;
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    for (const char* option : {"--json=-", "--json=pipe"}) {
        test::How how{.folder = folder.path(), .out = test::Stream::unread};
        how.signal = SIGTERM;
        how.signal_when = folder / "a.svg"; // which comes before the JSON, and that is more than a pipe holds
        const test::Ran ran = test::gnomon({"plan", "rts", "--draw", "a.svg", option}, how);
        EXPECT_EQ(ran.status, 143) << option;
        EXPECT_EQ(ran.err, "gnomon: interrupted\n") << option;
        EXPECT_TRUE(std::filesystem::remove(folder / "a.svg"));
    }
    EXPECT_EQ(folder.names(), std::vector<std::string>{"pipe"});
}

/// In a process of its own, for signals stay set.
void endBySignals(std::initializer_list<int> numbers)
{
    app::watchForInterrupts();
    for (const int number : numbers) {
        std::raise(number);
    }
    std::_Exit(app::interruptFlag() ? app::interruptStatus() : EXIT_SUCCESS);
}

TEST(InterruptDeathTest, StatusIsOfTheFirstSignalAndTheSecondEndsAtOnce)
{
    EXPECT_EXIT(endBySignals({}), testing::ExitedWithCode(0), "");
    EXPECT_EXIT(endBySignals({SIGINT}), testing::ExitedWithCode(130), "");
    EXPECT_EXIT(endBySignals({SIGTERM}), testing::ExitedWithCode(143), "");
    EXPECT_EXIT(endBySignals({SIGHUP}), testing::ExitedWithCode(129), "");
    EXPECT_EXIT(endBySignals({SIGTERM, SIGINT, SIGTERM}), testing::ExitedWithCode(130), "");
    EXPECT_EXIT(endBySignals({SIGINT, SIGTERM, SIGINT}), testing::ExitedWithCode(143), "");
}

} // namespace
} // namespace gnomon
