// SPDX-License-Identifier: Apache-2.0
#include <gnomon/pack/map_notes.h>

#include <gnomon/plan_views.h>

#include <algorithm>
#include <cassert>

namespace gnomon::pack {
namespace {

bool isSame(const Tile& a, const Tile& b)
{
    return a.layer == b.layer && a.x == b.x && a.y == b.y && a.width == b.width && a.height == b.height;
}

bool overlap(const Tile& a, const Tile& b)
{
    return a.layer == b.layer && a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height &&
           b.y < a.y + a.height;
}

bool overlap(TexelPart a, TexelPart b)
{
    return a == TexelPart::whole || b == TexelPart::whole || a == b;
}

ViewWork asTheViewSays(const View& view)
{
    ViewWork work;
    work.draw = view.contents.redraw;
    work.draw_kept = view.contents.redraw && view.contents.kept_layer != kNoIndex && view.contents.redraw_kept;
    work.whole = view.contents.kept_layer == kNoIndex || work.draw_kept;
    return work;
}

} // namespace

std::span<const std::uint32_t> castersOf(const Plan& plan, const View& view, CasterShare share)
{
    assert(view.casters.first + view.casters.count <= plan.casters.size() && view.casters.still <= view.casters.count);
    const auto all = std::span(plan.casters).subspan(view.casters.first, view.casters.count);
    return share == CasterShare::all     ? all
           : share == CasterShare::still ? all.first(view.casters.still)
                                         : all.subspan(view.casters.still);
}

Tile redrawnPart(const View& view, bool all)
{
    const Tile& tile = view.place.tile;
    const TexelRect& dirty = view.contents.dirty;
    if (all) {
        return tile;
    }
    assert(dirty.x + dirty.width <= tile.width && dirty.y + dirty.height <= tile.height);
    return {tile.layer, tile.x + dirty.x, tile.y + dirty.y, dirty.width, dirty.height};
}

MapNotes::Held MapNotes::mapOf(const Plan& plan, const View& view)
{
    return {view.contents.makes, optionsIndexOf(plan, view), view.place.tile, view.place.part, false};
}

MapNotes::Held MapNotes::keptOf(const Plan& plan, const View& view)
{
    Tile tile = view.place.tile;
    tile.layer = view.contents.kept_layer;
    return {view.contents.kept_makes, optionsIndexOf(plan, view), tile, view.place.part, true};
}

bool MapNotes::holds(MapId id, const Held& wanted) const
{
    if (wanted.content == 0 || id.index >= held_.size()) {
        return false;
    }
    const Held& held = held_[id.index];
    return held.content == wanted.content && held.options == wanted.options && isSame(held.tile, wanted.tile) &&
           held.part == wanted.part && held.kept == wanted.kept;
}

void MapNotes::reserve(const Plan& plan)
{
    std::size_t maps = plan.map_count;
    for (const View& view : plan.views) {
        maps = std::max<std::size_t>(maps, view.place.map ? view.place.map.index + 1 : 0);
        maps = std::max<std::size_t>(maps, view.contents.kept_map ? view.contents.kept_map.index + 1 : 0);
    }
    held_.resize(std::max(held_.size(), maps));
    work_.reserve(plan.views.size());
}

std::span<const ViewWork> MapNotes::workFor(const Plan& plan)
{
    reserve(plan);
    work_.clear();
    for (const View& view : plan.views) {
        ViewWork work = asTheViewSays(view);
        if (view.place.map && view.contents.makes == 0) {
            work = {};
        } else if (view.place.map) {
            Held presumed = mapOf(plan, view);
            presumed.content = view.contents.presumes;
            const bool map_holds = holds(view.place.map, presumed);
            work.draw = view.contents.redraw || !map_holds;
            work.whole = !map_holds || view.contents.kept_layer == kNoIndex;
            if (view.contents.kept_layer != kNoIndex) {
                Held kept = keptOf(plan, view);
                kept.content = view.contents.kept_presumes;
                work.draw_kept = work.draw && (view.contents.redraw_kept || !holds(view.contents.kept_map, kept));
                work.whole = work.whole || work.draw_kept;
            }
        }
        if (work.draw && !work.whole && view.contents.dirty.empty()) {
            work.draw = false;
        }
        work_.push_back(work);
    }
    return work_;
}

/// Whatever lay where this map lies is gone.
void MapNotes::forgetUnder(const Held& held)
{
    for (Held& other : held_) {
        if (other.kept == held.kept && other.options == held.options && overlap(other.tile, held.tile) &&
            overlap(other.part, held.part)) {
            other.content = 0;
        }
    }
}

void MapNotes::note(MapId id, const Held& held)
{
    Held& entry = held_[id.index];
    const bool was_there =
        entry.content != 0 && entry.kept == held.kept && entry.options == held.options && isSame(entry.tile, held.tile);
    if (!was_there || entry.part != held.part) {
        forgetUnder(held);
    }
    entry = held;
}

void MapNotes::done(const Plan& plan)
{
    assert(work_.size() == plan.views.size());
    for (std::size_t i = 0; i < plan.views.size(); ++i) {
        const View& view = plan.views[i];
        changes_ += work_[i].draw || work_[i].draw_kept ? 1 : 0;
        if (view.contents.kept_map && work_[i].draw_kept) {
            note(view.contents.kept_map, keptOf(plan, view));
        }
        if (view.place.map && view.contents.makes != 0 && (work_[i].draw || view.contents.redraw)) {
            note(view.place.map, mapOf(plan, view));
        } else if (!view.place.map && work_[i].draw) {
            forgetUnder(mapOf(plan, view));
        }
    }
}

void MapNotes::lose(std::uint32_t options)
{
    change();
    for (Held& held : held_) {
        if (held.options == options) {
            held.content = 0;
        }
    }
}

} // namespace gnomon::pack
