// SPDX-License-Identifier: Apache-2.0
// Which features are asked for, by use, and how they are added to an engine's own.
#include "null_driver.h"

#include <gnomon/error.h>

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace gnomon::test {
namespace {

using vulkan::FeatureMerge;
using vulkan::FeatureUses;

constexpr FeatureUses kMost{
    .indirect_draws = true, .depth_clamp = true, .filterable = true, .sample_metric = true, .statistics = true};
constexpr const char* kAlways = "hostQueryReset, dynamicRendering, synchronization2, maintenance4";

/// In `chain`: how often a structure is there.
std::size_t countOf(const void* chain, VkStructureType type)
{
    std::size_t count = 0;
    for (auto* next = static_cast<const VkBaseInStructure*>(chain); next != nullptr; next = next->pNext) {
        count += next->sType == type ? 1 : 0;
    }
    return count;
}

bool hasNoneTwice(const void* chain)
{
    std::set<VkStructureType> seen;
    for (auto* next = static_cast<const VkBaseInStructure*>(chain); next != nullptr; next = next->pNext) {
        if (!seen.insert(next->sType).second) {
            return false;
        }
    }
    return true;
}

TEST(Features, requiredOnesAreFound)
{
    NullDriver driver;
    char missing[256] = "x";
    vulkan::missingFeatures(driver.view(), missing, sizeof missing);
    EXPECT_STREQ(missing, "");
    driver.hideFunction("vkGetPhysicalDeviceFeatures2"); // then none is there
    vulkan::missingFeatures(driver.view(), missing, sizeof missing);
    EXPECT_STREQ(missing, kAlways);
    vulkan::missingFeatures(driver.view(), missing, 24);
    EXPECT_STREQ(missing, "hostQueryReset");
    vulkan::missingFeatures(driver.view(), missing, 1);
    EXPECT_STREQ(missing, "");
}

TEST(Features, areThoseOfWhatIsUsed)
{
    const VkPhysicalDeviceFeatures& none = vulkan::requiredFeatures({}).features;
    EXPECT_FALSE(none.multiDrawIndirect || none.depthClamp || none.pipelineStatisticsQuery || none.shaderClipDistance);
    const VkPhysicalDeviceFeatures& most = vulkan::requiredFeatures(kMost).features;
    EXPECT_TRUE(most.multiDrawIndirect && most.drawIndirectFirstInstance && most.depthClamp);
    EXPECT_TRUE(most.pipelineStatisticsQuery && most.sampleRateShading && most.shaderStorageImageWriteWithoutFormat);
    EXPECT_FALSE(most.shaderClipDistance || most.depthBounds);
    EXPECT_TRUE(vulkan::requiredFeatures({.clip_planes = true}).features.shaderClipDistance);
    EXPECT_TRUE(vulkan::requiredFeatures({.depth_bounds = true}).features.depthBounds);
}

TEST(Features, areAddedToAnEmptyChain)
{
    VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
    const FeatureMerge merge(info, kMost);
    EXPECT_TRUE(hasNoneTwice(info.pNext));
    EXPECT_EQ(countOf(info.pNext, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2), 1U);
    EXPECT_EQ(countOf(info.pNext, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DYNAMIC_RENDERING_FEATURES), 1U);
    EXPECT_EQ(countOf(info.pNext, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES), 0U);
}

TEST(Features, areTurnedOnInTheStructuresOfVersions)
{
    VkPhysicalDeviceVulkan13Features v13{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
    VkPhysicalDeviceVulkan12Features v12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES, &v13};
    VkPhysicalDeviceFeatures2 core{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &v12};
    core.features.samplerAnisotropy = VK_TRUE;
    VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &core};
    const FeatureMerge merge(info, {.indirect_draws = true, .depth_clamp = true, .layered = true});
    EXPECT_EQ(info.pNext, &core) << "nothing had to be added";
    EXPECT_TRUE(core.features.samplerAnisotropy && core.features.depthClamp && core.features.multiDrawIndirect);
    EXPECT_TRUE(v12.hostQueryReset && v12.shaderOutputLayer);
    EXPECT_TRUE(v13.dynamicRendering && v13.synchronization2 && v13.maintenance4);
}

TEST(Features, areTurnedOnInTheirOwnStructures)
{
    VkPhysicalDeviceSynchronization2Features sync{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SYNCHRONIZATION_2_FEATURES};
    VkPhysicalDeviceTimelineSemaphoreFeatures timeline{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_TIMELINE_SEMAPHORE_FEATURES,
                                                       &sync};
    VkPhysicalDeviceFeatures enabled{};
    enabled.fillModeNonSolid = VK_TRUE;
    VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &timeline};
    info.pEnabledFeatures = &enabled;
    const FeatureMerge merge(info, kMost);
    EXPECT_TRUE(sync.synchronization2);
    EXPECT_TRUE(hasNoneTwice(info.pNext));
    EXPECT_EQ(countOf(info.pNext, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2), 0U) << "not beside pEnabledFeatures";
    EXPECT_TRUE(info.pEnabledFeatures->fillModeNonSolid && info.pEnabledFeatures->depthClamp);
    EXPECT_EQ(enabled.depthClamp, VK_FALSE);
    EXPECT_EQ(countOf(info.pNext, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_HOST_QUERY_RESET_FEATURES), 1U);
    EXPECT_EQ(countOf(info.pNext, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES), 0U);
    VkDeviceCreateInfo layered{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &timeline};
    EXPECT_THROW(FeatureMerge(layered, {.layered = true}), Error);
}

} // namespace
} // namespace gnomon::test
