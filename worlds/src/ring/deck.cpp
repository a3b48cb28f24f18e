// SPDX-License-Identifier: Apache-2.0
#include "deck.h"

#include "../mesh_maker.h"
#include "../rng.h"
#include "../scene_maker.h"
#include "bent.h"

#include <glm/common.hpp>

#include <array>
#include <cmath>
#include <numbers>
#include <string>

namespace gnomon::worlds {

namespace {

using World = RingWorld;

constexpr std::array<std::array<Room, 2>, World::sectors> kRooms{{
    {Room::bar, Room::lounge},
    {Room::garden, Room::market},
    {Room::berths, Room::lab},
    {Room::stores, Room::garden},
    {Room::engine, Room::workshop},
    {Room::market, Room::berths},
    {Room::lab, Room::bar},
    {Room::lounge, Room::stores},
    {Room::garden, Room::berths},
    {Room::workshop, Room::engine},
    {Room::berths, Room::market},
    {Room::lab, Room::stores},
}};

int sectorOf(int tile)
{
    constexpr int kHalf = World::sector_tiles / 2;
    return ((tile + kHalf + World::tiles_around) / World::sector_tiles) % World::sectors;
}

/// Column 0 is at z = -half_deck_m.
glm::vec4 floorColour(int tile, int column, std::uint32_t seed)
{
    constexpr int kMiddle = World::tiles_across / 2;
    const int side = column < kMiddle ? -1 : 1;
    const int from_middle = std::abs(column - kMiddle);
    const float tone = 0.93F + 0.14F * hashUnit(tile, column, seed);
    const glm::vec4 tint(tone, tone, tone, 1.0F);
    if (from_middle == 0) {
        return (tile & 1) != 0 ? rgb(0x7E8C93) * tint : rgb(0x8E9AA0) * tint; // the promenade's runner
    }
    if (from_middle == 1) {
        return rgb(0xA9A096) * tint;
    }
    const RoomColours colours = coloursOf(roomOf(sectorOf(tile), side));
    const bool checked = ((tile + column) & 1) != 0;
    return (from_middle == 2 ? colours.trim : colours.floor) * tint * (checked ? 1.0F : 0.84F);
}

void addFloorTile(Scene& scene, const RingPalette& palette, int tile, int column, std::uint32_t seed)
{
    const glm::vec4 colour = floorColour(tile, column, seed);
    const double width_m = 2.0 * World::half_deck_m / World::tiles_across;
    const double from_m = -World::half_deck_m + width_m * column;
    BentPart part;
    part.patch(4, 4, [&](double u, double v) {
        const double t = tile + u;
        const double z = from_m + width_m * v;
        const float worn = 0.94F + 0.10F * noise(glm::vec2(t * 1.7, z * 0.85), seed + 1, 0);
        return BentVertex{World::place(t, 0.0, z), World::up(t), glm::vec2(0.5 * t, 0.5 * (z + 9.0) / width_m),
                          colour * glm::vec4(worn, worn, worn, 1.0F)};
    });
    const std::string name = "deck/" + std::to_string(tile) + "," + std::to_string(column);
    const std::uint32_t node = addNode(scene, name, addMesh(scene, part.take(name, palette.deck)), {});
    scene.nodes[node].casts = false;
}

/// The rounding between deck and wall, and the wall.
void addHullTiles(Scene& scene, const RingPalette& palette, int tile, int side)
{
    constexpr double kRound_m = World::half_width_m - World::half_deck_m;
    const RoomColours colours = coloursOf(roomOf(sectorOf(tile), side));
    const auto add = [&](const std::string& what, BentPart& part) {
        const std::string name = "hull/" + what + (side < 0 ? "-" : "+") + std::to_string(tile);
        const std::uint32_t node = addNode(scene, name, addMesh(scene, part.take(name, palette.wall)), {});
        scene.nodes[node].casts = false;
    };
    BentPart foot;
    foot.patch(4, 6, [&](double u, double v) {
        const double a = v * 0.5 * std::numbers::pi;
        const double t = tile + u;
        // At both ends what the neighbours have, to the bit.
        const double z = v == 1.0 ? World::half_width_m : World::half_deck_m + kRound_m * std::sin(a);
        const double h = v == 1.0 ? kRound_m : kRound_m * (1.0 - std::cos(a));
        const glm::vec3 normal =
            v == 1.0 ? glm::vec3(0.0F, 0.0F, -side)
                     : World::up(t) * static_cast<float>(std::cos(a)) + glm::vec3(0.0, 0.0, -side * std::sin(a));
        return BentVertex{World::place(t, h, side * z), normal, glm::vec2(t, 0.03 + 0.1 * (1.0 - v)),
                          glm::mix(colours.floor, colours.wall, static_cast<float>(v)) * 0.9F};
    });
    add("foot", foot);
    BentPart wall;
    wall.patch(4, 4, [&](double u, double v) {
        const double t = tile + u;
        const double h = v == 0.0 ? kRound_m : kRound_m + (World::hull_m - kRound_m) * v;
        const glm::vec4 high = glm::mix(colours.wall, rgb(0x59657C), 0.75F);
        return BentVertex{World::place(t, h, side * World::half_width_m),
                          {0.0F, 0.0F, static_cast<float>(-side)},
                          glm::vec2(t, -v),
                          glm::mix(colours.wall, high, static_cast<float>(v))};
    });
    add("wall", wall);
}

/// The rail on the hull's wall, four tiles at a time.
void addRail(Scene& scene, const RingPalette& palette, int tile, int side)
{
    const double inner = World::half_width_m - 0.28;
    const double outer = World::half_width_m + 0.30;
    const Extent across = side > 0 ? Extent{inner, outer} : Extent{-outer, -inner};
    const glm::vec4 steel = rgb(0x8C93A0);
    BentPart part;
    part.box({{static_cast<double>(tile), tile + 4.0}, {World::hull_m - 0.02, World::hull_m + 0.30}, across},
             {steel, steel, steel}, 16);
    const std::string name = "rail/" + std::to_string(tile) + (side < 0 ? "-" : "+");
    const std::uint32_t node = addNode(scene, name, addMesh(scene, part.take(name, palette.metal)), {});
    scene.nodes[node].casts = false;
}

} // namespace

Room roomOf(int sector, int side)
{
    return kRooms[static_cast<std::size_t>(sector)][side < 0 ? 0 : 1];
}

bool isWalled(Room room)
{
    return room != Room::garden && room != Room::market;
}

RoomColours coloursOf(Room room)
{
    const auto of = [](std::uint32_t floor, std::uint32_t trim, std::uint32_t wall) {
        return RoomColours{rgb(floor), rgb(trim), rgb(wall)};
    };
    switch (room) {
    case Room::bar:
        return of(0x9A6244, 0x7A4230, 0xA0433C);
    case Room::lounge:
        return of(0x7B5A86, 0x5E4269, 0x8A6699);
    case Room::garden:
        return of(0x7D9A55, 0x9A8A66, 0x6E9474);
    case Room::market:
        return of(0xB08C58, 0x8E6A40, 0xB58A4C);
    case Room::berths:
        return of(0x6F8FB0, 0x55708E, 0x7FA0BE);
    case Room::lab:
        return of(0xC4CFCB, 0x8FB0AA, 0xBFD2CC);
    case Room::stores:
        return of(0x8E8672, 0xB99A3C, 0x9A9078);
    case Room::workshop:
        return of(0x8A7A70, 0xB86A34, 0xA88A72);
    case Room::engine:
        return of(0x6A7076, 0x8E4438, 0x77808C);
    }
    return of(0x808080, 0x808080, 0x808080);
}

void addDeck(Scene& scene, const RingPalette& palette, std::uint64_t seed)
{
    const std::uint32_t noise_seed = hash(static_cast<std::uint32_t>(seed) + 71U);
    for (int tile = 0; tile < World::tiles_around; ++tile) {
        for (int column = 0; column < World::tiles_across; ++column) {
            addFloorTile(scene, palette, tile, column, noise_seed);
        }
        for (const int side : {-1, 1}) {
            addHullTiles(scene, palette, tile, side);
            if (tile % 4 == 0) {
                addRail(scene, palette, tile, side);
            }
        }
    }
}

} // namespace gnomon::worlds
