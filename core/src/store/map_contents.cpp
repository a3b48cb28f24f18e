// SPDX-License-Identifier: Apache-2.0
#include "store/map_contents.h"

#include <glm/common.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace gnomon {

MapProjection projectionOf(const View& view)
{
    return {view.projection.clip_from_world, view.projection.metric.metric_ws,
            view.projection.orthographic,    view.projection.clamp_near,
            view.contents.ids_key,           view.serves.layers};
}

bool MapContents::show(const MapProjection& now, std::span<const std::uint32_t> casters,
                       std::span<const std::uint64_t> changes) const
{
    return projection == now && std::ranges::equal(still, casters) &&
           std::ranges::none_of(casters, [&](std::uint32_t object) { return changes[object] > version; });
}

bool MapContents::showMovers() const
{
    return std::ranges::any_of(moving, [](const Mover& mover) { return !mover.texels.empty(); });
}

void MapContents::fill(const MapProjection& now, std::span<const std::uint32_t> casters, std::uint64_t now_version)
{
    projection = now;
    version = now_version;
    if (still.capacity() < casters.size()) { // seldom, for pages are given to others that have a few casters more
        constexpr std::size_t kFew = 64;
        still.reserve(std::bit_ceil(std::max(casters.size(), kFew)));
    }
    still.assign(casters.begin(), casters.end());
    moving.clear();
}

TexelRect placeMovers(const View& view, const MapContents& drawn, const ObjectSet& objects, std::span<Mover> movers)
{
    const std::span<const Aabb> bounds = objects.allBounds();
    const std::span<const std::uint64_t> changes = objects.allChanges();
    TexelRect changed;
    auto old = drawn.moving.begin();
    const auto leaveBefore = [&](std::uint32_t object) {
        for (; old != drawn.moving.end() && old->object < object; ++old) {
            changed = merge(changed, old->texels);
        }
    };
    for (Mover& mover : movers) {
        leaveBefore(mover.object);
        const bool known = old != drawn.moving.end() && old->object == mover.object;
        if (known && changes[mover.object] <= drawn.version) {
            mover.texels = old->texels;
        } else {
            mover.texels = texelsOf(view, bounds[mover.object]);
            changed = merge(changed, mover.texels);
            if (known) {
                changed = merge(changed, old->texels);
            }
        }
        if (known) {
            ++old;
        }
    }
    leaveBefore(kNoIndex);
    return changed;
}

TexelRect texelsOf(const View& view, const Aabb& box_ws)
{
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    glm::dvec2 low(kInfinity);
    glm::dvec2 high(-kInfinity);
    if (view.projection.paraboloid) { // where a box's edges are bent
        return {0, 0, view.place.tile.width, view.place.tile.height};
    }
    for (int i = 0; i < 8; ++i) {
        const glm::dvec4 c = view.projection.clip_from_world * glm::dvec4(glm::dvec3(box_ws.corner(i)), 1.0);
        if (!(c.w > 0.0)) {
            return {0, 0, view.place.tile.width, view.place.tile.height};
        }
        low = glm::min(low, glm::dvec2(c) / c.w);
        high = glm::max(high, glm::dvec2(c) / c.w);
    }
    const glm::dvec2 size(view.place.tile.width, view.place.tile.height);
    low = glm::clamp(glm::floor((low * 0.5 + 0.5) * size) - 1.0, glm::dvec2(0.0), size);
    high = glm::clamp(glm::ceil((high * 0.5 + 0.5) * size) + 1.0, glm::dvec2(0.0), size);
    if (!(low.x < high.x && low.y < high.y)) {
        return {};
    }
    const glm::uvec2 first(low);
    const glm::uvec2 end(high);
    return {first.x, first.y, end.x - first.x, end.y - first.y};
}

TexelRect merge(const TexelRect& a, const TexelRect& b)
{
    if (a.empty() || b.empty()) {
        return a.empty() ? b : a;
    }
    const std::uint32_t x = std::min(a.x, b.x);
    const std::uint32_t y = std::min(a.y, b.y);
    return {x, y, std::max(a.x + a.width, b.x + b.width) - x, std::max(a.y + a.height, b.y + b.height) - y};
}

} // namespace gnomon
