// SPDX-License-Identifier: Apache-2.0
// No prepare() and no drawer's beginFrame() has to make what warmUp() has made.
#include "changing_host.h"
#include "option_steps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace gnomon::test {
namespace {

struct WarmCase {
    const char* name;
    const char* options;
};
std::ostream& operator<<(std::ostream& out, const WarmCase& c)
{
    return out << c.name;
}

class WarmUp : public testing::TestWithParam<WarmCase> {
protected:
    // Pipelines that some frames make, of suns or beginning with a spot.
    static std::uint64_t made(ChangingHost& host, std::span<const ShadowOptions> options, std::uint32_t lights,
                              LightType first)
    {
        host.first_light = first;
        Planner planner(options);
        FrameSetup setup;
        setup.lights = lights;
        setup.options = static_cast<std::uint32_t>(options.size());
        setup.inputs.normals = true;
        std::uint64_t pipelines = 0;
        for (int i = 0; i < 5; ++i) {
            pipelines += host.frame(planner, setup).pipelines;
            pipelines += host.prepared_now;
        }
        return pipelines;
    }
};

TEST_P(WarmUp, leavesNoPipelineToMake)
{
    const std::vector<ShadowOptions> options{optionsFrom(GetParam().options)};
    const ResolvedOptions resolved = resolvedOrThrow(options[0]);
    for (const std::uint32_t lights : {1U, 3U, 9U}) {
        for (const LightType first : {LightType::directional, LightType::spot}) {
            ChangingHost host({.mask_shape = vulkan::MaskShape{.normals = true}});
            EXPECT_GT(made(host, options, lights, first), 0U) << "else the test is about nothing";
            ChangingHost warm({.mask_shape = vulkan::MaskShape{.normals = true}});
            warm.renderer.warmUp(resolved, {.inputs = {.normals = true}});
            warm.drawer.warmUp(resolved, true);
            EXPECT_EQ(made(warm, options, lights, first), 0U) << lights << " lights";
            warm.expectNoMistakes(GetParam().options);
        }
    }
}

// The last ones stop casting, and start again.
TEST_P(WarmUp, leavesNoPipelineToMakeBesideLightsWithoutMaps)
{
    const std::vector<ShadowOptions> options{optionsFrom(GetParam().options)};
    const ResolvedOptions resolved = resolvedOrThrow(options[0]);
    for (const LightType first : {LightType::directional, LightType::spot}) {
        ChangingHost warm({.mask_shape = vulkan::MaskShape{.normals = true}});
        warm.renderer.warmUp(resolved, {.inputs = {.normals = true}});
        warm.drawer.warmUp(resolved, true);
        warm.first_light = first;
        Planner planner(options);
        FrameSetup setup{.lights = 3};
        setup.inputs.normals = true;
        std::uint64_t pipelines = 0;
        for (int i = 0; i < 8; ++i) {
            setup.cast = i < 4 ? 1 : 3;
            pipelines += warm.frame(planner, setup).pipelines + warm.prepared_now;
        }
        EXPECT_EQ(pipelines, 0U);
        warm.expectNoMistakes(GetParam().options);
    }
}

// Also where both have maps of one kind.
TEST_P(WarmUp, ofTwoOptionsLeavesNoPipelineToMakeForBoth)
{
    const std::vector<ShadowOptions> options{optionsFrom(GetParam().options), optionsFrom("filter=esm map-size=128")};
    ChangingHost warm({.mask_shape = vulkan::MaskShape{.normals = true}});
    for (const ShadowOptions& one : options) {
        warm.renderer.warmUp(resolvedOrThrow(one), {.inputs = {.normals = true}, .several_options = true});
        warm.drawer.warmUp(resolvedOrThrow(one), true);
    }
    EXPECT_EQ(made(warm, options, 9, LightType::directional), 0U);
}

// The camera rises from the ground and sinks back to it, and the planner changes its mind on the way.
TEST(WarmUpOfAuto, leavesNoPipelineToMakeWhenThePartitionChanges)
{
    for (const char* line :
         {"filter=pcf partition=auto fit=auto map-size=64", "filter=raymarch partition=auto fit=auto map-size=64",
          "filter=pcf partition=auto fit=auto quality=best map-size=64"}) {
        const ShadowOptions options = optionsFrom(line);
        ChangingHost host({.mask_shape = vulkan::MaskShape{.normals = true}});
        host.renderer.warmUp(resolvedOrThrow(options), {.inputs = {.normals = true}, .several_lights = false});
        host.drawer.warmUp(resolvedOrThrow(options), true);
        Planner planner(options);
        FrameSetup setup;
        setup.inputs.normals = true;
        std::set<Partition> seen;
        std::uint64_t pipelines = 0;
        for (int i = 0; i < 60; ++i) {
            const double t = std::abs(i - 30) / 30.0;
            host.eye_ws = {0.0, 0.4 * std::pow(100.0, 1.0 - t), 29.0 * t + 1.0};
            pipelines += host.frame(planner, setup).pipelines + host.prepared_now;
            seen.insert(host.chosen);
        }
        EXPECT_EQ(pipelines, 0U) << line;
        EXPECT_EQ(seen.size(), options.quality == Quality::best ? 1U : 2U) << line;
        host.expectNoMistakes(line);
    }
}

INSTANTIATE_TEST_SUITE_P(
    Options, WarmUp,
    testing::Values(
        WarmCase{"hard", "filter=hard partition=cascades map-size=64"},
        WarmCase{"pcf", "filter=pcf partition=cascades map-size=64"},
        WarmCase{"evsm", "filter=evsm partition=cascades map-size=64"},
        WarmCase{"lvsm", "filter=lvsm partition=cascades map-size=64"},
        WarmCase{"vsm_single", "filter=vsm map-size=64"}, WarmCase{"esm", "filter=esm map-size=64"},
        WarmCase{"msm", "filter=msm map-size=64"}, WarmCase{"pcf_single", "filter=pcf map-size=64"},
        WarmCase{"pcf_warped", "filter=pcf fit=lispsm map-size=64"},
        WarmCase{"pcf_kept", "filter=pcf keep-still=always motion=snap map-size=64"},
        WarmCase{"pcf_together", "filter=pcf partition=cascades cascades.pass=layered map-size=64"},
        WarmCase{"pcf_sdsm", "filter=pcf partition=sdsm map-size=64"},
        WarmCase{"pcf_step_band", "filter=pcf motion=step-band map-size=64"},
        WarmCase{"hard_step_blend_paired", "filter=hard motion=step-blend map-format=rg16 map-size=64"},
        WarmCase{"pcf_step_alternate", "filter=pcf motion=step-alternate map-size=64"},
        WarmCase{"evsm_step_alternate", "filter=evsm motion=step-alternate map-size=64"},
        WarmCase{"pcf_colour", "filter=pcf translucent=colour map-size=64"},
        WarmCase{"pcf_colour_converge", "filter=pcf translucent=colour soften=converge map-size=64"},
        WarmCase{"pcf_pages", "filter=pcf partition=virtual texels=65536"},
        WarmCase{"raymarch_pages", "filter=raymarch partition=virtual texels=65536"},
        WarmCase{"pcf_half", "filter=pcf mask-size=half partition=cascades map-size=64"},
        WarmCase{"pcf_colour_half", "filter=pcf mask-size=half translucent=colour map-size=64"},
        WarmCase{"hard_blur", "filter=hard soften=blur map-size=64"},
        WarmCase{"pcf_colour_blur_half", "filter=pcf translucent=colour soften=blur soften.size=half map-size=64"},
        WarmCase{"pcf_colour_step_alternate", "filter=pcf translucent=colour motion=step-alternate map-size=64"}),
    [](const auto& test_case) { return std::string(test_case.param.name); });

} // namespace
} // namespace gnomon::test
