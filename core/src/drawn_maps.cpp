// SPDX-License-Identifier: Apache-2.0
#include "drawn_maps.h"

#include <glm/common.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace gnomon {
namespace {

std::atomic<ContentNumber> next_content{1};
constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool sameTile(const Tile& a, const Tile& b)
{
    return a.layer == b.layer && a.x == b.x && a.y == b.y && a.width == b.width && a.height == b.height;
}

bool sameSize(const MapPages& a, const MapPages& b)
{
    return a.width == b.width && a.height == b.height && a.layers == b.layers;
}

TexelRect wholeOf(const Tile& tile)
{
    return {0, 0, tile.width, tile.height};
}

} // namespace

TexelRect merge(const TexelRect& a, const TexelRect& b)
{
    if (a.empty() || b.empty())
        return a.empty() ? b : a;
    const std::uint32_t x = std::min(a.x, b.x);
    const std::uint32_t y = std::min(a.y, b.y);
    return {x, y, std::max(a.x + a.width, b.x + b.width) - x, std::max(a.y + a.height, b.y + b.height) - y};
}

TexelRect texelsOf(const View& view, const Aabb& box_ws)
{
    glm::dvec2 low(kInfinity);
    glm::dvec2 high(-kInfinity);
    for (int i = 0; i < 8; ++i) {
        const glm::dvec4 c = view.clip_from_world * glm::dvec4(glm::dvec3(box_ws.corner(i)), 1.0);
        if (!(c.w > 0.0))
            return wholeOf(view.tile);
        low = glm::min(low, glm::dvec2(c) / c.w);
        high = glm::max(high, glm::dvec2(c) / c.w);
    }
    const glm::dvec2 size(view.tile.width, view.tile.height);
    low = glm::clamp(glm::floor((low * 0.5 + 0.5) * size) - 1.0, glm::dvec2(0.0), size);
    high = glm::clamp(glm::ceil((high * 0.5 + 0.5) * size) + 1.0, glm::dvec2(0.0), size);
    if (!(low.x < high.x && low.y < high.y))
        return {};
    const glm::uvec2 first(low);
    const glm::uvec2 end(high);
    return {first.x, first.y, end.x - first.x, end.y - first.y};
}

bool DrawnMaps::Record::shows(const View& view, std::span<const std::uint32_t> casters,
                              std::span<const std::uint64_t> changes) const
{
    return filled && clip_from_world == view.clip_from_world && metric_ws == view.metric.metric_ws &&
           orthographic == view.orthographic && clamp_near == view.clamp_near && std::ranges::equal(still, casters) &&
           std::ranges::none_of(casters, [&](std::uint32_t object) { return changes[object] > version; });
}

bool DrawnMaps::Record::showsMovers() const
{
    return std::ranges::any_of(moving, [](const Mover& mover) { return !mover.texels.empty(); });
}

void DrawnMaps::Record::fill(const View& view, std::span<const std::uint32_t> casters, std::uint64_t drawn_version)
{
    filled = true;
    clip_from_world = view.clip_from_world;
    metric_ws = view.metric.metric_ws;
    orthographic = view.orthographic;
    clamp_near = view.clamp_near;
    version = drawn_version;
    content = next_content.fetch_add(1, std::memory_order_relaxed);
    still.assign(casters.begin(), casters.end());
    moving.clear();
}

void DrawnMaps::forget()
{
    for (std::vector<Record>* records : {&maps_, &kept_}) // their memory is kept
        for (Record& record : *records)
            record.filled = false;
}

void DrawnMaps::begin(const Plan& plan, const ObjectSet& objects)
{
    if (!sameSize(plan.pages[0], atlas_) || objects.identity() != identity_) {
        forget();
        if (!sameSize(plan.pages[0], atlas_))
            maps_.clear();
    }
    if (plan.pages[0].kept_layers != kept_layers_) {
        kept_.resize(plan.pages[0].kept_layers);
        for (Record& record : kept_)
            record.filled = false;
    }
    atlas_ = plan.pages[0];
    kept_layers_ = plan.pages[0].kept_layers;
    identity_ = objects.identity();
}

