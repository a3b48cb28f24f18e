// SPDX-License-Identifier: Apache-2.0
// Every call of Vulkan's that may fail fails once while our own host opens a device, uploads a scene, draws and reads
// back: a typed error comes out, and as much is destroyed as was made.
#include "host/frame_renderer.h"
#include "small_scene.h"
#include "sweep.h"
#include "vulkan_faults.h"

#include <gnomon/error.h>

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <optional>

namespace gnomon::host::test {
namespace {

using gnomon::test::FailingCall;
using gnomon::test::fallibleVulkanCalls;
using gnomon::test::liveVulkanObjects;
using gnomon::test::sweepPoints;

constexpr WantedImages kColourAndMasks{.colour = true, .masks = true};

RenderOptions tinyOptions(Filter filter, MapFormat format)
{
    RenderOptions options;
    options.width = 32;
    options.height = 32;
    options.anti_aliasing = AntiAliasing::fxaa;
    options.bloom.on = true;
    options.shadow.map_size = 32;
    options.shadow.technique.filter = filter;
    options.shadow.technique.fit =
        Fit::uniform; // what auto came to in the frames before is not what a new renderer finds
    options.shadow.format = format;
    return options;
}

/// A device, a scene and a renderer, two techniques, two sizes, a frame that reads itself back and one that is read.
class HostWalk {
public:
    explicit HostWalk(bool validate = false) : validate_(validate) {}

    Picture run()
    {
        gpu_ = std::make_unique<Gpu>(GpuOptions{.gpu = "software", .validate = validate_});
        uploaded_ = std::make_unique<SceneOnGpu>(*gpu_, scene_, state_);
        renderer_ = std::make_unique<FrameRenderer>(*uploaded_, tinyOptions(Filter::pcf, MapFormat::d32f));
        draw();
        renderer_->resize(40, 24);
        renderer_->setShadows(tinyOptions(Filter::vsm, MapFormat::rg32f).shadow);
        ReadBack back(*gpu_, kColourAndMasks);
        renderer_->submit(state_, smallEye(), lightsOf(scene_, state_), &back);
        (void)renderer_->finish();
        (void)back.picture();
        return draw();
    }
    /// A frame that is drawn whatever came before, if there is a renderer.
    [[nodiscard]] std::optional<Picture> drawAfterwards() { return renderer_ ? std::optional(draw()) : std::nullopt; }
    [[nodiscard]] std::optional<RenderOptions> options() const
    {
        return renderer_ ? std::optional(renderer_->options()) : std::nullopt;
    }
    [[nodiscard]] std::vector<std::string> messages() const
    {
        return gpu_ ? gpu_->messages() : std::vector<std::string>{};
    }
    /// By a renderer of its own.
    [[nodiscard]] Picture drawnByNew(const RenderOptions& options)
    {
        FrameRenderer fresh(*uploaded_, options);
        fresh.draw(state_, smallEye(), lightsOf(scene_, state_));
        return fresh.read(kColourAndMasks);
    }

private:
    Picture draw()
    {
        renderer_->draw(state_, smallEye(), lightsOf(scene_, state_));
        return renderer_->read(kColourAndMasks);
    }

    bool validate_;
    scene::Scene scene_ = smallScene();
    scene::State state_ = scene::evaluate(scene_, 0.3);
    std::unique_ptr<Gpu> gpu_;
    std::unique_ptr<SceneOnGpu> uploaded_;
    std::unique_ptr<FrameRenderer> renderer_;
};

std::optional<Error> errorOf(const std::function<void()>& work)
{
    try {
        work();
    } catch (const Error& error) {
        return error;
    }
    return std::nullopt;
}

std::uint64_t callsOfAWalk()
{
    const std::uint64_t before = fallibleVulkanCalls();
    const std::int64_t live = liveVulkanObjects();
    {
        HostWalk walk;
        (void)walk.run();
        EXPECT_GT(liveVulkanObjects(), live + 50);
    }
    EXPECT_EQ(liveVulkanObjects(), live);
    return fallibleVulkanCalls() - before;
}

class HostFaults : public testing::TestWithParam<std::pair<VkResult, ErrorKind>> {};

TEST_P(HostFaults, AreTypedAndLeaveNothing)
{
    const auto& [result, kind] = GetParam();
    const std::uint64_t calls = callsOfAWalk();
    const std::int64_t live = liveVulkanObjects();
    std::size_t survived = 0; // failures that nothing depends on
    for (const std::uint64_t point : sweepPoints("host, result " + std::to_string(result), calls, 24)) {
        SCOPED_TRACE("call " + std::to_string(point));
        {
            HostWalk walk;
            std::optional<Error> error;
            {
                const FailingCall failing(point, result);
                error = errorOf([&] { (void)walk.run(); });
            }
            survived += error ? 0 : 1;
            if (error) {
                EXPECT_EQ(error->kind(), kind) << error->what();
            }
            if (kind != ErrorKind::device_lost && walk.options()) {
                EXPECT_TRUE(walk.drawAfterwards()->masks.front().values ==
                            walk.drawnByNew(*walk.options()).masks.front().values);
            }
        }
        ASSERT_EQ(liveVulkanObjects(), live);
        ASSERT_FALSE(HasFailure());
    }
    EXPECT_LE(survived, 3U) << "the pipeline cache is not stored, and that is all";
    HostWalk again; // as if nothing had been
    EXPECT_FALSE(again.run().masks.empty());
}

INSTANTIATE_TEST_SUITE_P(Results, HostFaults,
                         testing::Values(std::pair{VK_ERROR_OUT_OF_DEVICE_MEMORY, ErrorKind::out_of_memory},
                                         std::pair{VK_ERROR_OUT_OF_HOST_MEMORY, ErrorKind::out_of_memory},
                                         std::pair{VK_ERROR_DEVICE_LOST, ErrorKind::device_lost}),
                         [](const auto& one) {
                             return std::string(one.param.first == VK_ERROR_DEVICE_LOST          ? "DeviceLost"
                                                : one.param.first == VK_ERROR_OUT_OF_HOST_MEMORY ? "HostMemory"
                                                                                                 : "DeviceMemory");
                         });

// Under the validation layer what is destroyed too early, twice or not at all is said aloud.
TEST(HostFaultsUnderLayers, SayNothing)
{
    const std::uint64_t calls = callsOfAWalk();
    for (const std::uint64_t point : sweepPoints("host under layers", calls, 8)) {
        for (const VkResult result : {VK_ERROR_OUT_OF_DEVICE_MEMORY, VK_ERROR_DEVICE_LOST}) {
            SCOPED_TRACE("call " + std::to_string(point));
            HostWalk walk(true);
            {
                const FailingCall failing(point, result);
                (void)errorOf([&] { (void)walk.run(); });
            }
            EXPECT_EQ(walk.messages(), std::vector<std::string>{});
        }
    }
}

} // namespace
} // namespace gnomon::host::test
