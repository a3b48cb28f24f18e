// SPDX-License-Identifier: Apache-2.0
#include "parity.h"

#include "read_error.h"

#include "fixture.h"
#include "moment_bench.h"
#include "moment_numbers.h"
#include "write_pgm.h"

#include <gnomon/object_ids.h>

#include <glm/gtc/matrix_access.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gnomon::test {
namespace {

using vulkan::CasterDrawer;
using vulkan::MapPass;
using vulkan::ShadowRenderer;

void readBack(const ShadowRenderer& renderer, const ShadowOptions& options, Rendered& r)
{
    const auto maps = renderer.maps();
    for (std::uint32_t layer = 0; layer < maps.layers; ++layer) {
        r.maps.push_back(readCpuMap(gpu(), maps, layer, levelsOf(options, r.plan.pages[0])));
    }
    for (const LightPlan& light : r.plan.lights) {
        r.masks.push_back(readMaskChannel(gpu(), renderer.mask(), light));
    }
    for (std::uint32_t view = 0; view < r.plan.views.size(); ++view) {
        r.layers.push_back(renderer.depthLayers(r.plan, view));
    }
}

bool hasTwoMapsInATexel(const ShadowOptions& options)
{
    return !isFilterable(options.technique.filter) && resolvedOrThrow(options).paired_maps();
}

/// A sun whose maps are of before and after it.
void setSteppingSun(bool band, bool share_texels, Rendered& r)
{
    const glm::dvec3 earlier = glm::normalize(glm::dvec3(0.8, -0.9, -0.35));
    const glm::dvec3 later = glm::normalize(glm::dvec3(0.65, -0.9, -0.55));
    r.lights = {makeSun(earlier + later)};
    r.plan = makePlan(r.scene, r.lights, std::vector<Tile>{{0, 0, 0, 512, 512}}, {512, 512, share_texels ? 1U : 2U});
    r.plan.views.clear();
    for (const SunPosition position : {SunPosition::earlier, SunPosition::later}) {
        const bool second = position == SunPosition::later;
        View view = makeView(r.scene, makeSun(second ? later : earlier), 0,
                             {second && !share_texels ? 1U : 0U, 0, 0, 512, 512});
        view.serves.sun = position;
        if (share_texels) {
            view.place.part = second ? TexelPart::second : TexelPart::first;
        }
        view.casters.count = static_cast<std::uint32_t>(r.plan.casters.size());
        r.plan.views.push_back(view);
    }
    LightPlan& light = r.plan.lights[0];
    light.view_count = 2;
    light.steps.stepping = true;
    light.steps.paired = true;
    light.steps.earlier_ws = earlier;
    light.steps.later_ws = later;
    light.steps.share = 0.4;
    light.steps.smooth = band;
    light.steps.band = band ? 0.5 : 0.0;
    light.steps.edge = band ? 0.7 : 0.0;
}

/// A lamp between the boxes. Its views overlap by some degrees, as those do that have room for a filter's kernel.
void setPoint(Rendered& r)
{
    constexpr std::uint32_t kSide = 256;
    Light lamp = makeSpot({-2.5, 4.0, 2.0}, {0.0, 0.0, 0.0}, 0.85);
    lamp.type = LightType::point;
    lamp.radius_m = 0.1;
    r.lights = {lamp};
    r.plan = makePlan(r.scene, r.lights, std::vector<Tile>{{0, 0, 0, kSide, kSide}}, {4 * kSide, 2 * kSide, 1});
    r.plan.views.clear();
    for (int face = 0; face < 6; ++face) {
        glm::dmat3 axes(0.0);
        for (int i = 0; i < 3; ++i) {
            axes[i][(face / 2 + i) % 3] = i == 0 && face % 2 == 1 ? -1.0 : 1.0;
        }
        Light toward = lamp;
        toward.type = LightType::spot;
        toward.direction_ws = axes[0];
        const auto at = static_cast<std::uint32_t>(face);
        View view = makeView(r.scene, toward, 0, {0, at % 4 * kSide, at / 4 * kSide, kSide, kSide});
        const auto row = [&](int i) {
            return glm::dvec4(axes[i], -glm::dot(axes[i], lamp.position_ws));
        };
        view.serves.sector = {row(1), row(2), row(0)};
        view.casters.count = static_cast<std::uint32_t>(r.plan.casters.size());
        r.plan.views.push_back(view);
    }
    r.plan.lights[0].view_count = 6;
}

/// The same lamp, with the half spaces above it and below.
void setParaboloid(Rendered& r)
{
    constexpr std::uint32_t kSide = 512;
    constexpr double kNear_m = 0.5;
    constexpr double kFar_m = 45.0;
    setPoint(r);
    const glm::dvec3 lamp = r.lights[0].position_ws;
    std::vector<View> views;
    for (const double sign : {1.0, -1.0}) {
        const std::uint32_t at = views.empty() ? 0 : kSide;
        View view;
        view.place.tile = {0, at, 0, kSide, kSide};
        view.serves.sector.w = {0.0, sign, 0.0, -sign * lamp.y};
        view.projection.parallel = false;
        view.projection.orthographic = false;
        view.projection.clamp_near = false;
        view.projection.paraboloid = true;
        view.projection.light_place_ws = lamp;
        view.projection.texel_m = 4.0 / kSide;
        view.projection.metric = {{0.0, 0.0, 0.0, -kNear_m / (kFar_m - kNear_m)}, kNear_m, kFar_m};
        const glm::dvec3 axes[] = {{-sign, 0.0, 0.0}, {0.0, 0.0, 1.0}, {0.0, sign, 0.0}};
        for (int i = 0; i < 3; ++i) {
            view.projection.clip_from_world = glm::row(
                view.projection.clip_from_world, i, glm::dvec4(axes[i], -glm::dot(axes[i], lamp)) / (kFar_m - kNear_m));
        }
        view.projection.clip_from_world[3][3] = kSide / (kSide - 2.0 * 8.0); // a border of 8 texels
        view.casters.count = static_cast<std::uint32_t>(r.plan.casters.size());
        views.push_back(view);
    }
    r.plan.views = views;
    r.plan.pages[0] = {2 * kSide, kSide, 1};
    r.plan.lights[0].view_count = 2;
}

void setLights(ParityLights lights, const ShadowOptions& options, Rendered& r)
{
    if (lights == ParityLights::stepping_sun || lights == ParityLights::stepping_band) {
        setSteppingSun(lights == ParityLights::stepping_band, hasTwoMapsInATexel(options), r);
        return;
    }
    if (lights == ParityLights::point) {
        setPoint(r);
        return;
    }
    if (lights == ParityLights::paraboloid) {
        setParaboloid(r);
        return;
    }
    Light sun = makeSun({0.8, -0.9, -0.35});
    Light spot = makeSpot({-6.0, 9.0, 5.0}, {0.0, 0.0, 0.0}, 0.6);
    sun.angular_diameter_rad = 0.06; // of use to filters that know how large the light is
    spot.radius_m = 0.3;
    std::vector<Tile> tiles{{0, 0, 0, 512, 512}, {1, 128, 64, 384, 384}};
    MapPages atlas{512, 512, 2};
    r.lights = {sun, spot};
    if (lights == ParityLights::sun_alone) {
        r.lights.pop_back();
    } else if (lights == ParityLights::one_layer) {
        r.lights.push_back(makeSun({-0.5, -0.9, 0.4}));
        tiles = {{0, 0, 0, 256, 256}, {0, 256, 0, 256, 256}, {0, 256, 256, 128, 128}};
        atlas.layers = 1;
    }
    r.plan = makePlan(r.scene, r.lights, tiles, atlas);
}

/// As a planner gives them; the ground does not cast.
void giveIds(const ShadowOptions& options, Rendered& r)
{
    ObjectSet objects;
    const auto half = static_cast<float>(r.scene.ground_half);
    objects.add({{-half, 0.0F, -half}, {half, 0.0F, half}}, {false, true, false});
    for (const Box& box : r.scene.boxes) {
        const double c = std::abs(std::cos(box.angle));
        const double s = std::abs(std::sin(box.angle));
        const glm::dvec3 reach(c * box.half.x + s * box.half.z, box.half.y, s * box.half.x + c * box.half.z);
        objects.add({glm::vec3(box.centre - reach), glm::vec3(box.centre + reach)}, {.pieces = 6});
    }
    const std::span<const Aabb> bounds = objects.allBounds();
    r.plan.object_bounds.assign(bounds.begin(), bounds.end());
    for (std::size_t i = 0; i < r.lights.size(); ++i) {
        r.plan.lights[i].first_object_id = static_cast<std::uint32_t>(r.plan.object_ids.size());
        const IdHandout handout{idsOf(formatOf(options)), options.ids.of,
                                idSharingOf(options.technique.filter, options.ids.of)};
        IdScratch scratch;
        handOutIds(r.lights[i], objects, handout, scratch, r.plan.object_ids);
    }
}

std::vector<std::byte> toBytes(const std::vector<double>& mask)
{
    std::vector<std::byte> bytes;
    bytes.reserve(mask.size());
    for (const double v : mask) {
        bytes.push_back(static_cast<std::byte>(std::lround(255.0 * v)));
    }
    return bytes;
}

} // namespace

