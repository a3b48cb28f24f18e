// SPDX-License-Identifier: Apache-2.0
// The bounds of everything that casts or receives, in a loose octree that is updated as things move.
// Based on: A. Marinescu, "Achieving real-time soft shadows using LVSM in an RTS game", 2011, section 5 (octree for
// culling); T. Ulrich, "Loose Octrees", Game Programming Gems, 2000.
#pragma once

#include <gnomon/export.h>
#include <gnomon/geometry.h>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace gnomon {

/// Pieces of one object that ids tell apart; more share numbers.
inline constexpr std::uint32_t kMostPieces = 4096;

/// Casters and lights meet in groups, a bit each: a light's maps hold casters of the light's groups alone.
inline constexpr std::uint32_t kAllGroups = 0xFFFFFFFFU;
/// Group 0, which objects are in unless they say otherwise. Then one object leaves it for a group of its own, and a
/// light that leaves out that group needs no word about any other object.
inline constexpr std::uint32_t kCommonGroup = 1;

/// What an object does to shadows.
struct ObjectFlags {
    /// Off spares drawing what throws no shadow anyway, such as level ground. Filterable maps
    /// (FilterTraits::filterable) draw it all the same where the camera sees it, because their averages need the
    /// receiver's own depth; then it casts. `groups` 0 is for what must not cast.
    bool casts = true;
    bool receives = true; // off: planning takes no notice that the camera sees it
    bool dynamic = false; // a hint: expected to move; kept apart from what stands still
    /// Filter volumes counts faces of what casts, and only of a closed body is the count right: each edge of its
    /// triangles is run along as often one way as the other, by opaque triangles of this object or of others that cast
    /// too, and nothing is cut away. Others are refused or left out (VolumeOptions::open).
    bool closed = false;
    /// IdOf::face: of how many pieces its triangles are, 1 .. kMostPieces, each of which shades the others. 0: nobody
    /// said so, and lights that tell pieces apart are refused.
    std::uint16_t pieces = 0;
    /// Its surface goes on in others' without an edge, as those of floor tiles do. MultiDivide::receivers then has
    /// frustums fade over into each other there. Nothing else asks.
    bool joined = false;
    /// The groups that it casts in: bits, all values are legal. A light draws it to maps, and counts it as a volume,
    /// where Light::groups has one of them; it receives shadow of any light. 0: no light does, whatever the filter.
    std::uint32_t groups = kCommonGroup;

    friend bool operator==(const ObjectFlags&, const ObjectFlags&) = default;
};

/// Names an object for as long as it lives. Its index is its place in plans and in the host's own arrays; when the
/// object is removed, another one may get the index, but not the name. No two objects of a process have one name
/// before 2^32 were added.
struct ObjectId {
    std::uint32_t index = 0xFFFFFFFFU; // its place in plans and in the host's arrays
    std::uint32_t generation = 0;      // 0: names nothing

    /// It names an object, alive or gone.
    [[nodiscard]] explicit operator bool() const { return generation != 0; }
    friend bool operator==(const ObjectId&, const ObjectId&) = default;
};

/// A cell of an ObjectSet's octree. Its objects may reach beyond it, by half its size on every side.
struct OctreeCell {
    Aabb bounds_ws;            // a cube
    std::uint32_t objects = 0; // that hang in it and in no smaller one; 1 at least
};

/// No coordinate of an object's bounds may be larger; metres. The set's own arithmetic is sound up to here. That is
/// more than a world may be (kFarthestPlace_m in world_range.h): what lies between is found, and plans say that it is
/// too far.
inline constexpr float kFarthestBounds_m = 1e12F;

/// Indices are dense: 0 .. size() - 1 in order of insertion, the smallest one is reused first. They are what Plan lists
/// name. What changes an object takes its ObjectId and is checked in every build: a name of an object that is gone, or
/// of another set, does nothing and says so. What reads takes either, and finds nothing of an object that is not there.
///
/// An object whose bounds are empty, not finite or beyond kFarthestBounds_m lives, but is nowhere: no query finds it,
/// no box holds it, and its own bounds read as empty. It is back with the first update() that says where it is.
///
/// A set that was moved from is empty and may be used again. add(), update() and setFlags() throw std::bad_alloc when
/// memory runs out, and then have changed nothing; the others that change something take no memory.
class GNOMON_API ObjectSet {
public:
    ObjectSet();
    ~ObjectSet();
    ObjectSet(ObjectSet&&) noexcept;            // the other set is empty then, and may be used again
    ObjectSet& operator=(ObjectSet&&) noexcept; // the other set is empty then, and may be used again

