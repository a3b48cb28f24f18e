// SPDX-License-Identifier: Apache-2.0
// A GPU that is never heard of again. Each case in a process of its own: what the GPU may be at work with is left as it
// is.
#include "small_scene.h"
#include "vulkan_faults.h"

#include "host/frame_renderer.h"
#include "host/gpu.h"

#include <gnomon/error.h>

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>

namespace gnomon::test {
namespace {

constexpr int kAsItShould = 42;

void waitForADeafGpu()
{
    int asked = 0;
    auto gpu = std::make_unique<host::Gpu>(host::GpuOptions{.gpu = "software", .while_waiting = [&asked] {
                                                                if (++asked == 3) {
                                                                    throw std::runtime_error("asked to end");
                                                                }
                                                            }});
    const scene::Scene scene = host::test::smallScene();
    const scene::State state = scene::evaluate(scene, 0.0);
    auto uploaded = std::make_unique<host::SceneOnGpu>(*gpu, scene, state);
    auto renderer = std::make_unique<host::FrameRenderer>(*uploaded, host::RenderOptions{.width = 16, .height = 16});
    const DeafFences deaf;
    bool ended = false;
    try {
        renderer->draw(state, host::test::smallEye(), host::lightsOf(scene, state));
    } catch (const std::runtime_error& error) {
        ended = std::string(error.what()) == "asked to end";
    }
    const auto start = std::chrono::steady_clock::now();
    renderer.reset(); // no more waiting: the device is given up
    uploaded.reset();
    const bool given_up = gpu->abandoned();
    gpu.reset();
    const bool at_once = std::chrono::steady_clock::now() - start < std::chrono::seconds(5);
    std::_Exit(ended && given_up && at_once && host::anyDeviceAbandoned() ? kAsItShould : 1);
}

void waitForAGpuThatHangs()
{
    host::Gpu gpu({.gpu = "software", .patience_s = 0.5});
    const scene::Scene scene = host::test::smallScene();
    const scene::State state = scene::evaluate(scene, 0.0);
    const host::SceneOnGpu uploaded(gpu, scene, state);
    host::FrameRenderer renderer(uploaded, host::RenderOptions{.width = 16, .height = 16});
    const DeafFences deaf;
    try {
        renderer.draw(state, host::test::smallEye(), host::lightsOf(scene, state));
    } catch (const Error& error) {
        std::_Exit(error.kind() == ErrorKind::device_lost && DeafFences::waits() < 100 ? kAsItShould : 1);
    }
    std::_Exit(1);
}

TEST(DeafGpuDeathTest, AWaitEndsWhenItIsAskedTo)
{
    EXPECT_EXIT(waitForADeafGpu(), testing::ExitedWithCode(kAsItShould), "");
}

TEST(DeafGpuDeathTest, AWaitEndsWhenNothingComes)
{
    EXPECT_EXIT(waitForAGpuThatHangs(), testing::ExitedWithCode(kAsItShould), "");
}

} // namespace
} // namespace gnomon::test
