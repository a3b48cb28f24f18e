// SPDX-License-Identifier: Apache-2.0
// Filterable maps whose penumbrae follow from the light's size, on maps whose shadows are known in closed form.
#include "cpu_map.h"

#include <gnomon/lib/encoders.glsl>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

namespace gnomon {
namespace {

using namespace shared;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr int kSide = 256;
constexpr std::array kFilters{GNOMON_FILTER_VSM, GNOMON_FILTER_MSM};

MomentRule ruleOf(int filter)
{
    MomentRule rule{};
    rule.flags = kMomentPenumbra | (filter == GNOMON_FILTER_MSM ? kMomentRemap : 0);
    rule.sampling = 1;
    rule.power = 1.0;
    rule.moment_bias = 3e-6;
    rule.min_variance = 1.3e-6;
    rule.min_variance_texels = 0.5;
    return rule;
}

/// A map of moments, of what a texel's four corners' quarters hold, blurred by a binomial kernel `passes` times.
template <class Depth>
test::MomentImage momentsOf(int filter, int passes, Depth depth)
{
    const MomentRule rule = ruleOf(filter);
    test::MomentImage image(kSide, kSide);
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            for (const double u : {0.25, 0.75}) {
                for (const double v : {0.25, 0.75}) {
                    EncodeInput e{};
                    e.depth = depth(glm::dvec2(x + u, y + v));
                    image.at(x, y) += 0.25 * encodeDepth(filter, e, rule);
                }
            }
        }
    }
    for (int pass = 0; pass < passes; ++pass) {
        test::MomentImage blurred(kSide, kSide);
        for (int y = 0; y < kSide; ++y) {
            for (int x = 0; x < kSide; ++x) { // what is read at a corner is the mean of four
                blurred.at(x, y) =
                    0.25 * (image.read({x + 0.0, y + 0.0}, 0.0, 0.0) + image.read({x + 1.0, y + 0.0}, 0.0, 0.0) +
                            image.read({x + 0.0, y + 1.0}, 0.0, 0.0) + image.read({x + 1.0, y + 1.0}, 0.0, 0.0));
            }
        }
        image = blurred;
    }
    return image;
}

/// Parallel light along -z over a floor at z = 0, depth 1 being `range` metres below depth 0, `top` above the floor.
struct Sun {
    double texel = 0.02;
    double top = 8.0;
    double range = 10.0;
    double tangent = std::tan(1.0 * kDegree); // of half the light's angle
    int filter = GNOMON_FILTER_VSM;

    [[nodiscard]] double depthOf(double height) const { return std::clamp((top - height) / range, 0.0, 1.0); }
    [[nodiscard]] glm::dvec2 placeOf(glm::dvec2 at) const { return (at - 0.5 * kSide) * texel; }
    /// `height`: of the highest surface over a place.
    template <class Height>
    void draw(int passes, Height height) const
    {
        const test::MomentImage image =
            momentsOf(filter, passes, [&](glm::dvec2 at) { return depthOf(height(placeOf(at))); });
        test::map_moments = [image](glm::dvec2 at, double level, double layer) {
            return image.read(at, level, layer);
        };
    }
    [[nodiscard]] double visibility(glm::dvec3 p, glm::dvec3 n, int pixel) const
    {
        MapRows rows{};
        rows.x = {1.0 / texel, 0.0, 0.0, 0.5 * kSide};
        rows.y = {0.0, 1.0 / texel, 0.0, 0.5 * kSide};
        rows.w = {0.0, 0.0, 0.0, 1.0};
        rows.metric = {0.0, 0.0, -1.0 / range, top / range};
        rows.texel_m = texel;
        rows.range_m = range;
        BiasRule rule{};
        rule.automatic = 1.0;
        rule.snap_texels = snapOf(8.0);
        rule.normal_error = 2e-4;
        rule.quantum = 4e-6;
        rule.reach_texels = 1.75;
        FilterInput f{};
        f.moments = ruleOf(filter);
        f.pixel = {pixel % 61 + 0.5, pixel / 61 + 0.5};
        f.rows = rows;
        f.n = n;
        f.toward = {0.0, 0.0, 1.0};
        f.spread = tangent;
        f.tile = {0.0, 0.0, kSide, kSide};
        f.near_over_far = 1.0;
        return applyFilter(filter, projectReceiver(rows, rule, p, n), f);
    }
};

