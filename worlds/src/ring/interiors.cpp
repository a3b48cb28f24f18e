// SPDX-License-Identifier: Apache-2.0
// One function a room.
#include "../rng.h"
#include "furnish.h"

#include <array>

namespace gnomon::worlds {

namespace {

constexpr float kHalfTurn = kPi;
constexpr double kAtHull_m = 10.0 - 0.15;                          // for lamps on the hull's wall
constexpr double kEnd = 4.0 - 0.056 - 0.077;                       // tiles: for lamps on the walls between rooms
constexpr double kHung_m = kRail_m - static_cast<double>(kCord_m); // for lamps below rails

/// Turns a lamp to the wall at the room's end with more tiles (side 1) or fewer.
float towardsEnd(int side, bool more)
{
    return (more ? -0.5F : 0.5F) * kHalfTurn * (side < 0 ? 1.0F : -1.0F);
}

} // namespace

void Decorator::bar(bool large)
{
    rail(7.05);
    rail(4.7);
    counter(-2, 2, 7.2);
    for (int i = 0; i < 4; ++i) {
        put(wares_.shelf, -1.5 + i, 8.75, 0.0F);
    }
    for (int i = 0; i < 7; ++i) {
        put(wares_.stool, -1.8 + 0.6 * i, 6.35, 0.4F * static_cast<float>(i));
    }
    for (int i = 0; i < 4; ++i) {
        put(wares_.glasses, -1.6 + 0.95 * i, 7.1, static_cast<float>(i), 1.12);
        lamp(Lamp::pendant, -1.5 + i, 7.05, kHung_m, {Hue::amber, 4.4F, 0.5F});
    }
    tableSet(-2.6, 4.7, 3, 0);
    tableSet(2.5, 4.7, 3, 1);
    lamp(Lamp::pierced, -2.6, 4.7, kHung_m, {Hue::warm, 5.0F, 0.8F});
    lamp(Lamp::pierced, 2.5, 4.7, kHung_m, {large ? Hue::rose : Hue::violet, 5.0F, 0.8F});
    put(wares_.jukebox, 3.55, 7.2, towardsEnd(side_, true));
    mood(3.1, 7.0, 1.0, {Hue::rose, 3.0F, 0.35F});
    mood(0.0, 8.2, 0.5, {Hue::cyan, 4.0F, 0.16F});
    guest(-0.8, 8.1, 0.2F, 1);
    guest(0.9, 8.1, -0.3F, 3);
    plant(wares_.palms[0], -3.5, 8.7, 1);
    if (!large) {
        return;
    }
    tableSet(0.2, 4.1, 2, 2);
    lamp(Lamp::table, 0.34, 4.0, 0.762 + 0.40, {Hue::warm, 3.2F, 0.7F});
    lamp(Lamp::caged, kEnd, 5.2, 2.15, {Hue::amber, 6.0F, 0.55F}, towardsEnd(side_, true));
    for (const double t : {-2.0, 0.0, 3.0}) {
        lamp(Lamp::sconce, t, kAtHull_m, 2.7, {Hue::warm, 4.0F, 0.7F});
    }
    guest(-0.3, 5.6, kHalfTurn + 0.3F, 0);
    guest(1.35, 5.7, kHalfTurn - 0.4F, 2);
    guest(3.2, 5.9, 2.6F, 0);
    plant(wares_.palms[1], 3.45, 3.9, 0, 0.9F);
}

void Decorator::lounge()
{
    rail(5.6);
    rug(-1.9, 6.3, 1.9, 0xB86A3C, 0xE0C48A);
    put(wares_.sofas[0], -1.9, 8.1);
    put(wares_.sofas[1], -1.9, 4.7, kHalfTurn);
    put(wares_.table, -1.9, 6.4, 0.0F, 0.0, 0.72F);
    put(wares_.glasses, -1.85, 6.3, 0.0F, 0.55);
    put(wares_.sofas[2], 1.2, 8.3);
    tableSet(2.2, 5.6, 3, 2);
    lamp(Lamp::drum, -3.3, 7.9, 1.45, {Hue::warm, 6.0F, 0.8F});
    lamp(Lamp::pierced, 2.2, 5.6, kHung_m, {Hue::violet, 5.0F, 0.8F});
    lamp(Lamp::drum, 2.6, 8.5, 1.45, {Hue::amber, 5.0F, 0.7F});
    mood(0.0, 9.0, 0.4, {Hue::violet, 5.0F, 0.20F});
    plant(wares_.palms[1], 0.2, 8.4, 2);
    plant(wares_.fern, -3.5, 4.0, 0);
    plant(wares_.fern, 3.5, 4.0, 1);
    guest(-0.6, 6.4, 1.3F, 1);
}

void Decorator::garden()
{
    const std::array<glm::vec4, 5> trees{glm::vec4(-2.7F, 7.4F, 0.50F, 0.3F),
                                         {-0.6F, 8.1F, 0.42F, 1.9F},
                                         {1.5F, 7.2F, 0.54F, 3.2F},
                                         {3.2F, 8.3F, 0.40F, 4.4F},
                                         {-3.6F, 5.2F, 0.34F, 5.0F}};
    for (const glm::vec4& t : trees) {
        put(wares_.tree, t.x, t.y, t.w, 0.0, t.z);
    }
    Rng rng(rng_seed_, 810);
    for (int i = 0; i < 12; ++i) {
        put(wares_.bush, rng.range(-3.7F, 3.7F), rng.range(6.6F, 9.2F), rng.range(0.0F, kTau), -0.05,
            rng.range(0.45F, 0.75F));
        put(wares_.rock, rng.range(-3.7F, 3.7F), rng.range(5.8F, 8.8F), rng.range(0.0F, kTau), -0.05,
            rng.range(0.14F, 0.32F));
    }
    for (int i = 0; i < 4; ++i) {
        plant(i % 2 == 0 ? wares_.fern : wares_.palms[static_cast<std::size_t>(i) / 2], -3.2 + 2.1 * i, 3.5,
              static_cast<std::uint32_t>(i) % 3);
    }
    put(wares_.bench, -1.9, 4.3);
    put(wares_.bench, 2.1, 4.3);
    lamp(Lamp::bollard, -2.3, 5.7, 0.62, {Hue::warm, 5.5F, 0.8F});
    lamp(Lamp::bollard, 1.0, 5.4, 0.62, {Hue::lime, 5.5F, 0.7F});
    mood(0.4, 7.8, 0.5, {Hue::lime, 6.0F, 0.22F});
    guest(-0.4, 4.7, 0.4F, 2);
}

void Decorator::market()
{
    for (int i = 0; i < 3; ++i) {
        const double t = -2.6 + 2.5 * i;
        const auto which = static_cast<std::size_t>(i);
        put(wares_.stalls[which], t, 5.0 + 0.5 * (i % 2), 0.1F * static_cast<float>(1 - i));
        put(wares_.wares, t, 5.0 + 0.5 * (i % 2), 0.1F * static_cast<float>(1 - i), 0.92);
        guest(t + 0.2, 6.2 + 0.5 * (i % 2), 0.2F, (which + 1) % kFolkKinds);
        put(wares_.drums[which], t - 0.9, 7.6, 0.3F);
        put(wares_.crates[which], t + 0.1, 8.0, 0.2F + static_cast<float>(i));
        put(wares_.crates[(which + 1) % 3], t + 0.15, 8.0, 0.5F - static_cast<float>(i), 0.89, 0.8F);
        plant(wares_.fern, t + 1.2, 3.9, static_cast<std::uint32_t>(i));
    }
    rail(5.6);
    lamp(Lamp::lantern, -1.35, 5.6, kHung_m, {Hue::warm, 7.0F, 0.8F});
    lamp(Lamp::lantern, 1.15, 5.6, kHung_m, {Hue::rose, 6.0F, 0.8F});
    for (const double t : {-1.35, 1.2}) {
        put(wares_.bench, t, t < 0.0 ? 7.0 : 6.9);
    }
    guest(-2.4, 3.9, kHalfTurn, 0);
    guest(0.2, 4.3, kHalfTurn - 0.2F, 2);
}

void Decorator::berths()
{
    for (int i = 0; i < 3; ++i) {
        const double t = -2.7 + 2.3 * i;
        put(wares_.beds[static_cast<std::size_t>(i)], t, 8.3);
        put(wares_.nightstand, t + 0.5, 8.9);
    }
    rug(-0.3, 5.4, 1.3, 0x3E6F9E, 0xC9D6E0);
    put(wares_.lockers[0], 3.3, 8.6);
    put(wares_.lockers[2], -3.5, 4.0, kHalfTurn);
    put(wares_.chairs[1], 2.6, 5.0, 0.7F);
    lamp(Lamp::table, -2.2, 8.9, 0.55 + 0.40, {Hue::warm, 4.0F, 0.8F});
    lamp(Lamp::sconce, 1.2, kAtHull_m, 2.3, {Hue::white, 6.0F, 0.7F});
    mood(0.2, 8.0, 1.6, {Hue::cyan, 7.0F, 0.12F});
    plant(wares_.fern, 3.4, 4.2, 1);
}

void Decorator::lab()
{
    rail(6.2);
    put(wares_.scanner, -2.0, 7.0, 0.5F * kHalfTurn);
    for (int i = 0; i < 3; ++i) {
        put(wares_.consoles[static_cast<std::size_t>(i)], 0.4 + 1.1 * i, 8.5);
    }
    put(wares_.chairs[2], 1.0, 7.4, kHalfTurn);
    put(wares_.lockers[2], -3.4, 8.6);
    guest(-0.9, 6.0, kHalfTurn - 0.4F, 1);
    lamp(Lamp::pendant, 0.0, 6.2, kHung_m, {Hue::white, 7.0F, 0.8F});
    mood(-2.0, 7.0, 1.0, {Hue::cyan, 3.5F, 0.45F});
    plant(wares_.fern, 3.4, 4.2, 2);
}

void Decorator::stores()
{
    Rng rng(rng_seed_, 820);
    for (int i = 0; i < 11; ++i) {
        const double t = -3.3 + 0.62 * i + rng.range(-0.05F, 0.05F);
        const double depth = 7.4 + 1.1 * (i % 2) + rng.range(-0.1F, 0.1F);
        const auto which = static_cast<std::size_t>(rng.below(3));
        put(wares_.crates[which], t, depth, rng.range(-0.25F, 0.25F));
        if (rng.unit() < 0.6F) {
            put(wares_.crates[(which + 1) % 3], t, depth, rng.range(-0.5F, 0.5F), 0.89, 0.85F);
        }
    }
    for (int i = 0; i < 7; ++i) {
        put(wares_.drums[rng.below(3)], -3.4 + 0.38 * i, 4.0 + 0.7 * (i % 2));
    }
    guest(1.6, 5.6, 1.1F, 3);
    lamp(Lamp::caged, -kEnd, 5.8, 2.1, {Hue::amber, 8.0F, 0.8F}, towardsEnd(side_, false));
    lamp(Lamp::sconce, 1.9, kAtHull_m, 2.5, {Hue::warm, 6.5F, 0.8F});
}

void Decorator::workshop()
{
    rail(7.4);
    put(wares_.workbench, -2.0, 8.3);
    put(wares_.workbench, 0.8, 8.3);
    put(wares_.boiler, 3.2, 7.9, 0.4F);
    put(wares_.crates[0], -3.4, 4.4, 0.3F);
    put(wares_.drums[2], -2.8, 4.2);
    put(wares_.drums[0], 2.4, 4.6);
    put(wares_.lockers[1], 2.0, 8.7);
    guest(-1.5, 7.2, kHalfTurn, 0);
    lamp(Lamp::pendant, -0.6, 7.4, kHung_m, {Hue::warm, 7.0F, 0.85F});
}

void Decorator::engine()
{
    put(wares_.turbine, -1.0, 7.0);
    put(wares_.boiler, 2.2, 8.2, -0.3F);
    put(wares_.boiler, 3.1, 6.6, 0.5F);
    put(wares_.consoles[2], 1.2, 4.3, kHalfTurn);
    guest(1.0, 5.4, kHalfTurn, 3);
    lamp(Lamp::caged, kEnd, 5.0, 2.2, {Hue::red, 7.0F, 0.7F}, towardsEnd(side_, true));
    lamp(Lamp::caged, -kEnd, 6.0, 2.2, {Hue::amber, 7.0F, 0.7F}, towardsEnd(side_, false));
    mood(-1.0, 8.6, 0.5, {Hue::red, 4.0F, 0.35F});
}

} // namespace gnomon::worlds
