// SPDX-License-Identifier: Apache-2.0
#include "../mesh_maker.h"
#include "../rng.h"
#include "../scene_maker.h"
#include "bent.h"
#include "deck.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

namespace gnomon::worlds {

namespace {

using World = RingWorld;

constexpr double kWall_m = 2.8;   // height
constexpr double kThick_m = 0.22; // thick enough for every map's bias
constexpr double kBelow_m = -0.1; // no light passes between wall and deck
constexpr double kDoor_m = 2.25;
constexpr double kCut_m = 1.05;     // the height that is left of a front that is cut away
constexpr double kPostCut_m = 1.22; // and of its posts: the top of their rings

const glm::vec4 kSteel = rgb(0x9AA0AA);
const glm::vec4 kOutside = rgb(0x9C958C); // the outside of rooms, as the promenade sees them

/// The front of a room, a letter a tile: solid, window, door, grille, low wall, nothing.
std::string_view frontOf(Room room)
{
    switch (room) {
    case Room::bar:
        return "SW.DDWWS";
    case Room::lounge:
        return "SLLDDLLS";
    case Room::berths:
        return "SWSDSWDS";
    case Room::lab:
        return "WWDSWWDW";
    case Room::stores:
        return "GGSDDSGG";
    case Room::workshop:
        return "SGDDGSWS";
    case Room::engine:
        return "GGDGGGDG";
    case Room::garden:
    case Room::market:
        break;
    }
    return "........";
}

/// Cuts a node whose vertices are in world space down to `height_m` above the deck at tile `t`.
void cutDown(Node& node, double t, double height_m)
{
    const glm::vec3 up = World::up(t);
    node.clip_planes[0] = glm::vec4(-up, glm::dot(up, World::place(t, height_m, 0.0)));
}

/// A tile's length of wall along the ring, its middle at `across_m`.
class Panel {
public:
    Panel(int tile, double across_m, const BentPaint& paint) : tile_(tile), across_m_(across_m), paint_(paint) {}

