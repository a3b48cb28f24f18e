// SPDX-License-Identifier: Apache-2.0
// Views that the GPU fits: what is recorded for them, on a driver that only keeps count. That nothing waits for the GPU
// and nothing is read back, and that what it finds changes nothing that the CPU does.
#include "allocation_count.h"
#include "null_driver.h"
#include "scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <string>

namespace gnomon::test {
namespace {

using vulkan::MapPass;
using vulkan::ShadowRenderer;
using vulkan::ShadowRendererOptions;
using Kind = NullEvent::Kind;

constexpr VkExtent2D kScreen{100, 70};
constexpr std::uint32_t kCascades = 3;

/// Memory of the host's own, so that a test can see what is mapped and change it as a GPU would.
struct Blocks {
    std::vector<std::unique_ptr<std::vector<std::byte>>> mapped;

    static VkResult allocate(void* user, const vulkan::MemoryRequest& request, vulkan::MemoryBlock* block)
    {
        auto& blocks = *static_cast<Blocks*>(user);
        if ((request.properties & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) != 0) {
            blocks.mapped.push_back(std::make_unique<std::vector<std::byte>>(request.needs.size));
            block->mapped = blocks.mapped.back()->data();
        }
        return VK_SUCCESS;
    }
    static void release(void* /*user*/, const vulkan::MemoryBlock& /*block*/) {}

    void fill(std::byte value)
    {
        for (auto& block : mapped) {
            std::fill(block->begin(), block->end(), value);
        }
    }
};

/// A sun and a spot over the scene of boxes, each with a base map that is divided in three.
struct FittedHost {
    explicit FittedHost(NullDriver& driver_in, Blocks* blocks = nullptr)
        : driver(driver_in),
          renderer(viewOf(driver_in, blocks), ShadowRendererOptions{.mask_shape = vulkan::MaskShape{}})
    {
        lights = {makeSun({0.5, -1.0, 0.2}), makeSpot({4.0, 8.0, 2.0}, {0.0, 0.0, 0.0}, 0.5)};
        const std::vector<Tile> tiles{{0, 0, 0, 256, 256}, {kCascades, 0, 0, 256, 256}};
        plan = makePlan(scene, lights, tiles, {256, 256, 2 * kCascades});
        const std::vector<View> bases = plan.views;
        plan.views.clear();
        for (std::uint32_t light = 0; light < bases.size(); ++light) {
            plan.lights[light].first_view = light * kCascades;
            plan.lights[light].view_count = kCascades;
            for (std::uint32_t i = 0; i < kCascades; ++i) {
                plan.views.push_back(bases[light]);
                plan.views.back().projection.gpu_cascade = i;
                plan.views.back().place.tile.layer = light * kCascades + i;
            }
        }
        ShadowOptions options{.technique = kPlainTechnique};
        options.technique.partition = Partition::sdsm;
        options.cascades.count = kCascades;
        options.border_texels = 0.0;
        plan.options = planOptions(options);
        inputs.extent = kScreen;
        inputs.depth = driver.makeView();
    }
    static vulkan::DeviceView viewOf(NullDriver& driver, Blocks* blocks)
    {
        vulkan::DeviceView view = driver.view();
        if (blocks != nullptr) {
            view.memory = {blocks, Blocks::allocate, Blocks::release};
        }
        return view;
    }
    void record(std::uint32_t slot)
    {
        renderer.recordBounds(driver.commands(), slot, plan, inputs);
        renderer.recordMaps(driver.commands(), slot, plan, draw);
        renderer.recordMask(driver.commands(), slot, plan, inputs);
    }

