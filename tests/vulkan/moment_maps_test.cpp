// SPDX-License-Identifier: Apache-2.0
// Filterable maps before any blur: each texel is the average of its samples' encoded depths.
#include "moment_bench.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace gnomon::test {
namespace {

struct Case {
    const char* name;
    Filter filter;
    MapFormat format;
    void (*change)(MomentOptions&) = [](MomentOptions&) {
    };
};
std::ostream& operator<<(std::ostream& out, const Case& c)
{
    return out << c.name;
}

ShadowOptions filterOf(const Case& c)
{
    ShadowOptions filter = momentFilter(c.filter, c.format);
    c.change(filter.moments);
    return filter;
}

/// Channels that differ by more than the format's rounding and `steep` times the error of a depth.
bool differs(const glm::vec4& stored, const glm::dvec4& expected, MapFormat format, double steep)
{
    for (int c = 0; c < channelsOf(format); ++c) {
        const double scale = std::max(std::abs(expected[c]), 0.01);
        const double bound =
            storageError(format) * (format == MapFormat::rg16 || format == MapFormat::rgba16 ? 1 : scale);
        if (!(std::abs(static_cast<double>(stored[c]) - expected[c]) <= bound + steep * scale)) {
            return true;
        }
    }
    return false;
}

bool isOnRing(const Tile& tile, std::uint32_t x, std::uint32_t y)
{
    return x == 0 || y == 0 || x == tile.width - 1 || y == tile.height - 1;
}

class MomentMaps : public testing::TestWithParam<Case> {};

TEST_P(MomentMaps, encodeTheDepthsOfTheirTexels)
{
    const Scene scene = makeScene();
    const Plan plan = momentPlan(scene);
    const CpuMap depths = drawDepths(scene, plan);
    const ShadowOptions filter = filterOf(GetParam());
    const DrawnMaps drawn = drawMaps(scene, plan, filter);
    ASSERT_EQ(drawn.layers.size(), imageLayersPerMap(filter.technique.filter, filter.moments));
    for (std::uint32_t v = 0; v < plan.views.size(); ++v) {
        const View& view = plan.views[v];
        const Tile& tile = view.place.tile;
        for (std::uint32_t layer = 0; layer < drawn.layers.size(); ++layer) {
            std::size_t wrong = 0;
            std::size_t casters = 0;
            for (std::uint32_t y = 0; y < tile.height; ++y) {
                for (std::uint32_t x = 0; x < tile.width; ++x) {
                    const std::size_t at = std::size_t{tile.y + y} * depths.width + tile.x + x;
                    const double depth =
                        isOnRing(tile, x, y) ? 1.0 : static_cast<double>(depths.depth(tile.x + x, tile.y + y));
                    const glm::dvec4 expected =
                        encodeSamples(filter, view, drawn.depth_layers[v], layer, std::array{depth});
                    // An exponential turns an error of 1e-7 in c d into one of its value.
                    wrong += differs(drawn.layers[layer].levels[0][at], expected, formatOf(filter), 5e-5) ? 1 : 0;
                    casters += depth < 1.0 ? 1 : 0;
                }
            }
            EXPECT_EQ(wrong, 0U) << "view " << v << ", layer " << layer;
            EXPECT_GT(casters, 1000U);
        }
    }
}

constexpr auto kLog = [](MomentOptions& o) {
    o.log_space = true;
};
INSTANTIATE_TEST_SUITE_P(Filters, MomentMaps,
                         testing::Values(Case{"vsm_rg32f", Filter::vsm, MapFormat::rg32f},
                                         Case{"vsm_rg16", Filter::vsm, MapFormat::rg16},
                                         Case{"vsm_rg16f", Filter::vsm, MapFormat::rg16f},
                                         Case{"vsm_remapped", Filter::vsm, MapFormat::rg32f,
                                              [](MomentOptions& o) {
                                                  o.remap = true;
                                              }},
                                         Case{"vsm_z_over_w", Filter::vsm, MapFormat::rg32f,
                                              [](MomentOptions& o) {
                                                  o.metric = DepthMetricKind::z_over_w;
                                              }},
                                         Case{"lvsm_2_rgba16", Filter::lvsm, MapFormat::rgba16},
                                         Case{"lvsm_3_rgba32f", Filter::lvsm, MapFormat::rgba32f,
                                              [](MomentOptions& o) {
                                                  o.layers = 3;
                                              }},
                                         Case{"lvsm_8_rgba16f", Filter::lvsm, MapFormat::rgba16f,
                                              [](MomentOptions& o) {
                                                  o.layers = 8;
                                                  o.placement = LayerPlacement::lloyd;
                                              }},
                                         Case{"esm_r32f", Filter::esm, MapFormat::r32f},
                                         Case{"esm_r16f_log", Filter::esm, MapFormat::r16f, kLog},
                                         Case{"evsm_rgba32f", Filter::evsm, MapFormat::rgba32f},
                                         Case{"evsm_rg32f", Filter::evsm, MapFormat::rg32f},
                                         Case{"evsm_rgba16f_log", Filter::evsm, MapFormat::rgba16f, kLog},
                                         Case{"msm_rgba16", Filter::msm, MapFormat::rgba16},
                                         Case{"msm_rgba32f", Filter::msm, MapFormat::rgba32f}),
                         [](const auto& test_case) { return std::string(test_case.param.name); });

// Where a point of the map, in texels, meets the scene first, in the view's metric.
double tracedDepth(const Scene& scene, const View& view, double x, double y)
{
    const glm::dmat4 world_from_clip = glm::inverse(view.projection.clip_from_world);
    const glm::dvec2 ndc((x - view.place.tile.x) / view.place.tile.width * 2.0 - 1.0,
                         (y - view.place.tile.y) / view.place.tile.height * 2.0 - 1.0);
    const glm::dvec4 near = world_from_clip * glm::dvec4(ndc, 0.0, 1.0);
    const glm::dvec4 far = world_from_clip * glm::dvec4(ndc, 1.0, 1.0);
    const glm::dvec3 a = glm::dvec3(near) / near.w;
    const glm::dvec3 direction = glm::normalize(glm::dvec3(far) / far.w - a);
    const auto hit = scene.trace(a, direction);
    return hit ? std::min(glm::dot(view.projection.metric.metric_ws, glm::dvec4(a + direction * hit->t, 1.0)), 1.0)
               : 1.0;
}

// Four samples are averaged as moments. Their places are the standard ones of Vulkan 1.3, chapter "Multisampling".
// The spot's depths are written by a shader, and Mesa 22.3's llvmpipe keeps one of them for all samples of a texel that
// a triangle covers, although the shader runs for each: so its bound is what a slope makes of that.
TEST(MomentSamples, areAveragedAsMoments)
{
    constexpr std::array<glm::dvec2, 4> kPlaces{{{0.375, 0.125}, {0.875, 0.375}, {0.125, 0.625}, {0.625, 0.875}}};
    const Scene scene = makeScene();
    const Plan plan = momentPlan(scene);
    ShadowOptions filter = momentFilter(Filter::vsm, MapFormat::rg32f);
    filter.moments.samples = 4;
    const DrawnMaps drawn = drawMaps(scene, plan, filter);
    for (const View& view : plan.views) {
        const Tile& tile = view.place.tile;
        std::size_t edges = 0;
        std::size_t wrong = 0;
        for (std::uint32_t y = 1; y + 1 < tile.height; ++y) {
            for (std::uint32_t x = 1; x + 1 < tile.width; ++x) {
                std::array<double, 4> depths{};
                for (std::size_t i = 0; i < 4; ++i) {
                    depths[i] = tracedDepth(scene, view, tile.x + x + kPlaces[i].x, tile.y + y + kPlaces[i].y);
                }
                const glm::dvec4 expected = encodeSamples(filter, view, {}, 0, depths);
                const glm::vec4 stored =
                    drawn.layers[0].levels[0][std::size_t{tile.y + y} * drawn.layers[0].width + tile.x + x];
                wrong +=
                    differs(stored, expected, formatOf(filter), view.projection.orthographic ? 3e-5 : 3e-3) ? 1 : 0;
                // Where moments and the square of a mean depth are far apart.
                edges += expected.y - expected.x * expected.x > 1e-3 ? 1 : 0;
            }
        }
        EXPECT_GT(edges, 50U) << "without edges this says nothing";
        EXPECT_LE(wrong, tile.width * tile.height / (view.projection.orthographic ? 200 : 40))
            << "light " << view.light;
    }
}

TEST(MomentDerivatives, addTheSmallerStepsOfBothAxes)
{
    const Scene scene = makeScene();
    const Plan plan = momentPlan(scene);
    const CpuMap depths = drawDepths(scene, plan);
    ShadowOptions filter = momentFilter(Filter::vsm, MapFormat::rg32f);
    const DrawnMaps without = drawMaps(scene, plan, filter);
    filter.moments.derivative_variance = true;
    const DrawnMaps with = drawMaps(scene, plan, filter);
    const Tile& tile = plan.views[0].place.tile;
    std::size_t wrong = 0;
    double largest = 0.0;
    for (std::uint32_t y = 1; y + 1 < tile.height; ++y) {
        for (std::uint32_t x = 1; x + 1 < tile.width; ++x) {
            const auto depth = [&](std::uint32_t i, std::uint32_t j) {
                return double(depths.depth(i, j));
            };
            const double here = depth(x, y);
            const double dx = std::min(std::abs(here - depth(x - 1, y)), std::abs(depth(x + 1, y) - here));
            const double dy = std::min(std::abs(here - depth(x, y - 1)), std::abs(depth(x, y + 1) - here));
            const double expected = here < 1.0 ? 0.25 * (dx * dx + dy * dy) : 0.0;
            const std::size_t at = std::size_t{y} * depths.width + x;
            const double added = double(with.layers[0].levels[0][at].y) - double(without.layers[0].levels[0][at].y);
            wrong += std::abs(added - expected) > 2e-7 ? 1 : 0;
            largest = std::max(largest, expected);
        }
    }
    EXPECT_EQ(wrong, 0U);
    EXPECT_GT(largest, 1e-6);
}

TEST(MomentGuard, depthsThatAreNoNumbersAreNotStored)
{
    const Scene scene = makeScene();
    Plan plan = momentPlan(scene);
    plan.views[1].projection.metric.metric_ws.x = std::numeric_limits<double>::quiet_NaN();
    for (const std::uint32_t samples : {1U, 4U}) {
        ShadowOptions filter = momentFilter(Filter::evsm, MapFormat::rgba32f);
        filter.moments.samples = samples;
        const DrawnMaps drawn = drawMaps(scene, plan, filter);
        std::size_t bad = 0;
        const Tile& tile = plan.views[1].place.tile;
        for (std::uint32_t y = tile.y; y < tile.y + tile.height; ++y) {
            for (std::uint32_t x = tile.x; x < tile.x + tile.width; ++x) {
                const glm::vec4& texel = drawn.layers[0].levels[0][std::size_t{y} * drawn.layers[0].width + x];
                for (int c = 0; c < 4; ++c) {
                    bad += std::isfinite(texel[c]) ? 0 : 1;
                }
            }
        }
        EXPECT_EQ(bad, 0U);
    }
}

} // namespace
} // namespace gnomon::test
