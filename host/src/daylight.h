// SPDX-License-Identifier: Apache-2.0
// All light of a frame, exposed: its lights, the sky, the sky's light, and the brightness of the picture.
#pragma once

#include "atmosphere.h"

#include "host/frame_renderer.h"
#include "host/view.h"

#include <array>
#include <cstdint>
#include <span>

namespace gnomon::host {

/// A sun or a moon in the sky.
struct SkyBody {
    glm::dvec3 towards_ws{0.0, 1.0, 0.0};
    glm::dvec3 times{0.0}; // exposed radiance of the sky per unit of SkyUnder's tables
    glm::dvec3 disc{0.0};  // exposed radiance of its disc
    double cos_radius = 0.9999;
    /// The tables, and a number that changes with them. 0: there is no body.
    const SkyUnder* under = nullptr;
    std::uint64_t version = 0;
};
inline constexpr std::size_t kSkyBodies = 2; // sun, moon

/// In the unit of Picture::linear.
struct FrameLight {
    std::array<glm::dvec3, kMaxLights> colours{}; // by light: illuminance over pi, or intensity
    Skylight skylight;
    double emission = 1.0; // times what materials emit
    double lamps = 0.0;    // the brightness of lit windows
    bool physical = false; // the sky is; else it is a gradient
    glm::dvec3 zenith{0.0};
    glm::dvec3 horizon{0.0};
    glm::dvec3 ground{0.0}; // the colour below the horizon, in either sky
    std::array<SkyBody, kSkyBodies> bodies;
    bool night_sky = false; // there are a moon or stars
    double stars = 0.0;     // how bright they are
    glm::dvec3 night{0.0};  // radiance of a sky without sun and moon
};

/// The factor that brings the brightest of `given`, illuminance by light, to the range that the tone curve is made for;
/// multiplies all light that the scene's lights give. Sky, hemisphere light and emission are given relative to that and
/// are only scaled by Environment::exposure, so lights in lux, candela or any other unit fit the same sky.
[[nodiscard]] double exposureOf(std::span<const double> given, const scene::Environment& environment);

/// Keeps the tables of the last sun and moon. Its result depends on the arguments alone.
class Daylight {
public:
    /// `given`: the illuminance by each light of the surfaces in view (SeenLight). Allocates nothing. Valid until the
    /// next call.
    const FrameLight& at(SkyModel sky, double exposure_ev, std::span<const ShadedLight> lights,
                         std::span<const double> given, const scene::Environment& environment);

private:
    struct Kept {
        SkyUnder under;
        double sine = 2.0; // none
        std::uint64_t version = 0;
    };
    void fillPlain(std::span<const ShadedLight> lights, std::span<const double> given,
                   const scene::Environment& environment);
    void fillPhysical(std::span<const ShadedLight> lights, std::span<const double> given,
                      const scene::Environment& environment, double exposure_ev);
    void placeBody(std::size_t body, const ShadedLight& light);

    FrameLight light_;
    std::array<Kept, kSkyBodies> kept_;
};

} // namespace gnomon::host