Rendered renderParity(const ShadowOptions& options, ParityLights lights)
{
    Rendered r;
    setLights(lights, options, r);
    r.plan.options = planOptions(options);
    constexpr std::uint32_t kFrames = 3;
    r.camera = makeCamera({9.0, 6.0, 11.0}, {0.0, 0.5, 0.0}, double(kParityScreen.width) / kParityScreen.height);
    r.plan.made_for.camera = r.camera;
    r.plan.made_for.lights = r.lights;
    r.picture = tracePicture(r.scene, r.camera, kParityScreen);
    vulkan::MaskInputs inputs = uploadPicture(gpu(), r.picture);
    if (filterTraits(options.technique.filter)->ids) {
        giveIds(options, r);
        std::vector<std::uint32_t> numbers = r.picture.object_plus_one;
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            numbers[i] = numbers[i] == 0 ? 0 : pixelObject(numbers[i] - 1, r.picture.piece[i]);
        }
        inputs.object_id = gpu().makeImage(VK_FORMAT_R32_UINT, kParityScreen, std::as_bytes(std::span(numbers))).view;
        inputs.object_pieces = true;
    }

    vulkan::ShadowRendererOptions renderer_options;
    renderer_options.frames_in_flight = kFrames;
    vulkan::FinDrawer fins(gpu().view(), {.frames_in_flight = kFrames});
    renderer_options.classics = vulkan::makeClassics({.fins = [&fins](const vulkan::FinPass& pass) {
        (void)fins.draw(pass);
    }});
    ShadowRenderer renderer(gpu().view(), renderer_options);
    vulkan::CasterDrawerOptions drawer_options;
    drawer_options.frames_in_flight = kFrames;
    drawer_options.vertices.piece = kPieceOfVertex;
    CasterDrawer drawer(gpu().view(), drawer_options);
    SceneMesh mesh = uploadMesh(gpu(), r.scene);
    if (options.ids.of == IdOf::face) {
        partSides(gpu(), mesh);
    }
    drawer.setScene(mesh.parts, mesh.objects, mesh.batches);
    fins.setScene(mesh.outlines);
    const auto transforms = r.scene.transforms();
    EXPECT_TRUE(renderer.prepare(r.plan, kParityScreen));
    EXPECT_FALSE(renderer.prepare(r.plan, kParityScreen));
    // All frames in one submission: the layer checks the order of one frame's reads and the next one's writes.
    gpu().run([&](VkCommandBuffer commands) {
        for (std::uint32_t slot = 0; slot < kFrames; ++slot) {
            drawer.beginFrame(slot, r.plan, mesh.geometry, transforms);
            fins.beginFrame(slot, mesh.edges, transforms);
            renderer.recordMaps(commands, slot, r.plan, drawer.callback());
            renderer.recordMask(commands, slot, r.plan, inputs);
        }
    });
    readBack(renderer, options, r);
    return r;
}

