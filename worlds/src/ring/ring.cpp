// SPDX-License-Identifier: Apache-2.0
// A space station bent into a ring, the setting in which T. Forsyth, "Extremely Practical Shadows", GDC 2006, gave
// shadows to StarTopia (2001): many point lights inside the objects that they shine from, over a world of tiles.
#include "worlds/ring.h"

#include "../rng.h"
#include "bent.h"
#include "deck.h"
#include "folk.h"
#include "furnish.h"
#include "lamps.h"
#include "palette.h"

#include "scene/state.h"

#include <array>
#include <cmath>
#include <memory>

namespace gnomon::worlds {

namespace {

constexpr double kReactorTile = 8.0;

/// Lanterns under the beams, the reactor in the middle of the promenade.
void addPromenadeLamps(LampMaker& lamps)
{
    constexpr std::array<Hue, 3> kHuesInTurn{Hue::warm, Hue::white, Hue::amber};
    for (int sector = 0; sector < RingWorld::sectors; ++sector) {
        const double t = RingWorld::sector_tiles * sector - RingWorld::sector_tiles / 2.0;
        const Shine shine{kHuesInTurn[static_cast<std::size_t>(sector) % 3], 9.5F, 0.8F};
        lamps.add(Lamp::lantern, onRing(t, 0.0, 0.3F * static_cast<float>(sector), 5.1), shine);
    }
    lamps.add(Lamp::reactor, onRing(kReactorTile, 0.0, 0.0F, static_cast<double>(footOf(Lamp::reactor))),
              {Hue::cyan, 12.0F, 0.9F});
}

glm::quat turned(const glm::vec3& axis, double turns)
{
    const double once = turns - std::floor(turns);
    const auto half = static_cast<float>(0.5 * once);
    const float s = sineOfTurns(half);
    return {cosineOfTurns(half), axis.x * s, axis.y * s, axis.z * s};
}

void addRingViews(Scene& scene)
{
    const auto at = [](double tiles, double height_m, double across_m) {
        return RingWorld::place(tiles, height_m, across_m);
    };
    scene.views = {
        {.name = "deck", .eye = at(-3.8, 2.25, 0.8), .target = at(4.0, 2.7, -0.4), .fov_y_rad = 1.0F},
        {.name = "bar", .eye = at(-3.8, 2.05, -5.3), .target = at(1.2, 1.2, -6.3), .fov_y_rad = 0.95F},
        {.name = "overview", .eye = {0.0F, 32.0F, 23.0F}, .target = {0.0F, 4.6F, -1.6F}, .fov_y_rad = 0.84F},
        {.name = "duel", .eye = at(4.6, 1.25, 0.9), .target = at(8.0, 1.6, 0.0), .fov_y_rad = 0.85F},
    };
}

} // namespace

Scene makeRing(std::uint64_t seed)
{
    Scene scene;
    scene.name = "ring";
    const RingPalette palette = addRingPalette(scene);
    addDeck(scene, palette, seed);
    addRooms(scene, palette);
    addTrim(scene, palette);
    addSpace(scene);
    const Wares wares = addWares(scene, palette);
    LampMaker lamps(scene, palette);
    const auto folk = std::make_shared<const Folk>(scene, palette, seed);
    addPromenadeLamps(lamps);
    for (int sector = 0; sector < RingWorld::sectors; ++sector) {
        for (const int side : {-1, 1}) {
            Decorator(scene, palette, wares, lamps, *folk, sector, side).furnish();
        }
    }
    // Some look at the reactor, before which the view `duel` stands.
    constexpr std::array<glm::vec3, 5> kLookers{glm::vec3(6.75F, 0.75F, 0.0F),
                                                {6.55F, -0.75F, 1.0F},
                                                {7.45F, 2.3F, 2.0F},
                                                {9.2F, -0.7F, 3.0F},
                                                {7.35F, -2.3F, 3.0F}};
    for (const glm::vec3& p : kLookers) {
        const double ahead_m = (kReactorTile - p.x) * RingWorld::tile_m;
        const auto yaw = static_cast<float>(std::atan2(ahead_m, static_cast<double>(-p.y)));
        folk->addStanding(scene, onRing(p.x, p.y, yaw), static_cast<std::uint32_t>(p.z));
    }
    scene.environment.sky_zenith = {0.0022F, 0.0036F, 0.0095F};
    scene.environment.sky_horizon = {0.0070F, 0.0085F, 0.0165F};
    scene.environment.ground = {0.0044F, 0.0038F, 0.0052F};
    scene.environment.ambient = 5.0F; // stands for the lights that nobody sees
    scene.environment.exposure = 1.2F;
    addRingViews(scene);
    scene.procedural = [folk, rings = lamps.rings()](double time_s, std::vector<Node>& nodes) {
        folk->pose(time_s, nodes);
        nodes[rings].transform.rotation = turned({0, 0, 1}, 0.04 * time_s + 0.16);
        nodes[rings + 1].transform.rotation = turned({1, 0, 0}, 0.06 * time_s + 0.14);
        nodes[rings + 2].transform.rotation = turned({0, 0, 1}, 0.09 * time_s + 0.12);
    };
    scene.procedural(0.0, scene.nodes);
    finishScene(scene);
    return scene;
}

} // namespace gnomon::worlds
