// SPDX-License-Identifier: Apache-2.0
// As many lights and views as one likes in a mask; and descriptors that follow what a host's handles stand for.
#include "fixture.h"
#include "null_driver.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::test {
namespace {

constexpr VkExtent2D kPicture{96, 72};
constexpr std::uint32_t kLights = 64;
constexpr std::uint32_t kViewsEach = 6;
constexpr std::uint32_t kSide = 64; // texels of a tile; eight by eight of them in the atlas

Light lampAt(std::uint32_t i)
{
    const double angle = 0.7 * i;
    return makeSpot({(3.0 + 0.05 * i) * std::cos(angle), 5.0 + 0.05 * i, (3.0 + 0.05 * i) * std::sin(angle)},
                    {0.0, 0.0, 0.0}, 0.5);
}

Tile tileOf(std::uint32_t i)
{
    return {0, i % 8 * kSide, i / 8 * kSide, kSide, kSide};
}

// Gives each light more views: those before its own serve other depths of the camera alone.
void addViews(Plan& plan)
{
    std::vector<View> views;
    for (LightPlan& light : plan.lights) {
        const View own = plan.views[light.first_view];
        light.first_view = static_cast<std::uint32_t>(views.size());
        light.view_count = kViewsEach;
        for (std::uint32_t v = 0; v < kViewsEach; ++v) {
            views.push_back(own);
            views.back().serves.slice.axis = {0.0, 0.0, -1.0, 0.0};
            if (v + 1 < kViewsEach) {
                views.back().serves.slice.begin_m = 1e6;
            }
        }
    }
    plan.views = std::move(views);
}

std::vector<std::byte> maskAlone(std::uint32_t light)
{
    Bench bench(kPicture, MapFormat::d32f);
    bench.setLights({lampAt(light)}, {tileOf(light)}, {8 * kSide, 8 * kSide, 1});
    bench.prepare();
    bench.record(1);
    return bench.readMask(0);
}

TEST(ManyLights, EachIsMaskedAsAlone)
{
    Bench bench(kPicture, MapFormat::d32f);
    std::vector<Light> lights;
    std::vector<Tile> tiles;
    for (std::uint32_t i = 0; i < kLights; ++i) {
        lights.push_back(lampAt(i));
        tiles.push_back(tileOf(i));
    }
    bench.setLights(lights, tiles, {8 * kSide, 8 * kSide, 1});
    addViews(bench.plan);
    ASSERT_EQ(bench.plan.views.size(), kLights * kViewsEach);
    bench.prepare();
    bench.record(1);
    std::vector<std::byte> last;
    for (const std::uint32_t light : {0U, 3U, 4U, 37U, 63U}) {
        const std::vector<std::byte> mask = bench.readMask(light);
        EXPECT_EQ(mask, maskAlone(light)) << light;
        EXPECT_NE(mask, last) << "lights that cannot be told apart";
        last = mask;
    }
    expectSilence(gpu());
}

/// The lights that the test of reach has, of this range; 0: without one, so that they are drawn all over the mask.
std::vector<std::vector<std::byte>> masksOfRange(double range_m, const glm::dvec3& eye)
{
    Bench bench(kPicture, MapFormat::d32f);
    bench.look(eye, {0.0, 0.5, 0.0});
    std::vector<Light> lights;
    std::vector<Tile> tiles;
    for (std::uint32_t i = 0; i < 6; ++i) {
        lights.push_back(lampAt(7 * i));
        lights.back().range_m = range_m;
        tiles.push_back(tileOf(i));
    }
    bench.setLights(lights, tiles, {8 * kSide, 8 * kSide, 1});
    bench.prepare();
    bench.record(1);
    std::vector<std::vector<std::byte>> masks;
    for (std::uint32_t i = 0; i < lights.size(); ++i) {
        masks.push_back(bench.readMask(i));
    }
    return masks;
}

bool reaches(const Light& lamp, double range_m, const glm::dvec3& p)
{
    const glm::dvec3 ray = p - lamp.position_ws;
    const double distance = glm::length(ray);
    return distance <= range_m && glm::dot(ray, lamp.direction_ws) >= distance * std::cos(lamp.outer_half_angle_rad);
}

// Pixels beyond a light's range are 1, and all others equal those without a range.
TEST(ManyLights, AreMaskedWhereTheyReach)
{
    constexpr double kRange = 5.5;
    std::size_t left_out = 0;
    for (const glm::dvec3 eye : {glm::dvec3(9.0, 6.0, 11.0), glm::dvec3(2.0, 3.0, 3.0)}) {
        const auto all_over = masksOfRange(0.0, eye);
        const auto within = masksOfRange(kRange, eye);
        const Scene scene = makeScene();
        const Picture picture =
            tracePicture(scene, makeCamera(eye, {0.0, 0.5, 0.0}, double(kPicture.width) / kPicture.height), kPicture);
        for (std::uint32_t i = 0; i < within.size(); ++i) {
            for (std::size_t pixel = 0; pixel < within[i].size(); ++pixel) {
                const bool is_drawn = picture.object_plus_one[pixel] != 0;
                if (within[i][pixel] != all_over[i][pixel]) {
                    ASSERT_EQ(within[i][pixel], std::byte{255});
                    ASSERT_TRUE(is_drawn && !reaches(lampAt(7 * i), kRange, picture.position[pixel])) << i;
                    ++left_out;
                }
            }
        }
    }
    EXPECT_GT(left_out, 100U) << "the lights reach everything";
    expectSilence(gpu());
}

// A view that was made after its predecessor was destroyed may have the same handle: so handles that are the same as
// before are no reason to leave descriptors as they are.
TEST(HostHandles, AreWrittenInEveryFrame)
{
    NullDriver driver;
    vulkan::ShadowRenderer renderer(driver.view(), {});
    const Scene scene = makeScene();
    const std::vector<Light> lights{makeSun({0.5, -1.0, 0.2})};
    const Plan plan = makePlan(scene, lights, std::vector<Tile>{{0, 0, 0, 64, 64}}, {64, 64, 1});
    vulkan::MaskInputs inputs;
    inputs.extent = kPicture;
    inputs.depth = driver.makeView();
    (void)renderer.prepare(plan, kPicture);
    for (std::uint32_t i = 0; i < 6; ++i) {
        const auto before = driver.counts().descriptor_updates;
        renderer.recordMaps(driver.commands(), i % 2, plan, [](const vulkan::MapPass&) {});
        renderer.recordMask(driver.commands(), i % 2, plan, inputs);
        EXPECT_GT(driver.counts().descriptor_updates, before) << i;
    }
}

} // namespace
} // namespace gnomon::test
