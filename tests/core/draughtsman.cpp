// SPDX-License-Identifier: Apache-2.0
#include "draughtsman.h"

#include "worlds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

namespace gnomon::test {
namespace {

std::uint64_t mixed(std::uint64_t a, std::uint64_t b)
{
    return Random(a * 31 + b).bits();
}

/// A mark of a view's matrix and metric, on which all that is drawn depends.
std::uint64_t markOf(const View& view)
{
    std::uint64_t mark = view.projection.clamp_near ? 1 : 0;
    for (int i = 0; i < 16; ++i)
        mark = mixed(mark, std::bit_cast<std::uint64_t>(view.projection.clip_from_world[i / 4][i % 4] + 0.0));
    for (int i = 0; i < 4; ++i)
        mark = mixed(mark, std::bit_cast<std::uint64_t>(view.projection.metric.metric_ws[i] + 0.0));
    return mark;
}

/// The texels around a box's image; all where the box reaches behind the light.
TexelRect imageOf(const View& view, const Aabb& box)
{
    const double size = view.place.tile.width;
    glm::dvec2 low(1e9);
    glm::dvec2 high(-1e9);
    for (int i = 0; i < 8; ++i) {
        const glm::dvec4 c = view.projection.clip_from_world * glm::dvec4(glm::dvec3(box.corner(i)), 1.0);
        if (c.w <= 0.0)
            return {0, 0, view.place.tile.width, view.place.tile.height};
        low = glm::min(low, (glm::dvec2(c) / c.w * 0.5 + 0.5) * size);
        high = glm::max(high, (glm::dvec2(c) / c.w * 0.5 + 0.5) * size);
    }
    low = glm::clamp(glm::floor(low), 0.0, size);
    high = glm::clamp(glm::ceil(high), 0.0, size);
    return {static_cast<std::uint32_t>(low.x), static_cast<std::uint32_t>(low.y),
            static_cast<std::uint32_t>(high.x - low.x), static_cast<std::uint32_t>(high.y - low.y)};
}

bool inside(const TexelRect& rect, std::uint32_t x, std::uint32_t y)
{
    return x >= rect.x && y >= rect.y && x < rect.x + rect.width && y < rect.y + rect.height;
}

bool overlap(const Tile& a, const Tile& b)
{
    return a.layer == b.layer && a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height &&
           b.y < a.y + a.height;
}

TexelRect wholeOf(const View& view)
{
    return {0, 0, view.place.tile.width, view.place.tile.height};
}

std::span<const std::uint32_t> castersOf(const Plan& plan, const View& view)
{
    return std::span(plan.casters).subspan(view.casters.first, view.casters.count);
}

} // namespace

void Draughtsman::Canvas::clear() const
{
    const std::uint64_t mark = markOf(view);
    for (std::uint32_t y = 0; y < view.place.tile.height; ++y)
        for (std::uint32_t x = 0; x < view.place.tile.width; ++x)
            at(x, y) = mark;
}

void Draughtsman::Canvas::draw(std::span<const std::uint32_t> casters, const ObjectSet& set,
                               const TexelRect& scissor) const
{
    const std::uint64_t mark = markOf(view);
    for (const std::uint32_t object : casters) {
        const TexelRect rect = imageOf(view, set.bounds(object));
        const std::uint64_t drawn = mixed(mark, mixed(object, set.changed(object)));
        for (std::uint32_t y = rect.y; y < rect.y + rect.height; ++y)
            for (std::uint32_t x = rect.x; x < rect.x + rect.width; ++x)
                if (inside(scissor, x, y))
                    at(x, y) += drawn;
    }
}

/// Pages are made when they are first drawn to, and hold what they hold for good: the plan takes it that they grow by
/// being copied.
Draughtsman::Canvas Draughtsman::canvas(const Plan& plan, const View& view, bool kept)
{
    const std::uint32_t options = plan.lights[view.light].options;
    const MapPages& pages = plan.pages[options];
    const std::uint32_t layer = kept ? view.contents.kept_layer : view.place.tile.layer;
    EXPECT_LT(layer, kept ? pages.kept_layers : pages.layers);
    EXPECT_LE(view.place.tile.x + view.place.tile.width, pages.width);
    EXPECT_LE(view.place.tile.y + view.place.tile.height, pages.height);
    Page& page = pages_[{options, kept, view.place.part, layer}];
    if (page.texels.empty()) {
        page.side = pages.width;
        page.texels.resize(std::size_t{page.side} * page.side);
    }
    EXPECT_EQ(page.side, pages.width);
    return {page, view};
}

bool Draughtsman::holds(const MapId& map, ContentNumber presumed) const
{
    const auto found = held_.find(map.index);
    return presumed != 0 && found != held_.end() && found->second == presumed;
}

void Draughtsman::note(const MapId& map, ContentNumber made)
{
    EXPECT_NE(made, 0U);
    EXPECT_TRUE(given_.insert(made).second || !strict_); // a number means one thing
    held_[map.index] = made;
    generations_[map.index] = map.generation;
}

void Draughtsman::follow(const Plan& plan, const ObjectSet& set)
{
    for (const View& view : plan.views)
        followView(plan, view, set);
}

void Draughtsman::followView(const Plan& plan, const View& view, const ObjectSet& set)
{
    ASSERT_LT(view.place.map.index, plan.map_count);
    EXPECT_EQ(view.contents.redraw, view.contents.makes != view.contents.presumes);
    const auto known = generations_.find(view.place.map.index);
    if (known != generations_.end() && known->second != view.place.map.generation) {
        EXPECT_EQ(view.contents.presumes != 0 && strict_, false);
    }
    if (view.contents.makes == 0)
        return;
    const bool map_holds = holds(view.place.map, view.contents.presumes);
    if (strict_) {
        ASSERT_EQ(map_holds, view.contents.presumes != 0);
    }
    if (map_holds && !view.contents.redraw)
        return;
    mended += view.contents.presumes != 0 && !map_holds ? 1 : 0;
    if (view.contents.kept_layer == kNoIndex) {
        const Canvas map = canvas(plan, view, false);
        map.clear();
        map.draw(castersOf(plan, view), set, wholeOf(view));
        still_drawn += view.casters.count;
    } else {
        restore(plan, view, set, map_holds);
    }
    note(view.place.map, view.contents.makes);
}

void Draughtsman::restore(const Plan& plan, const View& view, const ObjectSet& set, bool map_holds)
{
    const std::span casters = castersOf(plan, view);
    const Canvas kept = canvas(plan, view, true);
    const bool kept_holds = holds(view.contents.kept_map, view.contents.kept_presumes);
    if (strict_) {
        ASSERT_EQ(kept_holds, !view.contents.redraw_kept);
    }
    if (!kept_holds) {
        kept.clear();
        kept.draw(casters.first(view.casters.still), set, wholeOf(view));
        still_drawn += view.casters.still;
        note(view.contents.kept_map, view.contents.kept_makes);
    }
    const bool in_part = map_holds && kept_holds;
    if (strict_ && !in_part) {
        ASSERT_EQ(view.contents.dirty.width, view.place.tile.width);
        ASSERT_EQ(view.contents.dirty.height, view.place.tile.height);
    }
    const TexelRect dirty = in_part ? view.contents.dirty : wholeOf(view);
    ASSERT_FALSE(dirty.empty());
    const Canvas map = canvas(plan, view, false);
    for (std::uint32_t y = 0; y < view.place.tile.height; ++y)
        for (std::uint32_t x = 0; x < view.place.tile.width; ++x)
            if (inside(dirty, x, y))
                map.at(x, y) = kept.at(x, y);
    map.draw(casters.subspan(view.casters.still), set, dirty);
    moving_drawn += casters.size() - view.casters.still;
    dirty_texels += std::uint64_t{dirty.width} * dirty.height;
}

void Draughtsman::check(const Plan& plan, const ObjectSet& set) const
{
    for (const View& view : plan.views) {
        if (view.contents.makes == 0)
            continue;
        const auto page = pages_.find({plan.lights[view.light].options, false, view.place.part, view.place.tile.layer});
        ASSERT_NE(page, pages_.end());
        View alone = view;
        alone.place.tile = {0, 0, 0, view.place.tile.width, view.place.tile.height};
        Page anew{view.place.tile.width, Image(std::size_t{view.place.tile.width} * view.place.tile.height)};
        const Canvas canvas{anew, alone};
        canvas.clear();
        canvas.draw(castersOf(plan, view), set, wholeOf(view));
        for (std::uint32_t y = 0; y < view.place.tile.height; ++y) {
            const auto row =
                page->second.texels.begin() +
                static_cast<std::ptrdiff_t>((view.place.tile.y + y) * page->second.side + view.place.tile.x);
            ASSERT_TRUE(std::equal(row, row + view.place.tile.width,
                                   anew.texels.begin() + static_cast<std::ptrdiff_t>(y * view.place.tile.width)))
                << "light " << view.light << " row " << y;
        }
    }
}

void Draughtsman::lose(const View& view, bool kept)
{
    held_.erase(kept ? view.contents.kept_map.index : view.place.map.index);
}

void expectOrder(const Plan& plan, const ObjectSet& set)
{
    std::set<std::uint32_t> names;
    for (std::size_t i = 0; i < plan.views.size(); ++i) {
        const View& view = plan.views[i];
        EXPECT_TRUE(names.insert(view.place.map.index).second);
        for (std::size_t j = 0; j < i; ++j) {
            const View& other = plan.views[j];
            if (plan.lights[other.light].options != plan.lights[view.light].options)
                continue;
            EXPECT_FALSE(other.place.part == view.place.part && overlap(other.place.tile, view.place.tile));
            const bool shares = view.contents.kept_layer != kNoIndex &&
                                other.contents.kept_layer == view.contents.kept_layer &&
                                (other.place.part == view.place.part || other.place.part == TexelPart::whole ||
                                 view.place.part == TexelPart::whole);
            EXPECT_FALSE(
                shares &&
                overlap({0, other.place.tile.x, other.place.tile.y, other.place.tile.width, other.place.tile.height},
                        {0, view.place.tile.x, view.place.tile.y, view.place.tile.width, view.place.tile.height}));
        }
        const auto first = plan.casters.begin() + view.casters.first;
        const auto end = first + view.casters.count;
        if (view.contents.kept_layer == kNoIndex) {
            EXPECT_TRUE(std::is_sorted(first, end));
            EXPECT_FALSE(view.contents.redraw_kept);
            EXPECT_TRUE(view.contents.dirty.empty());
            EXPECT_FALSE(view.contents.kept_map);
            continue;
        }
        EXPECT_TRUE(names.insert(view.contents.kept_map.index).second);
        ASSERT_LE(view.casters.still, view.casters.count);
        const auto moving = first + view.casters.still;
        EXPECT_TRUE(std::is_sorted(first, moving));
        EXPECT_TRUE(std::is_sorted(moving, end));
        EXPECT_TRUE(std::none_of(first, moving, [&](std::uint32_t c) { return set.flags(c).dynamic; }));
        EXPECT_TRUE(std::all_of(moving, end, [&](std::uint32_t c) { return set.flags(c).dynamic; }));
    }
}

} // namespace gnomon::test
