// SPDX-License-Identifier: Apache-2.0
#include <gnomon/pack/compact_mask.h>

#include "reach_cells.h"

#include <gnomon/error.h>
#include <gnomon/pack/mask_draws.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <bit>
#include <cmath>

namespace gnomon::pack {
namespace {

// The inputs of a light's importance.
struct Source {
    glm::dvec3 position_ws{0.0};
    double brightness = 0.0;
    double reach_m = 0.0; // 0: a directional light, which is the same everywhere
};

double positive(double value)
{
    return value > 0.0 && std::isfinite(value) ? value : 0.0;
}

Source sourceOf(const Light& light, const Aabb& scene_ws)
{
    Source source;
    source.brightness = positive(light.brightness);
    if (light.type != LightType::directional) {
        source.position_ws = light.position_ws;
        const double range_m = positive(light.range_m);
        const double scene_m = scene_ws.empty() ? 1.0 : glm::length(glm::dvec3(scene_ws.extent()));
        source.reach_m = range_m > 0.0 ? range_m : std::max(positive(scene_m), 1e-6);
    }
    return source;
}

// Illuminance of a surface that faces the light, `distance2` square metres away; KHR_lights_punctual, 2018.
double importanceOf(const Source& source, double distance2)
{
    if (source.reach_m == 0.0) {
        return source.brightness;
    }
    const double reach2 = source.reach_m * source.reach_m;
    const double q = distance2 / reach2;
    // A corner of the tile may be nearer than its middle: nobody counts for nothing at all.
    const double window = std::max(1.0 - q * q, 0.01);
    return positive(source.brightness * window / std::max(distance2, reach2 / 64.0));
}

// A line of sight: a point on it and a unit vector along it, 0 where there is none.
struct SightLine {
    glm::dvec3 from_ws{0.0};
    glm::dvec3 way{0.0};
};
// Squared distance of a point to a line of sight, which has no part behind the eye.
double distance2(const SightLine& line, const glm::dvec3& point_ws)
{
    const glm::dvec3 to = point_ws - line.from_ws;
    const glm::dvec3 beside = to - line.way * positive(glm::dot(to, line.way));
    return positive(glm::dot(beside, beside));
}

class Sights {
public:
    Sights(const Camera& camera, glm::uvec2 size_px)
        : eye_ws_(camera.eye_ws), world_from_clip_(glm::inverse(clipFromWorld(camera))), size_px_(size_px),
          parallel_(glm::dvec3(glm::row(world_from_clip_, 3)) == glm::dvec3(0.0)), near_(camera.reversed_z ? 1.0 : 0.0)
    {
    }
    // Through a point of the picture.
    [[nodiscard]] SightLine through(const glm::dvec2& pixel) const
    {
        const glm::dvec2 ndc = pixel / size_px_ * 2.0 - 1.0;
        const glm::dvec3 from = parallel_ ? pointAt(ndc, near_) : eye_ws_;
        const glm::dvec3 way = pointAt(ndc, parallel_ ? 1.0 - near_ : 0.5) - from;
        const double length = positive(glm::length(way));
        return {from, length > 0.0 ? way / length : glm::dvec3(0.0)};
    }

private:
    [[nodiscard]] glm::dvec3 pointAt(const glm::dvec2& ndc, double depth) const
    {
        const glm::dvec4 h = world_from_clip_ * glm::dvec4(ndc, depth, 1.0);
        return glm::dvec3(h) / h.w;
    }