    /// `from` to `to` are shares of the tile.
    void slab(double from, double to, double low_m, double high_m, double thick_m = kThick_m)
    {
        constexpr double kDado_m = 0.9; // below, walls are dark
        const glm::vec4 dim(0.45F, 0.45F, 0.48F, 1.0F);
        const int pieces = to - from > 0.5 ? 2 : 1;
        const auto part = [&](double bottom_m, double top_m, const BentPaint& paint) {
            if (bottom_m < top_m) {
                part_.box(
                    {{tile_ + from, tile_ + to}, {bottom_m, top_m}, {across_m_ - thick_m / 2, across_m_ + thick_m / 2}},
                    paint, pieces);
            }
        };
        part(low_m, std::min(high_m, kDado_m), {paint_.low * dim, paint_.high * dim, paint_.edges * dim});
        part(std::max(low_m, kDado_m), high_m, paint_);
    }
    void trim(double from, double to, double low_m, double high_m, double thick_m)
    {
        part_.box({{tile_ + from, tile_ + to}, {low_m, high_m}, {across_m_ - thick_m / 2, across_m_ + thick_m / 2}},
                  {kSteel, kSteel, kSteel}, to - from > 0.5 ? 2 : 1);
    }
    void window()
    {
        slab(0.0, 1.0, kBelow_m, 0.85);
        slab(0.0, 1.0, 2.2, kWall_m);
        for (const double at : {0.0, 0.94}) {
            slab(at, at + 0.06, 0.85, 2.2);
        }
        for (const double at : {0.33, 0.64}) {
            trim(at, at + 0.03, 0.85, 2.2, 0.07);
        }
        trim(0.06, 0.94, 1.50, 1.56, 0.06);
        trim(0.0, 1.0, 0.80, 0.88, kThick_m + 0.12); // the sill
    }
    void door() { slab(0.0, 1.0, kDoor_m, kWall_m); }
    void grille()
    {
        slab(0.0, 1.0, kBelow_m, 0.45);
        slab(0.0, 1.0, 2.4, kWall_m);
        for (int i = 0; i < 9; ++i) {
            trim(0.03 + 0.105 * i, 0.03 + 0.105 * i + 0.04, 0.45, 2.4, 0.09);
        }
    }
    void low()
    {
        slab(0.0, 1.0, kBelow_m, 0.8);
        trim(0.0, 1.0, 0.8, 0.9, kThick_m + 0.14);
    }
    [[nodiscard]] BentPart& part() { return part_; }

private:
    int tile_;
    double across_m_;
    BentPaint paint_;
    BentPart part_;
};

std::uint32_t addPart(Scene& scene, const std::string& name, BentPart& part, std::uint32_t material)
{
    return addNode(scene, name, addMesh(scene, part.take(name, material)), {});
}

/// A bar along the edge at which a tile's wall is cut, where it is not open.
void addCutEdge(Scene& scene, const RingPalette& palette, int tile, int side)
{
    const glm::vec4 mark = rgb(0xD9A441);
    const double z = side * World::promenade_m;
    const double half_m = kThick_m / 2 + 0.03;
    BentPart part;
    part.box({{static_cast<double>(tile), tile + 1.0}, {kCut_m - 0.03, kCut_m + 0.04}, {z - half_m, z + half_m}},
             {mark, mark, mark}, 2);
    (void)addPart(scene, std::string("wall/cut ") + (side < 0 ? "-" : "+") + std::to_string(tile), part, palette.metal);
}

void addPanel(Scene& scene, const RingPalette& palette, int tile, int side, Room room, char kind, bool is_cut)
{
    if (kind == '.') {
        return;
    }
    const glm::vec4 inside = coloursOf(room).wall;
    const BentPaint paint = side > 0 ? BentPaint{kOutside, inside, kOutside} : BentPaint{inside, kOutside, kOutside};
    Panel panel(tile, side * World::promenade_m, paint);
    switch (kind) {
    case 'S':
        panel.slab(0.0, 1.0, kBelow_m, kWall_m);
        break;
    case 'W':
        panel.window();
        break;
    case 'D':
        panel.door();
        break;
    case 'G':
        panel.grille();
        break;
    default:
        panel.low();
        break;
    }
    if (kind != 'L') {
        panel.trim(0.0, 1.0, kWall_m, kWall_m + 0.12, kThick_m + 0.10);
    }
    const std::string name = std::string("wall/") + (side < 0 ? "-" : "+") + std::to_string(tile);
    const std::uint32_t node = addPart(scene, name, panel.part(), palette.wall);
    if (is_cut) {
        cutDown(scene.nodes[node], tile + 0.5, kCut_m);
        if (kind != 'D') {
            addCutEdge(scene, palette, tile, side);
        }
    }
}

/// From the promenade to the hull at tile `t`, in pieces of a tile's width. The last one goes into the hull.
void addCrossWall(Scene& scene, const RingPalette& palette, int t, int side, const BentPaint& paint)
{
    constexpr double kHalf = 0.5 * kThick_m / World::tile_m;
    constexpr double kCoping = kHalf + 0.05 / World::tile_m;
    for (int piece = 0; piece < 3; ++piece) {
        const double from = World::promenade_m + 2.0 * piece;
        const double to = piece == 2 ? World::half_width_m + 0.05 : from + 2.0;
        const Extent across = side > 0 ? Extent{from, to} : Extent{-to, -from};
        BentPart part;
        part.box({{t - kHalf, t + kHalf}, {kBelow_m, kWall_m}, across}, paint, 1);
        part.box({{t - kCoping, t + kCoping}, {kWall_m, kWall_m + 0.12}, across}, {kSteel, kSteel, kSteel}, 1);
        const std::string name =
            std::string("wall/across ") + (side < 0 ? "-" : "+") + std::to_string(t) + "," + std::to_string(piece);
        (void)addPart(scene, name, part, palette.wall);
    }
}

std::uint32_t addPostMesh(Scene& scene, const RingPalette& palette)
{
    MeshMaker maker;
    Part& metal = maker.with(palette.metal);
    metal.colour = rgb(0x868D99);
    metal.lathe({{0.30F, -0.1F},
                 {0.30F, 0.10F},
                 {0.22F, 0.22F},
                 {0.20F, 0.30F},
                 {0.20F, 2.70F},
                 {0.26F, 2.82F},
                 {0.28F, 2.95F},
                 {0.20F, 3.06F},
                 {0.0F, 3.10F}},
                12, false, true);
    metal.colour = rgb(0xC98B3A);
    metal.lathe({{0.215F, 1.1F}, {0.215F, 1.22F}}, 12, false, true);
    return addMesh(scene, maker.take("post"));
}

/// An arch over the whole deck that stands on the hull's walls.
std::uint32_t addBeamMesh(Scene& scene, const RingPalette& palette)
{
    constexpr int kPieces = 14;
    MeshMaker maker;
    Part& metal = maker.with(palette.metal);
    const auto on = [](int i) {
        const float z = 10.1F * (2.0F * static_cast<float>(i) / kPieces - 1.0F);
        return glm::vec3(0.0F, 4.7F + 1.6F * (1.0F - z * z / 102.01F), z);
    };
    metal.colour = rgb(0x7C8492);
    for (int i = 0; i < kPieces; ++i) {
        const glm::vec3 a = on(i);
        const glm::vec3 b = on(i + 1);
        metal.beam(a, b, 0.22F, false);
        metal.beam(a + glm::vec3(0, 0.55F, 0), b + glm::vec3(0, 0.55F, 0), 0.12F, false);
        metal.beam(a, b + glm::vec3(0, 0.55F, 0), 0.07F, false);
        metal.beam(b, b + glm::vec3(0, 0.55F, 0), 0.07F, false);
    }
    for (const float z : {-9.86F, 9.86F}) {
        metal.box({-0.26F, 0.9F, z - 0.26F}, {0.26F, 5.4F, z + 0.26F}, 0.8F, true);
    }
    return addMesh(scene, maker.take("beam"));
}

bool needsPost(Room room, int i)
{
    const std::string_view front = frontOf(room);
    const char before = i == 0 ? '.' : front[static_cast<std::size_t>(i) - 1];
    const char after = i == World::sector_tiles ? '.' : front[static_cast<std::size_t>(i)];
    return before != after && (before == 'D' || after == 'D' || before == '.' || after == '.');
}

void addPosts(Scene& scene, std::uint32_t mesh, int sector, int side)
{
    const Room room = roomOf(sector, side);
    const int first = sector * World::sector_tiles - World::sector_tiles / 2;
    const Room previous = roomOf((sector + World::sectors - 1) % World::sectors, side);
    for (int i = 0; i < World::sector_tiles; ++i) {
        const bool corner = i == 0 && (isWalled(room) || isWalled(previous));
        if (corner || (isWalled(room) && i > 0 && needsPost(room, i))) {
            const std::string name = std::string("post/") + (side < 0 ? "-" : "+") + std::to_string(first + i);
            const std::uint32_t node = addNode(scene, name, mesh, onRing(first + i, side * World::promenade_m));
            if (isFrontCutAway(sector, side) && i > 0) { // corners stand
                scene.nodes[node].clip_planes[0] = {0.0F, -1.0F, 0.0F, static_cast<float>(kPostCut_m)};
            }
        }
    }
}

} // namespace

bool isFrontCutAway(int sector, int side)
{
    return sector == World::sectors - 1 && side < 0;
}

void addRooms(Scene& scene, const RingPalette& palette)
{
    const std::uint32_t post = addPostMesh(scene, palette);
    const std::uint32_t beam = addBeamMesh(scene, palette);
    for (int sector = 0; sector < World::sectors; ++sector) {
        const int first = sector * World::sector_tiles - World::sector_tiles / 2;
        addNode(scene, "beam/" + std::to_string(sector), beam, onRing(first, 0.0));
        for (const int side : {-1, 1}) {
            const Room room = roomOf(sector, side);
            const Room previous = roomOf((sector + World::sectors - 1) % World::sectors, side);
            const std::string_view front = frontOf(room);
            for (int i = 0; i < World::sector_tiles; ++i) {
                addPanel(scene, palette, first + i, side, room, front[static_cast<std::size_t>(i)],
                         isFrontCutAway(sector, side));
            }
            if (isWalled(room) || isWalled(previous)) {
                addCrossWall(scene, palette, first, side, {coloursOf(previous).wall, coloursOf(room).wall, kOutside});
            }
            addPosts(scene, post, sector, side);
        }
    }
}

} // namespace gnomon::worlds
