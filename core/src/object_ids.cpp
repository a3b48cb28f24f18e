// SPDX-License-Identifier: Apache-2.0
// Based on: T. Forsyth, "Extremely Practical Shadows", GDC 2006; see the header for the departures.
#include <gnomon/object_ids.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
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

/// The bounds of a box in a map, in clip space; everything where the box is partly behind a lamp.
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
        const glm::dvec4 c = view.projection.clip_from_world * glm::dvec4(glm::dvec3(box_ws.corner(i)), 1.0);
        if (!(c.w > 0.0)) {
            return {};
        }
        box.low = glm::min(box.low, glm::dvec2(c) / c.w);
        box.high = glm::max(box.high, glm::dvec2(c) / c.w);
    }
    return {glm::max(box.low, glm::dvec2(-1.0)), glm::min(box.high, glm::dvec2(1.0))};
}

/// A plane across x, y or z that an object without thickness lies in.
struct FlatPlace {
    int axis = 0;
    double at = 0.0;
    double tolerance = 0.0; // metres by which one that is rounded otherwise may be beside it
};

std::optional<FlatPlace> flatPlaceOf(const Aabb& box)
{
    constexpr double kFlat = 1e-6; // share of the box's size and of its distance from the origin
    const glm::dvec3 low(box.min);
    const glm::dvec3 size = glm::dvec3(box.max) - low;
    for (int axis = 0; axis < 3; ++axis) {
        const double most = std::max(size[(axis + 1) % 3], size[(axis + 2) % 3]);
        const double tolerance = kFlat * std::max(most, std::abs(low[axis]));
        if (most > 0.0 && size[axis] <= tolerance) {
            return FlatPlace{axis, low[axis] + 0.5 * size[axis], tolerance};
        }
    }
    return std::nullopt;
}

/// Which faces of a box count.
enum class Face : std::uint8_t { low, high, any };

Face towards(const Light& light, const FlatPlace& flat)
{
    const double way =
        light.type == LightType::directional ? -light.direction_ws[flat.axis] : light.position_ws[flat.axis] - flat.at;
    return way > 0.0 ? Face::high : Face::low;
}

/// Does the object lie on such a face of the box, and nowhere beyond it?
bool liesOn(const Aabb& object, const FlatPlace& flat, const Aabb& box, Face face)
{
    for (int side = 1; side < 3; ++side) {
        const int axis = (flat.axis + side) % 3;
        if (static_cast<double>(box.min[axis]) > static_cast<double>(object.min[axis]) + flat.tolerance ||
            static_cast<double>(box.max[axis]) < static_cast<double>(object.max[axis]) - flat.tolerance) {
            return false;
        }
    }
    const bool is_high = std::abs(static_cast<double>(box.max[flat.axis]) - flat.at) <= flat.tolerance;
    const bool is_low = std::abs(static_cast<double>(box.min[flat.axis]) - flat.at) <= flat.tolerance;
    return (is_high && face != Face::low) || (is_low && face != Face::high);
}

/// The first box of these groups that the object lies on; the object itself where there is none.
std::uint32_t boxUnder(const ObjectSet& objects, std::uint32_t object, const FlatPlace& flat, Face face,
                       std::uint32_t groups, std::vector<std::uint32_t>& found)
{
    const Aabb box = objects.bounds(object);
    found.clear();
    objects.query(planesAround(glm::dvec3(box.min) - flat.tolerance, glm::dvec3(box.max) + flat.tolerance),
                  ObjectSet::Want::casters, found, groups);
    const auto under = std::ranges::find_if(found, [&](std::uint32_t other) {
        const Aabb bounds = objects.bounds(other);
        return !flatPlaceOf(bounds) && liesOn(box, flat, bounds, face);
    });
    return under == found.end() ? object : *under;
}

/// Calls take(object, its plane, the first object in the same plane) for all objects without thickness that `counts`.
template <typename Counts, typename Take>
void eachInPlane(const ObjectSet& objects, IdScratch& scratch, const Counts& counts, const Take& take)
{
    for (int axis = 0; axis < 3; ++axis) {
        scratch.places.clear();
        for (std::uint32_t object = 0; object < objects.allBounds().size(); ++object) {
            const std::optional<FlatPlace> flat = flatPlaceOf(objects.allBounds()[object]);
            if (flat && flat->axis == axis && counts(object)) {
                scratch.places.emplace_back(flat->at, object);
            }
        }
        std::sort(scratch.places.begin(), scratch.places.end());
        double before = 0.0;
        std::uint32_t first = kNoIndex;
        for (const auto& [at, object] : scratch.places) {
            const FlatPlace flat = *flatPlaceOf(objects.allBounds()[object]);
            first = first != kNoIndex && at - before <= flat.tolerance ? first : object;
            before = at;
            take(object, flat, first);
        }
    }
}

