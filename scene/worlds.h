// SPDX-License-Identifier: Apache-2.0
// The built-in worlds by name, and the numbers of the one whose shadows can be computed by hand.
#pragma once

#include "scene/model.h"

#include <glm/vec3.hpp>

#include <cstdint>

namespace gnomon::scene {

/// Exact geometry of the world `planes`: an axis-aligned box that floats over the plane y = ground_y, a sun (the first
/// light, named "sun") and a spot light ("spot"). Both are drawn from here, so tests can compute where an edge lies.
struct PlanesWorld {
    static constexpr float ground_y = 0.0F;
    static constexpr float ground_half_size_m = 20.0F; // the ground spans [-20, 20] in x and z
    static constexpr glm::vec3 box_min{-1.5F, 2.0F, -1.0F};
    static constexpr glm::vec3 box_max{0.5F, 3.0F, 1.0F};
    /// The way sunlight travels, before normalisation: 4 down for every 3 along +x. A point at height h throws its
    /// shadow exactly 0.75 h further along +x.
    static constexpr glm::vec3 sun_direction{3.0F, -4.0F, 0.0F};
    static constexpr glm::vec3 spot_position{-4.0F, 8.0F, 6.0F};
    static constexpr glm::vec3 spot_target{-0.5F, 0.0F, 0.0F};
    static constexpr float spot_inner_half_angle_rad = 0.45F;
    static constexpr float spot_outer_half_angle_rad = 0.55F;
    static constexpr float spot_range_m = 30.0F;

    /// Where the ray through `point` from `light_position` meets the ground.
    [[nodiscard]] static constexpr glm::vec3 projectFrom(const glm::vec3& light_position, const glm::vec3& point)
    {
        const glm::vec3 ray{point.x - light_position.x, point.y - light_position.y, point.z - light_position.z};
        const float t = (ground_y - light_position.y) / ray.y;
        return {light_position.x + ray.x * t, ground_y, light_position.z + ray.z * t};
    }
    /// Where `point`'s shadow under the sun meets the ground.
    [[nodiscard]] static constexpr glm::vec3 projectAlongSun(const glm::vec3& point)
    {
        const float t = (ground_y - point.y) / sun_direction.y;
        return {point.x + sun_direction.x * t, ground_y, point.z + sun_direction.z * t};
    }
};

/// One box over one plane. Views `box`, `top` (straight down) and `side`. The seed changes nothing.
[[nodiscard]] Scene makePlanes(std::uint64_t seed);

/// A strategy game's map, after Marinescu 2011. Views `camp` (the usual three-quarter view), `unit` (on the ground
/// beside a squad) and `map` (everything). The first light, "sun", is the only one. Node names say what a thing is:
/// "terrain/…", "unit/…", "building/…", "debris/…", "grove/…". Terrain chunks too flat to shade anything while the sun
/// stands higher than kFlatChunkSlope say casts = false: along a ray that meets a height field from above, the field
/// must rise at least as steeply as the ray falls.
[[nodiscard]] Scene makeRts(std::uint64_t seed);
inline constexpr float kFlatChunkSlope = 0.27F; // rise over run, 15 degrees

/// Objects on a tiled stage under three spot lights with cookies, after Shastry 2005. Views `stage` and `close`.
[[nodiscard]] Scene makeSpotlit(std::uint64_t seed);

/// Exact geometry of the world `canopies`: flat roofs at three heights, one over the other, above the plane y = 0.
/// Where a border of a higher roof crosses a lower one, seen from the light, the ground below both is in full shadow,
/// and a map holds both heights side by side there: this is where filters that store averages let light through (light
/// bleeding). Seen along the sun, every roof is farther from the light than all of the roofs above it and nearer than
/// all of the ground, so that planes between them can part them.
struct CanopiesWorld {
    struct Box {
        glm::vec3 min{0.0F};
        glm::vec3 max{0.0F};
    };
    struct Rectangle { // of the ground
        float min_x = 0.0F;
        float min_z = 0.0F;
        float max_x = 0.0F;
        float max_z = 0.0F;

        [[nodiscard]] constexpr bool holds(float x, float z) const
        {
            return x > min_x && x < max_x && z > min_z && z < max_z;
        }
    };
    static constexpr float ground_half_size_m = 10.0F;
    static constexpr int slats = 6; // of the pergola, the highest roof, side by side along x
    static constexpr Box sail{{-6.4F, 7.0F, -4.4F}, {-0.6F, 7.1F, 2.2F}};
    static constexpr Box awning{{-2.2F, 2.5F, -1.1F}, {5.2F, 2.6F, 3.3F}}; // the lowest
    /// The way sunlight travels, before normalisation: a point at height h throws its shadow 0.02 h along +x and 0.12 h
    /// along +z.
    static constexpr glm::vec3 sun_direction{0.02F, -1.0F, 0.12F};
    /// How much farther the sun's disc, 0.53 degrees wide, carries that, in x or z at most: 0.005 h.
    static constexpr float sun_spread = 0.005F;
    static constexpr glm::vec3 spot_position{1.0F, 30.0F, 2.0F};
    static constexpr glm::vec3 spot_target{-0.5F, 0.0F, 0.0F};

