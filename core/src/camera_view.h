// SPDX-License-Identifier: Apache-2.0
// The camera's view: the convex region that it can see into, and the receivers in it.
#pragma once

#include <gnomon/frame.h>
#include <gnomon/plan.h>

#include <vector>

namespace gnomon {

struct CameraView {
    Outcome outcome; // degenerate: the camera's numbers describe no view
    glm::dvec3 eye_ws{0.0};
    glm::dvec3 forward_ws{0.0, 0.0, -1.0}; // unit: depth of view grows along it
    bool perspective = true;               // else near and far things are seen equally large
    glm::dmat4 clip_from_world{1.0};
    std::vector<Plane> planes; // inward; planes at infinity are left out
    double pad_m = 0.0;        // largest error of a float coordinate in this scene
    Aabb scene_ws;

    /// Depths along forward_ws from the eye: between which the receivers are that it sees, by measureDepths(); or could
    /// be, by boundDepths().
    double near_m = 0.0;
    double far_m = 0.0;

    /// Fills this and `receivers` (ascending, cleared first), keeping memory.
    void look(const Frame& frame, double max_distance_m, std::vector<std::uint32_t>& receivers);
    /// Depth of what is seen of them. After look(), when it said ok and found receivers.
    void measureDepths(const ObjectSet& objects, const std::vector<std::uint32_t>& receivers);
    /// From the near plane to the far plane, `max_distance_m` (0: none) or the farthest corner of the scene, whichever
    /// is nearest: numbers that a turn of the camera does not change, and the last of which changes in steps.
    void boundDepths(const Camera& camera, double max_distance_m);
    [[nodiscard]] double depthOf(const glm::dvec3& p_ws) const { return glm::dot(forward_ws, p_ws - eye_ws); }

private:
    ConvexBody cut_; // scratch
};

} // namespace gnomon