    NullDriver& driver;
    Scene scene = makeScene();
    std::vector<Light> lights;
    Plan plan;
    vulkan::MaskInputs inputs;
    ShadowRenderer renderer;
    VkBuffer placement = VK_NULL_HANDLE;
    VkDeviceSize last_offset = 0;
    vulkan::DrawCasters draw = [this](const MapPass& pass) {
        placement = pass.placement;
        last_offset = pass.placement_offset;
    };
};

bool isSame(const NullEvent& a, const NullEvent& b)
{
    return a.kind == b.kind && a.area.extent.width == b.area.extent.width && a.layer == b.layer &&
           a.old_layout == b.old_layout && a.new_layout == b.new_layout && a.count == b.count &&
           a.target_stages == b.target_stages && a.target_access == b.target_access;
}

TEST(CascadeFitter, FitsBeforeItDrawsAndCompletesTheConstantsBeforeTheMask)
{
    NullDriver driver;
    FittedHost host(driver);
    (void)host.renderer.prepare(host.plan, kScreen);
    host.record(0);
    std::vector<Kind> work;
    std::vector<std::uint32_t> groups;
    for (const NullEvent& event : driver.events()) {
        if (event.kind == Kind::dispatch || event.kind == Kind::begin_rendering) {
            work.push_back(event.kind);
        }
        if (event.kind == Kind::dispatch) {
            groups.push_back(event.count);
        }
    }
    std::vector<Kind> expected(3, Kind::dispatch); // depth, bounds, finish
    expected.insert(expected.end(), 2 * kCascades, Kind::begin_rendering);
    expected.push_back(Kind::dispatch); // the constants
    expected.push_back(Kind::begin_rendering);
    EXPECT_EQ(work, expected);
    // Squares of 64 pixels, two lights.
    EXPECT_EQ(groups, (std::vector<std::uint32_t>{2 * 2 * 2, 2 * 2 * 2, 2, 1}));
    EXPECT_NE(host.placement, VkBuffer{VK_NULL_HANDLE});
    EXPECT_EQ(host.last_offset, (2 * kCascades - 1) * 48U);
}

TEST(CascadeFitter, RecordsNothingForOtherViews)
{
    NullDriver driver;
    FittedHost host(driver);
    for (View& view : host.plan.views) {
        view.projection.gpu_cascade = kNoIndex;
    }
    (void)host.renderer.prepare(host.plan, kScreen);
    host.record(0);
    EXPECT_EQ(driver.counts().dispatches, 0U);
    EXPECT_EQ(host.placement, VkBuffer{VK_NULL_HANDLE});
    EXPECT_TRUE(host.renderer.fittedViews(0).empty());
}

TEST(CascadeFitter, HasNoFunctionToWaitOrToReadBackWith)
{
    NullDriver driver;
    FittedHost host(driver);
    (void)host.renderer.prepare(host.plan, kScreen);
    host.record(0); // with the functions that this driver has, and it lacks these
    for (const char* name :
         {"vkQueueSubmit", "vkQueueSubmit2", "vkQueueWaitIdle", "vkDeviceWaitIdle", "vkWaitForFences",
          "vkGetFenceStatus", "vkWaitSemaphores", "vkGetEventStatus", "vkCmdSetEvent2", "vkCmdWaitEvents2",
          "vkCmdCopyBuffer2", "vkCmdCopyImageToBuffer", "vkCmdCopyImageToBuffer2", "vkCmdCopyQueryPoolResults",
          "vkInvalidateMappedMemoryRanges"}) {
        EXPECT_EQ(driver.view().get_instance_proc_addr(driver.view().instance, name), nullptr) << name;
    }
    for (const NullEvent& event : driver.events()) { // what layers of depth that grow are copied by
        EXPECT_NE(event.kind, NullEvent::Kind::copy_buffer);
    }
}

// Memory that the CPU sees and the GPU may have written is overwritten by two different values before the second frame.
// The CPU records and writes the same, so it has read none of it.
TEST(CascadeFitter, RecordsTheSameWhateverTheGpuFound)
{
    constexpr std::byte kValues[]{std::byte{0x00}, std::byte{0xFF}};
    std::vector<NullEvent> events[2];
    std::vector<std::vector<std::byte>> after[2];
    for (int i = 0; i < 2; ++i) {
        NullDriver driver;
        Blocks blocks;
        FittedHost host(driver, &blocks);
        (void)host.renderer.prepare(host.plan, kScreen);
        host.record(0);
        host.record(1);
        driver.clearEvents();
        blocks.fill(kValues[i]);
        host.record(0);
        events[i].assign(driver.events().begin(), driver.events().end());
        for (const auto& block : blocks.mapped) {
            after[i].push_back(*block);
        }
    }
    ASSERT_EQ(events[0].size(), events[1].size());
    EXPECT_TRUE(std::equal(events[0].begin(), events[0].end(), events[1].begin(), isSame));
    ASSERT_EQ(after[0].size(), after[1].size());
    std::size_t written = 0;
    for (std::size_t block = 0; block < after[0].size(); ++block) {
        ASSERT_EQ(after[0][block].size(), after[1][block].size());
        for (std::size_t i = 0; i < after[0][block].size(); ++i) {
            const bool left_alone = after[0][block][i] == kValues[0] && after[1][block][i] == kValues[1];
            written += left_alone ? 0 : 1;
            ASSERT_TRUE(left_alone || after[0][block][i] == after[1][block][i]) << "block " << block << ", byte " << i;
        }
    }
    EXPECT_GT(written, 2 * kCascades * 192U) << "at least the views in the mask's constants";
}

TEST(CascadeFitter, AllocatesNothingInASteadyState)
{
    NullDriver driver;
    FittedHost host(driver);
    (void)host.renderer.prepare(host.plan, kScreen);
    host.record(0);
    host.record(1);
    const auto counts = driver.counts();
    const auto heap = heapAllocations();
    for (std::uint32_t i = 0; i < 10; ++i) {
        EXPECT_FALSE(host.renderer.prepare(host.plan, kScreen));
        host.record(i % 2);
    }
    EXPECT_EQ(heapAllocations(), heap);
    EXPECT_EQ(driver.counts().created, counts.created);
    EXPECT_EQ(driver.counts().allocations, counts.allocations);
    EXPECT_EQ(driver.counts().descriptor_updates - counts.descriptor_updates, 30U) << "two sets here and the mask's";
}

// More lights than before need longer buffers, and sets that name them.
TEST(CascadeFitter, GrowsWithThePlanAndLeavesNothingBehind)
{
    NullDriver driver;
    {
        FittedHost host(driver);
        Plan whole = host.plan;
        host.plan.views.resize(kCascades);
        host.plan.lights.resize(1);
        host.plan.made_for.lights.resize(1);
        (void)host.renderer.prepare(host.plan, kScreen);
        host.record(0);
        const auto updates = driver.counts().descriptor_updates;
        host.plan = whole;
        EXPECT_TRUE(host.renderer.prepare(host.plan, kScreen)) << "the mask has another format";
        host.record(0);
        EXPECT_GE(driver.counts().descriptor_updates, updates + 2);
        EXPECT_EQ(host.renderer.fittedViews(0).size(), 2 * kCascades);
    }
    EXPECT_EQ(driver.counts().created, driver.counts().destroyed);
    EXPECT_EQ(driver.counts().bytes, 0U);
}

} // namespace
} // namespace gnomon::test
