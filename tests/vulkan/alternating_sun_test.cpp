// SPDX-License-Identifier: Apache-2.0
// Masks of a sun whose positions take turns (step-alternate), against those by either of its positions alone.
#define GNOMON_REAL double
#include "stepping_suns.h"
#include "write_pgm.h"

#include <gnomon/shared/sun_steps.h>

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::test {
namespace {

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
                // The last frame's mask is rounded once more, and is read beside pixel centres by the error of single
                // precision.
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
    const glm::dvec3 moved_eye = suns.bench.camera.eye_ws + glm::dvec3(-0.9, 0.2, 0.6);
    const Picture before = suns.bench.picture;
    const Camera camera_before = suns.bench.camera;
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
        const glm::dvec2 at =
            (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * glm::dvec2(kStepScreen.width, kStepScreen.height) - 0.5;
        const glm::ivec2 cell(glm::floor(at));
        const double expected = glm::length(now.position[i] - camera_before.eye_ws);
        int same = 0;
        int near = 0;
        for (int k = 0; k < 4; ++k) {
            const glm::ivec2 p = cell + glm::ivec2(k & 1, k >> 1);
            if (p.x < 0 || p.y < 0 || p.x >= int(kStepScreen.width) || p.y >= int(kStepScreen.height)) {
                continue;
            }
            const std::size_t j = std::size_t(p.y) * kStepScreen.width + std::size_t(p.x);
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
    EXPECT_GT(hidden, mask.size() / 50) << "else this says nothing";
    EXPECT_EQ(wrong, 0U) << "this frame alone counts there";
    EXPECT_GT(seen, mask.size() / 3);
    // At shadows' edges the frame before is read between its pixels.
    EXPECT_LE(off, seen / 30);
    writePgm("alternate_moved", mask, kStepScreen);
    expectSilence(gpu());
}

} // namespace
} // namespace gnomon::test
