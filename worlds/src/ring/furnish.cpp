// SPDX-License-Identifier: Apache-2.0
#include "furnish.h"

#include "../mesh_maker.h"
#include "../rng.h"
#include "../scene_maker.h"
#include "bent.h"
#include "deck.h"

#include <glm/common.hpp>

#include <cmath>
#include <string>

namespace gnomon::worlds {

namespace {

using World = RingWorld;

} // namespace

Transform Decorator::spot(double tiles, double depth_m, float turn_rad, double height_m, float scale) const
{
    const float facing = side_ > 0 ? kPi : 0.0F;
    return onRing(World::sector_tiles * sector_ + tiles, side_ * depth_m, facing + turn_rad, height_m, scale);
}

void Decorator::put(std::uint32_t mesh, double tiles, double depth_m, float turn_rad, double height_m, float scale)
{
    const std::string name =
        "room/" + std::to_string(rng_seed_) + "/" + std::to_string(put_++) + " " + scene_.meshes[mesh].name;
    addNode(scene_, name, mesh, spot(tiles, depth_m, turn_rad, height_m, scale));
}

void Decorator::lamp(Lamp lamp, double tiles, double depth_m, double height_m, const Shine& shine, float turn_rad)
{
    lamps_.add(lamp, spot(tiles, depth_m, turn_rad, height_m, 1.0F), shine);
}

void Decorator::mood(double tiles, double depth_m, double height_m, const Shine& shine)
{
    lamps_.addMood(World::place(World::sector_tiles * sector_ + tiles, height_m, side_ * depth_m), shine);
}

void Decorator::guest(double tiles, double depth_m, float turn_rad, std::uint32_t kind)
{
    folk_.addStanding(scene_, spot(tiles, depth_m, turn_rad, 0.0, 1.0F), kind);
}

void Decorator::plant(std::uint32_t green, double tiles, double depth_m, std::uint32_t pot, float scale)
{
    put(wares_.planters[pot], tiles, depth_m, 0.0F, 0.0, scale);
    put(green, tiles, depth_m, 1.7F * static_cast<float>(put_), 0.04, scale);
}

void Decorator::tableSet(double tiles, double depth_m, int chairs, std::uint32_t chair)
{
    put(wares_.table, tiles, depth_m);
    for (int i = 0; i < chairs; ++i) {
        const float a = kTau * (static_cast<float>(i) + 0.2F) / static_cast<float>(chairs);
        const double along = 0.92 * std::sin(a) * side_ * -1.0 / World::tile_m;
        put(wares_.chairs[chair], tiles + along, depth_m - 0.92 * std::cos(a), a + kPi);
    }
    put(wares_.glasses, tiles + 0.06, depth_m + 0.1, 0.6F, 0.762);
}

void Decorator::rail(double depth_m)
{
    constexpr double kHalf_m = 0.045;
    const double middle = World::sector_tiles * sector_;
    const glm::vec4 steel = rgb(0x5A626E);
    BentPart part;
    part.box({{middle - 4.0, middle + 4.0},
              {kRail_m, kRail_m + 2.0 * kHalf_m},
              {side_ * depth_m - kHalf_m, side_ * depth_m + kHalf_m}},
             {steel, steel, steel}, 32);
    for (const double t : {-3.97, 3.97}) { // on the walls
        part.box({{middle + t - 0.04, middle + t + 0.04},
                  {2.9, kRail_m},
                  {side_ * depth_m - kHalf_m, side_ * depth_m + kHalf_m}},
                 {steel, steel, steel}, 1);
    }
    const std::string name = "rail/" + std::to_string(rng_seed_) + "," + std::to_string(put_++);
    addNode(scene_, name, addMesh(scene_, part.take(name, palette_.metal)), {});
}

void Decorator::counter(int from, int to, double depth_m)
{
    const glm::vec4 wood = rgb(0x7A4A30);
    const glm::vec4 top = rgb(0xB98352);
    const glm::vec4 brass = rgb(0xC9A24E);
    const int middle = World::sector_tiles * sector_;
    const auto across = [&](double low, double high) {
        return side_ > 0 ? Extent{low, high} : Extent{-high, -low};
    };
    for (int i = from; i < to; ++i) {
        const Extent tile{static_cast<double>(middle + i), middle + i + 1.0};
        BentPart part;
        part.box({tile, {-0.1, 0.12}, across(depth_m - 0.24, depth_m + 0.30)},
                 {rgb(0x3A2A22), rgb(0x3A2A22), rgb(0x3A2A22)});
        part.box({tile, {0.12, 1.04}, across(depth_m - 0.30, depth_m + 0.30)}, {wood, wood, wood});
        part.box({tile, {0.74, 0.80}, across(depth_m - 0.34, depth_m + 0.2)}, {brass, brass, brass});
        part.box({tile, {1.04, 1.12}, across(depth_m - 0.46, depth_m + 0.40)}, {top, top, top});
        const std::string name = "counter/" + std::to_string(rng_seed_) + "," + std::to_string(i);
        addNode(scene_, name, addMesh(scene_, part.take(name, palette_.common.wood)), {});
    }
}

void Decorator::rug(double tiles, double depth_m, double radius_m, std::uint32_t srgb, std::uint32_t border)
{
    BentPart part;
    part.patch(40, 8, [&](double u, double v) {
        const double a = 2.0 * std::acos(-1.0) * u;
        const double r = radius_m * v;
        const double t = World::sector_tiles * sector_ + tiles + r * std::sin(a) / World::tile_m;
        const bool edge = v > 0.80 || (v > 0.45 && v < 0.60);
        return BentVertex{World::place(t, 0.014, side_ * depth_m + r * std::cos(a)),
                          World::up(t),
                          {0.0F, 0.0F},
                          rgb(edge ? border : srgb)};
    });
    const std::string name = "rug/" + std::to_string(rng_seed_);
    const std::uint32_t node = addNode(scene_, name, addMesh(scene_, part.take(name, palette_.common.plain)), {});
    scene_.nodes[node].casts = false; // it lies flat
}

void Decorator::promenade()
{
    const int green = static_cast<int>(rng_seed_ % 3);
    for (const double t : {-3.55, 3.55}) {
        const std::uint32_t mesh = t < 0.0 ? wares_.fern : wares_.palms[rng_seed_ % 2];
        plant(mesh, t, World::promenade_m - 0.48, static_cast<std::uint32_t>(green), 0.62F);
    }
}

void Decorator::furnish()
{
    if (isWalled(roomOf(sector_, side_))) {
        promenade();
    }
    switch (roomOf(sector_, side_)) {
    case Room::bar:
        return bar(sector_ == 0);
    case Room::lounge:
        return lounge();
    case Room::garden:
        return garden();
    case Room::market:
        return market();
    case Room::berths:
        return berths();
    case Room::lab:
        return lab();
    case Room::stores:
        return stores();
    case Room::workshop:
        return workshop();
    case Room::engine:
        return engine();
    }
}

} // namespace gnomon::worlds
