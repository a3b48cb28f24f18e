// SPDX-License-Identifier: Apache-2.0
// How wrong the shadows of a map will be, told by its matrix and by where the camera looks.
#pragma once

#include "auto/map_size.h"
#include "auto/sight.h"
#include "fit/projection.h"

#include <glm/mat2x2.hpp>

#include <optional>
#include <span>
#include <vector>

namespace gnomon {

/// A SightPoint as a light sees it.
struct LitPoint {
    glm::dvec2 q{0.0};            // in the plane across the light, as in LightRect
    glm::dmat2 q_from_pixel{1.0}; // by how much q moves to the next pixel on the right, and below
    double pixel_m = 0.0;         // SightPoint::pixel_m
    double facing = 0.0;          // SightPoint::facing_m, as LightRect has it on a surface that faces the light
};

/// Nothing where the light does not reach it.
[[nodiscard]] std::optional<LitPoint> litPoint(const LightSpace& space, const SightPoint& point);

/// Appends those of the points that a slice of the light serves and that are in the light's reach.
void lightPoints(const LightSpace& space, std::span<const SightPoint> points, const ViewSlice& depths,
                 const ViewSector& sector, std::vector<LitPoint>& out);

/// The map's Jacobian at a point: by how many texels the place on the map moves from pixel to pixel.
[[nodiscard]] glm::dmat2 texelFromPixel(const LitPoint& point, const Warp& warp, const MapFrame& frame);

/// A sum over points.
struct MapError {
    double sum = 0.0;        // sum of errors, each in [0, 1]
    double log_texels = 0.0; // sum of natural logarithms of texels per pixel
    std::size_t count = 0;

    [[nodiscard]] double mean() const { return count > 0 ? sum / static_cast<double>(count) : 0.0; }
    void add(const MapError& other)
    {
        sum += other.sum;
        log_texels += other.log_texels;
        count += other.count;
    }
};

/// The edge of a shadow is off by about a texel, so of a shadow of size f a texel of length t gets a share of about
/// t / (t + f) wrong. A texel smaller than `finest_px` is no better than one of that size. `feature_m`: f. Lengths
/// are those on the receiver: so much of the picture is wrong where things are far off and their shadows small, and
/// counting texels in pixels alone gives the near end too much of the map (docs/techniques/auto.md has figures).
[[nodiscard]] MapError mapErrorOf(std::span<const LitPoint> points, const Warp& warp, const MapFrame& frame,
                                  double feature_m, double finest_px);

/// Edges gain by still finer texels, if little: finer than this is more than is of use.
inline constexpr double kFineEnough_px = 0.125;
/// Where texels are shared among frustums (partition multi): one that has these gives way to those that do not.
inline constexpr double kEnoughForOne_px = 0.5;
/// Natural logarithms of the shares of wrong pixels that mapErrorOf() sums up, themselves summed over the points, by
/// how often the map's largest side is halved: `frame` is that of a map halved `halvings` times. In their geometric
/// mean the few points that the light grazes, which are all wrong with any map, do not count for more than others.
[[nodiscard]] BySize edgesBySize(std::span<const LitPoint> points, const Warp& warp, const MapFrame& frame,
                                 double feature_m, std::uint32_t halvings);

/// The size of a texel that all but a fiftieth of the points have at most, in pixels; 0: there are no points. Reorders
/// `scratch`, which it fills.
[[nodiscard]] double coarsestTexel_px(std::span<const LitPoint> points, const Warp& warp, const MapFrame& frame,
                                      std::vector<double>& scratch);
/// Texels in pixels on surfaces that face both light and eye: their size by distances alone. A surface at a flat angle
/// to the light or the eye does not count for more.
struct FacingTexels {
    double coarsest_px = 0.0; // except for the coarsest fiftieth
    double sum_px = 0.0;      // over all points that have one
};
/// Fills `scratch`.
[[nodiscard]] FacingTexels facingTexels(std::span<const LitPoint> points, const Warp& warp, const MapFrame& frame,
                                        std::vector<double>& scratch);

} // namespace gnomon
