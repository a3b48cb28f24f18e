// SPDX-License-Identifier: Apache-2.0
// Each thing that a device may lack, taken away in turn: what is left out is told, nothing else is, and nothing that
// the device lacks is used.
#include "changing_host.h"

#include <gnomon/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace gnomon::test {
namespace {

/// Techniques that take between them all that is optional.
struct Drawn {
    const char* name;
    ShadowOptions options;
    LightType light = LightType::directional;
};

ShadowOptions optionsOf(Filter filter, Partition partition = Partition::single)
{
    ShadowOptions options{.technique = kPlainTechnique};
    options.technique.filter = filter;
    options.technique.partition = partition;
    options.map_size = 64;
    return options;
}

std::vector<Drawn> drawn()
{
    std::vector<Drawn> all{{"pcf", optionsOf(Filter::pcf)},
                           {"raymarch", optionsOf(Filter::raymarch)},
                           {"id", optionsOf(Filter::id)},
                           {"vsm", optionsOf(Filter::vsm)},
                           {"vsm of a spot", optionsOf(Filter::vsm), LightType::spot},
                           {"lvsm", optionsOf(Filter::lvsm)},
                           {"sdsm", optionsOf(Filter::pcf, Partition::sdsm)},
                           {"cascades", optionsOf(Filter::pcf, Partition::cascades)},
                           {"layered cascades", optionsOf(Filter::pcf, Partition::cascades)},
                           {"volumes", optionsOf(Filter::volumes)}};
    all[8].options.cascades.pass = CascadePass::layered;
    all[9].options.volumes.open = OpenCasters::skip;
    return all;
}

struct Lacking {
    std::string part; // of optionalParts(); empty: nothing is lacking
    NullLimits limits;
    std::vector<std::string> left_out; // of drawn()
};

NullLimits without(VkBool32 VkPhysicalDeviceFeatures::*feature)
{
    NullLimits limits;
    limits.lacks.*feature = VK_TRUE;
    return limits;
}

std::vector<Lacking> lackings()
{
    using Features = VkPhysicalDeviceFeatures;
    NullLimits no_layer;
    no_layer.lacks_output_layer = true;
    NullLimits no_times;
    no_times.timestamp_bits = 0;
    NullLimits no_stencil;
    no_stencil.lacks_format = VK_FORMAT_D32_SFLOAT_S8_UINT;
    NullLimits small_groups;
    small_groups.group_threads = 128;
    constexpr const char* kIndirect = "multiDrawIndirect and drawIndirectFirstInstance";
    return {{"", {}, {}},
            {kIndirect, without(&Features::multiDrawIndirect), {}},
            {kIndirect, without(&Features::drawIndirectFirstInstance), {}},
            {"depthClamp", without(&Features::depthClamp), {"volumes"}},
            {"shaderStorageImageWriteWithoutFormat",
             without(&Features::shaderStorageImageWriteWithoutFormat),
             {"vsm", "vsm of a spot", "lvsm"}},
            {"sampleRateShading", without(&Features::sampleRateShading), {}},
            {"shaderOutputLayer", no_layer, {"layered cascades"}},
            {"shaderClipDistance", without(&Features::shaderClipDistance), {}},
            {"depthBounds", without(&Features::depthBounds), {}},
            {"pipelineStatisticsQuery", without(&Features::pipelineStatisticsQuery), {}},
            {"timestamps", no_times, {}},
            {"D32_SFLOAT_S8_UINT", no_stencil, {}},
            {"maxComputeWorkGroupInvocations of 256", small_groups, {"lvsm", "sdsm"}}};
}

/// The reason of a refusal; empty: it was drawn.
std::string refusalOf(NullDriver& driver, const Drawn& one)
{
    try {
        ChangingHost host(driver, {.mask_shape = vulkan::MaskShape{true, true}});
        host.first_light = one.light;
        Planner planner(one.options);
        const FrameSetup setup{.inputs = {true, true}};
        (void)host.frame(planner, setup);
        (void)host.frame(planner, setup);
        return {};
    } catch (const Error& error) {
        return error.what();
    }
}

TEST(OptionalParts, TakenAwayInTurnAreToldAndNeverUsed)
{
    for (const Lacking& lacking : lackings()) {
        for (const Drawn& one : drawn()) {
            const std::string what = lacking.part + ": " + one.name;
            NullDriver driver(lacking.limits);
            const std::string refusal = refusalOf(driver, one);
            const bool left_out = std::ranges::find(lacking.left_out, one.name) != lacking.left_out.end();
            EXPECT_EQ(!refusal.empty(), left_out) << what << ": " << refusal;
            EXPECT_EQ(driver.counts().lacking, 0U) << what;
            if (left_out && lacking.part != "shaderOutputLayer") { // whose sentence is the renderer's own
                EXPECT_NE(refusal.find(lacking.part), std::string::npos) << what << ": " << refusal;
            }
        }
    }
}

// Where everything is claimed to be on, the driver sees what is used of what it lacks.
TEST(OptionalParts, WouldBeMissedIfTheyWereUsed)
{
    for (const Lacking& lacking : lackings()) {
        const auto names = {"depthClamp", "shaderStorageImageWriteWithoutFormat", "sampleRateShading",
                            "shaderOutputLayer"};
        if (std::ranges::find(names, lacking.part) == names.end()) {
            continue;
        }
        NullDriver driver(lacking.limits);
        driver.claimAll();
        for (const Drawn& one : drawn()) {
            (void)refusalOf(driver, one);
        }
        EXPECT_GT(driver.counts().lacking, 0U) << lacking.part;
    }
}

TEST(OptionalParts, SayEachOnceWhatTheDeviceHas)
{
    for (const Lacking& lacking : lackings()) {
        NullDriver driver(lacking.limits);
        for (const vulkan::OptionalPart& part : vulkan::optionalParts()) {
            EXPECT_EQ(part.has(driver.view()), part.name != lacking.part) << part.name << " without " << lacking.part;
        }
    }
}

TEST(OptionalParts, OfMemoryAreTheHostsWhereTheDevicesIsFull)
{
    constexpr VkMemoryPropertyFlags kHost = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    constexpr std::array kTypes{
        VkMemoryType{VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT | VK_MEMORY_PROPERTY_PROTECTED_BIT, 0},
        VkMemoryType{VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT | VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT, 0},
        VkMemoryType{VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT | VK_MEMORY_PROPERTY_DEVICE_COHERENT_BIT_AMD, 0},
        VkMemoryType{VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0}, VkMemoryType{kHost, 1}};
    constexpr std::array<VkDeviceSize, 2> kRoom{1U << 30U, 1U << 30U};
    constexpr std::array<VkDeviceSize, 2> kFull{1024, 1U << 30U};
    for (const Drawn& one : drawn()) {
        for (const std::span<const VkDeviceSize> heaps : {std::span(kRoom), std::span(kFull)}) {
            NullLimits limits;
            limits.memory_types = kTypes;
            limits.heap_bytes = heaps;
            NullDriver driver(limits);
            EXPECT_EQ(refusalOf(driver, one), "") << one.name;
            EXPECT_EQ(driver.counts().lacking, 0U) << one.name;
        }
    }
    constexpr std::array<VkDeviceSize, 2> kBothFull{1024, 4096};
    NullLimits limits;
    limits.memory_types = kTypes;
    limits.heap_bytes = kBothFull;
    NullDriver driver(limits);
    EXPECT_NE(refusalOf(driver, drawn().front()).find("out of device memory"), std::string::npos);
}

} // namespace
} // namespace gnomon::test