    /// Amortised O(1). Of the 2^30 objects that a set can hold none is left: an id that names nothing.
    ObjectId add(const Aabb& bounds_ws, ObjectFlags flags = {});
    /// Moves an object; O(1), allocates nothing once warm. Same bounds: no change is recorded. False: no such object.
    bool update(ObjectId object, const Aabb& bounds_ws);
    /// Says that an object's shape changed inside unchanged bounds (deformation), so maps that show it are redrawn.
    /// False: no such object.
    bool touch(ObjectId object);
    /// Says that an object does something else to shadows from now on; O(1). The same flags: no change is recorded.
    /// False: no such object.
    bool setFlags(ObjectId object, const ObjectFlags& flags);
    /// False: no such object.
    bool remove(ObjectId object);

    [[nodiscard]] std::uint32_t size() const; // one past the largest index of a live object
    /// Is the object of this name in the set?
    [[nodiscard]] bool alive(ObjectId object) const;
    /// Has an object this index now?
    [[nodiscard]] bool alive(std::uint32_t index) const;
    /// The object that has an index now; names nothing where none does.
    [[nodiscard]] ObjectId idAt(std::uint32_t index) const;
    /// Empty of an object that is nowhere, or not there.
    [[nodiscard]] Aabb bounds(ObjectId object) const;
    /// By index, which another object may have got.
    [[nodiscard]] Aabb bounds(std::uint32_t index) const;
    /// The bounds by index, for loops over many; empty where there is no object, or it is nowhere. Holds until the next
    /// add().
    [[nodiscard]] std::span<const Aabb> allBounds() const;
    /// Of an object that is not there: nothing is set.
    [[nodiscard]] ObjectFlags flags(ObjectId object) const;
    /// By index, which another object may have got.
    [[nodiscard]] ObjectFlags flags(std::uint32_t index) const;
    /// How many live objects are nowhere. In a sound scene: 0.
    [[nodiscard]] std::uint32_t nowhere() const;
    /// Box around all live objects; empty when there are none. Exact; the first call after an object left the rim
    /// looks at all of them, so it is not for several threads at once (query() is).
    [[nodiscard]] Aabb bounds() const;
    /// Counts up at every add, update, touch, setFlags and remove that did something.
    [[nodiscard]] std::uint64_t version() const;
    /// That count at the last change of the object that has this index, or had it last; 0 where none ever had.
    [[nodiscard]] std::uint64_t changed(std::uint32_t index) const;
    /// `changed` by index.
    [[nodiscard]] std::span<const std::uint64_t> allChanges() const;
    /// Differs between any two sets of a process, so that a planner notices when it is handed another one.
    [[nodiscard]] std::uint64_t identity() const;

    /// Which objects a query() finds.
    enum class Want : std::uint8_t { casters, receivers, all };
    /// Appends, in ascending order, the index of every live object whose bounds the convex region `planes` (inward) may
    /// touch. No object inside is ever left out. `out` is not cleared. `groups`: casters of these alone, of a light's
    /// groups say; plays no part for Want::receivers and Want::all. An object that casts in no group is no caster.
    void query(std::span<const Plane> planes, Want want, std::vector<std::uint32_t>& out,
               std::uint32_t groups = kAllGroups) const;

    /// The cells of its octrees that have objects of their own, in no order to rely on. For pictures.
    [[nodiscard]] std::vector<OctreeCell> cells() const;

private:
    struct GNOMON_LOCAL Impl;
    [[nodiscard]] Impl& own();
    [[nodiscard]] const Impl& read() const;

    std::unique_ptr<Impl> impl_; // null: moved from
};

} // namespace gnomon
