// SPDX-License-Identifier: Apache-2.0
// No plane shadows itself, whatever its slant, the map and the kernel; and what is farther off than the bias still
// does.
#include "cpu_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace gnomon::shared {
namespace {

using glm::dmat3;
using glm::dvec2;
using glm::dvec3;
using glm::dvec4;

struct PlaneUnderLight {
    MapRows map;
    BiasRule rule;
    dvec3 normal{0.0}; // of the receiver's plane
    dvec3 point{0.0};  // on it
    dvec3 to_light{0.0};
    double tangent = 0.0; // of the angle between normal and light
    dvec3 axis{0.0};      // of the map
};

enum class Shape { orthographic, perspective, warped };
constexpr Shape kShapes[] = {Shape::orthographic, Shape::perspective, Shape::warped};

class Bias : public testing::Test {
protected:
    double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(rng); }

    dvec3 direction()
    {
        std::normal_distribution<double> normal;
        dvec3 drawn; // one by one: the order of arguments is each compiler's own
        for (int axis = 2; axis >= 0; --axis) {
            drawn[axis] = normal(rng);
        }
        return glm::normalize(drawn);
    }

    // A map that looks along a random direction at a random plane through a random point.
    PlaneUnderLight make(Shape shape, double steepest)
    {
        const bool perspective =
            shape == Shape::perspective || (shape == Shape::warped && std::bernoulli_distribution()(rng));
        PlaneUnderLight s;
        const dvec3 axis = direction();
        const dvec3 right = glm::normalize(glm::cross(axis, direction()));
        const dvec3 up = glm::cross(right, axis);
        s.axis = axis;
        s.point = direction();
        s.point *= uniform(0.0, 20.0);
        const double texel_m = std::exp(uniform(std::log(0.002), std::log(0.5)));
        const double distance = uniform(5.0, 30.0);
        s.map.range_m = uniform(60.0, 300.0);
        if (perspective) {
            const double per_texel = std::min(texel_m / distance, 0.01); // at least 100 texels across 45 degrees
            const dvec2 aside{uniform(-0.4, 0.4), uniform(-0.4, 0.4)};
            const dvec3 origin = s.point - axis * distance + (right * aside.x + up * aside.y) * distance;
            s.map.w = dvec4(axis, -glm::dot(axis, origin));
            s.map.x = dvec4(right, -glm::dot(right, origin)) / per_texel + s.map.w * 1000.0;
            s.map.y = dvec4(-up, glm::dot(up, origin)) / per_texel + s.map.w * 700.0;
            s.map.metric = dvec4(axis, -glm::dot(axis, origin) - 0.1) / s.map.range_m;
            s.map.texel_m = per_texel;
            s.to_light = glm::normalize(origin - s.point);
        } else {
            s.map.w = {0.0, 0.0, 0.0, 1.0};
            s.map.x = dvec4(right / texel_m, 1000.0);
            s.map.y = dvec4(-up / texel_m, 700.0);
            s.map.metric = dvec4(axis, distance - glm::dot(axis, s.point)) / s.map.range_m;
            s.map.texel_m = texel_m;
            s.to_light = -axis;
        }
        if (shape == Shape::warped) {
            warp(s);
        }
        s.tangent = std::exp(uniform(std::log(1e-3), std::log(steepest)));
        const dvec3 side = glm::normalize(glm::cross(s.to_light, direction()));
        s.normal = glm::normalize(s.to_light + side * s.tangent);
        s.rule = {1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 4e-6};
        return s;
    }

    // A homography of the map: w is from 1 to 2 at the point, and texels near it are up to four times as long.
    void warp(PlaneUnderLight& s)
    {
        const double n = uniform(200.0, 3000.0);
        const double upright = uniform(500.0, 1500.0);
        const double along = dotRow(s.map.y, s.point) / dotRow(s.map.w, s.point) - uniform(0.0, n);
        s.map.x -= s.map.w * upright;
        s.map.y -= s.map.w * along;
        s.map.w += s.map.y / n;
    }

    // The metric of the plane (moved by `offset_m` towards the light's side) at a texel's centre.
    static double planeDepth(const PlaneUnderLight& s, dvec2 texel, double offset_m)
    {
        const auto xyz = [](const dvec4& v) {
            return dvec3(v.x, v.y, v.z);
        };
        const dvec4 a = s.map.x - s.map.w * texel.x;
        const dvec4 b = s.map.y - s.map.w * texel.y;
        const dmat3 system = glm::transpose(dmat3(xyz(a), xyz(b), s.normal));
        const dvec3 p = glm::inverse(system) * dvec3(-a.w, -b.w, glm::dot(s.normal, s.point) + offset_m);
        // Beyond the plane's horizon there is nothing in the map.
        return dotRow(s.map.w, p) > 0.0 ? std::min(dotRow(s.map.metric, p), 1.0) : 1.0;
    }

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

    std::mt19937 rng{5};
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
            // A stored depth is off by up to the quantum and belongs to a point up to 1/256 texel away.
            test::map_texels = [&](int x, int y) {
                const dvec2 snap{uniform(-1.0, 1.0) / 256.0, uniform(-1.0, 1.0) / 256.0};
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
            s.rule = {0.0, 0.0, 0.0, 0.0, 1.0, 4.0, 0.0}; // receiver plane alone
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
        s.rule = {0.0, 0.25, 0.0, 0.0, 0.0, 1.0, 0.0};
        const double plain = dotRow(s.map.metric, s.point);
        EXPECT_NEAR(projectReceiver(s.map, s.rule, s.point, s.normal).depth, plain - 0.25 / s.map.range_m, 1e-12);
        s.rule = {0.0, 0.0, 2.0, 0.0, 0.0, 1.0, 0.0};
        EXPECT_NEAR(projectReceiver(s.map, s.rule, s.point, s.normal).depth,
                    plain - 2.0 * s.tangent * s.map.texel_m / s.map.range_m, 1e-9);
        s.rule = {0.0, 0.0, 0.0, 3.0, 0.0, 1.0, 0.0};
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
        return applyFilter(kFilterPcf, projectReceiver(s.map, s.rule, s.point, s.normal), kernel(5));
    };
    const double texel_m = s.map.texel_m;
    for (const double constant_texels : {0.1, 1.0, 3.0, 10.0, 30.0}) {
        s.rule = {0.0, static_cast<double>(constant_texels) * texel_m, 0.0, 0.0, 0.0, 3.0, 0.0};
        const bool acne = visibility(15.0, 0.0) < 0.999;
        const bool lost = visibility(0.01, 2.0 * texel_m) > 0.001;
        EXPECT_TRUE(acne || lost) << constant_texels;
    }
    s.rule = {1.0, 0.0, 0.0, 0.0, 0.0, 3.0, 4e-6};
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
