// SPDX-License-Identifier: Apache-2.0
// How far a receiver's surface moves on the map from pixel to pixel: against a closed form, against the neighbouring
// pixel's ray traced to the plane and projected, and where there is nothing to hold on to.
#define GNOMON_REAL double
#include <gnomon/lib/receiver_footprint.glsl>

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <limits>
#include <optional>
#include <random>

namespace gnomon::shared {
namespace {

using glm::dmat4;
using glm::dvec2;
using glm::dvec3;
using glm::dvec4;

constexpr dvec2 kScreen{640.0, 400.0};

dvec4 rowOf(const dmat4& m, int i)
{
    return {m[0][i], m[1][i], m[2][i], m[3][i]};
}

// A camera by the matrix that takes normalised device coordinates to the world.
struct Screen {
    dmat4 world_from_ndc{1.0};

    [[nodiscard]] dvec3 at(const dvec2& pixel, double depth) const
    {
        const dvec4 h = world_from_ndc * dvec4(2.0 * pixel / kScreen - 1.0, depth, 1.0);
        return dvec3(h) / h.w;
    }
    // Where the pixel's ray meets the plane through `p`, before the eye.
    [[nodiscard]] std::optional<dvec3> meet(const dvec2& pixel, const dvec3& p, const dvec3& n) const
    {
        const dvec3 a = at(pixel, 1.0); // reversed: the near plane
        const dvec3 direction = at(pixel, 0.5) - a;
        const double t = glm::dot(n, p - a) / glm::dot(n, direction);
        return t > 0.0 ? std::optional(a + direction * t) : std::nullopt;
    }
    [[nodiscard]] PixelSteps steps(const dvec2& pixel, const dvec3& p) const
    {
        const dvec4 ndc_h = glm::inverse(world_from_ndc) * dvec4(p, 1.0);
        const dvec4 ndc(2.0 * pixel / kScreen - 1.0, ndc_h.z / ndc_h.w, 1.0);
        const double w = glm::dot(rowOf(world_from_ndc, 3), ndc);
        return pixelSteps(rowOf(world_from_ndc, 0), rowOf(world_from_ndc, 1), rowOf(world_from_ndc, 2),
                          rowOf(world_from_ndc, 3), w, 2.0 / kScreen);
    }
};

Screen perspectiveScreen(const dvec3& eye, const dvec3& target)
{
    const dmat4 clip_from_view = glm::perspectiveRH_ZO(0.9, kScreen.x / kScreen.y, 200.0, 0.1); // reversed
    const dmat4 flip = glm::scale(dmat4(1.0), dvec3(1.0, -1.0, 1.0));
    return {glm::inverse(flip * clip_from_view * glm::lookAtRH(eye, target, dvec3(0, 1, 0)))};
}

Screen orthographicScreen(const dvec3& eye, const dvec3& target)
{
    const dmat4 clip_from_view = glm::orthoRH_ZO(-8.0, 8.0, 5.0, -5.0, 100.0, 0.1);
    return {glm::inverse(clip_from_view * glm::lookAtRH(eye, target, dvec3(0, 1, 0)))};
}

// A map of 1000 texels around the origin, by a sun or by a spot that stands 20 m off or elsewhere.
MapRows mapAlong(const dvec3& axis, bool perspective, std::optional<dvec3> place = {})
{
    const dvec3 right = glm::normalize(glm::cross(axis, dvec3(0.3, 0.8, -0.5)));
    const dvec3 down = glm::cross(axis, right);
    const dvec3 origin = place.value_or(axis * -20.0);
    MapRows rows{};
    rows.range_m = 40.0;
    rows.texel_m = perspective ? 0.001 : 0.02;
    rows.w = perspective ? dvec4(axis, -glm::dot(axis, origin)) : dvec4(0.0, 0.0, 0.0, 1.0);
    rows.x = dvec4(right, -glm::dot(right, origin)) / rows.texel_m + rows.w * 500.0;
    rows.y = dvec4(down, -glm::dot(down, origin)) / rows.texel_m + rows.w * 500.0;
    rows.metric = dvec4(axis, -glm::dot(axis, origin)) / rows.range_m;
    return rows;
}

dvec2 project(const MapRows& map, const dvec3& p)
{
    return dvec2(dotRow(map.x, p), dotRow(map.y, p)) / dotRow(map.w, p);
}

dvec2 footprint(const MapRows& map, const dvec3& p, const dvec3& n, const dvec4& step, const dvec4& along)
{
    return footprintOf(map, project(map, p), dotRow(map.w, p), p, n, step, along);
}

TEST(ReceiverFootprint, ofAWallThatFacesTheCameraIsAPixelsWidth)
{
    // The camera and a sun look along -z at the plane z = 0 from 10 m: a pixel is 2 tan(0.45) 10 / 400 metres.
    const Screen screen = perspectiveScreen({0.0, 0.0, 10.0}, {0.0, 0.0, 0.0});
    MapRows map{};
    map.x = dvec4(50.0, 0.0, 0.0, 500.0); // texels of 2 cm
    map.y = dvec4(0.0, -50.0, 0.0, 500.0);
    map.w = dvec4(0.0, 0.0, 0.0, 1.0);
    const double pixel_m = 2.0 * std::tan(0.45) * 10.0 / kScreen.y;
    for (const dvec2 pixel : {dvec2(320.0, 200.0), dvec2(10.5, 390.5)}) {
        const dvec3 n(0.0, 0.0, 1.0);
        const dvec3 p = *screen.meet(pixel, dvec3(0.0), n);
        const PixelSteps s = screen.steps(pixel, p);
        const dvec2 x = footprint(map, p, n, s.right, s.along);
        const dvec2 y = footprint(map, p, n, s.below, s.along);
        EXPECT_NEAR(x.x, 50.0 * pixel_m, 1e-9);
        EXPECT_NEAR(x.y, 0.0, 1e-9);
        EXPECT_NEAR(y.x, 0.0, 1e-9);
        EXPECT_NEAR(y.y, 50.0 * pixel_m, 1e-9) << "rows go from the top on the map too";
    }
}

// Random receivers, cameras and maps: wherever the neighbour's point is inside the bounds, it is where its ray meets
// the plane, projected.
TEST(ReceiverFootprint, isThatOfTheNeighboursPointProjected)
{
    std::mt19937 rng(5);
    const auto uniform = [&](double a, double b) {
        return std::uniform_real_distribution<double>(a, b)(rng);
    };
    const auto direction = [&] {
        std::normal_distribution<double> normal;
        return glm::normalize(dvec3(normal(rng), normal(rng), normal(rng)));
    };
    int compared = 0;
    int bounded = 0;
    for (int i = 0; i < 4000; ++i) {
        const bool orthographic = i % 4 == 3;
        const dvec3 eye = direction() * uniform(5.0, 15.0);
        const Screen screen = orthographic ? orthographicScreen(eye, {}) : perspectiveScreen(eye, {});
        const MapRows map = mapAlong(direction(), i % 2 == 1);
        const dvec2 pixel = glm::floor(dvec2(uniform(0.0, 639.0), uniform(0.0, 399.0))) + 0.5;
        const dvec3 n = direction();
        const auto p = screen.meet(pixel, direction(), n);
        if (!p || dotRow(map.w, *p) < 0.1) {
            continue;
        }
        const PixelSteps s = screen.steps(pixel, *p);
        for (const bool right : {true, false}) {
            const auto q = screen.meet(pixel + (right ? dvec2(1.0, 0.0) : dvec2(0.0, 1.0)), *p, n);
            const dvec2 found = footprint(map, *p, n, right ? s.right : s.below, s.along);
            const double distance = glm::length(*p - eye);
            const bool far = !q || (!orthographic && glm::length(*q - eye) > 15.0 * distance) ||
                             dotRow(map.w, *q) < dotRow(map.w, *p) / 15.0;
            const dvec2 expected = far ? dvec2(0.0) : project(map, *q) - project(map, *p);
            if (far || glm::length(expected) > 0.9 * kLongestFootprint) {
                ++bounded;
                EXPECT_LE(glm::length(found), kLongestFootprint);
                EXPECT_GE(glm::length(found), 0.0) << "a number";
                continue;
            }
            ++compared;
            EXPECT_NEAR(glm::length(found - expected), 0.0, 1e-7 * (1.0 + glm::length(expected)));
        }
    }
    EXPECT_GT(compared, 4000);
    EXPECT_GT(bounded, 0) << "some neighbours must be out of bounds";
}

TEST(ReceiverFootprint, ofAFloorAtTheHorizonIsLongAndBounded)
{
    // 2 m above the floor, looking level: pixels towards the horizon go ever further, those above it miss.
    const Screen screen = perspectiveScreen({0.0, 2.0, 0.0}, {0.0, 2.0, -1.0});
    const MapRows map = mapAlong(glm::normalize(dvec3(0.3, -1.0, 0.2)), false);
    const dvec3 n(0.0, 1.0, 0.0);
    double last = 0.0;
    for (double y = 399.5; y > 200.6; y -= 1.0) {
        const dvec2 pixel(320.5, y);
        const dvec3 p = *screen.meet(pixel, dvec3(0.0), n);
        const PixelSteps s = screen.steps(pixel, p);
        const double length = glm::length(footprint(map, p, n, s.below, s.along));
        EXPECT_GT(length, last) << y;
        EXPECT_LE(length, kLongestFootprint);
        last = length;
        const double up = glm::length(footprint(map, p, n, -s.below, s.along)); // the last one's ray misses
        EXPECT_GT(up, length);
        EXPECT_LE(up, kLongestFootprint);
    }
    EXPECT_GT(last, 1000.0);
}

TEST(ReceiverFootprint, stepsTowardsALightKeepAwayFromItsPlane)
{
    // A wall seen from the side reaches behind a spot that stands 1 cm before p.
    const Screen screen = perspectiveScreen({0.0, 0.0, 4.0}, {0.0, 0.0, 0.0});
    const dvec3 n = glm::normalize(dvec3(0.2, 0.1, 1.0));
    const dvec2 pixel(320.5, 200.5);
    const dvec3 p = *screen.meet(pixel, dvec3(0.0), n);
    const PixelSteps s = screen.steps(pixel, p);
    for (const double before : {0.1, 0.02, 0.003, 1e-6}) {
        const MapRows map = mapAlong(dvec3(1.0, 0.0, 0.0), true, p - dvec3(before, 0.0, 0.0));
        for (const dvec4& step : {s.right, -s.right, s.below, -s.below}) {
            const dvec2 moved = footprint(map, p, n, step, s.along);
            const double length = glm::length(moved);
            EXPECT_GE(length, 0.0) << before;
            EXPECT_LE(length, kLongestFootprint) << before;
            // Beyond the light's plane it would come out on the other side.
            if (length < kLongestFootprint) {
                EXPECT_GT(glm::dot(moved, footprint(map, p, n, 1e-9 * step, s.along)), 0.0) << before;
            }
        }
    }
}

TEST(ReceiverFootprint, ofWhatIsSeenEdgeOnOrIsNoNumberIsALength)
{
    const Screen screen = perspectiveScreen({0.0, 0.0, 10.0}, {0.0, 0.0, 0.0});
    const MapRows map = mapAlong(dvec3(0.0, -1.0, 0.0), false);
    const dvec3 p(0.0);
    const PixelSteps s = screen.steps(kScreen * 0.5, p);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double inf = std::numeric_limits<double>::infinity();
    const dvec3 normals[] = {{1, 0, 0}, {0, 1, 0}, {1, 0, 1e-12}, {0, 0, 0}, {nan, 0, 1}, {inf, 0, 1}};
    for (const dvec3& n : normals) {
        for (const dvec4& step : {s.right, s.below}) {
            const double length = glm::length(footprint(map, p, n, step, s.along));
            EXPECT_TRUE(length >= 0.0 && length <= kLongestFootprint) << n.x << ' ' << n.y << ' ' << n.z;
        }
    }
}

} // namespace
} // namespace gnomon::shared