/// Mean and standard deviation, along x, of the edge that a half plane x < 0 at a height casts on the floor.
struct Edge {
    double middle = 0.0;
    double width = 0.0;
};

Edge edgeBelow(const Sun& sun, double height, int passes)
{
    constexpr int kPoints = 2000;
    const double reach = 3.0 * height * sun.tangent + 8.0 * sun.texel;
    sun.draw(passes, [&](glm::dvec2 q) { return q.x < 0.0 ? height : 0.0; });
    Edge edge;
    double second = 0.0;
    for (int i = 0; i < kPoints; ++i) { // moments of dV/dx, by parts
        const double x = reach * (-1.0 + 2.0 * (i + 0.5) / kPoints);
        const double lit = sun.visibility({x, 0.0371 * sun.texel * i, 0.0}, {0.0, 0.0, 1.0}, i);
        const double excess = lit - (x > 0.0 ? 1.0 : 0.0);
        edge.middle -= excess * 2.0 * reach / kPoints;
        second -= 2.0 * x * excess * 2.0 * reach / kPoints;
    }
    edge.width = std::sqrt(std::max(second - edge.middle * edge.middle, 0.0));
    return edge;
}

// A disc's chords have a standard deviation of half its radius along a line.
TEST(MomentPenumbra, GrowsWithTheHeightOfItsOccluder)
{
    for (const int filter : kFilters) {
        for (const int passes : {0, 2}) {
            for (const double degrees : {2.0, 6.0}) {
                for (const double height : {1.5, 3.0, 6.0}) {
                    Sun sun;
                    sun.filter = filter;
                    sun.tangent = std::tan(0.5 * degrees * kDegree);
                    sun.texel = height * sun.tangent / 8.0; // 16 texels wide
                    const Edge edge = edgeBelow(sun, height, passes);
                    const double wanted = 0.5 * height * sun.tangent;
                    EXPECT_NEAR(edge.width, wanted, 0.1 * wanted)
                        << "filter " << filter << ", " << degrees << " degrees, " << height << " m, blurred " << passes;
                    EXPECT_NEAR(edge.middle, 0.0, 0.25 * sun.texel);
                }
            }
        }
    }
}

// No part of a plane that rises all over the search counts as an occluder.
TEST(MomentPenumbra, APlaneWithoutOccludersIsLit)
{
    for (const int filter : kFilters) {
        for (const double degrees : {0.0, 30.0, 60.0, 75.0}) {
            Sun sun;
            sun.filter = filter;
            const double slope = std::tan(degrees * kDegree);
            const auto height = [&](glm::dvec2 q) {
                return 0.5 * slope * (q.x + q.y);
            };
            sun.texel = 0.005;
            sun.draw(2, height);
            const glm::dvec3 n = glm::normalize(glm::dvec3(-0.5 * slope, -0.5 * slope, 1.0));
            for (int i = 0; i < 200; ++i) {
                const glm::dvec2 q = 0.2 * glm::dvec2(std::cos(2.4 * i), std::sin(2.4 * i)) * std::sqrt(i / 200.0);
                EXPECT_GE(sun.visibility({q, height(q)}, n, i), 0.98) << filter << ", " << degrees << " degrees";
            }
        }
    }
}

// A roof that is wider than the search, with a low one beneath it: nothing is lit, though two depths are before the
// floor.
TEST(MomentPenumbra, BelowAWideRoofAllIsDark)
{
    for (const int filter : kFilters) {
        Sun sun;
        sun.filter = filter;
        sun.draw(2, [](glm::dvec2 q) { return q.x < 0.0 ? 6.0 : 2.0; });
        for (int i = 0; i < 200; ++i) {
            EXPECT_LE(sun.visibility({0.005 * (i - 100), 0.1, 0.0}, {0.0, 0.0, 1.0}, i),
                      filter == GNOMON_FILTER_MSM ? 0.02 : 0.25)
                << filter << ", " << i;
        }
    }
}

} // namespace
} // namespace gnomon
