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

constexpr FeatureUses kMaskAlone{};
constexpr FeatureUses kMost{.filterable = true, .caster_drawer = true, .statistics = true};

std::string missingFor(const FeatureUses& uses)
{
    NullDriver driver;
    driver.hideFunction("vkGetPhysicalDeviceFeatures2"); // then none is there
    char missing[256] = "x";
    vulkan::missingFeatures(driver.view(), missing, sizeof missing, uses);
    return missing;
}

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
    vulkan::missingFeatures(driver.view(), missing, sizeof missing, kMost);
    EXPECT_STREQ(missing, "");
    EXPECT_EQ(missingFor(kMost), "multiDrawIndirect, drawIndirectFirstInstance, depthClamp, pipelineStatisticsQuery, "
                                 "sampleRateShading, shaderStorageImageWriteWithoutFormat, hostQueryReset, "
                                 "dynamicRendering, synchronization2, maintenance4");
    driver.hideFunction("vkGetPhysicalDeviceFeatures2");
    vulkan::missingFeatures(driver.view(), missing, 24, kMost);
    EXPECT_STREQ(missing, "multiDrawIndirect");
    vulkan::missingFeatures(driver.view(), missing, 1, kMost);
    EXPECT_STREQ(missing, "");
}

TEST(Features, areThoseOfWhatIsUsed)
{
    EXPECT_EQ(missingFor(kMaskAlone), "hostQueryReset, dynamicRendering, synchronization2, maintenance4");
    FeatureUses uses = kMaskAlone;
    uses.caster_drawer = true;
    EXPECT_EQ(missingFor(uses), "multiDrawIndirect, drawIndirectFirstInstance, depthClamp, hostQueryReset, "
                                "dynamicRendering, synchronization2, maintenance4");
    uses = kMaskAlone;
    uses.statistics = true;
    EXPECT_EQ(missingFor(uses),
              "pipelineStatisticsQuery, hostQueryReset, dynamicRendering, synchronization2, maintenance4");
    uses = kMaskAlone;
    uses.layered = true;
    EXPECT_EQ(missingFor(uses), "hostQueryReset, dynamicRendering, synchronization2, maintenance4, shaderOutputLayer");
    uses = kMaskAlone;
    uses.clip_planes = true;
    EXPECT_EQ(missingFor(uses), "shaderClipDistance, hostQueryReset, dynamicRendering, synchronization2, maintenance4");
    EXPECT_EQ(vulkan::requiredFeatures(uses).features.shaderClipDistance, VK_TRUE);
    EXPECT_EQ(vulkan::requiredFeatures(kMost).features.shaderClipDistance, VK_FALSE);
    EXPECT_EQ(vulkan::requiredFeatures(kMaskAlone).features.multiDrawIndirect, VK_FALSE);
    EXPECT_EQ(vulkan::requiredFeatures(kMost).features.multiDrawIndirect, VK_TRUE);
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
    const FeatureMerge merge(info, {.filterable = true, .caster_drawer = true, .layered = true});
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