    [[nodiscard]] static constexpr Box slat(int i)
    {
        const float x = 2.0F * static_cast<float>(i) - 5.6F;
        return {{x, 18.0F, -5.0F}, {x + 1.2F, 18.15F, 5.0F}};
    }
    /// Points of the ground to which `roof` alone lets nothing of the sun.
    [[nodiscard]] static constexpr Rectangle umbraOf(const Box& roof)
    {
        const float h = roof.min.y;
        return {roof.min.x + (sun_direction.x + sun_spread) * h, roof.min.z + (sun_direction.z + sun_spread) * h,
                roof.max.x + (sun_direction.x - sun_spread) * h, roof.max.z + (sun_direction.z - sun_spread) * h};
    }
    /// Outside, `roof` takes nothing of the sun from the ground.
    [[nodiscard]] static constexpr Rectangle reachOf(const Box& roof)
    {
        return {roof.min.x + (sun_direction.x - sun_spread) * roof.min.y,
                roof.min.z + (sun_direction.z - sun_spread) * roof.min.y,
                roof.max.x + (sun_direction.x + sun_spread) * roof.max.y,
                roof.max.z + (sun_direction.z + sun_spread) * roof.max.y};
    }
    /// How far from the light a point is, metres along the sun's direction, from the plane through the origin.
    [[nodiscard]] static constexpr float depthOf(const glm::vec3& point)
    {
        constexpr float kLength = 1.0073728F; // of sun_direction
        return (sun_direction.x * point.x + sun_direction.y * point.y + sun_direction.z * point.z) / kLength;
    }
};

/// Three roofs over each other: a pergola of slats, a sail and an awning. A sun, "sun", and a spot light, "spot". Views
/// `roofs`, `side` and `top`. The seed changes nothing.
[[nodiscard]] Scene makeCanopies(std::uint64_t seed);

/// The sky over the world `sundial`: a sun and a full moon on their daily courses over a place at `latitude_rad` north.
/// +x is east, -z is north. Clocks show solar time, and all of it repeats day by day: the sun's declination stays, and
/// so does the moon's, whose daily delay of 50 minutes is left out. Heights above the horizon are angles.
struct SundialWorld {
    static constexpr double latitude_rad = 0.8726646260;          // 50 degrees
    static constexpr double sun_declination_rad = 0.1745329252;   // 10 degrees: mid-April, or the end of August
    static constexpr double moon_declination_rad = -0.0872664626; // -5 degrees: full, on the other side of the sky
    static constexpr double clock_rate = 60.0;                    // one minute passes in a second
    static constexpr double day_s = 1440.0;
    static constexpr double start_hour = 8.0; // on the clock at time 0
    static constexpr float sun_angular_diameter_rad = 0.00925025F;
    static constexpr float moon_angular_diameter_rad = 0.00907571F; // 0.52 degrees
    /// Sun and moon give nothing up to the first of these heights, all they have from the second on. In between they
    /// fade, so that no light grazes the ground.
    static constexpr double fade_from_rad = 0.0349065850; // 2 degrees
    static constexpr double fade_to_rad = 0.1221730476;   // 7 degrees

    /// Hours since midnight, [0, 24).
    [[nodiscard]] static double hourOf(double time_s);
    /// Seconds from time 0 to the next time that the clock shows `hour`, [0, day_s).
    [[nodiscard]] static double timeOf(double hour);
    /// The way the light travels, unit; upwards while its source is below the horizon.
    [[nodiscard]] static glm::dvec3 sunDirection(double time_s);
    [[nodiscard]] static glm::dvec3 moonDirection(double time_s);
    /// [0, 1]: of what the light gives at most.
    [[nodiscard]] static double sunStrength(double time_s);
    [[nodiscard]] static double moonStrength(double time_s);
    /// Clock hours at which the sun's centre crosses the horizon.
    [[nodiscard]] static double sunriseHour();
    [[nodiscard]] static double sunsetHour();

    /// The dial in the middle of the meadow: a level disc whose centre is at (0, dial_y, 0), and over it the gnomon's
    /// straight edge (the style), which starts there and points to the celestial pole. The style's shadow shows the
    /// hour.
    static constexpr float dial_y = 1.25F;
    static constexpr float dial_radius_m = 1.5F;
    static constexpr float style_length_m = 1.75F;
    /// Azimuth of the hour's line on the dial, from north, clockwise seen from above.
    [[nodiscard]] static double hourLineAzimuth(double hour);
};

/// A meadow about a sundial, with fences, trees and a house with an arcade, after P. Fortier 2010 ("Shadow maps for
/// moving light sources"): open ground in which the shadow of a sun that never stands still is seen from afar. Lights
/// "sun" and "moon" (SundialWorld). One walker, "walker/…", is the only object that moves. Views `meadow` (the usual
/// one), `long` (at eye height over all of the open ground), `porch` (fence and arcade from nearby), `overhead` and
/// `face` (the dial with its numerals, the house behind).
[[nodiscard]] Scene makeSundial(std::uint64_t seed);

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

    /// About the axis, from straight below it; [-pi, pi).
    [[nodiscard]] static double angleOf(double tiles);
    [[nodiscard]] static glm::vec3 place(double tiles, double height_m, double across_m);
    /// Towards the axis, unit.
    [[nodiscard]] static glm::vec3 up(double tiles);
    /// Along the ring, unit.
    [[nodiscard]] static glm::vec3 along(double tiles);
};

/// A space station bent into a ring, after T. Forsyth 2006, who gave shadows to StarTopia (2001): many point lights
/// inside lamps that shade them, over a deck of tiles. Each tile of deck, hull and walls is an object of its own
/// ("deck/…", "hull/…", "wall/…"), and neighbours share the vertices and normals of their border. "lamp/…" are lamps;
/// each has a child "…/bulb" and a child that is its light. Lights "mood …" cast no shadow. "walker/…" go round the
/// promenade. Views `deck` (along the promenade), `bar` (inside one), `overview` (from high up) and `duel` (into a
/// lamp).
[[nodiscard]] Scene makeRing(std::uint64_t seed);

} // namespace gnomon::scene
