// SPDX-License-Identifier: Apache-2.0
// Masks of a sun that moves in steps, against those by either of its positions alone.
#define GNOMON_REAL double
#include "fixture.h"
#include "write_pgm.h"

#include <shared/sun_steps.h>

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::test {
namespace {

using vulkan::FilterOptions;

constexpr VkExtent2D kScreen{160, 100};
constexpr std::uint32_t kMapSize = 256;
constexpr glm::dvec3 kEarlier{0.8, -0.9, -0.35};
constexpr glm::dvec3 kLater{0.65, -0.9, -0.55};

using Mask = std::vector<std::byte>;

enum class Slices : std::uint8_t { one, two };

struct Setting {
    FilterOptions options;
    Slices slices = Slices::one;
    bool paired_texels = false;
};

// The views of one position, with tiles from `layer` on.
void addViews(const Setting& setting, const Scene& scene, const Camera& camera, const glm::dvec3& direction,
              SunPosition position, std::uint32_t light, Plan& plan)
{
    const std::uint32_t count = setting.slices == Slices::two ? 2 : 1;
    for (std::uint32_t i = 0; i < count; ++i) {
        const bool second = setting.paired_texels && position == SunPosition::later;
        const std::uint32_t layer = second ? plan.atlas.layers - count + i : plan.atlas.layers;
        View view = makeView(scene, makeSun(direction), light, {layer, 0, 0, kMapSize, kMapSize});
        plan.atlas.layers += second ? 0 : 1;
        view.sun = position;
        if (setting.paired_texels) {
            view.part = second ? TexelPart::second : TexelPart::first;
        }
        if (count == 2) {
            // A different size, so that the slices can be told apart.
            if (i == 1) {
                view.clip_from_world =
                    glm::dmat4(0.7, 0, 0, 0, 0, 0.7, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1) * view.clip_from_world;
                view.texel_m /= 0.7;
            }
            const glm::dvec3 axis = glm::normalize(-camera.eye_ws);
            view.slice.axis = glm::dvec4(axis, -glm::dot(axis, camera.eye_ws));
            view.slice.begin_m = i == 0 ? -1e9 : 12.0;
            view.slice.end_m = i == 0 ? 15.0 : 1e9;
            view.slice.blend_m = i == 0 ? 0.0 : 3.0;
        }
        view.caster_count = static_cast<std::uint32_t>(plan.casters.size());
        plan.views.push_back(view);
        ++plan.lights[light].view_count;
    }
}

Plan emptyPlan(const Scene& scene, std::size_t lights)
{
    Plan plan = makePlan(scene, {}, {}, {kMapSize, kMapSize, 0});
    plan.mask_layers = 1;
    for (std::uint32_t i = 0; i < lights; ++i) {
        plan.lights.push_back({0, 0, 0, i, {}});
    }
    return plan;
}

// Two suns, each with its positions as asked for; the second one's pair is the other way round.
class Suns {
public:
    Suns(const Setting& setting_in, std::size_t lights = 1) : bench(kScreen, setting_in.options), setting(setting_in)
    {
        const glm::dvec3 between = glm::normalize(glm::normalize(kEarlier) + glm::normalize(kLater));
        bench.setLights(std::vector<Light>(lights, makeSun(between)),
                        std::vector<Tile>(lights, Tile{0, 0, 0, kMapSize, kMapSize}), {kMapSize, kMapSize, 1});
    }

    /// Every light by one position alone: not a stepping sun at all.
    std::vector<Mask> maskOf(SunPosition position)
    {
        Plan plan = emptyPlan(bench.scene, bench.lights.size());
        for (std::uint32_t i = 0; i < bench.lights.size(); ++i) {
            plan.lights[i].first_view = static_cast<std::uint32_t>(plan.views.size());
            addViews(setting, bench.scene, bench.frame.camera, directionOf(i, position), SunPosition::only, i, plan);
            if (setting.paired_texels) {
                for (View& view : plan.views) {
                    view.part = TexelPart::whole;
                }
            }
        }
        return draw(plan);
    }
    std::vector<Mask> maskOf(const std::vector<SunSteps>& steps)
    {
        Plan plan = emptyPlan(bench.scene, bench.lights.size());
        for (std::uint32_t i = 0; i < bench.lights.size(); ++i) {
            LightPlan& light = plan.lights[i];
            light.first_view = static_cast<std::uint32_t>(plan.views.size());
            light.steps = steps[i];
            light.steps.stepping = true;
            light.steps.paired = true;
            light.steps.earlier_ws = glm::normalize(directionOf(i, SunPosition::earlier));
            light.steps.later_ws = glm::normalize(directionOf(i, SunPosition::later));
            for (const SunPosition position : {SunPosition::earlier, SunPosition::later}) {
                addViews(setting, bench.scene, bench.frame.camera, directionOf(i, position), position, i, plan);
            }
        }
        return draw(plan);
    }

    Bench bench;
    Setting setting;

private:
    static glm::dvec3 directionOf(std::uint32_t light, SunPosition position)
    {
        return (position == SunPosition::later) == (light == 0) ? kLater : kEarlier;
    }
    std::vector<Mask> draw(const Plan& plan)
    {
        bench.plan = plan;
        bench.prepare();
        bench.record(1);
        std::vector<Mask> masks;
        for (std::uint32_t i = 0; i < bench.lights.size(); ++i) {
            masks.push_back(bench.readMask(i));
        }
        return masks;
    }
};

shared::real4 ruleOf(const SunSteps& s)
{
    return {s.share, s.edge, s.band > 0.0 ? 1.0 / s.band : 0.0, s.smooth ? 1.0 : 0.0};
}

int steps255(const Mask& mask, std::size_t i)
{
    return std::to_integer<int>(mask[i]);
}

// How far the mask is from what both positions' masks make it, at most, in steps of 255.
double worstOff(const Mask& mask, const Mask& earlier, const Mask& later, const SunSteps& steps)
{
    double worst = 0.0;
    for (std::size_t i = 0; i < mask.size(); ++i) {
        const double x = (double(i % kScreen.width) + 0.5) / kScreen.width;
        const double weight = shared::stepWeight(ruleOf(steps), x);
        const double expected = shared::steppedVisibility(steps255(earlier, i), steps255(later, i), weight);
        worst = std::max(worst, std::abs(steps255(mask, i) - expected));
    }
    return worst;
}

std::size_t countDifferent(const Mask& a, const Mask& b)
{
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        count += a[i] != b[i] ? 1 : 0;
    }
    return count;
}

// Both masks are rounded, and so is what is made of them; a bit more for single precision.
constexpr double kRounding = 1.01;

SunSteps blendOf(double share, bool smooth)
{
    SunSteps steps;
    steps.share = share;
    steps.smooth = smooth;
    return steps;
}

struct Case {
    const char* name;
    Filter filter;
    MapFormat format;
    Slices slices;
    bool paired_texels;
};

std::ostream& operator<<(std::ostream& out, const Case& c)
{
    return out << c.name;
}

Setting settingOf(const Case& c)
{
    Setting setting;
    setting.options.filter = c.filter;
    setting.options.format = c.format;
    setting.slices = c.slices;
    setting.paired_texels = c.paired_texels;
    return setting;
}

class SteppingSun : public testing::TestWithParam<Case> {};

TEST_P(SteppingSun, isABlendOfBothPositions)
{
    Suns suns(settingOf(GetParam()));
    const Mask earlier = suns.maskOf(SunPosition::earlier)[0];
    const Mask later = suns.maskOf(SunPosition::later)[0];
    EXPECT_GT(countDifferent(earlier, later), earlier.size() / 100) << "else this says nothing";
    for (const bool smooth : {false, true}) {
        for (const double share : {0.0, 0.3, 0.5, 0.85, 1.0}) {
            const SunSteps steps = blendOf(share, smooth);
            const Mask mask = suns.maskOf({steps})[0];
            EXPECT_LE(worstOff(mask, earlier, later, steps), kRounding) << share;
            if (share == 0.0 || share == 1.0) {
                EXPECT_EQ(mask, share == 0.0 ? earlier : later);
            }
            writePgm(std::string("steps_") + GetParam().name, mask, kScreen);
        }
    }
    expectSilence(gpu());
}

TEST_P(SteppingSun, isOneOrTheOtherBesideTheBand)
{
    Suns suns(settingOf(GetParam()));
    const Mask earlier = suns.maskOf(SunPosition::earlier)[0];
    const Mask later = suns.maskOf(SunPosition::later)[0];
    for (const double edge : {0.0, 0.13, 0.6, 1.0, 1.25}) {
        SunSteps steps = blendOf(0.5, true);
        steps.band = 0.25;
        steps.edge = edge;
        const Mask mask = suns.maskOf({steps})[0];
        EXPECT_LE(worstOff(mask, earlier, later, steps), kRounding) << edge;
        for (std::size_t i = 0; i < mask.size(); ++i) {
            const double x = (double(i % kScreen.width) + 0.5) / kScreen.width;
            if (x < edge - 0.25) {
                ASSERT_EQ(mask[i], later[i]) << x;
            } else if (x > edge) {
                ASSERT_EQ(mask[i], earlier[i]) << x;
            }
        }
        writePgm(std::string("band_") + GetParam().name, mask, kScreen);
    }
    expectSilence(gpu());
}

INSTANTIATE_TEST_SUITE_P(Filters, SteppingSun,
                         testing::Values(Case{"hard", Filter::hard, MapFormat::d32f, Slices::one, false},
                                         Case{"pcf_cascades", Filter::pcf, MapFormat::d16, Slices::two, false},
                                         Case{"pcf_rg16_cascades", Filter::pcf, MapFormat::rg16, Slices::two, true},
                                         Case{"hard_rgba8", Filter::hard, MapFormat::rgba8, Slices::one, true},
                                         Case{"vsm", Filter::vsm, MapFormat::rg32f, Slices::one, false}),
                         [](const auto& test_case) { return std::string(test_case.param.name); });

// Lights of one layer whose bands lie elsewhere, one without a band and one that takes no steps part the screen
// further.
TEST(SteppingSuns, ofOneLayerAreEachTheirOwn)
{
    Setting setting;
    setting.slices = Slices::two;
    Suns suns(setting, 3);
    const auto earlier = suns.maskOf(SunPosition::earlier);
    const auto later = suns.maskOf(SunPosition::later);
    std::vector<SunSteps> steps(3, blendOf(0.4, true));
    steps[0].band = 0.3;
    steps[0].edge = 0.5;
    steps[1].band = 0.5;
    steps[1].edge = 0.9;
    const auto masks = suns.maskOf(steps);
    for (std::size_t i = 0; i < masks.size(); ++i) {
        EXPECT_LE(worstOff(masks[i], earlier[i], later[i], steps[i]), kRounding) << i;
    }
    expectSilence(gpu());
}

// Two maps in one texel are those that have texels of their own, but for how depths are rounded.
TEST(SteppingSuns, sharedTexelsShowWhatOwnTexelsShow)
{
    for (const MapFormat format : {MapFormat::rg16, MapFormat::rgba8}) {
        Setting own;
        own.options.format = MapFormat::d16;
        Setting shared = own;
        shared.options.format = format;
        shared.paired_texels = true;
        const SunSteps steps = blendOf(0.4, false);
        const Mask a = Suns(own).maskOf({steps})[0];
        const Mask b = Suns(shared).maskOf({steps})[0];
        std::size_t off = 0;
        for (std::size_t i = 0; i < a.size(); ++i) {
            off += std::abs(steps255(a, i) - steps255(b, i)) > 1 ? 1 : 0;
        }
        // Depths differ by a code at most, and the bias is more than that: only where a caster's edge is the receiver's
        // own can one go the other way.
        EXPECT_LE(off, a.size() / 1000);
    }
    expectSilence(gpu());
}

// --- step-alternate

SunSteps turnOf(SunPosition read, double share)
{
    SunSteps steps = blendOf(share, true);
    steps.alternate = true;
    steps.read = read;
    return steps;
}

TEST(AlternatingSun, showsBothPositionsFromTheSecondFrameOn)
{
    for (const std::size_t lights : {1U, 2U}) {
        Suns suns({}, lights);
        const auto earlier = suns.maskOf(SunPosition::earlier);
        const auto later = suns.maskOf(SunPosition::later);
        const auto all = [&](const SunSteps& steps) {
            return std::vector<SunSteps>(lights, steps);
        };
        Suns turns({}, lights);
        EXPECT_EQ(turns.maskOf(all(turnOf(SunPosition::earlier, 0.3))), earlier) << "nothing is known of the other one";
        int frame = 0;
        for (const double share : {0.35, 0.4, 0.45, 0.5}) {
            const SunPosition read = frame++ % 2 == 0 ? SunPosition::later : SunPosition::earlier;
            const SunSteps steps = turnOf(read, share);
            const auto masks = turns.maskOf(all(steps));
            for (std::size_t i = 0; i < lights; ++i) {
                // What the frame before made has been rounded once more, and is read between pixels by as much as
                // single precision is off.
                EXPECT_LE(worstOff(masks[i], earlier[i], later[i], steps), kRounding + 1.0) << share;
            }
        }
        // The same position again has no partner.
        EXPECT_EQ(turns.maskOf(all(turnOf(SunPosition::earlier, 0.5))), earlier);
        expectSilence(gpu());
    }
}

// A frame that another motion has drawn is no partner either.
TEST(AlternatingSun, forgetsWhereItIsInterrupted)
{
    Suns suns(Setting{});
    (void)suns.maskOf({turnOf(SunPosition::earlier, 0.3)});
    const auto later = suns.maskOf(SunPosition::later);
    EXPECT_EQ(suns.maskOf({turnOf(SunPosition::later, 0.3)}), later);
    expectSilence(gpu());
}

TEST(AlternatingSun, doesNotDrawBehindWhatMovesAway)
{
    Suns suns(Setting{});
    const glm::dvec3 moved_eye = suns.bench.frame.camera.eye_ws + glm::dvec3(-0.9, 0.2, 0.6);
    const Picture before = suns.bench.picture;
    const Camera camera_before = suns.bench.frame.camera;
    (void)suns.maskOf({turnOf(SunPosition::earlier, 0.5)});
    suns.bench.look(moved_eye, {0.0, 0.5, 0.0});
    const SunSteps steps = turnOf(SunPosition::later, 0.5);
    const Mask mask = suns.maskOf({steps})[0];
    const Mask later = suns.maskOf(SunPosition::later)[0];
    const Mask earlier = suns.maskOf(SunPosition::earlier)[0];
    const Picture& now = suns.bench.picture;
    std::size_t hidden = 0;
    std::size_t wrong = 0;
    std::size_t seen = 0;
    std::size_t off = 0;
    for (std::size_t i = 0; i < mask.size(); ++i) {
        if (now.object_plus_one[i] == 0) {
            continue;
        }
        const glm::dvec4 clip = camera_before.clip_from_world * glm::dvec4(now.position[i], 1.0);
        const glm::dvec2 at = (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * glm::dvec2(kScreen.width, kScreen.height) - 0.5;
        const glm::ivec2 cell(glm::floor(at));
        const double expected = glm::length(now.position[i] - camera_before.eye_ws);
        int same = 0;
        int near = 0;
        for (int k = 0; k < 4; ++k) {
            const glm::ivec2 p = cell + glm::ivec2(k & 1, k >> 1);
            if (p.x < 0 || p.y < 0 || p.x >= int(kScreen.width) || p.y >= int(kScreen.height)) {
                continue;
            }
            const std::size_t j = std::size_t(p.y) * kScreen.width + std::size_t(p.x);
            const double found = glm::length(before.position[j] - camera_before.eye_ws);
            same += before.object_plus_one[j] == now.object_plus_one[i] && std::abs(found - expected) < 0.02 * expected;
            near += before.object_plus_one[j] != 0 && std::abs(found - expected) < 0.04 * expected;
        }
        if (near == 0) {
            ++hidden;
            wrong += mask[i] != later[i] ? 1 : 0;
        } else if (same == 4) {
            ++seen;
            const double both = shared::steppedVisibility(steps255(earlier, i), steps255(later, i), 0.5);
            off += std::abs(steps255(mask, i) - both) > 40.0 ? 1 : 0;
        }
    }
    EXPECT_GT(hidden, 100U);
    EXPECT_EQ(wrong, 0U) << "this frame alone counts there";
    EXPECT_GT(seen, mask.size() / 3);
    // At shadows' edges the frame before is read between its pixels.
    EXPECT_LE(off, seen / 30);
    writePgm("alternate_moved", mask, kScreen);
    expectSilence(gpu());
}

} // namespace
} // namespace gnomon::test