    glm::dvec3 eye_ws_;
    glm::dmat4 world_from_clip_;
    glm::dvec2 size_px_;
    bool parallel_; // orthographic
    double near_;   // depth at the near plane
};

// A tile's lights with maps, whose weights are their importances so far.
void giveChannels(std::span<TileLight> lights, std::uint32_t channels)
{
    const auto more = [](const TileLight& a, const TileLight& b) {
        return a.weight != b.weight ? a.weight > b.weight : a.light < b.light;
    };
    const bool shares = lights.size() > channels;
    const std::size_t own = shares ? channels - 1U : lights.size();
    std::partial_sort(lights.begin(), lights.begin() + static_cast<std::ptrdiff_t>(own), lights.end(), more);
    for (std::size_t i = 0; i < own; ++i) {
        lights[i].channel = static_cast<std::uint32_t>(i);
        lights[i].weight = 1.0F;
    }
    const std::span<TileLight> rest = lights.subspan(own);
    double sum = 0.0;
    for (const TileLight& light : rest) {
        sum += light.weight;
    }
    for (TileLight& light : rest) {
        light.channel = channels - 1;
        light.weight = static_cast<float>(sum > 0.0 ? light.weight / sum : 1.0 / static_cast<double>(rest.size()));
    }
}

void check(const Plan& plan, const CompactMaskRule& rule)
{
    constexpr const char* kTried = "list the lights of a compact mask";
    if (const char* const wrong = wrongOf(rule)) {
        throw Error(kTried, wrong);
    }
    if (plan.made_for.lights.size() != plan.lights.size()) {
        throw Error(kTried, "the plan does not say what they are (Plan::made_for)");
    }
    if (plan.lights.size() > kMostTileLights) {
        throw Error(kTried, "there are more than 65535 lights");
    }
}

} // namespace

const char* wrongOf(const CompactMaskRule& rule)
{
    if (rule.channels != 0 && rule.channels != 4 && rule.channels != 8) {
        return "a compact mask has 4 or 8 channels";
    }
    return rule.channels == 0 || rule.side_px == 16 || rule.side_px == 32 ? nullptr
                                                                          : "a tile has 16 or 32 pixels on a side";
}

void listCompactMask(const Plan& plan, const CompactMaskRule& rule, glm::uvec2 size_px, LightLists& lists,
                     CompactMask& out)
{
    check(plan, rule);
    const PlannedFrame& from = plan.made_for;
    listLights(from.lights, from.camera, from.scene_ws, size_px, rule.channels == 0 ? 0 : rule.side_px, lists);
    out.rule = rule;
    out.tiles = lists.tiles;
    out.first = lists.first;
    out.masked.assign(out.first.size() - 1, 0);
    out.lights.resize(lists.lights.size());
    const Sights sights(from.camera, size_px);
    for (std::size_t tile = 0; tile < out.masked.size(); ++tile) {
        const std::size_t row = tile / out.tiles.x;
        const glm::dvec2 place(static_cast<double>(tile % out.tiles.x), static_cast<double>(row));
        const SightLine line = sights.through((place + 0.5) * static_cast<double>(rule.side_px));
        std::uint32_t begin = out.first[tile]; // where the next light with a map goes
        std::uint32_t end = out.first[tile + 1];
        for (std::uint32_t i = out.first[tile]; i < out.first[tile + 1]; ++i) {
            const std::uint32_t light = lists.lights[i];
            if (!plan.lights[light].outcome.hasMap()) {
                out.lights[--end] = {light, kNoMaskChannel, 1.0F};
                continue;
            }
            const Source source = sourceOf(from.lights[light], from.scene_ws);
            const double importance = importanceOf(source, distance2(line, source.position_ws));
            out.lights[begin++] = {light, 0, static_cast<float>(std::min(importance, 1e30))};
        }
        out.masked[tile] = begin - out.first[tile];
        giveChannels(std::span(out.lights).subspan(out.first[tile], out.masked[tile]), rule.channels);
    }
}

void listCompactMaskDraws(const Plan& plan, const CompactMaskRule& rule, glm::uvec2 size_px, std::vector<MaskDraw>& out)
{
    out.clear();
    for (std::uint32_t options = 0; options < plan.options->size(); ++options) {
        MaskDraw draw;
        draw.options = draw.channels = options;
        draw.pixels = {0, 0, size_px.x, size_px.y};
        bool has_lights = false;
        for (const LightPlan& light : plan.lights) {
            const bool is_own = light.options == options && light.outcome.hasMap();
            has_lights = has_lights || is_own;
            const auto views = std::span(plan.views).subspan(light.first_view, is_own ? light.view_count : 0);
            draw.orthographic = draw.orthographic && std::ranges::all_of(views, [](const View& view) {
                                    return view.projection.orthographic;
                                });
        }
        for (std::uint32_t layer = 0; has_lights && layer < rule.channels / shared::kLightsPerLayer; ++layer) {
            draw.layer = draw.first_light = layer;
            out.push_back(draw);
        }
    }
    for (MaskDraw& draw : out) {
        draw.shares = out.size() > rule.channels / shared::kLightsPerLayer;
    }
}

std::size_t maskTileWords(const CompactMask& mask)
{
    return 1 + mask.masked.size() + mask.lights.size();
}

void fillMaskTiles(const CompactMask& mask, std::span<glm::uvec2> words)
{
    if (words.size() < maskTileWords(mask)) {
        throw Error("describe a compact mask's tiles", "there is no room for them", "give room for maskTileWords()");
    }
    const auto first_light = static_cast<std::uint32_t>(1 + mask.masked.size());
    words[0] = {mask.rule.side_px, mask.tiles.x};
    for (std::size_t i = 0; i < mask.masked.size(); ++i) {
        const std::uint32_t count = mask.first[i + 1] - mask.first[i];
        words[1 + i] = {first_light + mask.first[i], mask.masked[i] | count << 16U};
    }
    for (std::size_t i = 0; i < mask.lights.size(); ++i) {
        const TileLight& light = mask.lights[i];
        words[first_light + i] = {light.light | light.channel << 24U, std::bit_cast<std::uint32_t>(light.weight)};
    }
}

} // namespace gnomon::pack
