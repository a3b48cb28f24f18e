// SPDX-License-Identifier: Apache-2.0
// Filters id and depth-id: a texel holds the id of an object, by which the pixel's own object is told from what shades
// it, without a bias. Ids are few, so that they fit a texel of 8 or 16 bits; the planner hands them out for each light
// anew in each frame.
// Based on: T. Forsyth, "Extremely Practical Shadows", GDC 2006 (ID buffers; 0 is the ground's, the others go by
// render order, front to back, so that objects with one id are far apart).
// Departures: the ground is what does not cast (ObjectFlags::casts, groups), and 0 also stands for texels that nothing
// was drawn to; such texels light everything. "Front" is measured along the light and not from the camera, so
// that ids do not change as the camera moves, and that of two ids the lower is in front (IdTest::priority).
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

/// Those of a light of the plan, by object index; empty where it has none. With IdOf::face it is that of an object's
/// first piece, and those of its others follow, from 1 again after the last.
[[nodiscard]] GNOMON_API std::span<const std::uint16_t> objectIdsOf(const Plan& plan, std::uint32_t light);

/// Where there are more objects than ids.
enum class IdSharing : std::uint8_t {
    far,        // they begin again from 1, so that objects with one id are far apart (Forsyth 2006)
    neighbours, // objects that follow each other in the order share one, so that a higher id is always behind
};
/// far, but of depth-id with an id for each object neighbours: it compares depths where ids are the same, and asks
/// which of two objects is in front where they are not.
[[nodiscard]] GNOMON_API IdSharing idSharingOf(Filter filter, IdOf of);

/// How handOutIds() goes about it.
struct IdHandout {
    std::uint32_t most = 65535;         // ids besides 0
    IdOf of = IdOf::object;             // what has an id of its own
    IdSharing sharing = IdSharing::far; // what happens when there are more
};
/// Memory that handOutIds() keeps between calls, so that it allocates nothing once all is large enough.
struct IdScratch {
    std::vector<std::pair<double, std::uint32_t>> places;       // how far an object's box reaches, and its index
    std::vector<std::uint32_t> found;                           // objects of a query
    std::vector<std::pair<std::uint32_t, std::uint32_t>> links; // objects that share bounds
};

/// Appends one for each object of the set: 0 of what does not cast for the light or is nowhere, then 1 .. `most` in the
/// order of the farthest points of their boxes, by depth along a sun or by distance from a lamp: so what stands on the
/// ground is before the ground. Among objects as far as each other the lower index is first. With IdOf::face each piece
/// takes one, and what is appended is that of an object's first. Surfaces in one plane never shade each other, and a
/// map cannot tell which is in front: objects without thickness in a plane across x, y or z share an id, and one that
/// lies on the face of a box that it does not reach beyond has the box's (with IdOf::object). `scratch`: whatever was
/// in it.
GNOMON_API void handOutIds(const Light& light, const ObjectSet& objects, const IdHandout& handout, IdScratch& scratch,
                           std::vector<std::uint16_t>& out);

/// By object, the bounds by which filter depth-id counts depths within it (Plan::object_bounds): its own, and of
/// objects that may share an id because they are in one plane, the bounds around them all.
GNOMON_API void shareIdBounds(const ObjectSet& objects, IdScratch& scratch, std::vector<Aabb>& bounds_ws);

/// Filters id and depth-id have the index of a pixel's object and its piece in one number (pixelObject()); so many
/// objects can be told apart by it.
inline constexpr std::uint32_t kMostIdObjects = (1U << 20U) - 1U;
/// What stands for a pixel of an object and of one of its pieces in MaskInputs::object_id; 0 stands for no object.
[[nodiscard]] constexpr std::uint32_t pixelObject(std::uint32_t object, std::uint32_t piece = 0)
{
    return (object + 1) | ((piece % kMostPieces) << 20U);
}

/// What objects with one id cost: a shadow where one of them would have thrown it on the other.
struct IdCollisions {
    std::uint32_t casters = 0;    // drawn in any of the light's maps, with an id
    std::uint64_t taken = 0;      // by them: one each, or one for each piece
    std::uint32_t ids = 0;        // how many there are to be had
    std::uint64_t pairs = 0;      // of casters that overlap in a map, by their boxes
    std::uint64_t collisions = 0; // of these, with an id that both have. Best: 0. Of ids drawn by lot: pairs / ids
};
/// Of a light of the plan; zeros where it has no ids. Looks at all pairs of a map's casters.
[[nodiscard]] GNOMON_API IdCollisions countIdCollisions(const Plan& plan, std::uint32_t light);

} // namespace gnomon