/// See handOutIds(). `ids`: by object.
void shareInPlanes(const Light& light, const ObjectSet& objects, const IdHandout& handout, IdScratch& scratch,
                   std::span<std::uint16_t> ids)
{
    std::uint32_t plane = kNoIndex;
    std::uint16_t id = 0; // id of the objects in the plane
    eachInPlane(
        objects, scratch,
        [&](std::uint32_t object) {
            return ids[object] != 0 && (handout.of == IdOf::object || objects.flags(object).pieces <= 1);
        },
        [&](std::uint32_t object, const FlatPlace& flat, std::uint32_t first) {
            id = first == plane ? id : ids[first];
            plane = first;
            const std::uint32_t under =
                handout.of == IdOf::object
                    ? boxUnder(objects, object, flat, towards(light, flat), light.groups, scratch.found)
                    : object;
            ids[object] = under == object ? id : ids[under];
        });
}

/// The ids of one object: `count` of them, from `first` on.
struct IdRange {
    std::uint32_t first = 0;
    std::uint32_t count = 1;

    /// Do both have an id in common? There are `ids` of them, and the first follows the last.
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

/// Counts the pairs that overlap in one map.
void countPairs(const Plan& plan, const View& view, std::span<const std::uint16_t> ids, IdCollisions& counted)
{
    struct Drawn {
        MapBox box;
        IdRange ids;
        Aabb bounds_ws;
        bool is_flat = false;
    };
    std::vector<Drawn> drawn;
    for (std::uint32_t i = 0; i < view.casters.count; ++i) {
        const std::uint32_t object = plan.casters[view.casters.first + i];
        if (ids[object] != 0) {
            const Aabb& bounds_ws = plan.object_bounds[object];
            drawn.push_back({boxOn(view, bounds_ws),
                             {ids[object], piecesOf(plan, view.light, object)},
                             bounds_ws,
                             flatPlaceOf(bounds_ws).has_value()});
        }
    }
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            const Drawn& a = drawn[i];
            const Drawn& b = drawn[k];
            const bool touch = a.box.touches(b.box);
            const bool in_one_plane = (a.is_flat || b.is_flat) && a.bounds_ws.overlaps(b.bounds_ws);
            counted.pairs += touch ? 1 : 0;
            counted.collisions += touch && !in_one_plane && a.ids.meets(b.ids, counted.ids) ? 1 : 0;
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

void handOutIds(const Light& light, const ObjectSet& objects, const IdHandout& handout, IdScratch& scratch,
                std::vector<std::uint16_t>& out)
{
    const double length = glm::length(light.direction_ws);
    const glm::dvec3 along_ws = length > 0.0 ? light.direction_ws / length : glm::dvec3(0.0, -1.0, 0.0);
    const std::span<const Aabb> bounds = objects.allBounds();
    std::vector<std::pair<double, std::uint32_t>>& places = scratch.places;
    places.clear();
    std::uint64_t wanted = 0;
    const auto takes = [&](std::uint32_t object) {
        return handout.of == IdOf::face ? std::max<std::uint32_t>(objects.flags(object).pieces, 1) : 1U;
    };
    for (std::uint32_t object = 0; object < bounds.size(); ++object) {
        const ObjectFlags flags = objects.flags(object);
        if (flags.casts && (flags.groups & light.groups) != 0 && !bounds[object].empty()) {
            places.emplace_back(farthestOf(light, along_ws, bounds[object]), object);
            wanted += takes(object);
        }
    }
    std::sort(places.begin(), places.end());
    const std::size_t first = out.size();
    out.resize(first + bounds.size(), 0);
    std::uint64_t taken = 0;
    const bool squeezed = handout.sharing == IdSharing::neighbours && wanted > handout.most;
    for (const auto& [reach, object] : places) {
        const std::uint64_t place = squeezed ? taken * handout.most / wanted : taken % handout.most;
        out[first + object] = static_cast<std::uint16_t>(place + 1);
        taken += takes(object);
    }
    shareInPlanes(light, objects, handout, scratch, std::span(out).subspan(first));
}

void shareIdBounds(const ObjectSet& objects, IdScratch& scratch, std::vector<Aabb>& bounds_ws)
{
    const std::span<const Aabb> own = objects.allBounds();
    bounds_ws.assign(own.begin(), own.end());
    scratch.links.clear();
    const auto counts = [&](std::uint32_t object) {
        return objects.flags(object).casts;
    };
    eachInPlane(objects, scratch, counts, [&](std::uint32_t object, const FlatPlace& flat, std::uint32_t first) {
        scratch.links.emplace_back(object, first);
        scratch.links.emplace_back(object, boxUnder(objects, object, flat, Face::any, kAllGroups, scratch.found));
    });
    // Bounds pass on along links until all that are linked have the same.
    bool grows = true;
    while (grows) {
        grows = false;
        for (const auto& [a, b] : scratch.links) {
            const Aabb both = merge(bounds_ws[a], bounds_ws[b]);
            grows = grows || !bounds_ws[a].contains(both) || !bounds_ws[b].contains(both);
            bounds_ws[a] = both;
            bounds_ws[b] = both;
        }
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
        const auto casters = std::span(plan.casters).subspan(view.casters.first, view.casters.count);
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
