// SPDX-License-Identifier: Apache-2.0
// The one owner of what maps are: which square of which page is whose, and what it holds.
#pragma once

#include "store/light_rows.h"
#include "store/map_contents.h"
#include "store/page_squares.h"
#include "store/texel_shares.h"

#include <gnomon/object_set.h>
#include <gnomon/plan.h>

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon {

/// The maps that a light wants, whether it needs them in this frame or not. As long as it wants the same it has the
/// same.
struct MapWish {
    std::uint32_t options = 0;   // whose pages
    std::uint32_t side = 0;      // texels, of each map; not more than a page has
    std::uint32_t count = 0;     // frustums that it is divided among; 0: it wants no map
    std::uint32_t positions = 1; // that it shines from: 2 of a stepping sun
    bool stacked = true;         // its frustums' maps lie at one place of consecutive pages, if there is such a run
    bool shares_texels = false;  // its two positions' maps share texels
    bool keeps_still = false;    // each map has a copy of what stands still

    /// How many squares of the pages hold its maps.
    [[nodiscard]] std::uint32_t squares() const { return count * (shares_texels ? 1 : positions); }
    friend bool operator==(const MapWish&, const MapWish&) = default;
};

/// Where one map is.
struct MapPlace {
    MapId map;
    Tile tile;
    TexelPart part = TexelPart::whole;
    MapId kept_map; // none: the map is drawn all at once
    std::uint32_t kept_layer = kNoIndex;
};

/// A map keeps its place and contents until
/// - its light is gone, or wants other maps,
/// - there is room for it as large as it is wanted, where there was not before,
/// - lost() or forget() is told, or another object set comes.
/// Other lights and the frame's order of lights count only for room: first come, first served.
class MapStore {
public:
    MapStore();
    /// One for each of the planner's options. Before the first frame.
    void addPages(std::uint32_t side, std::uint32_t most_pages);

    /// The lights of a frame, by key. Those that are gone give up their maps.
    void follow(const ObjectSet& objects, std::span<const std::uint64_t> keys);
    /// The wish of a light in the last frame; after follow().
    [[nodiscard]] const MapWish& wishBefore(std::size_t light) const { return rooms_[rows_.rowOf(light)].wish; }
    /// The squares that maps share: a page is one whole square and has 4^level of a level.
    [[nodiscard]] const PageSquares& squaresOf(std::uint32_t options) const { return pages_[options].maps; }
    /// Gives each light its wish. Where the squares that are left are too small, maps are smaller than wanted, down to
    /// kSmallestMap.
    void furnish(std::span<const MapWish> wishes);
    /// False: it wants no map, or there is no room for it.
    [[nodiscard]] bool hasRoom(std::size_t light) const { return !rooms_[rows_.rowOf(light)].places.empty(); }
    /// The side of each of its maps. Precondition: hasRoom().
    [[nodiscard]] std::uint32_t sideOf(std::size_t light) const { return rooms_[rows_.rowOf(light)].side; }
    /// The map of a light's frustum at one of its positions (0 or 1). Precondition: hasRoom().
    [[nodiscard]] const MapPlace& placeOf(std::size_t light, std::uint32_t position, std::uint32_t frustum) const
    {
        const Room& room = rooms_[rows_.rowOf(light)];
        return room.places[position * room.wish.count + frustum];
    }
    void report(Plan& plan) const;

    /// Says what of a view has to be drawn, and takes it for granted that it is. The view's `casters` are reordered,
    /// those that stand still first, where the map is made of a kept copy.
    void draw(View& view, const MapPlace& place, std::span<std::uint32_t> casters, const ObjectSet& objects);
    /// Texels that draw() would have drawn.
    [[nodiscard]] std::uint64_t wouldDraw(View view, const MapPlace& place, std::span<const std::uint32_t> casters,
                                          const ObjectSet& objects);
    /// Its map and its kept copy still hold what a view of an earlier plan made of them.
    [[nodiscard]] bool holds(const View& view) const;
    /// A map is one of a light's; after furnish().
    [[nodiscard]] bool owns(std::size_t light, const MapId& map) const;
    /// A view of which nothing is known beforehand: drawn in each frame.
    void drawAnew(View& view);

    void lost(const MapId& id);
    void forget();

private:
    struct Map {
        std::uint32_t generation = 0;
        ContentNumber number = 0; // number of `contents`; 0: it holds nothing
        MapContents contents;
    };
    struct Pages {
        PageSquares maps;
        PageSquares kept;
    };
    /// The maps of a light.
    struct Room {
        MapWish wish;
        std::uint32_t side = 0;       // side of its maps; may be less than wanted
        std::uint64_t looked_at = 0;  // `given_up_` when it found no better
        std::vector<MapPlace> places; // position after position, of each its frustums
        std::vector<PageSquare> squares;
        std::vector<PageSquare> kept_squares;
    };

    void furnish(Room& room);
    [[nodiscard]] bool takeSquares(const MapWish& wish, std::uint32_t side, std::vector<PageSquare>& out);
    void findRoom(Room& room);
    bool takeKept(Room& room);
    void name(Room& room);
    void clear(Room& room);
    MapId freshMap();
    void giveUp(const MapId& id);
    void fill(Map& map, const MapProjection& now, std::span<const std::uint32_t> casters, const ObjectSet& objects);
    struct Due {
        bool map = false;       // is to be drawn
        bool over_kept = false; // there is a kept copy
    };
    Due dueOf(View& view, const MapPlace& place, std::span<const std::uint32_t> casters, const ObjectSet& objects);
    bool dueOverKept(View& view, const MapPlace& place, std::span<const std::uint32_t> casters,
                     const ObjectSet& objects);
    void split(std::span<const std::uint32_t> casters, const ObjectSet& objects);

    LightRows rows_;
    std::vector<Room> rooms_; // by row
    std::vector<Pages> pages_;
    std::vector<Map> maps_; // by MapId::index
    std::vector<std::uint32_t> free_maps_;
    std::uint64_t objects_identity_ = 0;
    std::uint64_t identity_;
    ContentNumber next_number_;
    std::uint64_t given_up_ = 1; // how often squares were
    // Scratch.
    std::vector<PageSquare> larger_;
    // The casters of a view.
    std::vector<std::uint32_t> still_;
    std::vector<Mover> moving_;
};

} // namespace gnomon
