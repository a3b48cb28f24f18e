// SPDX-License-Identifier: Apache-2.0
// Frames without end, with lights, casters, sizes and techniques changing: memory stays as it is once everything has
// come round. GNOMON_SOAK_FRAMES says how many frames there are on the null driver, and a fiftieth of them drawn ones.
#include "changing_host.h"
#include "fixture.h"
#include "option_steps.h"
#include "planned_scene.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <malloc.h>
#include <string>
#include <unistd.h>
#include <utility>

namespace gnomon::test {
namespace {

std::uint64_t wantedFrames(std::uint64_t unless_said)
{
    const char* const said = std::getenv("GNOMON_SOAK_FRAMES");
    return said != nullptr ? std::strtoull(said, nullptr, 10) : unless_said;
}

/// The memory of this process, bytes.
std::uint64_t residentBytes()
{
    std::uint64_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages >> pages;
    return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

/// Bytes in use of the C library's heap; 0 where a sanitizer has replaced it.
std::uint64_t heapBytes()
{
    const struct mallinfo2 info = ::mallinfo2();
    return info.uordblks + info.hblkhd;
}

/// Freed memory that a sanitizer holds back counts as resident.
std::uint64_t heldBack()
{
    return heapBytes() == 0 ? 96U << 20U : 0;
}

struct Held {
    std::uint64_t device = 0; // bytes of the device's memory
    std::uint64_t heap = 0;
    std::uint64_t resident = 0;
};

void report(const char* name, std::uint64_t frames, const Held& warm, const Held& end)
{
    std::cout << "[   soak   ] " << name << ", " << frames << " frames: device " << warm.device << " -> " << end.device
              << ", heap " << warm.heap << " -> " << end.heap << ", resident " << warm.resident << " -> "
              << end.resident << " bytes\n";
}

// In rounds that are all alike, each with every technique, so that the end of one can be held against that of another.
constexpr std::uint32_t kFramesOfOne = 10;

FrameSetup setupOf(std::uint64_t frame)
{
    constexpr std::array<std::uint32_t, 5> kLights{1, 3, 9, 0, 5};
    constexpr std::array<VkExtent2D, 4> kScreens{{{64, 40}, {64, 40}, {96, 40}, {33, 70}}};
    FrameSetup setup;
    setup.lights = kLights[frame % kLights.size()];
    setup.screen = kScreens[frame % kScreens.size()];
    setup.inputs.normals = true;
    setup.inputs.ids = frame % 2 == 1;
    return setup;
}

/// The device's bytes after its second round and after its last, which draws the same frames.
std::pair<std::uint64_t, std::uint64_t> soakAHost(std::uint64_t rounds)
{
    ChangingHost host(vulkan::ShadowRendererOptions{.mask_shape = vulkan::MaskShape{.normals = true}});
    std::uint64_t warm = 0;
    for (std::uint64_t i = 0; i < rounds; ++i) {
        for (const char* const base : kBases) {
            Planner planner(optionsFrom(base));
            for (std::uint32_t k = 0; k < kFramesOfOne; ++k) {
                (void)host.frame(planner, setupOf(k));
            }
        }
        host.expectNoMistakes("round " + std::to_string(i));
        warm = i == 1 ? host.driver.counts().bytes : warm;
    }
    return {warm, host.driver.counts().bytes};
}

// The null driver remembers every object that there ever was, so it is given up with its host, and what is left then is
// held against what an earlier host left.
TEST(Soak, OfFramesOnTheNullDriverHoldsItsMemory)
{
    const std::uint64_t round = kFramesOfOne * kBases.size();
    const std::uint64_t rounds_of_a_host = wantedFrames(0) > 0 ? 20 : 3;
    const std::uint64_t hosts = std::max<std::uint64_t>(wantedFrames(0) / (rounds_of_a_host * round), 3);
    Held first;
    Held end;
    for (std::uint64_t i = 0; i < hosts; ++i) {
        const auto [warm, last] = soakAHost(rounds_of_a_host);
        ASSERT_FALSE(HasFailure());
        EXPECT_LE(last, warm) << "host " << i;
        end = {last, heapBytes(), residentBytes()};
        first = i == 0 ? end : first;
    }
    report("null driver", hosts * rounds_of_a_host * round, first, end);
    EXPECT_LE(end.heap, first.heap + (64U << 10U));                      // what is kept for threads counts as taken
    EXPECT_LT(end.resident, first.resident + (16U << 20U) + heldBack()); // what the C library keeps for later
}

TEST(Soak, OfDrawnFramesHoldsItsMemoryAndIsSilent)
{
    constexpr std::array<VkExtent2D, 2> kScreens{{{32, 24}, {24, 32}}};
    constexpr std::array<std::uint32_t, 4> kLights{1, 3, 2, 5};
    constexpr std::uint32_t kOfOne = 4;
    const std::uint64_t round = kOfOne * kBases.size();
    const std::uint64_t rounds = std::max<std::uint64_t>(wantedFrames(120 * 50) / 50 / round, 3);
    PlannedScene scene(gpu(), kScreens[0]);
    Drawing drawing(gpu(), scene.mesh());
    const auto deviceBytes = [&] {
        std::uint64_t bytes = 0;
        for (const auto& uses : {drawing.renderer.memory(), drawing.drawer.memory()}) {
            for (const vulkan::MemoryUse& use : uses) {
                bytes += use.bytes;
            }
        }
        return bytes;
    };
    Held warm;
    Held end;
    std::uint64_t index = 0;
    for (std::uint64_t i = 0; i < rounds; ++i) {
        for (const char* const base : kBases) {
            Planner planner(optionsFrom(base));
            for (std::uint32_t k = 0; k < kOfOne; ++k) {
                scene.remakeViews(kScreens[k / 2 % 2], true, k % 2 == 1);
                const std::vector<Light> lights = sunsAndSpots(kLights[k]);
                Frame frame = scene.frameOf(lights);
                frame.index = index++;
                frame.time_s = 0.1 * static_cast<double>(frame.index);
                (void)scene.draw(drawing, planner.plan(frame), k % 2);
            }
        }
        end = {deviceBytes(), heapBytes(), residentBytes()};
        if (i == 1) {
            warm = end;
        }
        EXPECT_LE(i < 2 ? 0 : end.device, warm.device) << "round " << i;
        expectSilence(gpu());
    }
    report("drawn", rounds * round, warm, end);
    // The layers remember every name that an object ever had, and llvmpipe a little of every frame.
    const std::uint64_t of_others = (1U << 20U) + 8192 * rounds * round;
    EXPECT_LT(end.heap, warm.heap + of_others);
    EXPECT_LT(end.resident, warm.resident + 2 * of_others + heldBack());
}

} // namespace
} // namespace gnomon::test
