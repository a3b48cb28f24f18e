// SPDX-License-Identifier: Apache-2.0
// Some hundred points that the camera probably sees, by which maps are ranked before anything is drawn.
#pragma once

#include "camera_view.h"

#include <gnomon/frame.h>

#include <array>
#include <span>
#include <vector>

namespace gnomon {

/// A point of a receiver's box, and by how much it moves on the box's face from one pixel to the next.
struct SightPoint {
    glm::dvec3 p_ws{0.0};
    glm::dvec3 right_ws{0.0}; // to the next pixel on the right, metres
    glm::dvec3 down_ws{0.0};  // and below
    double pixel_m = 0.0;     // side of a square as large as the pixel's part of the face
    double facing_m = 0.0;    // a pixel's side there on a surface that faced the eye
    double depth_m = 0.0;     // along the view
};

/// One ray through the middle of each cell of a grid over the picture, ended by the first receiver that it meets. Only
/// a receiver's box is known: somewhere on the ray's way through it there is a surface. Each ray assumes it at a share
/// of its own of that way; shares are evenly spread over all rays. A flat box is ground or a wall and is met in its
/// middle, else behind it; a ray that leaves it through its rim goes on to the next. A box around the eye, as that of
/// an arch or a room, is hollow where the eye is: a ray that starts in it meets its far side, and only where it meets
/// nothing else.
class Sight {
public:
    static constexpr int kColumns = 20;
    static constexpr int kRows = 12;

    /// Takes nothing from the heap once warm, and time in proportion to the receivers. Precondition: the view is ok.
    void look(const Frame& frame, const CameraView& view, std::span<const std::uint32_t> receivers);
    /// The points of the rays that meet a box.
    [[nodiscard]] std::span<const SightPoint> points() const { return points_; }
    /// A pixel's side on a surface that faces the eye at a depth; 0: there are no points.
    [[nodiscard]] double pixelAt_m(double depth_m, bool perspective) const;
    /// Geometric mean of their SightPoint::pixel_m; 0: there are none.
    [[nodiscard]] double meanPixel_m() const { return mean_pixel_m_; }

private:
    /// From the eye, or from a place on the near plane where rays are parallel.
    struct Ray {
        glm::dvec3 from_ws{0.0};
        glm::dvec3 along_ws{0.0};
        double share = 0.0;        // share of its way through a box at which it meets the surface inside
        double met = 0.0;          // how many times `along_ws` the nearest face is away
        glm::dvec3 normal_ws{0.0}; // normal of that face, or its opposite
        double left = 0.0; // as `met`: where it leaves the last of the boxes that it starts in; 0: there is none
        int left_axis = 0; // axis of the face through which it leaves
    };
    [[nodiscard]] Ray rayAt(const glm::dvec2& place) const;
    void meet(const glm::dmat4& clip_from_world, const Aabb& box);
    static void meetSlabs(const glm::dvec3& low, const glm::dvec3& high, int flat_axis, Ray& ray);
    static void endInside(Ray& ray);
    void addPoint(const CameraView& view, const Ray& ray, const glm::dvec2& place, const glm::dvec2& pixel);
    [[nodiscard]] static glm::dvec3 meetPlane(const Ray& ray, const glm::dvec3& p_ws, const glm::dvec3& normal_ws);

    glm::dmat4 world_from_clip_{1.0};
    double near_z_ = 1.0;
    std::array<Ray, kColumns * kRows> rays_;
    std::vector<SightPoint> points_;
    double mean_pixel_m_ = 0.0;
};

} // namespace gnomon
