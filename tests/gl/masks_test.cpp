// SPDX-License-Identifier: Apache-2.0
// Masks by OpenGL against those by the Vulkan backend, of the same plan and the same depths: by filters, lights and
// partitions.
#include "beyond_edges.h"
#include "option_steps.h"
#include "sides.h"

#include <gnomon/plan_views.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace gnomon::test {
namespace {

constexpr VkExtent2D kScreen{160, 90};

struct MaskCase {
    const char* name;
    const char* options;
    const char* lights; // lightsOf()
    bool exact = false; // no pixel is off by more than one step
};

void PrintTo(const MaskCase& one, std::ostream* out)
{
    *out << one.lights << ' ' << one.options;
}

/// Both sides compile each of their programs once.
VulkanSide& vulkanSide()
{
    static VulkanSide side(kScreen);
    return side;
}
GlSide& glSide()
{
    static GlSide side(kScreen);
    return side;
}

class GlMasks : public testing::TestWithParam<MaskCase> {};

TEST_P(GlMasks, areThoseOfTheVulkanBackend)
{
    GNOMON_NEEDS_EGL();
    const MaskCase& one = GetParam();
    const std::vector<Light> lights = lightsOf(one.lights);
    Planner planner(optionsFrom(one.options));
    const Plan plan = planner.plan(vulkanSide().scene.frameOf(lights));
    for (const LightPlan& light : plan.lights) {
        ASSERT_TRUE(light.outcome.hasMap()) << light.outcome.reason;
    }
    const std::vector<std::byte> wanted = vulkanSide().scene.draw(vulkanSide().drawing, plan);
    const std::vector<std::byte> drawn = glSide().draw(plan);
    EglContext::instance().expectSilence();
    ASSERT_EQ(drawn.size(), wanted.size());
    std::size_t beyond = 0;
    for (const LightPlan& light : plan.lights) {
        const ImageF reference = channelOf(wanted, kScreen, plan, light);
        beyond += countBeyondEdges(channelOf(drawn, kScreen, plan, light), reference);
        const auto [least, most] = std::minmax_element(reference.values.begin(), reference.values.end());
        EXPECT_LT(*least, 0.5F) << "there is no shadow to compare";
        EXPECT_GT(*most, 0.5F) << "there is no light to compare";
    }
    const int most = farthest(drawn, wanted);
    RecordProperty("farthest", most);
    std::printf("%-28s farthest %d of 255, %zu beyond edges\n", one.name, most, beyond);
    EXPECT_EQ(beyond, 0U);
    if (one.exact) {
        EXPECT_LE(most, 1);
    }
}

// A check must be able to fail: another sun's mask is another.
TEST(GlMasksAre, toldFromThoseOfAnotherSun)
{
    GNOMON_NEEDS_EGL();
    std::vector<Light> lights = lightsOf("sun");
    Planner planner(optionsFrom("map-size=256 partition=single filter=hard"));
    Plan plan = planner.plan(vulkanSide().scene.frameOf(lights));
    const std::vector<std::byte> wanted = vulkanSide().scene.draw(vulkanSide().drawing, plan);
    lights[0].direction_ws = glm::normalize(glm::dvec3(0.4, -1.0, 0.3));
    plan = planner.plan(vulkanSide().scene.frameOf(lights));
    const std::vector<std::byte> drawn = glSide().draw(plan);
    EXPECT_GT(farthest(drawn, wanted), 128);
    EXPECT_GT(countBeyondEdges(channelOf(drawn, kScreen, plan, plan.lights[0]),
                               channelOf(wanted, kScreen, plan, plan.lights[0])),
              20U);
}

#define CASES(FILTER, EXACT)                                                                                           \
    MaskCase{FILTER "_sun", "map-size=256 partition=single filter=" FILTER, "sun", EXACT},                             \
        MaskCase{FILTER "_cascades", "map-size=256 partition=cascades filter=" FILTER, "sun", EXACT},                  \
        MaskCase{FILTER "_spot", "map-size=256 partition=single filter=" FILTER, "spot", EXACT},                       \
        MaskCase{FILTER "_cube", "map-size=256 partition=cube filter=" FILTER, "lamp", EXACT}, MaskCase                \
    {                                                                                                                  \
        FILTER "_multi", "map-size=256 partition=multi filter=" FILTER, "lamp", EXACT                                  \
    }

std::string nameOf(const testing::TestParamInfo<MaskCase>& one)
{
    return one.param.name;
}

INSTANTIATE_TEST_SUITE_P(Depth, GlMasks,
                         testing::Values(CASES("hard", true), CASES("pcf", true), CASES("pcss", false),
                                         CASES("raymarch", false)),
                         nameOf);
INSTANTIATE_TEST_SUITE_P(Filterable, GlMasks,
                         testing::Values(CASES("vsm", false), CASES("lvsm", false), CASES("esm", false),
                                         CASES("evsm", false), CASES("msm", false)),
                         nameOf);
INSTANTIATE_TEST_SUITE_P(
    Others, GlMasks,
    testing::Values(
        MaskCase{"three_lights", "map-size=256 partition=auto filter=pcf", "sun spot lamp", true},
        MaskCase{"five_lights", "map-size=128 partition=auto filter=evsm", "sun spot lamp sun spot"},
        MaskCase{"virtual_sun", "texels=262144 partition=virtual filter=pcf", "sun", true},
        MaskCase{"virtual_lamp", "texels=262144 partition=virtual filter=hard", "lamp", true},
        MaskCase{"receivers", "map-size=256 partition=multi multi.divide=receivers filter=pcf", "lamp", true},
        MaskCase{"warped", "map-size=256 partition=single fit=lispsm filter=pcf", "sun", true},
        MaskCase{"d16", "map-size=256 partition=single filter=pcf map-format=d16", "spot", true},
        MaskCase{"r32f", "map-size=256 partition=single filter=pcf map-format=r32f", "sun spot", true},
        MaskCase{"pairs", "map-size=256 filter=hard motion=step-blend map-format=rg16", "sun", true},
        MaskCase{"steps", "map-size=256 filter=pcf motion=step-band", "sun", true},
        MaskCase{"blur", "map-size=256 partition=single filter=hard soften=blur", "sun"},
        MaskCase{"blur_half", "map-size=256 filter=hard soften=blur soften.edges=plain soften.size=half", "sun spot"},
        MaskCase{"blur_poisson", "map-size=256 filter=pcf soften=blur soften.kernel=poisson", "spot"},
        MaskCase{"lloyd", "map-size=256 partition=single filter=lvsm lvsm.placement=lloyd", "sun"},
        MaskCase{"world", "map-size=256 partition=single filter=lvsm lvsm.placement=world", "sun"},
        MaskCase{"gaussian", "map-size=256 partition=single filter=msm blur=gaussian map-format=rgba16", "sun"},
        MaskCase{"unblurred", "map-size=256 partition=single filter=vsm blur=none msaa=1", "sun"},
        MaskCase{"coarser", "map-size=256 partition=single filter=evsm map-sampling=trilinear", "sun"}),
    nameOf);

} // namespace
} // namespace gnomon::test