DrawnMaps::Record& DrawnMaps::recordOf(const View& view)
{
    const auto found = std::ranges::find_if(
        maps_, [&](const Record& record) { return sameTile(record.tile, view.tile) && record.part == view.part; });
    if (found != maps_.end())
        return *found;
    Record& made = maps_.emplace_back();
    made.tile = view.tile;
    made.part = view.part;
    return made;
}

void DrawnMaps::split(std::span<const std::uint32_t> casters, const ObjectSet& objects)
{
    still_.clear();
    moving_.clear();
    for (const std::uint32_t object : casters) {
        if (objects.flags(object).dynamic)
            moving_.push_back({object, {}});
        else
            still_.push_back(object);
    }
}

/// Finds where each mover is, and returns what of the tile is no longer as it was drawn (null: whatever it was).
TexelRect DrawnMaps::placeMovers(const View& view, const Record* drawn, const ObjectSet& objects)
{
    const std::span<const Aabb> bounds = objects.allBounds();
    const std::span<const std::uint64_t> changes = objects.allChanges();
    const std::span<const Mover> then = drawn != nullptr ? std::span<const Mover>(drawn->moving) : std::span<Mover>();
    TexelRect changed;
    auto old = then.begin();
    const auto leaveBefore = [&](std::uint32_t object) {
        for (; old != then.end() && old->object < object; ++old)
            changed = merge(changed, old->texels);
    };
    for (Mover& mover : moving_) {
        leaveBefore(mover.object);
        const bool known = old != then.end() && old->object == mover.object;
        if (known && changes[mover.object] <= drawn->version) {
            mover.texels = old->texels;
        } else {
            mover.texels = texelsOf(view, bounds[mover.object]);
            changed = merge(changed, mover.texels);
            if (known)
                changed = merge(changed, old->texels);
        }
        if (known)
            ++old;
    }
    leaveBefore(kNoIndex);
    return changed;
}

void DrawnMaps::decideAtOnce(View& view, Record& map, std::span<const std::uint32_t> casters,
                             const ObjectSet& objects) const
{
    view.redraw = !(map.shows(view, casters, objects.allChanges()) && map.moving.empty());
    view.presumes = view.redraw ? 0 : map.content;
    if (view.redraw)
        map.fill(view, casters, objects.version());
    view.makes = map.content;
}

void DrawnMaps::decide(View& view, std::uint32_t kept_layer, std::span<std::uint32_t> casters, const ObjectSet& objects)
{
    Record& map = recordOf(view);
    view.map = {2 * static_cast<std::uint32_t>(&map - maps_.data()), 0};
    if (kept_layer == kNoIndex) {
        decideAtOnce(view, map, casters, objects);
        return;
    }
    split(casters, objects);
    view.still_count = static_cast<std::uint32_t>(still_.size());
    Record& kept = kept_[kept_layer];
    const std::span<const std::uint64_t> changes = objects.allChanges();
    const bool map_holds = map.shows(view, still_, changes);
    const bool kept_holds = kept.shows(view, still_, changes);
    const TexelRect changed = placeMovers(view, map_holds ? &map : nullptr, objects);
    const bool moves = std::ranges::any_of(moving_, [](const Mover& mover) { return !mover.texels.empty(); });
    const bool restores = map_holds && map.showsMovers() && kept_holds;
    view.redraw = !map_holds || !changed.empty();
    view.presumes = map_holds ? map.content : 0;
    if (moves || restores) {
        view.kept_layer = kept_layer;
        view.kept_map = {2 * kept_layer + 1, 0};
        view.kept_presumes = kept_holds ? kept.content : 0;
        view.redraw_kept = view.redraw && !kept_holds;
        if (view.redraw)
            view.dirty = map_holds && kept_holds ? changed : wholeOf(view.tile);
        std::ranges::copy(still_, casters.begin());
        std::ranges::transform(moving_, casters.begin() + view.still_count,
                               [](const Mover& mover) { return mover.object; });
    }
    if (view.redraw_kept)
        kept.fill(view, still_, objects.version());
    if (view.kept_layer != kNoIndex)
        view.kept_makes = kept_holds || view.redraw_kept ? kept.content : 0;
    if (view.redraw) {
        map.fill(view, still_, objects.version());
        map.moving.assign(moving_.begin(), moving_.end());
    }
    view.makes = map.content;
}

} // namespace gnomon
