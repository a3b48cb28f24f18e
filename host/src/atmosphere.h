// SPDX-License-Identifier: Apache-2.0
// The sky that one light makes, seen from the ground: tables for the pass that draws it, and the light that it gives.
// Based on: host/shaders/atmosphere.h, which has the arithmetic; R. Ramamoorthi and P. Hanrahan, "An Efficient
// Representation for Irradiance Environment Maps", 2001.
#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstddef>

namespace gnomon::host {

/// Light on a surface by the way that it faces, n: for each colour a row of (x, y, z, 1) and one of (xy, yz, yy, xz),
/// and a share of xx - zz. Radiance of a white surface, so illuminance over pi.
struct Skylight {
    std::array<glm::dvec4, 3> linear{};
    std::array<glm::dvec4, 3> square{};
    glm::dvec3 across{0.0};

    [[nodiscard]] glm::dvec3 on(const glm::dvec3& normal) const;
    /// Adds another, made stronger by a colour.
    void add(const Skylight& other, const glm::dvec3& times);
    /// Adds light of this radiance from everywhere below the horizon.
    void addGround(const glm::dvec3& radiance);
    /// Adds light of this radiance from everywhere above the horizon.
    void addSky(const glm::dvec3& radiance);
    /// The light turned about the vertical, so that +x goes to (x, z), of any length.
    [[nodiscard]] Skylight turned(double x, double z) const;
};

/// The sky under a light of 1 outside the air, of each colour.
struct SkyUnder {
    static constexpr std::size_t across = 32; // azimuths, of skyTablePlace().x
    static constexpr std::size_t up = 40;     // heights, of .y
    using Table = std::array<glm::vec3, across * up>;
    Table molecules;         // radiance without light that dust scatters once
    Table dust;              // light that dust scatters once, without its phase; per steradian
    double largest = 1.0;    // number in both
    glm::dvec3 direct{0.0};  // illuminance of a surface that is square to the light
    glm::dvec3 diffuse{0.0}; // illuminance of level ground, by the sky alone
    Skylight light;          // by the sky alone, with the light's azimuth along +x
};

/// The share of a light from above the air that gets to the ground; `sine` of its height above the horizon, of which
/// less than 0 is below. Its disc sets little by little.
[[nodiscard]] glm::dvec3 lightThroughAir(double sine);

/// Fills `sky` for a light at this height. A few milliseconds; the first call takes some more. Depends on nothing else
/// and allocates nothing.
void fillSkyUnder(double sine, SkyUnder& sky);

} // namespace gnomon::host
