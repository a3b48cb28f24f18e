// SPDX-License-Identifier: Apache-2.0
#include "store/map_store.h"

#include <gnomon/plan_views.h>

#include <algorithm>
#include <atomic>
#include <cassert>

namespace gnomon {
namespace {

std::uint64_t freshIdentity()
{
    static std::atomic<std::uint64_t> stores{0};
    return stores.fetch_add(1, std::memory_order_relaxed) + 1;
}

} // namespace

// Each store's numbers begin so far from the next one's that they never meet.
MapStore::MapStore() : identity_(freshIdentity()), next_number_(identity_ << 40U) {}

void MapStore::addPages(std::uint32_t side, std::uint32_t most_pages)
{
    Pages& added = pages_.emplace_back();
    added.maps.begin(side, most_pages);
    added.kept.begin(side, most_pages);
}

// ---- Whose a square is

void MapStore::follow(const ObjectSet& objects, std::span<const std::uint64_t> keys)
{
    if (objects.identity() != objects_identity_) {
        forget();
    }
    objects_identity_ = objects.identity();
    rows_.follow(keys);
    rooms_.resize(std::max<std::size_t>(rooms_.size(), rows_.end()));
    for (const std::uint32_t row : rows_.gone()) {
        clear(rooms_[row]);
    }
}

void MapStore::furnish(std::span<const MapWish> wishes)
{
    for (std::size_t light = 0; light < wishes.size(); ++light) {
        if (Room& room = rooms_[rows_.rowOf(light)]; room.wish != wishes[light]) {
            clear(room);
            room.wish = wishes[light];
        }
    }
    for (std::size_t light = 0; light < wishes.size(); ++light) {
        furnish(rooms_[rows_.rowOf(light)]);
    }
}

/// Finds room for what a light wants and does not have yet.
void MapStore::furnish(Room& room)
{
    if (room.wish.count == 0) {
        return;
    }
    if (room.places.empty() || (room.side < room.wish.side && room.looked_at != given_up_)) {
        findRoom(room);
    }
    if (room.wish.keeps_still && !room.places.empty() && room.kept_squares.empty() && takeKept(room)) {
        for (std::size_t i = 0; i < room.places.size(); ++i) {
            room.places[i].kept_map = freshMap();
            room.places[i].kept_layer = room.kept_squares[room.wish.shares_texels ? i % room.wish.count : i].page;
        }
    }
}

/// Takes the largest squares that there are, if they are larger than those that the light has.
void MapStore::findRoom(Room& room)
{
    const MapWish wish = room.wish;
    const std::uint32_t least = std::max(room.places.empty() ? kSmallestMap : 2 * room.side, 1U);
    std::uint32_t side = wish.side;
    larger_.clear();
    while (!takeSquares(wish, side, larger_)) {
        side /= 2;
        if (side < least) {
            room.looked_at = given_up_;
            return;
        }
    }
    clear(room);
    room.wish = wish;
    room.side = side;
    room.looked_at = given_up_;
    std::swap(room.squares, larger_);
    name(room);
}

/// Squares for all maps of a wish, or none.
bool MapStore::takeSquares(const MapWish& wish, std::uint32_t side, std::vector<PageSquare>& out)
{
    PageSquares& pages = pages_[wish.options].maps;
    const std::uint32_t level = pages.levelOf(side);
    const std::uint32_t pages_before = pages.pages();
    const std::uint32_t together = wish.stacked ? wish.count : 1;
    for (std::uint32_t i = 0; i < wish.squares(); i += together) {
        if (!pages.take(level, together, out)) {
            for (; !out.empty(); out.pop_back()) {
                pages.give(out.back());
            }
            pages.dropPagesFrom(pages_before);
            return false;
        }
    }
    return true;
}

/// Gives the squares that were found names.
void MapStore::name(Room& room)
{
    const MapWish& wish = room.wish;
    for (std::uint32_t i = 0; i < wish.positions * wish.count; ++i) {
        const PageSquare& square = room.squares[wish.shares_texels ? i % wish.count : i];
        MapPlace& place = room.places.emplace_back();
        place.map = freshMap();
        place.tile = pages_[wish.options].maps.tileOf(square, room.side);
        if (wish.shares_texels) {
            place.part = i < wish.count ? TexelPart::first : TexelPart::second;
        }
    }
}

/// A kept copy is at its map's place of its page, and has the same part of its texels. All of a light's maps have one,
/// or none.
bool MapStore::takeKept(Room& room)
{
    const MapWish& wish = room.wish;
    PageSquares& pages = pages_[wish.options].kept;
    const std::uint32_t pages_before = pages.pages();
    for (std::uint32_t i = 0; i < wish.squares(); ++i) {
        const PageSquare& square = room.squares[i];
        if (pages.takeAt(square.level, square.place, 1, room.kept_squares)) {
            continue;
        }
        for (const PageSquare& taken : room.kept_squares) {
            pages.give(taken);
        }
        pages.dropPagesFrom(pages_before);
        room.kept_squares.clear();
        return false;
    }
    return true;
}

/// Clears the room of a light that is gone or wants other maps. Keeps its memory.
void MapStore::clear(Room& room)
{
    for (const MapPlace& place : room.places) {
        giveUp(place.map);
        if (place.kept_map) {
            giveUp(place.kept_map);
        }
    }
    for (const PageSquare& square : room.squares) {
        pages_[room.wish.options].maps.give(square);
        ++given_up_;
    }
    for (const PageSquare& square : room.kept_squares) {
        pages_[room.wish.options].kept.give(square);
    }
    room.places.clear();
    room.squares.clear();
    room.kept_squares.clear();
    room.wish = {};
    room.side = 0;
}

MapId MapStore::freshMap()
{
    if (free_maps_.empty()) {
        maps_.emplace_back();
        return {static_cast<std::uint32_t>(maps_.size() - 1), 0};
    }
    const std::uint32_t index = free_maps_.back();
    free_maps_.pop_back();
    return {index, maps_[index].generation};
}

void MapStore::giveUp(const MapId& id)
{
    Map& map = maps_[id.index];
    map.number = 0;
    ++map.generation;
    free_maps_.push_back(id.index);
}

void MapStore::report(Plan& plan) const
{
    plan.pages.resize(pages_.size());
    for (std::size_t i = 0; i < pages_.size(); ++i) {
        const PageSquares& maps = pages_[i].maps;
        const std::uint32_t side = maps.pages() == 0 ? 0 : maps.side();
        plan.pages[i] = {};
        plan.pages[i].width = side;
        plan.pages[i].height = side;
        plan.pages[i].layers = maps.pages();
        plan.pages[i].kept_layers = pages_[i].kept.pages();
    }
    for (const Room& room : rooms_) {
        MapPages& pages = plan.pages[room.wish.options];
        pages.given_texels += std::uint64_t{room.side} * room.side * room.squares.size();
    }
    plan.planner = identity_;
    plan.map_count = static_cast<std::uint32_t>(maps_.size());
}

// ---- What it holds

void MapStore::lost(const MapId& id)
{
    if (id.index < maps_.size() && maps_[id.index].generation == id.generation) {
        maps_[id.index].number = 0;
    }
}

void MapStore::forget()
{
    for (Map& map : maps_) {
        map.number = 0;
    }
}

void MapStore::fill(Map& map, const MapProjection& now, std::span<const std::uint32_t> casters,
                    const ObjectSet& objects)
{
    map.contents.fill(now, casters, objects.version());
    map.number = next_number_++;
}

void MapStore::draw(View& view, const MapPlace& place, std::span<std::uint32_t> casters, const ObjectSet& objects)
{
    const Due due = dueOf(view, place, casters, objects);
    Map& map = maps_[place.map.index];
    const MapProjection projection = projectionOf(view);
    if (view.contents.kept_layer != kNoIndex) {
        Map& kept = maps_[place.kept_map.index];
        if (view.contents.redraw_kept) {
            fill(kept, projection, still_, objects);
        }
        view.contents.kept_makes = kept.number;
        std::ranges::copy(still_, casters.begin());
        std::ranges::transform(moving_, casters.begin() + view.casters.still,
                               [](const Mover& mover) { return mover.object; });
    }
    if (due.map) {
        fill(map, projection, due.over_kept ? std::span<const std::uint32_t>(still_) : casters, objects);
        if (due.over_kept) {
            map.contents.moving.assign(moving_.begin(), moving_.end());
        }
    }
    view.contents.makes = map.number;
    view.contents.redraw = view.contents.makes != view.contents.presumes;
}

std::uint64_t MapStore::wouldDraw(View view, const MapPlace& place, std::span<const std::uint32_t> casters,
                                  const ObjectSet& objects)
{
    view.contents.redraw = dueOf(view, place, casters, objects).map;
    return texelsToDraw(view);
}

bool MapStore::holds(const View& view) const
{
    const auto shows = [&](const MapId& id, ContentNumber content) {
        return content != 0 && id.index < maps_.size() && maps_[id.index].generation == id.generation &&
               maps_[id.index].number == content;
    };
    return shows(view.place.map, view.contents.makes) &&
           (view.contents.kept_layer == kNoIndex || shows(view.contents.kept_map, view.contents.kept_makes));
}

bool MapStore::owns(std::size_t light, const MapId& map) const
{
    return std::ranges::any_of(rooms_[rows_.rowOf(light)].places,
                               [&](const MapPlace& place) { return place.map == map; });
}

void MapStore::drawAnew(View& view)
{
    maps_[view.place.map.index].number = 0;
    view.contents.presumes = 0;
    view.contents.makes = next_number_++;
    view.contents.redraw = true;
}

/// Compares what a map holds with what it should hold. Writes the result to the view, except what the map will hold.
/// `still_` and `moving_` are its casters where there is a kept copy.
MapStore::Due MapStore::dueOf(View& view, const MapPlace& place, std::span<const std::uint32_t> casters,
                              const ObjectSet& objects)
{
    if (place.kept_map) {
        return {dueOverKept(view, place, casters, objects), true};
    }
    const Map& map = maps_[place.map.index];
    const bool holds = map.number != 0 && map.contents.show(projectionOf(view), casters, objects.allChanges()) &&
                       map.contents.moving.empty();
    view.contents.presumes = holds ? map.number : 0;
    return {!holds, false};
}

void MapStore::split(std::span<const std::uint32_t> casters, const ObjectSet& objects)
{
    still_.clear();
    moving_.clear();
    for (const std::uint32_t object : casters) {
        if (objects.flags(object).dynamic) {
            moving_.push_back({object, {}});
        } else {
            still_.push_back(object);
        }
    }
}

/// Is the map to be drawn?
bool MapStore::dueOverKept(View& view, const MapPlace& place, std::span<const std::uint32_t> casters,
                           const ObjectSet& objects)
{
    static const MapContents kNothing;
    split(casters, objects);
    view.casters.still = static_cast<std::uint32_t>(still_.size());
    const Map& map = maps_[place.map.index];
    const Map& kept = maps_[place.kept_map.index];
    const MapProjection projection = projectionOf(view);
    const bool map_holds = map.number != 0 && map.contents.show(projection, still_, objects.allChanges());
    const bool kept_holds = kept.number != 0 && kept.contents.show(projection, still_, objects.allChanges());
    const TexelRect changed = placeMovers(view, map_holds ? map.contents : kNothing, objects, moving_);
    const bool moves = std::ranges::any_of(moving_, [](const Mover& mover) { return !mover.texels.empty(); });
    const bool restores = map_holds && map.contents.showMovers() && kept_holds;
    const bool draws = !map_holds || !changed.empty();
    view.contents.presumes = map_holds ? map.number : 0;
    // A copy that was lost comes back with the next drawing.
    if ((moves || restores) && (draws || kept_holds)) {
        view.contents.kept_layer = place.kept_layer;
        view.contents.kept_map = place.kept_map;
        view.contents.kept_presumes = kept_holds ? kept.number : 0;
        view.contents.redraw_kept = draws && !kept_holds;
        if (draws) {
            view.contents.dirty =
                map_holds && kept_holds ? changed : TexelRect{0, 0, view.place.tile.width, view.place.tile.height};
        }
    }
    return draws;
}

} // namespace gnomon
