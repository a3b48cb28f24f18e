// SPDX-License-Identifier: Apache-2.0
// The GPU's maps and masks against closed forms and against the same shader files run on the CPU.
#include "fixture.h"
#include "parity.h"

#include <gnomon/plan_views.h>

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

namespace gnomon::test {
namespace {

struct Case {
    const char* name;
    Filter filter;
    PcfKernel kernel;
    MapFormat format;
    Soften soften = Soften::none;
};

std::ostream& operator<<(std::ostream& out, const Case& c)
{
    return out << c.name;
}

class Parity : public testing::TestWithParam<Case> {};

TEST_P(Parity, maskIsThatOfTheCpu)
{
    ShadowOptions options{.technique = kPlainTechnique};
    options.technique.filter = GetParam().filter;
    options.technique.soften = GetParam().soften;
    options.pcf.kernel = GetParam().kernel;
    options.format = GetParam().format;
    expectParity(renderParity(options), options, GetParam().name);
    expectParity(renderParity(options, ParityLights::sun_alone), options, std::string(GetParam().name) + "_alone");
    expectSilence(gpu());
}

INSTANTIATE_TEST_SUITE_P(
    Filters, Parity,
    testing::Values(Case{"hard_d32f", Filter::hard, PcfKernel::bilinear_2x2, MapFormat::d32f},
                    Case{"hard_d16", Filter::hard, PcfKernel::bilinear_2x2, MapFormat::d16},
                    Case{"hard_r32f", Filter::hard, PcfKernel::bilinear_2x2, MapFormat::r32f},
                    Case{"pcf_2x2_d32f", Filter::pcf, PcfKernel::bilinear_2x2, MapFormat::d32f},
                    Case{"pcf_3x3_d32f", Filter::pcf, PcfKernel::gaussian_3x3, MapFormat::d32f},
                    Case{"pcf_3x3_d16", Filter::pcf, PcfKernel::gaussian_3x3, MapFormat::d16},
                    Case{"pcf_3x3_r32f", Filter::pcf, PcfKernel::gaussian_3x3, MapFormat::r32f},
                    Case{"pcf_5x5_d32f", Filter::pcf, PcfKernel::gaussian_5x5, MapFormat::d32f},
                    Case{"pcf_7x7_d32f", Filter::pcf, PcfKernel::gaussian_7x7, MapFormat::d32f},
                    Case{"hard_rg16", Filter::hard, PcfKernel::bilinear_2x2, MapFormat::rg16},
                    Case{"hard_rgba8", Filter::hard, PcfKernel::bilinear_2x2, MapFormat::rgba8},
                    Case{"pcf_3x3_rg16f", Filter::pcf, PcfKernel::gaussian_3x3, MapFormat::rg16f},
                    Case{"pcf_5x5_rg16", Filter::pcf, PcfKernel::gaussian_5x5, MapFormat::rg16},
                    Case{"pcf_3x3_rgba8", Filter::pcf, PcfKernel::gaussian_3x3, MapFormat::rgba8},
                    Case{"pcf_box_d32f", Filter::pcf, PcfKernel::box_3x3, MapFormat::d32f},
                    Case{"pcf_projected_r32f", Filter::pcf, PcfKernel::projected_3x3, MapFormat::r32f},
                    Case{"pcf_poisson_d32f", Filter::pcf, PcfKernel::poisson, MapFormat::d32f},
                    Case{"pcf_vogel_d32f", Filter::pcf, PcfKernel::vogel, MapFormat::d32f},
                    Case{"hard_smoothies_d32f", Filter::hard, PcfKernel::bilinear_2x2, MapFormat::d32f,
                         Soften::smoothies},
                    Case{"pcf_smoothies_d16", Filter::pcf, PcfKernel::gaussian_3x3, MapFormat::d16, Soften::smoothies},
                    Case{"smoothies_d32f", Filter::smoothies, PcfKernel::gaussian_3x3, MapFormat::d32f},
                    Case{"smoothies_r32f", Filter::smoothies, PcfKernel::bilinear_2x2, MapFormat::r32f},
                    Case{"pcss_d32f", Filter::pcss, PcfKernel::vogel, MapFormat::d32f},
                    Case{"pcss_d16", Filter::pcss, PcfKernel::vogel, MapFormat::d16},
                    Case{"raymarch_d32f", Filter::raymarch, PcfKernel::vogel, MapFormat::d32f},
                    Case{"raymarch_d16", Filter::raymarch, PcfKernel::vogel, MapFormat::d16},
                    Case{"raymarch_r32f", Filter::raymarch, PcfKernel::vogel, MapFormat::r32f},
                    Case{"id_r16", Filter::id, PcfKernel::gaussian_3x3, MapFormat::r16},
                    Case{"id_r8", Filter::id, PcfKernel::gaussian_3x3, MapFormat::r8},
                    Case{"depth_id_rg16", Filter::depth_id, PcfKernel::vogel, MapFormat::rg16},
                    Case{"depth_id_rg8", Filter::depth_id, PcfKernel::vogel, MapFormat::rg8},
                    Case{"depth_id_rg32f", Filter::depth_id, PcfKernel::vogel, MapFormat::rg32f}),
    [](const auto& test_case) { return std::string(test_case.param.name); });

TEST(ParityOfIds, everyTestAndDepthIsThatOfTheCpu)
{
    for (const IdTest test : {IdTest::any, IdTest::priority, IdTest::nearest}) {
        for (const auto& [filter, depth, bias] :
             {std::tuple{Filter::id, IdDepth::object, std::optional<float>{}},
              std::tuple{Filter::depth_id, IdDepth::object, std::optional<float>{0.05F}},
              std::tuple{Filter::depth_id, IdDepth::global, std::optional<float>{}},
              std::tuple{Filter::depth_id, IdDepth::global, std::optional<float>{0.05F}}}) {
            for (const IdOf of : {IdOf::object, IdOf::face}) {
                ShadowOptions options{.technique = kPlainTechnique};
                options.technique.filter = filter;
                options.ids = {test, depth, bias, of};
                const std::string name = "ids_" + std::string(nameOf(filter)) + "_" + std::string(nameOf(test)) + "_" +
                                         std::string(nameOf(depth)) + (bias ? "_bias_" : "_") + std::string(nameOf(of));
                SCOPED_TRACE(name);
                expectParity(renderParity(options), options, name);
            }
        }
    }
    expectSilence(gpu());
}

// The rasteriser's z/w of a lamp's depth, and depths of 24 bits.
TEST(ParityOfDepths, zOverWAnd24BitsAreThoseOfTheCpu)
{
    for (const MapFormat format : {MapFormat::d32f, MapFormat::d24, MapFormat::d16}) {
        for (const DepthMetricKind metric : {DepthMetricKind::linear, DepthMetricKind::z_over_w}) {
            for (const Filter filter : {Filter::hard, Filter::pcf}) {
                ShadowOptions options{.technique = kPlainTechnique};
                options.technique.filter = filter;
                options.format = format;
                options.moments.metric = metric;
                const std::string name = "depths_" + std::string(nameOf(filter)) + "_" + std::string(nameOf(format)) +
                                         "_" + std::string(nameOf(metric));
                SCOPED_TRACE(name);
                const Rendered r = renderParity(options);
                expectParity(r, options, name);
                if (metric == DepthMetricKind::z_over_w) { // and the reference can tell
                    ShadowOptions linear = options;
                    linear.moments.metric = DepthMetricKind::linear;
                    const std::vector<double> wrong =
                        referenceMask({r.picture, r.camera, r.lights, r.plan, r.maps}, 1, linear, {});
                    std::size_t off = 0;
                    for (std::size_t i = 0; i < wrong.size(); ++i) {
                        off += std::abs(std::to_integer<int>(r.masks[1][i]) - 255.0 * wrong[i]) > 1.001 ? 1 : 0;
                    }
                    EXPECT_GT(off, wrong.size() / 500);
                }
            }
        }
    }
    expectSilence(gpu());
}

TEST(ParityOfDepths, zOverWIsReadByEveryKernel)
{
    for (const PcfKernel kernel : {PcfKernel::box_3x3, PcfKernel::projected_3x3, PcfKernel::vogel}) {
        ShadowOptions options{.technique = kPlainTechnique};
        options.pcf.kernel = kernel;
        options.moments.metric = DepthMetricKind::z_over_w;
        const std::string name = "depths_z_over_w_" + std::string(nameOf(kernel));
        SCOPED_TRACE(name);
        expectParity(renderParity(options), options, name);
    }
    expectSilence(gpu());
}

// Filters that read linear depths alone get these, whatever metric others would have.
TEST(ParityOfDepths, zOverWIsNotStoredForFiltersThatCannotReadIt)
{
    for (const Filter filter : {Filter::pcss, Filter::raymarch}) {
        ShadowOptions options{.technique = kPlainTechnique};
        options.technique.filter = filter;
        SCOPED_TRACE(nameOf(filter));
        const Rendered linear = renderParity(options);
        options.moments.metric = DepthMetricKind::z_over_w;
        EXPECT_EQ(renderParity(options).masks, linear.masks);
    }
    expectSilence(gpu());
}

// A point light's views stand side by side, and a pixel is one view's alone.
TEST(ParityOfPoints, maskIsThatOfTheCpu)
{
    for (const auto& [filter, format] :
         {std::pair{Filter::hard, MapFormat::d32f}, std::pair{Filter::pcf, MapFormat::d16},
          std::pair{Filter::pcss, MapFormat::d32f}, std::pair{Filter::raymarch, MapFormat::d32f},
          std::pair{Filter::id, MapFormat::r16}, std::pair{Filter::depth_id, MapFormat::rg8},
          std::pair{Filter::vsm, MapFormat::rg32f}}) {
        ShadowOptions options{.technique = kPlainTechnique};
        options.technique.filter = filter;
        options.format = format;
        const std::string name = std::string("point_") + std::string(nameOf(filter));
        SCOPED_TRACE(name);
        const Rendered r = renderParity(options, ParityLights::point);
        expectParity(r, options, name);
        // The reference can tell views that are swapped.
        Plan other = r.plan;
        std::swap(other.views[2].serves.sector, other.views[3].serves.sector);
        const std::vector<double> wrong = referenceMask({r.picture, r.camera, r.lights, other, r.maps}, 0, options, {});
        std::size_t off = 0;
        for (std::size_t i = 0; i < wrong.size(); ++i) {
            off += std::abs(std::to_integer<int>(r.masks[0][i]) - 255.0 * wrong[i]) > 1.001 ? 1 : 0;
        }
        EXPECT_GT(off, wrong.size() / 500); // twice what parity lets pass
    }
    expectSilence(gpu());
}

// A paraboloid's two views are of half spaces, and rows of each receiver's own.
TEST(ParityOfParaboloids, maskIsThatOfTheCpu)
{
    for (const auto& [filter, kernel, format] : {std::tuple{Filter::hard, PcfKernel::bilinear_2x2, MapFormat::d32f},
                                                 std::tuple{Filter::pcf, PcfKernel::gaussian_3x3, MapFormat::d32f},
                                                 std::tuple{Filter::pcf, PcfKernel::gaussian_7x7, MapFormat::d16},
                                                 std::tuple{Filter::pcf, PcfKernel::vogel, MapFormat::r32f}}) {
        ShadowOptions options{.technique = kPlainTechnique};
        options.technique.partition = Partition::paraboloid;
        options.technique.filter = filter;
        options.pcf.kernel = kernel;
        options.format = format;
        const std::string name = "paraboloid_" + std::string(nameOf(filter)) + "_" + std::string(nameOf(kernel));
        SCOPED_TRACE(name);
        const Rendered r = renderParity(options, ParityLights::paraboloid);
        expectParity(r, options, name);
        // The reference can tell views that are swapped.
        Plan other = r.plan;
        std::swap(other.views[0].serves.sector, other.views[1].serves.sector);
        const std::vector<double> wrong = referenceMask({r.picture, r.camera, r.lights, other, r.maps}, 0, options, {});
        std::size_t off = 0;
        for (std::size_t i = 0; i < wrong.size(); ++i) {
            off += std::abs(std::to_integer<int>(r.masks[0][i]) - 255.0 * wrong[i]) > 1.001 ? 1 : 0;
        }
        EXPECT_GT(off, wrong.size() / 500); // twice what parity lets pass
    }
    expectSilence(gpu());
}

// Edges are where straight lines between their ends are, but what is within them has its exact distance from the light.
TEST(MapsOfParaboloids, holdExactDistancesWithinBentEdges)
{
    ShadowOptions options{.technique = kPlainTechnique};
    options.technique.partition = Partition::paraboloid;
    options.technique.filter = Filter::hard;
    const Rendered r = renderParity(options, ParityLights::paraboloid);
    for (const View& view : r.plan.views) {
        const glm::dvec2 half = 0.5 * glm::dvec2(view.place.tile.width, view.place.tile.height);
        const glm::dmat4 rows = glm::transpose(view.projection.clip_from_world);
        std::size_t ground = 0;
        std::size_t exact = 0;
        std::size_t seen = 0;
        std::size_t other = 0;
        for (std::uint32_t y = 0; y < view.place.tile.height; ++y) {
            for (std::uint32_t x = 0; x < view.place.tile.width; ++x) {
                const glm::dvec2 place =
                    (glm::dvec2(x + 0.5, y + 0.5) / half - 1.0) * view.projection.clip_from_world[3][3];
                const double r2 = glm::dot(place, place);
                if (r2 > 0.36) { // beyond 0.64 the ground's own straight edges pass
                    continue;
                }
                const glm::dvec3 d = glm::dvec3(2.0 * place, 1.0 - r2) / (1.0 + r2);
                const glm::dvec3 ray =
                    glm::normalize(glm::dvec3(rows[0]) * d.x + glm::dvec3(rows[1]) * d.y + glm::dvec3(rows[2]) * d.z);
                const auto hit = r.scene.trace(view.projection.light_place_ws, ray);
                const double expected =
                    hit ? std::min(depthOnMap(view, view.projection.light_place_ws + ray * hit->t), 1.0) : 1.0;
                const double stored = r.maps[view.place.tile.layer].depth(view.place.tile.x + x, view.place.tile.y + y);
                const bool is_exact = std::abs(stored - expected) < 2e-5;
                ground += hit && hit->object == 0 ? 1 : 0;
                exact += hit && hit->object == 0 && is_exact ? 1 : 0;
                seen += 1;
                other += is_exact ? 0 : 1;
            }
        }
        const bool below = view.serves.sector.w.y < 0.0;
        EXPECT_EQ(ground > 0, below);
        EXPECT_GE(exact, ground * 97 / 100);
        EXPECT_LE(other, seen / 20) << "edges of boxes";
        EXPECT_EQ(other > 0, below) << "nothing is above the lamp, and edges below are bent";
    }
    expectSilence(gpu());
}

// Two positions of a sun, joined: by maps in halves of a texel and by maps with layers of their own.
class ParityOfSteps : public testing::TestWithParam<Case> {};

TEST_P(ParityOfSteps, maskIsThatOfTheCpu)
{
    ShadowOptions options{.technique = kPlainTechnique};
    options.technique.filter = GetParam().filter;
    options.pcf.kernel = GetParam().kernel;
    options.format = GetParam().format;
    const std::string name = std::string("steps_") + GetParam().name;
    expectParity(renderParity(options, ParityLights::stepping_sun), options, name);
    expectParity(renderParity(options, ParityLights::stepping_band), options, name + "_band");
    expectSilence(gpu());
}

INSTANTIATE_TEST_SUITE_P(Filters, ParityOfSteps,
                         testing::Values(Case{"hard_rg16", Filter::hard, PcfKernel::bilinear_2x2, MapFormat::rg16},
                                         Case{"pcf_3x3_rg16", Filter::pcf, PcfKernel::gaussian_3x3, MapFormat::rg16},
                                         Case{"pcf_3x3_rgba8", Filter::pcf, PcfKernel::gaussian_3x3, MapFormat::rgba8},
                                         Case{"hard_rg16f", Filter::hard, PcfKernel::bilinear_2x2, MapFormat::rg16f},
                                         Case{"pcf_3x3_d32f", Filter::pcf, PcfKernel::gaussian_3x3, MapFormat::d32f},
                                         Case{"vsm_rg32f", Filter::vsm, PcfKernel::bilinear_2x2, MapFormat::rg32f}),
                         [](const auto& test_case) { return std::string(test_case.param.name); });

// The reference must be able to tell: a weight that is off by a tenth, and positions the wrong way round.
TEST(ParityOfStepsItself, tellsAnotherBlendApart)
{
    ShadowOptions options{.technique = kPlainTechnique};
    options.technique.filter = Filter::pcf;
    options.format = MapFormat::rgba8;
    const Rendered r = renderParity(options, ParityLights::stepping_sun);
    const auto countOff = [&](const Plan& plan) {
        const ReferenceScene scene{r.picture, r.camera, r.lights, plan, r.maps};
        const auto reference = referenceMask(scene, 0, options);
        std::size_t off = 0;
        for (std::size_t i = 0; i < reference.size(); ++i) {
            off += std::abs(std::to_integer<int>(r.masks[0][i]) - 255.0 * reference[i]) > 1.001 ? 1 : 0;
        }
        return off;
    };
    Plan other = r.plan;
    other.lights[0].steps.share += 0.1;
    EXPECT_GT(countOff(other), r.picture.depth.size() / 1000);
    other = r.plan;
    std::swap(other.views[0].place.part, other.views[1].place.part);
    EXPECT_GT(countOff(other), r.picture.depth.size() / 1000);
    expectSilence(gpu());
}

TEST(ParityOfBias, manualRulesAreThoseOfTheCpu)
{
    ShadowOptions options{.technique = kPlainTechnique};
    options.bias = {false, 0.02F, 1.5F, 0.0F, false};
    expectParity(renderParity(options), options, "bias_slope");
    options.bias = {false, 0.0F, 0.0F, 2.0F, false};
    expectParity(renderParity(options, ParityLights::sun_alone), options, "bias_normal");
    options.bias = {false, 0.01F, 0.0F, 0.0F, true};
    expectParity(renderParity(options), options, "bias_plane");
    expectSilence(gpu());
}

// The depth that the first surface along a texel's ray has.
double expectedDepth(const Scene& scene, const View& view, double x, double y)
{
    const glm::dmat4 world_from_clip = glm::inverse(view.projection.clip_from_world);
    const glm::dvec2 ndc((x - view.place.tile.x) / view.place.tile.width * 2.0 - 1.0,
                         (y - view.place.tile.y) / view.place.tile.height * 2.0 - 1.0);
    const glm::dvec4 near = world_from_clip * glm::dvec4(ndc, 0.0, 1.0);
    const glm::dvec4 far = world_from_clip * glm::dvec4(ndc, 1.0, 1.0);
    const glm::dvec3 a = glm::dvec3(near) / near.w;
    const glm::dvec3 b = glm::dvec3(far) / far.w;
    const auto hit = scene.trace(a, glm::normalize(b - a));
    if (!hit) {
        return 1.0;
    }
    const glm::dvec3 p = a + glm::normalize(b - a) * hit->t;
    return std::min(glm::dot(view.projection.metric.metric_ws, glm::dvec4(p, 1.0)), 1.0);
}

class MapNotes : public testing::TestWithParam<MapFormat> {};

TEST_P(MapNotes, areTheDepthMetric)
{
    ShadowOptions options{.technique = kPlainTechnique};
    options.technique.filter = Filter::hard;
    options.format = GetParam();
    const Rendered r = renderParity(options);
    const double tolerance = GetParam() == MapFormat::d16 ? 3e-5 : 1e-5;
    for (const View& view : r.plan.views) {
        const CpuMap& map = r.maps[view.place.tile.layer];
        std::size_t wrong = 0;
        for (std::uint32_t y = 0; y < view.place.tile.height; ++y) {
            for (std::uint32_t x = 0; x < view.place.tile.width; ++x) {
                const double expected =
                    expectedDepth(r.scene, view, view.place.tile.x + x + 0.5, view.place.tile.y + y + 0.5);
                const double stored = map.depth(view.place.tile.x + x, view.place.tile.y + y);
                wrong += std::abs(stored - expected) > tolerance ? 1 : 0;
            }
        }
        // Texels whose centre is within rounding of an edge may go either way.
        EXPECT_LE(wrong, view.place.tile.width * view.place.tile.height / 200) << "light " << view.light;
    }
    expectSilence(gpu());
}

INSTANTIATE_TEST_SUITE_P(Formats, MapNotes, testing::Values(MapFormat::d32f, MapFormat::d16, MapFormat::r32f));

} // namespace
} // namespace gnomon::test
