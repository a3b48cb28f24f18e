// SPDX-License-Identifier: Apache-2.0
// A space station bent into a ring, after T. Forsyth 2006, who gave shadows to StarTopia (2001): many point lights
// inside lamps that shade them, over a deck of tiles. Each tile of deck, hull and walls is an object of its own
// ("deck/…", "hull/…", "wall/…"), and neighbours share the vertices and normals of their border. "lamp/…" are lamps;
// each has a child "…/bulb" and a child that is its light. Lights "mood …" cast no shadow. "walker/…" go round the
// promenade. Views `deck` (along the promenade), `bar` (inside one), `overview` (from high up) and `duel` (into a
// lamp).
#pragma once

#include <glm/vec3.hpp>

namespace gnomon::worlds {

/// The world `ring`: a deck bent around an axis that is parallel to z and passes through (0, radius_m, 0), with walls
/// along both borders. A point of it is given by tiles along the ring (0 lies below the axis, + is towards +x, and 96
/// are all the way round), metres across (z) and metres of height over the deck, towards the axis.
struct RingWorld {
    static constexpr double radius_m = 30.0;
    static constexpr int tiles_around = 96;
    static constexpr double tile_m = 1.9634954084936207; // along the deck: 2 pi radius_m / tiles_around
    static constexpr int tiles_across = 9;
    static constexpr double half_deck_m = 9.0;   // beyond it the hull rounds up into a wall
    static constexpr double half_width_m = 10.0; // from the middle to the hull's wall
    static constexpr double hull_m = 4.6;        // height of the hull's wall
    static constexpr int sector_tiles = 8;       // sector i is centred on tile 8 i; rooms lie on both its sides
    static constexpr int sectors = tiles_around / sector_tiles;
    static constexpr double promenade_m = 3.0; // from the middle to the rooms

    /// The angle about the axis, from straight below it; [-pi, pi).
    [[nodiscard]] static double angleOf(double tiles);
    [[nodiscard]] static glm::vec3 place(double tiles, double height_m, double across_m);
    /// The direction towards the axis, unit.
    [[nodiscard]] static glm::vec3 up(double tiles);
    /// The direction along the ring, unit.
    [[nodiscard]] static glm::vec3 along(double tiles);
};

} // namespace gnomon::worlds
