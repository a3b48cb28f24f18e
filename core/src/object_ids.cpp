// SPDX-License-Identifier: Apache-2.0
// Based on: T. Forsyth, "Extremely Practical Shadows", GDC 2006; see the header for the departures.
#include <gnomon/object_ids.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <utility>

namespace gnomon {
namespace {

/// How far the farthest point of a box is: along a sun from any plane across it, from a lamp.
double farthestOf(const Light& light, const glm::dvec3& along_ws, const Aabb& box)
{
    const glm::dvec3 low(box.min);
    const glm::dvec3 high(box.max);
    if (light.type == LightType::directional) {
        return glm::dot(along_ws, 0.5 * (low + high)) + glm::dot(glm::abs(along_ws), 0.5 * (high - low));
    }
    return glm::length(glm::max(glm::abs(low - light.position_ws), glm::abs(high - light.position_ws)));
}

/// Of a box in a map, in its clip space; everything where the box is partly behind a lamp.
struct MapBox {
    glm::dvec2 low{-1.0};
    glm::dvec2 high{1.0};

    [[nodiscard]] bool touches(const MapBox& other) const
    {
        return low.x < other.high.x && other.low.x < high.x && low.y < other.high.y && other.low.y < high.y;
    }
};

MapBox boxOn(const View& view, const Aabb& box_ws)
{
    MapBox box{glm::dvec2(1e300), glm::dvec2(-1e300)};
    for (int i = 0; i < 8; ++i) {
        const glm::dvec4 c = view.clip_from_world * glm::dvec4(glm::dvec3(box_ws.corner(i)), 1.0);
        if (!(c.w > 0.0)) {
            return {};
        }
        box.low = glm::min(box.low, glm::dvec2(c) / c.w);
        box.high = glm::max(box.high, glm::dvec2(c) / c.w);
    }
    return {glm::max(box.low, glm::dvec2(-1.0)), glm::min(box.high, glm::dvec2(1.0))};
}

/// The ids of one object: so many, from `first` on.
struct IdRange {
    std::uint32_t first = 0;
    std::uint32_t count = 1;

    /// Of `ids`, after the last of which the first comes again.
    [[nodiscard]] bool meets(const IdRange& other, std::uint32_t ids) const
    {
        const std::uint32_t after = (other.first + ids - first) % ids;
        return after < count || (ids - after) % ids < other.count;
    }
};

std::uint32_t piecesOf(const Plan& plan, std::uint32_t light, std::uint32_t object)
{
    const ResolvedOptions& options = (*plan.options)[plan.lights[light].options];
    return options.ids().of == IdOf::face ? std::max<std::uint32_t>(plan.object_pieces[object], 1) : 1;
}

/// What overlaps in one map.
void countPairs(const Plan& plan, const View& view, std::span<const std::uint16_t> ids, IdCollisions& counted)
{
    std::vector<std::pair<MapBox, IdRange>> boxes;
    for (std::uint32_t i = 0; i < view.caster_count; ++i) {
        const std::uint32_t object = plan.casters[view.first_caster + i];
        if (ids[object] != 0) {
            boxes.emplace_back(boxOn(view, plan.object_bounds[object]),
                               IdRange{ids[object], piecesOf(plan, view.light, object)});
        }
    }
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            const bool touch = boxes[i].first.touches(boxes[k].first);
            counted.pairs += touch ? 1 : 0;
            counted.collisions += touch && boxes[i].second.meets(boxes[k].second, counted.ids) ? 1 : 0;
        }
    }
}

} // namespace

std::uint32_t idsOf(MapFormat format)
{
    return format == MapFormat::r8 || format == MapFormat::rg8 ? 255 : 65535;
}

std::span<const std::uint16_t> objectIdsOf(const Plan& plan, std::uint32_t light)
{
    const std::uint32_t first = plan.lights[light].first_object_id;
    return first == kNoIndex ? std::span<const std::uint16_t>()
                             : std::span(plan.object_ids).subspan(first, plan.object_bounds.size());
}

IdSharing idSharingOf(Filter filter, IdOf of)
{
    return filter == Filter::depth_id && of == IdOf::object ? IdSharing::neighbours : IdSharing::far;
}

void handOutIds(const Light& light, const ObjectSet& objects, const IdHandout& handout, std::vector<IdPlace>& scratch,
                std::vector<std::uint16_t>& out)
{
    const double length = glm::length(light.direction_ws);
    const glm::dvec3 along_ws = length > 0.0 ? light.direction_ws / length : glm::dvec3(0.0, -1.0, 0.0);
    const std::span<const Aabb> bounds = objects.allBounds();
    scratch.clear();
    std::uint64_t wanted = 0;
    const auto takes = [&](std::uint32_t object) {
        return handout.of == IdOf::face ? std::max<std::uint32_t>(objects.flags(object).pieces, 1) : 1U;
    };
    for (std::uint32_t object = 0; object < bounds.size(); ++object) {
        if (objects.flags(object).casts && !bounds[object].empty()) {
            scratch.emplace_back(farthestOf(light, along_ws, bounds[object]), object);
            wanted += takes(object);
        }
    }
    std::sort(scratch.begin(), scratch.end());
    const std::size_t first = out.size();
    out.resize(first + bounds.size(), 0);
    std::uint64_t taken = 0;
    const bool squeezed = handout.sharing == IdSharing::neighbours && wanted > handout.most;
    for (const auto& [reach, object] : scratch) {
        const std::uint64_t place = squeezed ? taken * handout.most / wanted : taken % handout.most;
        out[first + object] = static_cast<std::uint16_t>(place + 1);
        taken += takes(object);
    }
}

IdCollisions countIdCollisions(const Plan& plan, std::uint32_t light)
{
    IdCollisions counted;
    const std::span<const std::uint16_t> ids = objectIdsOf(plan, light);
    if (ids.empty()) {
        return counted;
    }
    const LightPlan& planned = plan.lights[light];
    counted.ids = idsOf((*plan.options)[planned.options].format());
    std::vector<std::uint32_t> drawn;
    for (std::uint32_t i = 0; i < planned.view_count; ++i) {
        const View& view = plan.views[planned.first_view + i];
        countPairs(plan, view, ids, counted);
        const auto casters = std::span(plan.casters).subspan(view.first_caster, view.caster_count);
        std::copy_if(casters.begin(), casters.end(), std::back_inserter(drawn),
                     [&](std::uint32_t object) { return ids[object] != 0; });
    }
    std::sort(drawn.begin(), drawn.end());
    drawn.erase(std::unique(drawn.begin(), drawn.end()), drawn.end());
    counted.casters = static_cast<std::uint32_t>(drawn.size());
    for (const std::uint32_t object : drawn) {
        counted.taken += piecesOf(plan, light, object);
    }
    return counted;
}

} // namespace gnomon
