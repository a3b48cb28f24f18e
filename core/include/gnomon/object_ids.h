// SPDX-License-Identifier: Apache-2.0
// Filters id and depth-id: a texel holds the id of an object. It tells the pixel's own object from what shades it,
// without a bias. Ids are few, so that they fit a texel of 8 or 16 bits; the planner hands them out for each light anew
// in each frame.
// Based on: T. Forsyth, "Extremely Practical Shadows", GDC 2006 (ID buffers; 0 is the ground's, the others go by render
// order, front to back, so that objects with one id are far apart). Departures: the ground is what does not cast
// (ObjectFlags::casts, groups), and 0 also stands for texels that nothing was drawn to; such texels light everything.
// "Front" is measured along the light and not from the camera, so that ids do not change as the camera moves, and that
// the lower of two ids is in front (IdTest::priority).
#pragma once

#include <gnomon/export.h>
#include <gnomon/frame.h>
#include <gnomon/object_set.h>
#include <gnomon/options.h>
#include <gnomon/plan.h>

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace gnomon {

/// How many ids besides 0 a texel of this format tells apart: 255 (r8, rg8) or 65535.
[[nodiscard]] GNOMON_API std::uint32_t idsOf(MapFormat format);

/// The ids of one light of the plan, by object index; empty where it has none. With IdOf::face this is the id of an
/// object's first piece. The ids of its other pieces follow, from 1 again after the last.
[[nodiscard]] GNOMON_API std::span<const std::uint16_t> objectIdsOf(const Plan& plan, std::uint32_t light);

/// Where there are more objects than ids.
enum class IdSharing : std::uint8_t {
    far,        // they begin again from 1, so that objects with one id are far apart (Forsyth 2006)
    neighbours, // objects that follow each other in the order share one, so that a higher id is always behind
};
/// How a filter shares ids: `far`, but `neighbours` for depth-id with an id for each object. That filter compares
/// depths where ids are equal, and otherwise asks which of two objects is in front.
[[nodiscard]] GNOMON_API IdSharing idSharingOf(Filter filter, IdOf of);

/// How handOutIds() goes about it.
struct IdHandout {
    std::uint32_t most = 65535;         // ids besides 0
    IdOf of = IdOf::object;             // whether an object or each piece has an id
    IdSharing sharing = IdSharing::far; // the rule for objects beyond the number of ids
};
/// Memory that handOutIds() keeps between calls, so that it allocates nothing once all is large enough.
struct IdScratch {
    std::vector<std::pair<double, std::uint32_t>> places;       // how far an object's box reaches, and its index
    std::vector<std::uint32_t> found;                           // objects of a query
    std::vector<std::pair<std::uint32_t, std::uint32_t>> links; // objects that share bounds
};

/// Appends one id for each object of the set: 0 for an object that does not cast for the light or is nowhere, then 1 to
/// `most` in the order of the farthest points of their boxes, by depth along a sun or by distance from a lamp. So an
/// object that stands on the ground is before the ground. Among objects that are equally far the lower index is first.
/// With IdOf::face each piece takes an id, and the id of an object's first piece is appended. Surfaces in one plane
/// never shade each other, and a map cannot tell which is in front: objects without thickness in a plane across x, y or
/// z share an id, and one that lies on the face of a box that it does not reach beyond has the box's (with
/// IdOf::object). `scratch` may hold anything.
GNOMON_API void handOutIds(const Light& light, const ObjectSet& objects, const IdHandout& handout, IdScratch& scratch,
                           std::vector<std::uint16_t>& out);

/// Writes by object the bounds within which filter depth-id measures its depths (Plan::object_bounds): its own bounds,
/// or the bounds around all objects that may share its id because they are in one plane.
GNOMON_API void shareIdBounds(const ObjectSet& objects, IdScratch& scratch, std::vector<Aabb>& bounds_ws);

/// The number of objects that filters id and depth-id can tell apart: the index of a pixel's object and its piece share
/// one number (pixelObject()).
inline constexpr std::uint32_t kMostIdObjects = (1U << 20U) - 1U;
/// The number in MaskInputs::object_id for a pixel of an object and one of its pieces; 0 stands for no object.
[[nodiscard]] constexpr std::uint32_t pixelObject(std::uint32_t object, std::uint32_t piece = 0)
{
    return (object + 1) | ((piece % kMostPieces) << 20U);
}

/// Counts of casters that share an id. Two such objects throw no shadow on each other.
struct IdCollisions {
    std::uint32_t casters = 0;    // drawn in any of the light's maps, with an id
    std::uint64_t taken = 0;      // ids of these casters: one each, or one for each piece
    std::uint32_t ids = 0;        // how many there are to be had
    std::uint64_t pairs = 0;      // pairs of casters whose boxes overlap in a map
    std::uint64_t collisions = 0; // those of the pairs that share an id. Best: 0. Random ids would give pairs / ids
};
/// The collisions of one light of the plan. A light without ids has zeros. Looks at all pairs of a map's casters.
[[nodiscard]] GNOMON_API IdCollisions countIdCollisions(const Plan& plan, std::uint32_t light);

} // namespace gnomon
