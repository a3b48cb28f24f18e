// SPDX-License-Identifier: Apache-2.0
// The square of partition virtual across a light, and what lies where in it. Under parallel rays it is a plane across
// them, in metres, and depth is metres along them. Of a light with a place it is the plane before the light, in
// tangents of its half angle, and depth is minus one over metres along its axis. Both times rays of light are points,
// the planes of boxes are planes, and a ray to the light's rim leads away in proportion to depth.
#pragma once

#include "camera_view.h"
#include "depth_range.h"
#include "light_space.h"
#include "partition/page_tree.h"
#include "partition/partition.h"

#include <optional>
#include <span>
#include <vector>

namespace gnomon {

/// One of a light's roots.
struct PageSpace {
    LightSpace space;
    double unit = 1.0; // the square's unit, as LightRect has it
    DepthRange range;  // of all its maps
};
/// `slice`: wholeSlice(), or a face of the cube. All but its range.
[[nodiscard]] PageSpace pageSpaceOf(const Light& light, const Slice& slice, const Aabb& scene_ws);

/// How many roots a light has: one, or those around it.
[[nodiscard]] std::uint32_t pageFaces(const Light& light);
/// Of which of them a point of the world is.
[[nodiscard]] std::uint32_t pageFaceAt(const Light& light, const glm::dvec3& p_ws);

/// A point that the light may shine on: all but its weight and face. `pixel_m`: of a pixel there, on a surface that
/// faces the eye.
[[nodiscard]] std::optional<PagePoint> pagePointOf(const Light& light, const PageSpace& space, const glm::dvec3& p_ws,
                                                   double pixel_m);
/// A caster. Nothing where all of it is nearer than what casts.
[[nodiscard]] std::optional<PageCaster> pageCasterOf(const PageSpace& space, std::uint32_t object, const Aabb& box);

/// Planes around all that may cast into a rectangle, inward.
void planesAroundPage(const PageSpace& space, const glm::dvec2& low, const glm::dvec2& high, std::vector<Plane>& out);

/// How deep along the light the scene reaches, in steps, so that pages hold while something moves.
[[nodiscard]] DepthRange pageDepths(const PageSpace& space, const Aabb& scene_ws, std::span<const PageCaster> casters,
                                    double pad_m);

/// How far a ray to the light's rim is off, for each unit of depth: PageTree::Input::spread and slant.
struct PageSpread {
    double spread = 0.0;
    double slant = 0.0;
};
[[nodiscard]] PageSpread pageSpreadOf(const Light& light, const PageSpace& space);

/// Fills in how a page is projected onto `side` texels, a share `border` of which is on each side of it, and which
/// points it serves.
void projectPage(const PageSpace& space, const PageKey& page, std::uint32_t side, double border, View& view);

} // namespace gnomon