namespace {

// The error of a read in single precision. Three interpolations in a row (x, y, level) and a sum round seven times. The
// filter's first steps on the moments round once or twice more. Each time is half a step, 2^-24 of the value.
// Differences of moments lose digits, so that this can be visible.
constexpr double kRoundings = 8.0 / 16777216.0;

/// The largest error of a read of a filterable map; nothing where the device reads its 16 bits exactly.
ReadError errorOf(MapFormat format)
{
    switch (format) {
    case MapFormat::r32f:
    case MapFormat::rg32f:
    case MapFormat::rgba32f:
        return {0.0, kRoundings};
    case MapFormat::r16f:
    case MapFormat::rg16f:
    case MapFormat::rgba16f:
        return readErrorOf(VK_FORMAT_R16G16B16A16_SFLOAT);
    default:
        return readErrorOf(VK_FORMAT_R16G16B16A16_UNORM);
    }
}

/// The least and the most that the reference can become when each channel is off by that, up or down.
struct Bounds {
    std::vector<double> low;
    std::vector<double> high;
};
Bounds boundsOf(const Rendered& r, std::uint32_t light, const ShadowOptions& options,
                const std::vector<double>& reference)
{
    Bounds bounds{reference, reference};
    if (!isFilterable(options.technique.filter)) {
        return bounds;
    }
    const ReadError error = errorOf(formatOf(options));
    if (error.absolute == 0.0 && error.relative == 0.0) {
        return bounds;
    }
    const int channels = channelsOf(formatOf(options));
    for (int signs = 0; signs < 1 << channels; ++signs) {
        glm::dvec4 side(0.0);
        for (int c = 0; c < channels; ++c) {
            side[c] = (signs >> c & 1) != 0 ? 1.0 : -1.0;
        }
        const ReferenceScene scene{
            r.picture, r.camera, r.lights, r.plan, r.maps, side * error.absolute, side * error.relative, &r.scene};
        const auto mask = referenceMask(scene, light, options, r.layers[r.plan.lights[light].first_view]);
        for (std::size_t i = 0; i < mask.size(); ++i) {
            bounds.low[i] = std::min(bounds.low[i], mask[i]);
            bounds.high[i] = std::max(bounds.high[i], mask[i]);
        }
    }
    return bounds;
}

} // namespace

