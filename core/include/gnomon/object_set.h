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

/// All groups of casters and lights, a bit each. A light's maps hold only casters of the light's groups.
inline constexpr std::uint32_t kAllGroups = 0xFFFFFFFFU;
/// Group 0, which objects are in by default. To hide one object from a light, give the object a group of its own and
/// leave that group out of the light's groups.
inline constexpr std::uint32_t kCommonGroup = 1;

/// How an object takes part in shadows.
struct ObjectFlags {
    /// Off saves drawing an object that throws no shadow anyway, such as level ground. Filterable maps
    /// (FilterTraits::filterable) draw it all the same where the camera sees it, because their averages need the
    /// receiver's own depth; then it casts. Use `groups` 0 for an object that must not cast.
    bool casts = true;
    bool receives = true; // off: planning takes no notice that the camera sees it
    bool dynamic = false; // a hint: expected to move; kept apart from still objects
    /// Filter volumes counts faces of casters, and the count is right only for a closed body: opaque triangles of this
    /// object, or of others that cast too, run along each edge as often one way as the other, and nothing is cut away.
    /// Open casters are refused or left out (VolumeOptions::open).
    bool closed = false;
    /// IdOf::face: the number of pieces that its triangles belong to, 1 .. kMostPieces. Each piece shades the others.
    /// 0: not given, and lights that tell pieces apart are refused.
    std::uint16_t pieces = 0;
    /// Its surface continues in that of other objects without an edge, as floor tiles do. MultiDivide::receivers then
    /// lets frustums fade over into each other there. Nothing else reads this.
    bool joined = false;
    /// The groups that it casts in: bits, all values are legal. A light draws it to maps, or counts its volume, where
    /// Light::groups has one of them. It receives shadow from any light. 0: it casts for no light, with any filter.
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
    std::uint32_t objects = 0; // objects in this cell and in no smaller one; at least 1
};

/// No coordinate of an object's bounds may be larger; metres. The set's own arithmetic is sound up to here. This is
/// beyond the limit of a world (kFarthestPlace_m in world_range.h): queries find objects between both limits, and plans
/// report them as too far.
inline constexpr float kFarthestBounds_m = 1e12F;

/// Indices are dense: 0 .. size() - 1 in order of insertion, the smallest one is reused first. The lists of a Plan hold
/// indices. Functions that change an object take its ObjectId and check it in every build: with the name of an object
/// that is gone, or of another set, they do nothing and return false. Functions that read take either, and find nothing
/// for an object that is not there.
///
/// An object whose bounds are empty, not finite or beyond kFarthestBounds_m lives, but is nowhere: no query finds it,
/// no box holds it, and its own bounds read as empty. The first update() with sound bounds brings it back.
///
/// A set that was moved from is empty and may be used again. add(), update() and setFlags() throw std::bad_alloc when
/// memory runs out, and then have changed nothing; the others that change something take no memory.
class GNOMON_API ObjectSet {
public:
    ObjectSet();
    ~ObjectSet();
    ObjectSet(ObjectSet&&) noexcept;            // the other set is empty then, and may be used again
    ObjectSet& operator=(ObjectSet&&) noexcept; // the other set is empty then, and may be used again

    /// Adds an object; amortised O(1). Returns an id that names nothing where the set already holds 2^30 objects.
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
    /// The bounds of an object; empty where it is nowhere, or not in the set.
    [[nodiscard]] Aabb bounds(ObjectId object) const;
    /// By index, which another object may have by now.
    [[nodiscard]] Aabb bounds(std::uint32_t index) const;
    /// The bounds by index, for loops over many; empty where there is no object, or it is nowhere. Holds until the next
    /// add().
    [[nodiscard]] std::span<const Aabb> allBounds() const;
    /// The flags of an object. Nothing is set for an object that is not in the set.
    [[nodiscard]] ObjectFlags flags(ObjectId object) const;
    /// By index, which another object may have by now.
    [[nodiscard]] ObjectFlags flags(std::uint32_t index) const;
    /// How many live objects are nowhere. In a sound scene: 0.
    [[nodiscard]] std::uint32_t nowhere() const;
    /// Box around all live objects; empty when there are none. Exact; the first call after an object left the rim
    /// looks at all of them, so it is not for several threads at once (query() is).
    [[nodiscard]] Aabb bounds() const;
    /// Counts up at every add, update, touch, setFlags and remove that did something.
    [[nodiscard]] std::uint64_t version() const;
    /// The version at the last change of the object that has this index, or had it last; 0 where none ever had it.
    [[nodiscard]] std::uint64_t changed(std::uint32_t index) const;
    /// `changed` by index.
    [[nodiscard]] std::span<const std::uint64_t> allChanges() const;
    /// Differs between any two sets of a process, so that a planner notices when it is handed another one.
    [[nodiscard]] std::uint64_t identity() const;

    /// Which objects a query() finds.
    enum class Want : std::uint8_t { casters, receivers, all };
    /// Appends, in ascending order, the index of every live object whose bounds the convex region `planes` (inward) may
    /// touch. No object inside is ever left out. `out` is not cleared. `groups`: finds only casters in one of these
    /// groups; has no effect with Want::receivers and Want::all. An object that casts in no group is no caster.
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
