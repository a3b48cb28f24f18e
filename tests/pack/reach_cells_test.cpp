// SPDX-License-Identifier: Apache-2.0
// A layer of the mask is drawn where its lights reach: each pixel by those that reach it, once.
#include "plan_by_hand.h"
#include "reach_cells.h"

#include <gnomon/pack/mask_draws.h>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace gnomon::test {
namespace {

constexpr std::uint32_t kSide = 40;

class Dice {
public:
    [[nodiscard]] std::uint32_t upTo(std::uint32_t most)
    {
        return std::uniform_int_distribution<std::uint32_t>(0, most)(engine_);
    }
    [[nodiscard]] pack::ScreenBounds bounds() { return {upTo(kSide), upTo(kSide), upTo(kSide), upTo(kSide)}; }

private:
    std::mt19937 engine_{11};
};

bool has(const pack::ScreenBounds& bounds, std::uint32_t x, std::uint32_t y)
{
    return bounds.x0 <= x && x < bounds.x1 && bounds.y0 <= y && y < bounds.y1;
}

TEST(ReachCells, HaveEachPixelOnceWithTheLightsThatReachIt)
{
    Dice dice;
    for (int round = 0; round < 500; ++round) {
        pack::LayerReach reach;
        std::array<pack::ScreenBounds, 4> bounds;
        for (std::uint32_t i = 0; i < 4; ++i) {
            bounds[i] = dice.bounds();
            reach.add(1U << i, bounds[i]);
        }
        const pack::ScreenBounds strip{dice.upTo(10), 0, 30, kSide};
        const pack::ReachCells cells(reach, strip);
        for (std::uint32_t y = 0; y < kSide; ++y) {
            for (std::uint32_t x = 0; x < kSide; ++x) {
                std::uint32_t wanted = 0;
                for (std::uint32_t i = 0; i < 4; ++i) {
                    wanted |= has(strip, x, y) && has(bounds[i], x, y) ? 1U << i : 0U;
                }
                std::uint32_t found = 0;
                int times = 0;
                for (const pack::ReachCell& cell : cells) {
                    times += has(cell.pixels, x, y) ? 1 : 0;
                    found |= has(cell.pixels, x, y) ? cell.channels : 0U;
                }
                ASSERT_EQ(found, wanted) << x << " " << y;
                ASSERT_EQ(times, wanted != 0 ? 1 : 0) << x << " " << y;
            }
        }
    }
}

TEST(ReachCells, AreOneWhereAllLightsReachEverything)
{
    pack::LayerReach reach;
    for (std::uint32_t i = 0; i < 4; ++i) {
        reach.add(1U << i, {0, 0, kSide, kSide});
    }
    const pack::ReachCells cells(reach, {0, 0, kSide, kSide});
    ASSERT_EQ(cells.size(), 1U);
    EXPECT_EQ(cells.begin()->channels, 0xFU);
}

// Looks along -z.
Camera cameraAtOrigin()
{
    Camera camera;
    camera.clip_from_world = glm::perspectiveRH_ZO(1.0, 1.0, 0.1, 100.0);
    return camera;
}

Light lampAt(const glm::dvec3& place, double range_m)
{
    Light light;
    light.type = LightType::point;
    light.position_ws = place;
    light.range_m = range_m;
    return light;
}

TEST(MaskDraws, AreWhereALampReachesAndNeedNoOtherPipelines)
{
    PlanByHand by_hand({filteredBy(Filter::pcf), filteredBy(Filter::evsm)});
    by_hand.add(0, 1);
    by_hand.add(0, 6);
    by_hand.add(1, 6);
    by_hand.add(0, 6);
    by_hand.plan.made_for.lights[1] = lampAt({0.0, 0.0, -10.0}, 1.0);
    by_hand.plan.made_for.lights[2] = lampAt({0.0, 0.0, 10.0}, 1.0); // behind the eye
    by_hand.plan.made_for.lights[3] = lampAt({2.0, 0.0, -10.0}, 0.5);
    by_hand.plan.made_for.camera = cameraAtOrigin();
    std::vector<pack::MaskDraw> draws;
    pack::listMaskDraws(by_hand.plan, {400, 400}, draws);
    EXPECT_LE(draws.size(), pack::mostMaskDraws(by_hand.plan));
    std::uint64_t sun = 0;
    std::uint64_t lamp = 0;
    std::uint64_t hidden = 0;
    for (const pack::MaskDraw& draw : draws) {
        const std::uint64_t pixels = std::uint64_t{draw.pixels.x1 - draw.pixels.x0} * (draw.pixels.y1 - draw.pixels.y0);
        sun += (draw.channels & 1U) != 0 ? pixels : 0;
        lamp += (draw.channels & 2U) != 0 ? pixels : 0;
        hidden += (draw.channels & 4U) != 0 ? pixels : 0;
        EXPECT_TRUE(draw.shares) << "as in a frame in which the other filter's lamp is seen";
    }
    EXPECT_EQ(sun, 400U * 400U);
    EXPECT_GT(lamp, 0U);
    EXPECT_LT(lamp, 400U * 400U / 10);
    EXPECT_EQ(hidden, 0U);
    std::vector<shared::GpuLight> lights(pack::maskLightCount(by_hand.plan));
    pack::fillMaskLights(by_hand.plan, draws, lights);
    EXPECT_EQ(lights[1].views, glm::uvec4(1, 6, 0, 0));
    EXPECT_EQ(lights[3].views, glm::uvec4(13, 6, 0, 0));
}

TEST(MaskDraws, SurviveNumbersThatAreNone)
{
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    PlanByHand by_hand({filteredBy(Filter::pcf)});
    for (int i = 0; i < 4; ++i) {
        by_hand.add(0, 6);
    }
    by_hand.plan.made_for.lights[0] = lampAt({kNan, 0.0, 0.0}, 1.0);
    by_hand.plan.made_for.lights[1] = lampAt({0.0, 0.0, -5.0}, kNan);
    by_hand.plan.made_for.lights[2] = lampAt({0.0, 0.0, -5.0}, -1.0);
    by_hand.plan.made_for.lights[3] = lampAt({0.0, 0.0, -5.0}, 1.0);
    by_hand.plan.made_for.lights[3].type = LightType::spot;
    by_hand.plan.made_for.lights[3].direction_ws = glm::dvec3(0.0);
    by_hand.plan.made_for.camera = cameraAtOrigin();
    std::vector<pack::MaskDraw> draws;
    pack::listMaskDraws(by_hand.plan, {400, 400}, draws);
    ASSERT_EQ(draws.size(), 1U);
    EXPECT_EQ(draws[0].channels, 0xFU) << "where a light reaches is not known: everywhere";
    by_hand.plan.made_for.camera.clip_from_world[0][0] = kNan;
    pack::listMaskDraws(by_hand.plan, {400, 400}, draws);
    pack::listMaskDraws(by_hand.plan, {0, 0}, draws);
    EXPECT_TRUE(draws.empty());
}

} // namespace
} // namespace gnomon::test
