// SPDX-License-Identifier: Apache-2.0
// The mean visibility over a pixel's area.
#pragma once

#include "camera_rays.h"
#include "shadow_rays.h"

namespace gnomon::truth {

/// The visible surface point as a start of shadow rays. Nothing where none are traced.
[[nodiscard]] std::optional<Receiver> receiverOn(const SceneGeometry& geometry, const View& view,
                                                 const CameraRays::Seen& seen);

/// The options for each of a pixel's points.
[[nodiscard]] Options optionsOfPoint(const Options& options);

/// Where point `index` of set `set` of pixel number `pixel` lies in the pixel, [0, 1) each.
[[nodiscard]] glm::dvec2 pointInPixel(std::uint64_t seed, std::uint64_t pixel, std::uint32_t set, std::uint32_t index);

/// The result over kPixelPoints points of pixel (x, y); `camera` is that of the view, `shadow_rays` are of
/// optionsOfPoint(), `seed` is that of the options.
[[nodiscard]] ShadowRays::Result traceOverPixel(const SceneGeometry& geometry, const View& view,
                                                const CameraRays& camera, const ShadowRays& shadow_rays,
                                                std::uint64_t seed, const glm::uvec2& pixel);

} // namespace gnomon::truth
