// SPDX-License-Identifier: Apache-2.0
// The bounds of everything that casts or receives, in a loose octree that is updated as things move.
// Based on: A. Marinescu, "Achieving real-time soft shadows using LVSM in an RTS game", 2011, section 5 (octree for
// culling); T. Ulrich, "Loose Octrees", Game Programming Gems, 2000.
#pragma once

#include <gnomon/geometry.h>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace gnomon {

struct ObjectFlags {
    /// Off spares drawing what throws no shadow anyway, such as level ground. Filterable maps
    /// (FilterTraits::filterable) draw it all the same, because their averages need the receiver's own depth; then it
    /// casts.
    bool casts = true;
    bool receives = true;
    bool dynamic = false; // a hint: expected to move; kept apart from what stands still
};

/// Handles are dense: 0 .. size() - 1 in order of insertion, reused after `remove`. They are what Plan lists name.
class ObjectSet {
public:
    ObjectSet();
    ~ObjectSet();
    ObjectSet(ObjectSet&&) noexcept;
    ObjectSet& operator=(ObjectSet&&) noexcept;

    /// `bounds_ws` finite and not empty. Amortised O(1).
    std::uint32_t add(const Aabb& bounds_ws, ObjectFlags flags = {});
    /// Moves an object; O(1), allocates nothing once warm. Same bounds: no change is recorded.
    void update(std::uint32_t object, const Aabb& bounds_ws);
    /// Says that an object's shape changed inside unchanged bounds (deformation), so maps that show it are redrawn.
    void touch(std::uint32_t object);
    void remove(std::uint32_t object);

    [[nodiscard]] std::uint32_t size() const; // one past the largest live handle
    [[nodiscard]] bool alive(std::uint32_t object) const;
    [[nodiscard]] const Aabb& bounds(std::uint32_t object) const;
    /// The bounds of all handles, those of dead ones meaningless; for loops over many. Holds until the next add().
    [[nodiscard]] std::span<const Aabb> allBounds() const;
    [[nodiscard]] ObjectFlags flags(std::uint32_t object) const;
    /// Box around all live objects; empty when there are none. Exact; the first call after an object left the rim
    /// looks at all of them, so it is not for several threads at once (query() is).
    [[nodiscard]] Aabb bounds() const;
    /// Counts up at every add, update, touch and remove; `changed(object)` is the count at the object's last change.
    [[nodiscard]] std::uint64_t version() const;
    [[nodiscard]] std::uint64_t changed(std::uint32_t object) const;
    /// `changed` of all handles.
    [[nodiscard]] std::span<const std::uint64_t> allChanges() const;
    /// Differs between any two sets of a process, so that a planner notices when it is handed another one.
    [[nodiscard]] std::uint64_t identity() const;

    enum class Want : std::uint8_t { casters, receivers, all };
    /// Appends, in ascending order, every live object whose bounds the convex region `planes` (inward) may touch. No
    /// object inside is ever left out. `out` is not cleared.
    void query(std::span<const Plane> planes, Want want, std::vector<std::uint32_t>& out) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace gnomon
