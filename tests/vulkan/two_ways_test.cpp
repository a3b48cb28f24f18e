// SPDX-License-Identifier: Apache-2.0
// The mask has a way for software rasterisers and one for GPUs (GNOMON_IN_SOFTWARE). Both say the same, which a
// software rasteriser that says it is a GPU can show.
#include "fixture.h"
#include "option_steps.h"
#include "planned_scene.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>

namespace gnomon::test {
namespace {

constexpr VkExtent2D kScreen{140, 80};

VKAPI_ATTR void VKAPI_CALL propertiesOfGpu(VkPhysicalDevice device, VkPhysicalDeviceProperties* properties)
{
    vkGetPhysicalDeviceProperties(device, properties);
    properties->deviceType = VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL procAddrOfGpu(VkInstance instance, const char* name)
{
    return std::strcmp(name, "vkGetPhysicalDeviceProperties") == 0
               ? reinterpret_cast<PFN_vkVoidFunction>(&propertiesOfGpu)
               : vkGetInstanceProcAddr(instance, name);
}

vulkan::DeviceView asGpu(vulkan::DeviceView view)
{
    view.get_instance_proc_addr = procAddrOfGpu;
    return view;
}

struct WayCase {
    const char* name;
    const char* options;
    bool ids = false;
};
std::ostream& operator<<(std::ostream& out, const WayCase& c)
{
    return out << c.name;
}

class TwoWays : public testing::TestWithParam<WayCase> {};

TEST_P(TwoWays, SayTheSame)
{
    PlannedScene scene(gpu(), kScreen);
    scene.remakeViews(kScreen, true, GetParam().ids);
    std::size_t shaded = 0;
    for (const std::uint32_t count : {1U, 3U}) {
        const std::vector<Light> lights = sunsAndSpots(count);
        const Frame frame = scene.frameOf(lights);
        Planner planner(optionsFrom(GetParam().options));
        const Plan& plan = planner.plan(frame);
        Drawing software(gpu(), scene.mesh());
        const std::vector<std::byte> by_software = scene.draw(software, plan);
        Drawing hardware(asGpu(gpu().view()), scene.mesh());
        const std::vector<std::byte> by_gpu = scene.draw(hardware, plan);
        ASSERT_EQ(by_software.size(), by_gpu.size());
        std::size_t others = 0;
        for (std::size_t i = 0; i < by_gpu.size(); ++i) {
            const int difference = std::abs(static_cast<int>(by_gpu[i]) - static_cast<int>(by_software[i]));
            others += difference > 1 ? 1 : 0; // a rounding may decide what becomes of a ray
            shaded += by_software[i] != std::byte{255} ? 1 : 0;
        }
        EXPECT_LE(others, by_gpu.size() / 1000) << count << " lights";
    }
    EXPECT_GT(shaded, 1000U) << "else the test is about nothing";
}

INSTANTIATE_TEST_SUITE_P(
    Options, TwoWays,
    testing::Values(WayCase{"hard_cascades", "filter=hard partition=cascades map-size=256"},
                    WayCase{"pcf", "filter=pcf map-size=256"},
                    WayCase{"pcf_cascades", "filter=pcf partition=cascades map-size=256"},
                    WayCase{"pcf_steps", "filter=pcf motion=step-blend map-size=256"},
                    WayCase{"pcss", "filter=pcss map-size=256"}, WayCase{"raymarch", "filter=raymarch map-size=256"},
                    WayCase{"raymarch_cascades", "filter=raymarch partition=cascades map-size=256"},
                    WayCase{"raymarch_warped", "filter=raymarch fit=lispsm map-size=256"},
                    WayCase{"evsm_cascades", "filter=evsm partition=cascades map-size=256"},
                    WayCase{"id", "filter=id map-size=256", true}),
    [](const auto& test_case) { return std::string(test_case.param.name); });

} // namespace
} // namespace gnomon::test
