// SPDX-License-Identifier: Apache-2.0
#define GNOMON_REAL double
#include "moment_bench.h"

#include "moment_numbers.h"

#include <gnomon/lib/average.glsl>
#include <gnomon/lib/encoders.glsl>

#include <gtest/gtest.h>

#include <algorithm>

namespace gnomon::test {
namespace {

shared::MomentRule ruleOf(const ShadowOptions& filter)
{
    const MomentNumbers n = momentNumbers(filter);
    shared::MomentRule rule{};
    rule.flags = n.flags;
    rule.layers = n.layers;
    rule.exponent = n.exponent;
    rule.exponent_negative = n.exponent_negative;
    rule.moment_bias = n.moment_bias;
    return rule;
}

glm::dvec4 layerOf(const std::vector<pack::DepthLayer>& layers, std::size_t i)
{
    return i < layers.size() ? glm::dvec4(layers[i].near, layers[i].far, layers[i].begins, 0.0)
                             : glm::dvec4(0.0, 1.0, 2.0, 0.0);
}

} // namespace

Plan momentPlan(const Scene& scene)
{
    const std::vector<Light> lights{makeSun({0.8, -0.9, -0.35}), makeSpot({-6.0, 9.0, 5.0}, {0.0, 0.0, 0.0}, 0.6)};
    const std::vector<Tile> tiles{{0, 0, 0, 256, 256}, {0, 288, 64, 160, 96}};
    return makePlan(scene, lights, tiles, {512, 256, 1});
}

DrawnMaps drawMaps(const Scene& scene, const Plan& given, const ShadowOptions& filter)
{
    Plan plan = given;
    plan.options = planOptions(filter);
    vulkan::ShadowRenderer renderer(gpu().view(), {.frames_in_flight = 1});
    vulkan::CasterDrawerOptions drawer_options;
    drawer_options.frames_in_flight = 1;
    vulkan::CasterDrawer drawer(gpu().view(), drawer_options);
    const SceneMesh mesh = uploadMesh(gpu(), scene);
    drawer.setScene(mesh.parts, mesh.objects, mesh.batches);
    const auto transforms = scene.transforms();
    EXPECT_TRUE(renderer.prepare(plan, {8, 8}));
    gpu().run([&](VkCommandBuffer commands) {
        drawer.beginFrame(0, plan, mesh.geometry, transforms);
        renderer.recordMaps(commands, 0, plan, [&](const vulkan::MapPass& pass) { drawer.draw(pass); });
    });
    DrawnMaps drawn;
    const vulkan::ImageRef maps = renderer.maps();
    for (std::uint32_t layer = 0; layer < maps.layers; ++layer) {
        drawn.layers.push_back(readCpuMap(gpu(), maps, layer, levelsOf(filter, plan.pages[0])));
    }
    drawn.cost = renderer.filterCost(0);
    for (std::uint32_t view = 0; view < plan.views.size(); ++view) {
        drawn.depth_layers.push_back(renderer.depthLayers(plan, view));
    }
    expectSilence(gpu());
    return drawn;
}

CpuMap drawDepths(const Scene& scene, const Plan& plan)
{
    ShadowOptions filter{.technique = kPlainTechnique};
    filter.technique.filter = Filter::hard;
    filter.format = MapFormat::d32f;
    // A filterable map's depths are drawn at the working image's first texel, wherever its tile is; elsewhere an edge
    // may fall to the next texel. So each view is drawn in a layer of its own, at that place.
    Plan alone = plan;
    alone.pages[0].layers = static_cast<std::uint32_t>(plan.views.size());
    for (std::uint32_t v = 0; v < alone.views.size(); ++v) {
        alone.views[v].place.tile = {v, 0, 0, plan.views[v].place.tile.width, plan.views[v].place.tile.height};
    }
    const DrawnMaps drawn = drawMaps(scene, alone, filter);
    CpuMap depths = drawn.layers[0];
    std::fill(depths.levels[0].begin(), depths.levels[0].end(), glm::vec4(1.0F));
    for (std::uint32_t v = 0; v < plan.views.size(); ++v) {
        const Tile& tile = plan.views[v].place.tile;
        for (std::uint32_t y = 0; y < tile.height; ++y) {
            const auto row = drawn.layers[v].levels[0].begin() + std::size_t{y} * depths.width;
            std::copy_n(row, tile.width, depths.levels[0].begin() + std::size_t{tile.y + y} * depths.width + tile.x);
        }
    }
    return depths;
}

ShadowOptions momentFilter(Filter filter, MapFormat format)
{
    ShadowOptions options{.technique = kPlainTechnique};
    options.technique.filter = filter;
    options.format = format;
    options.moments.samples = 1;
    options.moments.blur = BlurKind::none;
    options.moments.sampling = MapSampling::bilinear;
    options.moments.layers = 2;
    options.moments.placement = LayerPlacement::uniform;
    return options;
}

glm::dvec4 encodeSamples(const ShadowOptions& filter, const View& view, const std::vector<pack::DepthLayer>& layers,
                         std::uint32_t image_layer, std::span<const double> depths)
{
    const shared::MomentRule rule = ruleOf(filter);
    const double near_over_far =
        view.projection.orthographic ? 1.0 : view.projection.metric.near_m / view.projection.metric.far_m;
    shared::EncodeInput input{};
    input.first = layerOf(layers, std::size_t{2} * image_layer);
    input.second = layerOf(layers, std::size_t{2} * image_layer + 1);
    std::vector<std::pair<glm::dvec4, double>> encoded;
    for (const double depth : depths) {
        input.depth = shared::momentDepth(depth, rule.flags, near_over_far);
        encoded.emplace_back(shared::encodeDepth(static_cast<int>(filter.technique.filter), input, rule),
                             1.0 / static_cast<double>(depths.size()));
    }
    return averageStored(filter, encoded);
}

// By the definition, not by the shaders' running sums.
glm::dvec4 averageStored(const ShadowOptions& filter, std::span<const std::pair<glm::dvec4, double>> weighted)
{
    const shared::MomentRule rule = ruleOf(filter);
    const int number = static_cast<int>(filter.technique.filter);
    const glm::dvec4 k = shared::averageExponents(number, rule);
    glm::dvec4 average(0.0);
    for (int c = 0; c < 4; ++c) {
        if (!shared::averagesLogarithms(number, rule.flags)) {
            for (const auto& [value, weight] : weighted) {
                average[c] += weight * value[c];
            }
            continue;
        }
        double largest = -1e300;
        for (const auto& [value, weight] : weighted) {
            largest = std::max(largest, k[c] * value[c]);
        }
        double sum = 0.0;
        for (const auto& [value, weight] : weighted) {
            sum += weight * std::exp(k[c] * value[c] - largest);
        }
        average[c] = (largest + std::log(sum)) / k[c];
    }
    return average;
}

double storageError(MapFormat format)
{
    switch (format) {
    case MapFormat::rg16:
    case MapFormat::rgba16:
        return 1.01 / 65535.0;
    case MapFormat::r16f:
    case MapFormat::rg16f:
    case MapFormat::rgba16f:
        return 1.0 / 1024.0; // of the value
    default:
        return 2e-6;
    }
}

int channelsOf(MapFormat format)
{
    switch (format) {
    case MapFormat::rg16:
    case MapFormat::rg16f:
    case MapFormat::rg32f:
        return 2;
    case MapFormat::rgba16:
    case MapFormat::rgba16f:
    case MapFormat::rgba32f:
        return 4;
    default:
        return 1;
    }
}

} // namespace gnomon::test
