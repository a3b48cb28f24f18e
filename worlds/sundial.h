// SPDX-License-Identifier: Apache-2.0
// A meadow about a sundial, with fences, trees and a house with an arcade, after P. Fortier 2010 ("Shadow maps for
// moving light sources"): open ground in which the shadow of a sun that never stands still is seen from afar. Lights
// "sun" and "moon" (SundialWorld). One walker, "walker/…", is the only object that moves. Views `meadow` (the usual
// one), `long` (at eye height over all of the open ground), `porch` (fence and arcade from nearby), `overhead` and
// `face` (the dial with its numerals, the house behind).
#pragma once

#include <glm/vec3.hpp>

namespace gnomon::worlds {

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
    /// Sun and moon give no light up to the first of these heights, and all of it from the second on. In between they
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
    /// The share of the light's full strength, [0, 1].
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

} // namespace gnomon::worlds
