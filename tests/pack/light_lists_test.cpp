// SPDX-License-Identifier: Apache-2.0
// Light lists of tiles: no pixel may miss a light that reaches it.
#include <gnomon/pack/light_lists.h>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace gnomon {
namespace {

constexpr glm::uvec2 kSize{320, 181};
constexpr std::uint32_t kSide = 16;

class Dice {
public:
    [[nodiscard]] double in(double low, double high) { return std::uniform_real_distribution(low, high)(engine_); }
    [[nodiscard]] glm::dvec3 point(double half) { return {in(-half, half), in(-half, half), in(-half, half)}; }

private:
    std::mt19937 engine_{7};
};

Camera cameraOf(Dice& dice)
{
    Camera camera;
    camera.eye_ws = dice.point(20.0);
    glm::dmat4 projection = glm::perspectiveRH_ZO(dice.in(0.4, 1.8), double(kSize.x) / kSize.y, 0.1, 500.0);
    projection[1][1] = -projection[1][1];
    camera.clip_from_world =
        projection * glm::lookAtRH(camera.eye_ws, dice.point(10.0), glm::normalize(dice.point(1.0)));
    camera.reversed_z = false;
    return camera;
}

Light lightOf(Dice& dice, LightType type)
{
    Light light;
    light.type = type;
    light.position_ws = dice.point(25.0);
    light.direction_ws = glm::normalize(dice.point(1.0));
    light.outer_half_angle_rad = dice.in(0.05, 1.047);
    light.range_m = dice.in(0.5, 30.0);
    return light;
}

bool reaches(const Light& light, const glm::dvec3& p)
{
    const glm::dvec3 ray = p - light.position_ws;
    const double distance = glm::length(ray);
    return light.type == LightType::directional ||
           (distance <= light.range_m &&
            (light.type == LightType::point ||
             glm::dot(ray, light.direction_ws) >= distance * std::cos(light.outer_half_angle_rad)));
}

bool has(const pack::LightLists& lists, std::uint32_t x, std::uint32_t y, std::uint32_t light)
{
    const auto list = lists.of(x, y);
    return std::binary_search(list.begin(), list.end(), light);
}

struct Count {
    std::size_t lit = 0;
    std::size_t missed = 0;
    std::size_t listed = 0;
    std::size_t all = 0;
};

// A point that light i reaches and that the camera sees must be in a tile that has the light.
void look(Dice& dice, const Frame& frame, const pack::LightLists& lists, std::uint32_t i, Count& count)
{
    const Light& light = frame.lights[i];
    const glm::dvec3 p = light.position_ws + dice.point(light.range_m);
    const glm::dvec4 clip = frame.camera.clip_from_world * glm::dvec4(p, 1.0);
    const glm::dvec3 ndc = glm::dvec3(clip) / clip.w;
    if (!reaches(light, p) || clip.w <= 0.0 || std::abs(ndc.x) >= 1.0 || std::abs(ndc.y) >= 1.0 || ndc.z < 0.0 ||
        ndc.z > 1.0) {
        return;
    }
    ++count.lit;
    const auto x = static_cast<std::uint32_t>((0.5 * ndc.x + 0.5) * kSize.x) / kSide;
    const auto y = static_cast<std::uint32_t>((0.5 * ndc.y + 0.5) * kSize.y) / kSide;
    count.missed += has(lists, x, y, i) ? 0 : 1;
}

TEST(LightLists, MissNoPixelThatALightReaches)
{
    Dice dice;
    Count count;
    pack::LightLists lists;
    for (int round = 0; round < 60; ++round) {
        Frame frame;
        frame.camera = cameraOf(dice);
        frame.size_px = kSize;
        std::vector<Light> lights;
        for (int i = 0; i < 24; ++i) {
            lights.push_back(lightOf(dice, i % 4 == 3 ? LightType::point : LightType::spot));
        }
        frame.lights = lights;
        pack::listLights(frame.lights, frame.camera, {glm::dvec3(-30.0), glm::dvec3(30.0)}, kSize, kSide, lists);
        ASSERT_EQ(lists.tiles, glm::uvec2(20, 12));
        count.listed += lists.lights.size();
        count.all += lights.size() * lists.tiles.x * lists.tiles.y;
        for (std::uint32_t i = 0; i < lights.size(); ++i) {
            for (int k = 0; k < 400; ++k) {
                look(dice, frame, lists, i, count);
            }
        }
    }
    EXPECT_GT(count.lit, 10'000U);
    EXPECT_EQ(count.missed, 0U);
    EXPECT_LT(count.listed, count.all * 6 / 10) << "lists that leave next to nothing out";
}

TEST(LightLists, HaveSunsEverywhereAndLightsBehindTheEyeNowhere)
{
    Frame frame;
    frame.size_px = {64, 48};
    frame.camera.clip_from_world = glm::perspectiveRH_ZO(1.0, 4.0 / 3.0, 0.1, 100.0); // looks along -z
    std::vector<Light> lights(3);
    lights[1].type = LightType::spot;
    lights[1].position_ws = {0.0, 0.0, 2.0};
    lights[1].direction_ws = {0.0, 0.0, 1.0};
    lights[1].range_m = 10.0;
    lights[2] = lights[1];
    lights[2].direction_ws = {0.0, 0.0, -1.0};
    frame.lights = lights;
    pack::LightLists lists;
    pack::listLights(frame.lights, frame.camera, {glm::dvec3(-1.0), glm::dvec3(1.0)}, frame.size_px, 16, lists);
    ASSERT_EQ(lists.tiles, glm::uvec2(4, 3));
    for (std::uint32_t y = 0; y < 3; ++y) {
        for (std::uint32_t x = 0; x < 4; ++x) {
            EXPECT_TRUE(has(lists, x, y, 0));
            EXPECT_FALSE(has(lists, x, y, 1));
            EXPECT_TRUE(has(lists, x, y, 2));
        }
    }
}

} // namespace
} // namespace gnomon
