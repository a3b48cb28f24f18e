// SPDX-License-Identifier: Apache-2.0
// A mask that is drawn in strips because of a band between two positions of a sun, against the same mask drawn at once
// with every pixel reading both positions' maps: the same bits.
#include "stepping_suns.h"
#include "write_pgm.h"

#include "light_strip.h"

#include <gnomon/shared/gpu_structs.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>

namespace gnomon::test {
namespace {

/// Memory that the test hands out, so that it can write over the constants of a mask that has been recorded.
class Memory {
public:
    [[nodiscard]] vulkan::MemoryHooks hooks() { return {this, allocate, release}; }
    /// The lights of the mask's first layer.
    [[nodiscard]] shared::GpuLight* lights() const
    {
        const VkPhysicalDeviceLimits limits = gpu().limits();
        const std::size_t align =
            std::max<std::size_t>({limits.minUniformBufferOffsetAlignment, limits.minStorageBufferOffsetAlignment, 16});
        const std::size_t at = (sizeof(shared::GpuConstants) + align - 1) / align * align;
        return reinterpret_cast<shared::GpuLight*>(static_cast<std::byte*>(constants_) + at);
    }

private:
    static VkResult allocate(void* user, const vulkan::MemoryRequest& request, vulkan::MemoryBlock* block)
    {
        const VkMemoryRequirements& needs = request.needs;
        const VkMemoryPropertyFlags properties = request.properties;
        const vulkan::DeviceView view = gpu().view();
        VkPhysicalDeviceMemoryProperties memory{};
        vkGetPhysicalDeviceMemoryProperties(view.physical_device, &memory);
        std::uint32_t type = 0;
        while ((needs.memoryTypeBits & (1U << type)) == 0 ||
               (memory.memoryTypes[type].propertyFlags & properties) != properties) {
            if (++type == memory.memoryTypeCount) {
                return VK_ERROR_OUT_OF_DEVICE_MEMORY;
            }
        }
        const VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, needs.size, type};
        VkResult result = vkAllocateMemory(view.device, &info, nullptr, &block->memory);
        if (result == VK_SUCCESS && (properties & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) != 0) {
            result = vkMapMemory(view.device, block->memory, 0, VK_WHOLE_SIZE, 0, &block->mapped);
        }
        if (request.purpose == std::string_view("constants")) {
            static_cast<Memory*>(user)->constants_ = block->mapped;
        }
        return result;
    }
    static void release(void* /*user*/, const vulkan::MemoryBlock& block)
    {
        vkFreeMemory(gpu().view().device, block.memory, nullptr);
    }

    void* constants_ = nullptr;
};

std::size_t stripsOf(const Plan& plan)
{
    std::vector<pack::MaskDraw> draws;
    pack::listMaskDraws(plan, {kStepScreen.width, kStepScreen.height}, draws);
    return draws.size();
}

/// Masks that are drawn at once: with bands wider than the picture, in place of which those that are wanted are put in.
class AtOnce {
public:
    AtOnce(const Setting& setting, std::size_t lights) : suns_(setting, lights, memory_.hooks()) {}

    [[nodiscard]] std::vector<Mask> maskOf(const std::vector<SunSteps>& steps)
    {
        std::vector<SunSteps> wide = steps;
        for (SunSteps& one : wide) {
            if (one.band > 0.0) {
                one.band = 4.0;
                one.edge = 2.0;
            }
        }
        Bench& bench = suns_.bench;
        bench.plan = suns_.planOf(wide);
        EXPECT_EQ(stripsOf(bench.plan), 1U);
        bench.prepare();
        const auto transforms = bench.scene.transforms();
        gpu().run([&](VkCommandBuffer commands) {
            bench.drawer.beginFrame(0, bench.plan, bench.mesh.geometry, transforms);
            bench.renderer.recordMaps(commands, 0, bench.plan,
                                      [&](const vulkan::MapPass& pass) { bench.drawer.draw(pass); });
            bench.renderer.recordMask(commands, 0, bench.plan, bench.inputs);
            for (std::size_t i = 0; i < steps.size(); ++i) {
                memory_.lights()[i].steps = pack::stepRule(steps[i]);
            }
        });
        std::vector<Mask> masks;
        for (std::uint32_t i = 0; i < steps.size(); ++i) {
            masks.push_back(bench.readMask(i));
        }
        return masks;
    }

private:
    Memory memory_;
    Suns suns_;
};

SunSteps bandOf(double edge, double band, bool smooth)
{
    SunSteps steps = blendOf(0.5, smooth);
    steps.band = band;
    steps.edge = edge;
    return steps;
}

class MaskInStrips : public testing::TestWithParam<StepCase> {};

TEST_P(MaskInStrips, isTheMaskDrawnAtOnce)
{
    Suns suns(settingOf(GetParam()));
    AtOnce at_once(settingOf(GetParam()), 1);
    // Edges amid pixels and between them, and a band that hangs out of the picture on either side.
    for (const double edge : {0.13, 0.5, 0.6031, 1.1}) {
        const std::vector<SunSteps> steps{bandOf(edge, 0.25, edge == 0.5)};
        EXPECT_GT(stripsOf(suns.planOf(steps)), 1U);
        const Mask strips = suns.maskOf(steps)[0];
        EXPECT_EQ(countDifferent(strips, at_once.maskOf(steps)[0]), 0U) << edge;
        writePgm(std::string("strips_") + GetParam().name, strips, kStepScreen);
    }
    // It must be possible to fail: a band a pixel further on gives other bits.
    const Mask strips = suns.maskOf({bandOf(0.6, 0.25, false)})[0];
    EXPECT_GT(countDifferent(strips, at_once.maskOf({bandOf(0.6 + 1.0 / kStepScreen.width, 0.25, false)})[0]), 0U);
    expectSilence(gpu());
}

INSTANTIATE_TEST_SUITE_P(Filters, MaskInStrips,
                         testing::Values(StepCase{"hard", Filter::hard, MapFormat::d32f, Slices::one, false},
                                         StepCase{"pcf_cascades", Filter::pcf, MapFormat::d16, Slices::two, false},
                                         StepCase{"pcf_rgba8", Filter::pcf, MapFormat::rgba8, Slices::one, true},
                                         StepCase{"vsm", Filter::vsm, MapFormat::rg32f, Slices::one, false}),
                         [](const auto& test_case) { return std::string(test_case.param.name); });

// Bands of several lights part the screen further.
TEST(MaskInStripsOfManyLights, isTheMaskDrawnAtOnce)
{
    const Setting setting;
    const std::vector<SunSteps> steps{bandOf(0.5, 0.3, true), bandOf(0.9, 0.5, false), blendOf(0.4, true)};
    Suns suns(setting, steps.size());
    EXPECT_EQ(stripsOf(suns.planOf(steps)), 5U);
    EXPECT_EQ(suns.maskOf(steps), AtOnce(setting, steps.size()).maskOf(steps));
    expectSilence(gpu());
}

} // namespace
} // namespace gnomon::test
