// SPDX-License-Identifier: Apache-2.0
// No plane shadows itself, whatever its slant, the map and the kernel; and what is farther off than the bias still
// does.
#include "plane_under_light.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::shared {
namespace {

class Bias : public testing::Test, public PlanesUnderLight {
protected:
    static FilterInput kernel(int width)
    {
        FilterInput input{};
        input.kernel_width = width;
        input.kernel = gaussianWeights(std::max(width, 1), 0.0);
        input.disc_taps = 32;
        input.disc_radius = 4.0;
        input.pixel = {11.5, 4.5};
        return input;
    }
    static double reach(int filter, int width) { return filter == 0 ? 0.5 : (width > 0 ? (width + 1) * 0.5 : 5.0); }
};

struct Kind {
    int filter;
    int width; // 0: disc
};
constexpr Kind kKinds[] = {{0, 1}, {1, 1}, {1, 3}, {1, 5}, {1, 7}, {1, 0}};

TEST_F(Bias, automaticNeverLetsAPlaneShadowItself)
{
    for (const Shape shape : kShapes) {
        for (int round = 0; round < 3000; ++round) {
            PlaneUnderLight s = make(shape, shape == Shape::orthographic ? 1e4 : 30.0);
            const Kind kind = kKinds[round % std::size(kKinds)];
            s.rule.reach_texels = reach(kind.filter, kind.width);
            // A stored depth is off by up to the quantum and belongs to a point some way off on the device's grid.
            s.rule.snap_texels = snapOf(round % 2 == 0 ? 4.0 : 8.0);
            test::map_texels = [&](int x, int y) {
                const dvec2 snap = dvec2(uniform(-0.5, 0.5), uniform(-0.5, 0.5)) * s.rule.snap_texels;
                return planeDepth(s, dvec2(x, y) + 0.5 + snap, 0.0) + uniform(-1.0, 1.0) * s.rule.quantum;
            };
            const MapPoint point = projectReceiver(s.map, s.rule, s.point, s.normal);
            EXPECT_NEAR(applyFilter(kind.filter, point, kernel(kind.width)), 1.0, 1e-9)
                << "filter " << kind.filter << " width " << kind.width << " tangent " << s.tangent << " shape "
                << static_cast<int>(shape);
        }
    }
}

// The other side of the bargain: a caster parallel to the receiver shadows it fully as soon as it is this far off.
TEST_F(Bias, automaticKeepsCastersThatAreAFewTexelsOff)
{
    int behind_the_light = 0;
    for (const Shape shape : kShapes) {
        for (int round = 0; round < 2000; ++round) {
            PlaneUnderLight s = make(shape, 4.0);
            const Kind kind = kKinds[round % std::size(kKinds)];
            const double texels = reach(kind.filter, kind.width);
            s.rule.reach_texels = texels;
            const double w = mapW(s.map, s.point);
            const double texel_m = texelExtent(s.map, texelAt(s.map, s.point, w), w);
            // Along the map's axis: roughness, what the plane falls over the kernel's diagonal, and the quantum.
            const double facing = std::abs(glm::dot(s.normal, s.axis));
            const double slope = std::sqrt(1.0 - facing * facing) / facing;
            const double depth_m = texel_m * (0.25 + 0.1 * texels + slope * (0.05 + 1.42 * texels)) * 1.3 +
                                   s.rule.quantum * 1.1 * s.map.range_m;
            if (depth_m > 0.5 * dotRow(s.map.metric, s.point) * s.map.range_m) {
                ++behind_the_light; // or nearly
                continue;
            }
            const double off_plane_m = depth_m * facing;
            test::map_texels = [&](int x, int y) {
                return planeDepth(s, dvec2(x, y) + 0.5, off_plane_m);
            };
            const MapPoint point = projectReceiver(s.map, s.rule, s.point, s.normal);
            EXPECT_NEAR(applyFilter(kind.filter, point, kernel(kind.width)), 0.0, 1e-9)
                << "filter " << kind.filter << " width " << kind.width << " tangent " << s.tangent << " shape "
                << static_cast<int>(shape);
        }
    }
    EXPECT_LT(behind_the_light, 60); // of 6000
}

// Against points of the plane across the light that one step in the map leads to.
TEST_F(Bias, aTexelsExtentIsTheLongestThatItHasAcrossTheLight)
{
    for (const Shape shape : kShapes) {
        for (int round = 0; round < 300; ++round) {
            PlaneUnderLight s = make(shape, 1.0);
            s.normal = s.to_light;
            const double w = mapW(s.map, s.point);
            const dvec2 texel = texelAt(s.map, s.point, w);
            const auto xyz = [](const dvec4& v) {
                return dvec3(v.x, v.y, v.z);
            };
            double longest = 0.0;
            for (int i = 0; i < 720; ++i) {
                const double angle = i * 0.004363323; // quarters of a degree
                constexpr double kStep = 1e-4;
                const dvec2 at = texel + kStep * dvec2(std::cos(angle), std::sin(angle));
                const dvec4 a = s.map.x - s.map.w * at.x;
                const dvec4 b = s.map.y - s.map.w * at.y;
                const dmat3 system = glm::transpose(dmat3(xyz(a), xyz(b), s.normal));
                const dvec3 p = glm::inverse(system) * dvec3(-a.w, -b.w, glm::dot(s.normal, s.point));
                longest = std::max(longest, glm::distance(p, s.point) / kStep);
            }
            EXPECT_NEAR(texelExtent(s.map, texel, w), longest, 1e-4 * longest) << static_cast<int>(shape);
        }
    }
}

TEST_F(Bias, planeIsFollowedExactly)
{
    for (const Shape shape : kShapes) {
        for (int round = 0; round < 1000; ++round) {
            PlaneUnderLight s = make(shape, 10.0);
            s.rule = {.receiver_plane = 1.0, .reach_texels = 4.0};
            const MapPoint point = projectReceiver(s.map, s.rule, s.point, s.normal);
            const dvec2 offset(uniform(-4.0, 4.0), uniform(-4.0, 4.0));
            const double followed =
                (point.depth + glm::dot(point.depth_slope, offset)) / (1.0 + glm::dot(point.w_slope, offset));
            EXPECT_NEAR(followed, planeDepth(s, point.texel + offset, 0.0), 1e-9);
        }
    }
}

TEST_F(Bias, constantAndSlopeAreInMetresAndTexels)
{
    for (int round = 0; round < 500; ++round) {
        PlaneUnderLight s = make(Shape::orthographic, 5.0);
        s.rule = {.constant_m = 0.25, .reach_texels = 1.0};
        const double plain = dotRow(s.map.metric, s.point);
        EXPECT_NEAR(projectReceiver(s.map, s.rule, s.point, s.normal).depth, plain - 0.25 / s.map.range_m, 1e-12);
        s.rule = {.slope = 2.0, .reach_texels = 1.0};
        EXPECT_NEAR(projectReceiver(s.map, s.rule, s.point, s.normal).depth,
                    plain - 2.0 * s.tangent * s.map.texel_m / s.map.range_m, 1e-9);
        s.rule = {.normal_texels = 3.0, .reach_texels = 1.0};
        const dvec3 moved = s.point + s.normal * (3.0 * s.map.texel_m);
        EXPECT_NEAR(projectReceiver(s.map, s.rule, s.point, s.normal).depth, dotRow(s.map.metric, moved), 1e-12);
        EXPECT_NEAR(projectReceiver(s.map, s.rule, s.point, s.normal).texel.x, dotRow(s.map.x, moved), 1e-9);
    }
}

// Forsyth 2006: no constant is right for a whole scene. A flat constant that suits one slant leaves acne on another, or
// swallows a caster that the automatic rule keeps.
TEST_F(Bias, noConstantServesEverySlant)
{
    PlaneUnderLight s = make(Shape::orthographic, 1.0);
    const auto visibility = [&](double tangent, double off_m) {
        const dvec3 side = glm::normalize(glm::cross(s.to_light, dvec3(0.3, 0.5, 0.81)));
        s.normal = glm::normalize(s.to_light + side * tangent);
        test::map_texels = [&](int x, int y) {
            return planeDepth(s, dvec2(x, y) + 0.5, off_m);
        };
        return applyFilter(GNOMON_FILTER_PCF, projectReceiver(s.map, s.rule, s.point, s.normal), kernel(5));
    };
    const double texel_m = s.map.texel_m;
    for (const double constant_texels : {0.1, 1.0, 3.0, 10.0, 30.0}) {
        s.rule = {.constant_m = constant_texels * texel_m, .reach_texels = 3.0};
        const bool acne = visibility(15.0, 0.0) < 0.999;
        const bool lost = visibility(0.01, 2.0 * texel_m) > 0.001;
        EXPECT_TRUE(acne || lost) << constant_texels;
    }
    s.rule = {.automatic = 1.0, .reach_texels = 3.0, .quantum = 4e-6};
    EXPECT_NEAR(visibility(15.0, 0.0), 1.0, 1e-12);
    EXPECT_NEAR(visibility(0.01, 2.0 * texel_m), 0.0, 1e-12);
}

TEST_F(Bias, edgeOnPlanesGiveNumbers)
{
    PlaneUnderLight s = make(Shape::orthographic, 1.0);
    s.rule.reach_texels = 4.0;
    const dvec3 edge_on = glm::normalize(glm::cross(s.to_light, dvec3(0.1, 0.9, 0.2)));
    const MapPoint point = projectReceiver(s.map, s.rule, s.point, edge_on);
    EXPECT_TRUE(std::isfinite(point.depth));
    EXPECT_TRUE(std::isfinite(point.depth_slope.x) && std::isfinite(point.depth_slope.y));
}

} // namespace
} // namespace gnomon::shared