ParityFigures expectParity(const Rendered& r, const ShadowOptions& options, const std::string& name, double steps)
{
    ParityFigures worst;
    for (std::uint32_t light = 0; light < r.lights.size(); ++light) {
        const ReferenceScene scene{r.picture, r.camera, r.lights, r.plan, r.maps, {}, {}, &r.scene};
        const auto reference = referenceMask(scene, light, options, r.layers[r.plan.lights[light].first_view]);
        const Bounds bounds = boundsOf(r, light, options, reference);
        ParityFigures figures;
        figures.pixels = reference.size();
        std::size_t dark = 0;
        for (std::size_t i = 0; i < reference.size(); ++i) {
            const double mask = std::to_integer<int>(r.masks[light][i]);
            const double off = std::max(255.0 * bounds.low[i] - mask, mask - 255.0 * bounds.high[i]);
            figures.different += off > steps ? 1 : 0;
            figures.worst = std::max(figures.worst, off);
            figures.loose += 255.0 * (bounds.high[i] - bounds.low[i]) > 1.0 ? 1 : 0;
            dark += reference[i] < 0.5 ? 1 : 0;
        }
        EXPECT_LE(figures.different, reference.size() / 1000) << "light " << light << ", worst " << figures.worst;
        EXPECT_LE(figures.loose, reference.size() / 8) << "else this says too little";
        EXPECT_GT(dark, reference.size() / 100) << "the scene must have shadows for this to mean anything";
        EXPECT_LT(dark, reference.size() * 9 / 10);
        writePgm(name + "_light" + std::to_string(light), r.masks[light], kParityScreen);
        writePgm(name + "_light" + std::to_string(light) + "_cpu", toBytes(reference), kParityScreen);
        if (figures.different >= worst.different) {
            figures.worst = std::max(figures.worst, worst.worst);
            worst = figures;
        }
    }
    return worst;
}

} // namespace gnomon::test
