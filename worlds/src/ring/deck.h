// SPDX-License-Identifier: Apache-2.0
// The structure of the world `ring`: deck and hull in tiles, rooms on both sides of the promenade.
#pragma once

#include "palette.h"

#include <glm/vec4.hpp>

#include <cstdint>

namespace gnomon::worlds {

enum class Room : std::uint8_t { bar, lounge, garden, market, berths, lab, stores, workshop, engine };

/// The room of a sector's side, -1 or 1 (of z).
[[nodiscard]] Room roomOf(int sector, int side);
/// Whether the room has walls: gardens and markets are open.
[[nodiscard]] bool isWalled(Room room);

/// Whether clip planes cut away the upper part of the room's front and the things that hang there. The game did so
/// where a wall stood between the camera and a room; the view `overview` looks into it.
[[nodiscard]] bool isFrontCutAway(int sector, int side);

struct RoomColours {
    glm::vec4 floor;
    glm::vec4 trim; // the trim of the floor, towards the promenade
    glm::vec4 wall;
};
[[nodiscard]] RoomColours coloursOf(Room room);

/// Deck and hull cast nothing: they enclose a convex space, so they stand between no two points of it.
void addDeck(Scene& scene, const RingPalette& palette, std::uint64_t seed);
/// Walls with doors and windows, posts where they meet, and beams over the deck.
void addRooms(Scene& scene, const RingPalette& palette);
/// Portholes in the hull, signs over the promenade, lines of light in the deck.
void addTrim(Scene& scene, const RingPalette& palette);
/// Stars and a planet, beyond the hull.
void addSpace(Scene& scene);

} // namespace gnomon::worlds
