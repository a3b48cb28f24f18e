// SPDX-License-Identifier: Apache-2.0
// The GPU's maps and masks against closed forms and against the same shader files run on the CPU.
#include "fixture.h"
#include "reference.h"
#include "write_pgm.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::test {
namespace {

using vulkan::CasterDrawer;
using vulkan::FilterOptions;
using vulkan::MapPass;
using vulkan::ShadowRenderer;

constexpr VkExtent2D kScreen{320, 200};

struct Case {
    const char* name;
    Filter filter;
    PcfKernel kernel;
    MapFormat format;
};

std::ostream& operator<<(std::ostream& out, const Case& c)
{
    return out << c.name;
}

// One frame of a scene under a sun and a spot, on the GPU.
struct Rendered {
    Scene scene = makeScene();
    std::vector<Light> lights;
    Plan plan;
    Camera camera;
    Picture picture;
    std::vector<CpuMap> maps;                  // by layer
    std::vector<std::vector<std::byte>> masks; // by light, one byte a pixel
};

void readBack(Gpu& gpu, const ShadowRenderer& renderer, Rendered& r)
{
    const auto maps = renderer.maps();
    for (std::uint32_t layer = 0; layer < maps.layers; ++layer) {
        r.maps.push_back(readCpuMap(gpu, maps, layer));
    }
    for (const LightPlan& light : r.plan.lights) {
        r.masks.push_back(readMaskChannel(gpu, renderer.mask(), light));
    }
}

Rendered render(Gpu& gpu, const FilterOptions& options, bool sun_alone = false)
{
    Rendered r;
    r.lights = {makeSun({0.8, -0.9, -0.35}), makeSpot({-6.0, 9.0, 5.0}, {0.0, 0.0, 0.0}, 0.6)};
    if (sun_alone) {
        r.lights.pop_back(); // then the mask is drawn by pipelines for orthographic views
    }
    // The sun's tile and the spot's share the second layer with room to spare, so tile offsets count.
    const Tile tiles[] = {{0, 0, 0, 512, 512}, {1, 128, 64, 384, 384}};
    r.plan = makePlan(r.scene, r.lights, tiles, {512, 512, 2});
    constexpr int frames = 3;
    Frame frame;
    frame.camera = makeCamera({9.0, 6.0, 11.0}, {0.0, 0.5, 0.0}, double(kScreen.width) / kScreen.height);
    frame.lights = r.lights;
    r.camera = frame.camera;
    r.picture = tracePicture(r.scene, frame.camera, kScreen);
    const vulkan::MaskInputs inputs = uploadPicture(gpu, r.picture);

    vulkan::ShadowRendererOptions renderer_options;
    renderer_options.filter = options;
    renderer_options.frames_in_flight = static_cast<std::uint32_t>(frames);
    ShadowRenderer renderer(gpu.view(), renderer_options);
    vulkan::CasterDrawerOptions drawer_options;
    drawer_options.orthographic = renderer.mapFormats(true);
    drawer_options.perspective = renderer.mapFormats(false);
    drawer_options.frames_in_flight = static_cast<std::uint32_t>(frames);
    CasterDrawer drawer(gpu.view(), drawer_options);
    const SceneMesh mesh = uploadMesh(gpu, r.scene);
    drawer.setScene(mesh.parts, mesh.objects, mesh.batches);
    const auto transforms = r.scene.transforms();
    EXPECT_TRUE(renderer.prepare(r.plan, kScreen));
    EXPECT_FALSE(renderer.prepare(r.plan, kScreen));
    // All frames in one submission: the layer checks the order of one frame's reads and the next one's writes.
    gpu.run([&](VkCommandBuffer commands) {
        for (std::uint32_t slot = 0; slot < renderer_options.frames_in_flight; ++slot) {
            drawer.beginFrame(slot, r.plan, mesh.geometry, transforms);
            renderer.recordMaps(commands, slot, frame, r.plan, [&](const MapPass& pass) { drawer.draw(pass); });
            renderer.recordMask(commands, slot, frame, r.plan, inputs);
        }
    });
    readBack(gpu, renderer, r);
    return r;
}

void expectParity(const Rendered& r, const FilterOptions& options, const std::string& name)
{
    for (std::uint32_t light = 0; light < r.lights.size(); ++light) {
        const ReferenceScene scene{r.picture, r.camera, r.lights, r.plan, r.maps};
        const auto reference = referenceMask(scene, light, options);
        std::size_t different = 0;
        std::size_t dark = 0;
        for (std::size_t i = 0; i < reference.size(); ++i) {
            const double v = std::to_integer<int>(r.masks[light][i]) / 255.0;
            different += std::abs(v - reference[i]) > 1.001 / 255.0 ? 1 : 0;
            dark += reference[i] < 0.5 ? 1 : 0;
        }
        EXPECT_LE(different, reference.size() / 1000) << "light " << light;
        EXPECT_GT(dark, reference.size() / 100) << "the scene must have shadows for this to mean anything";
        EXPECT_LT(dark, reference.size() * 9 / 10);
        writePgm(name + "_light" + std::to_string(light), r.masks[light], kScreen);
    }
}

class Parity : public testing::TestWithParam<Case> {};

TEST_P(Parity, maskIsThatOfTheCpu)
{
    FilterOptions options;
    options.filter = GetParam().filter;
    options.pcf_kernel = GetParam().kernel;
    options.format = GetParam().format;
    expectParity(render(gpu(), options), options, GetParam().name);
    expectParity(render(gpu(), options, true), options, std::string(GetParam().name) + "_alone");
    expectSilence(gpu());
}

INSTANTIATE_TEST_SUITE_P(Filters, Parity,
                         testing::Values(Case{"hard_d32f", Filter::hard, PcfKernel::bilinear_2x2, MapFormat::d32f},
                                         Case{"hard_d16", Filter::hard, PcfKernel::bilinear_2x2, MapFormat::d16},
                                         Case{"hard_r32f", Filter::hard, PcfKernel::bilinear_2x2, MapFormat::r32f},
                                         Case{"pcf_2x2_d32f", Filter::pcf, PcfKernel::bilinear_2x2, MapFormat::d32f},
                                         Case{"pcf_3x3_d32f", Filter::pcf, PcfKernel::gaussian_3x3, MapFormat::d32f},
                                         Case{"pcf_3x3_d16", Filter::pcf, PcfKernel::gaussian_3x3, MapFormat::d16},
                                         Case{"pcf_3x3_r32f", Filter::pcf, PcfKernel::gaussian_3x3, MapFormat::r32f},
                                         Case{"pcf_5x5_d32f", Filter::pcf, PcfKernel::gaussian_5x5, MapFormat::d32f},
                                         Case{"pcf_7x7_d32f", Filter::pcf, PcfKernel::gaussian_7x7, MapFormat::d32f},
                                         Case{"pcf_poisson_d32f", Filter::pcf, PcfKernel::poisson, MapFormat::d32f},
                                         Case{"pcf_vogel_d32f", Filter::pcf, PcfKernel::vogel, MapFormat::d32f}),
                         [](const auto& test_case) { return std::string(test_case.param.name); });

TEST(ParityOfBias, manualRulesAreThoseOfTheCpu)
{
    FilterOptions options;
    options.bias = {false, 0.02F, 1.5F, 0.0F, false};
    expectParity(render(gpu(), options), options, "bias_slope");
    options.bias = {false, 0.0F, 0.0F, 2.0F, false};
    expectParity(render(gpu(), options, true), options, "bias_normal");
    options.bias = {false, 0.01F, 0.0F, 0.0F, true};
    expectParity(render(gpu(), options), options, "bias_plane");
    expectSilence(gpu());
}

// The depth that the first surface along a texel's ray has.
double expectedDepth(const Scene& scene, const View& view, double x, double y)
{
    const glm::dmat4 world_from_clip = glm::inverse(view.clip_from_world);
    const glm::dvec2 ndc((x - view.tile.x) / view.tile.width * 2.0 - 1.0,
                         (y - view.tile.y) / view.tile.height * 2.0 - 1.0);
    const glm::dvec4 near = world_from_clip * glm::dvec4(ndc, 0.0, 1.0);
    const glm::dvec4 far = world_from_clip * glm::dvec4(ndc, 1.0, 1.0);
    const glm::dvec3 a = glm::dvec3(near) / near.w;
    const glm::dvec3 b = glm::dvec3(far) / far.w;
    const auto hit = scene.trace(a, glm::normalize(b - a));
    if (!hit) {
        return 1.0;
    }
    const glm::dvec3 p = a + glm::normalize(b - a) * hit->t;
    return std::min(glm::dot(view.metric.metric_ws, glm::dvec4(p, 1.0)), 1.0);
}

class MapContents : public testing::TestWithParam<MapFormat> {};

TEST_P(MapContents, areTheDepthMetric)
{
    FilterOptions options;
    options.filter = Filter::hard;
    options.format = GetParam();
    const Rendered r = render(gpu(), options);
    const double tolerance = GetParam() == MapFormat::d16 ? 3e-5 : 1e-5;
    for (const View& view : r.plan.views) {
        const CpuMap& map = r.maps[view.tile.layer];
        std::size_t wrong = 0;
        for (std::uint32_t y = 0; y < view.tile.height; ++y) {
            for (std::uint32_t x = 0; x < view.tile.width; ++x) {
                const double expected = expectedDepth(r.scene, view, view.tile.x + x + 0.5, view.tile.y + y + 0.5);
                const double stored = map.depth(view.tile.x + x, view.tile.y + y);
                wrong += std::abs(stored - expected) > tolerance ? 1 : 0;
            }
        }
        // Texels whose centre is within rounding of an edge may go either way.
        EXPECT_LE(wrong, view.tile.width * view.tile.height / 200) << "light " << view.light;
    }
    expectSilence(gpu());
}

INSTANTIATE_TEST_SUITE_P(Formats, MapContents, testing::Values(MapFormat::d32f, MapFormat::d16, MapFormat::r32f));

} // namespace
} // namespace gnomon::test
