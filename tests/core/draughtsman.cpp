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

/// Of a view's matrix and metric, which all that is drawn depends on.
std::uint64_t markOf(const View& view)
{
    std::uint64_t mark = view.clamp_near ? 1 : 0;
    for (int i = 0; i < 16; ++i)
        mark = mixed(mark, std::bit_cast<std::uint64_t>(view.clip_from_world[i / 4][i % 4] + 0.0));
    for (int i = 0; i < 4; ++i)
        mark = mixed(mark, std::bit_cast<std::uint64_t>(view.metric.metric_ws[i] + 0.0));
    return mark;
}

/// The texels around a box's image; all where the box reaches behind the light.
TexelRect imageOf(const View& view, const Aabb& box)
{
    const double size = view.tile.width;
    glm::dvec2 low(1e9);
    glm::dvec2 high(-1e9);
    for (int i = 0; i < 8; ++i) {
        const glm::dvec4 c = view.clip_from_world * glm::dvec4(glm::dvec3(box.corner(i)), 1.0);
        if (c.w <= 0.0)
            return {0, 0, view.tile.width, view.tile.height};
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
    return {0, 0, view.tile.width, view.tile.height};
}

std::span<const std::uint32_t> castersOf(const Plan& plan, const View& view)
{
    return std::span(plan.casters).subspan(view.first_caster, view.caster_count);
}

} // namespace

void Draughtsman::Canvas::clear() const
{
    const std::uint64_t mark = markOf(view);
    for (std::uint32_t y = 0; y < view.tile.height; ++y)
        for (std::uint32_t x = 0; x < view.tile.width; ++x)
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
    const std::uint32_t layer = kept ? view.kept_layer : view.tile.layer;
    EXPECT_LT(layer, kept ? pages.kept_layers : pages.layers);
    EXPECT_LE(view.tile.x + view.tile.width, pages.width);
    EXPECT_LE(view.tile.y + view.tile.height, pages.height);
    Page& page = pages_[{options, kept, view.part, layer}];
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
    ASSERT_LT(view.map.index, plan.map_count);
    EXPECT_EQ(view.redraw, view.makes != view.presumes);
    const auto known = generations_.find(view.map.index);
    if (known != generations_.end() && known->second != view.map.generation) {
        EXPECT_EQ(view.presumes != 0 && strict_, false);
    }
    if (view.makes == 0)
        return;
    const bool map_holds = holds(view.map, view.presumes);
    if (strict_) {
        ASSERT_EQ(map_holds, view.presumes != 0);
    }
    if (map_holds && !view.redraw)
        return;
    mended += view.presumes != 0 && !map_holds ? 1 : 0;
    if (view.kept_layer == kNoIndex) {
        const Canvas map = canvas(plan, view, false);
        map.clear();
        map.draw(castersOf(plan, view), set, wholeOf(view));
        still_drawn += view.caster_count;
    } else {
        restore(plan, view, set, map_holds);
    }
    note(view.map, view.makes);
}

void Draughtsman::restore(const Plan& plan, const View& view, const ObjectSet& set, bool map_holds)
{
    const std::span casters = castersOf(plan, view);
    const Canvas kept = canvas(plan, view, true);
    const bool kept_holds = holds(view.kept_map, view.kept_presumes);
    if (strict_) {
        ASSERT_EQ(kept_holds, !view.redraw_kept);
    }
    if (!kept_holds) {
        kept.clear();
        kept.draw(casters.first(view.still_count), set, wholeOf(view));
        still_drawn += view.still_count;
        note(view.kept_map, view.kept_makes);
    }
    const bool in_part = map_holds && kept_holds;
    if (strict_ && !in_part) {
        ASSERT_EQ(view.dirty.width, view.tile.width);
        ASSERT_EQ(view.dirty.height, view.tile.height);
    }
    const TexelRect dirty = in_part ? view.dirty : wholeOf(view);
    ASSERT_FALSE(dirty.empty());
    const Canvas map = canvas(plan, view, false);
    for (std::uint32_t y = 0; y < view.tile.height; ++y)
        for (std::uint32_t x = 0; x < view.tile.width; ++x)
            if (inside(dirty, x, y))
                map.at(x, y) = kept.at(x, y);
    map.draw(casters.subspan(view.still_count), set, dirty);
    moving_drawn += casters.size() - view.still_count;
    dirty_texels += std::uint64_t{dirty.width} * dirty.height;
}

void Draughtsman::check(const Plan& plan, const ObjectSet& set) const
{
    for (const View& view : plan.views) {
        if (view.makes == 0)
            continue;
        const auto page = pages_.find({plan.lights[view.light].options, false, view.part, view.tile.layer});
        ASSERT_NE(page, pages_.end());
        View alone = view;
        alone.tile = {0, 0, 0, view.tile.width, view.tile.height};
        Page anew{view.tile.width, Image(std::size_t{view.tile.width} * view.tile.height)};
        const Canvas canvas{anew, alone};
        canvas.clear();
        canvas.draw(castersOf(plan, view), set, wholeOf(view));
        for (std::uint32_t y = 0; y < view.tile.height; ++y) {
            const auto row = page->second.texels.begin() +
                             static_cast<std::ptrdiff_t>((view.tile.y + y) * page->second.side + view.tile.x);
            ASSERT_TRUE(std::equal(row, row + view.tile.width,
                                   anew.texels.begin() + static_cast<std::ptrdiff_t>(y * view.tile.width)))
                << "light " << view.light << " row " << y;
        }
    }
}

void Draughtsman::lose(const View& view, bool kept)
{
    held_.erase(kept ? view.kept_map.index : view.map.index);
}

void expectOrder(const Plan& plan, const ObjectSet& set)
{
    std::set<std::uint32_t> names;
    for (std::size_t i = 0; i < plan.views.size(); ++i) {
        const View& view = plan.views[i];
        EXPECT_TRUE(names.insert(view.map.index).second);
        for (std::size_t j = 0; j < i; ++j) {
            const View& other = plan.views[j];
            if (plan.lights[other.light].options != plan.lights[view.light].options)
                continue;
            EXPECT_FALSE(other.part == view.part && overlap(other.tile, view.tile));
            const bool shares =
                view.kept_layer != kNoIndex && other.kept_layer == view.kept_layer &&
                (other.part == view.part || other.part == TexelPart::whole || view.part == TexelPart::whole);
            EXPECT_FALSE(shares && overlap({0, other.tile.x, other.tile.y, other.tile.width, other.tile.height},
                                           {0, view.tile.x, view.tile.y, view.tile.width, view.tile.height}));
        }
        const auto first = plan.casters.begin() + view.first_caster;
        const auto end = first + view.caster_count;
        if (view.kept_layer == kNoIndex) {
            EXPECT_TRUE(std::is_sorted(first, end));
            EXPECT_FALSE(view.redraw_kept);
            EXPECT_TRUE(view.dirty.empty());
            EXPECT_FALSE(view.kept_map);
            continue;
        }
        EXPECT_TRUE(names.insert(view.kept_map.index).second);
        ASSERT_LE(view.still_count, view.caster_count);
        const auto moving = first + view.still_count;
        EXPECT_TRUE(std::is_sorted(first, moving));
        EXPECT_TRUE(std::is_sorted(moving, end));
        EXPECT_TRUE(std::none_of(first, moving, [&](std::uint32_t c) { return set.flags(c).dynamic; }));
        EXPECT_TRUE(std::all_of(moving, end, [&](std::uint32_t c) { return set.flags(c).dynamic; }));
    }
}

} // namespace gnomon::test
