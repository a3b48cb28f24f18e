// SPDX-License-Identifier: Apache-2.0
#include "geometry/octree.h"

#include <gnomon/object_set.h>

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cassert>
#include <cmath>

namespace gnomon {
namespace {

[[maybe_unused]] bool finite(const Aabb& box)
{
    return std::isfinite(box.min.x) && std::isfinite(box.min.y) && std::isfinite(box.min.z) &&
           std::isfinite(box.max.x) && std::isfinite(box.max.y) && std::isfinite(box.max.z);
}

/// The positions of the bits that are set, ascending.
void appendSet(std::span<const std::uint64_t> words, std::vector<std::uint32_t>& out)
{
    for (std::size_t word = 0; word < words.size(); ++word) {
        for (std::uint64_t left = words[word]; left != 0; left &= left - 1) {
            out.push_back(static_cast<std::uint32_t>(64 * word + static_cast<std::size_t>(std::countr_zero(left))));
        }
    }
}

std::uint64_t nextIdentity()
{
    static std::atomic<std::uint64_t> last{0};
    return ++last;
}

} // namespace

struct ObjectSet::Impl {
    // By handle. Apart from each other, because a plan reads all bounds, then all changes.
    TreeObjects objects;
    std::vector<std::uint64_t> changed;
    std::vector<ObjectFlags> flags;
    // A bit for each handle: alive, and alive with that flag.
    std::array<std::vector<std::uint64_t>, 3> bits;
    std::vector<std::uint32_t> free_handles; // a heap, the smallest on top: handles stay dense
    std::array<Octree, 2> trees;             // what stands still, what moves: the first one stays as it is
    std::uint64_t version = 0;
    std::uint64_t identity = nextIdentity();
    Aabb bounds;
    bool bounds_loose = false; // an object at the rim left it

    void record(std::uint32_t object) { changed[object] = ++version; }
    Octree& treeOf(std::uint32_t object) { return trees[flags[object].dynamic ? 1 : 0]; }

    std::uint32_t newHandle()
    {
        if (!free_handles.empty()) {
            std::pop_heap(free_handles.begin(), free_handles.end(), std::greater<>());
            const std::uint32_t handle = free_handles.back();
            free_handles.pop_back();
            return handle;
        }
        const auto handle = static_cast<std::uint32_t>(changed.size());
        assert(handle <= Octree::kHandleBits);
        objects.bounds_ws.emplace_back();
        objects.places.emplace_back();
        changed.push_back(0);
        flags.emplace_back();
        for (auto& words : bits) {
            words.resize(handle / 64 + 1);
        }
        return handle;
    }
    [[nodiscard]] std::vector<std::uint64_t>& bitsOf(Want want) { return bits[static_cast<std::size_t>(want)]; }
    [[nodiscard]] bool alive(std::size_t handle) const
    {
        return (bits[static_cast<std::size_t>(Want::all)][handle / 64] >> (handle % 64) & 1) != 0;
    }
    void setBits(std::uint32_t handle, bool now_alive)
    {
        const std::uint64_t bit = std::uint64_t{1} << (handle % 64);
        const auto set = [&](Want want, bool value) {
            std::uint64_t& word = bitsOf(want)[handle / 64];
            word = value ? word | bit : word & ~bit;
        };
        set(Want::all, now_alive);
        set(Want::casters, now_alive && flags[handle].casts);
        set(Want::receivers, now_alive && flags[handle].receives);
    }
    /// Called before an object's box goes or changes.
    void leave(const Aabb& box)
    {
        bounds_loose |=
            glm::any(glm::lessThanEqual(box.min, bounds.min)) || glm::any(glm::greaterThanEqual(box.max, bounds.max));
    }
    void enter(const Aabb& box)
    {
        bounds.min = glm::min(bounds.min, box.min);
        bounds.max = glm::max(bounds.max, box.max);
    }
};

ObjectSet::ObjectSet() : impl_(std::make_unique<Impl>()) {}
ObjectSet::~ObjectSet() = default;
ObjectSet::ObjectSet(ObjectSet&&) noexcept = default;
ObjectSet& ObjectSet::operator=(ObjectSet&&) noexcept = default;

std::uint32_t ObjectSet::add(const Aabb& bounds_ws, ObjectFlags flags)
{
    assert(!bounds_ws.empty() && finite(bounds_ws));
    Impl& s = *impl_;
    const std::uint32_t handle = s.newHandle();
    s.objects.bounds_ws[handle] = bounds_ws;
    s.flags[handle] = flags;
    s.setBits(handle, true);
    s.treeOf(handle).insert(s.objects,
                            handle | (flags.casts ? Octree::kCasts : 0U) | (flags.receives ? Octree::kReceives : 0U));
    s.enter(bounds_ws);
    s.record(handle);
    return handle;
}

void ObjectSet::update(std::uint32_t object, const Aabb& bounds_ws)
{
    assert(alive(object) && !bounds_ws.empty() && finite(bounds_ws));
    Impl& s = *impl_;
    Aabb& box = s.objects.bounds_ws[object];
    if (box.min == bounds_ws.min && box.max == bounds_ws.max) {
        return;
    }
    s.leave(box);
    box = bounds_ws;
    s.enter(bounds_ws);
    s.treeOf(object).moved(s.objects, object);
    s.record(object);
}

void ObjectSet::touch(std::uint32_t object)
{
    assert(alive(object));
    impl_->record(object);
}

void ObjectSet::remove(std::uint32_t object)
{
    assert(alive(object));
    Impl& s = *impl_;
    s.leave(s.objects.bounds_ws[object]);
    s.treeOf(object).remove(s.objects, object);
    s.objects.bounds_ws[object] = {}; // empty: bounds() may go over all of them alike
    s.setBits(object, false);
    s.record(object);
    s.free_handles.push_back(object);
    std::push_heap(s.free_handles.begin(), s.free_handles.end(), std::greater<>());
}

std::uint32_t ObjectSet::size() const
{
    std::size_t end = impl_->changed.size();
    while (end > 0 && !impl_->alive(end - 1)) {
        --end;
    }
    return static_cast<std::uint32_t>(end);
}

bool ObjectSet::alive(std::uint32_t object) const
{
    return object < impl_->changed.size() && impl_->alive(object);
}

const Aabb& ObjectSet::bounds(std::uint32_t object) const
{
    assert(alive(object));
    return impl_->objects.bounds_ws[object];
}

std::span<const Aabb> ObjectSet::allBounds() const
{
    return impl_->objects.bounds_ws;
}

ObjectFlags ObjectSet::flags(std::uint32_t object) const
{
    assert(alive(object));
    return impl_->flags[object];
}

Aabb ObjectSet::bounds() const
{
    Impl& s = *impl_;
    if (s.bounds_loose) {
        s.bounds = {};
        for (const Aabb& box : s.objects.bounds_ws) {
            s.enter(box);
        }
        s.bounds_loose = false;
    }
    return s.bounds;
}

std::uint64_t ObjectSet::version() const
{
    return impl_->version;
}

std::uint64_t ObjectSet::changed(std::uint32_t object) const
{
    assert(object < impl_->changed.size());
    return impl_->changed[object];
}

std::span<const std::uint64_t> ObjectSet::allChanges() const
{
    return impl_->changed;
}

std::uint64_t ObjectSet::identity() const
{
    return impl_->identity;
}

void ObjectSet::query(std::span<const Plane> planes, Want want, std::vector<std::uint32_t>& out) const
{
    const Impl& s = *impl_;
    const RegionTest region(planes);
    const glm::dvec3 low(s.bounds.min);
    const glm::dvec3 high(s.bounds.max);
    std::uint32_t mask = region.allPlanes();
    if (s.bounds.empty() || !region.narrow((low + high) * 0.5, (high - low) * 0.5, mask)) {
        return;
    }
    const std::vector<std::uint64_t>& all = s.bits[static_cast<std::size_t>(want)];
    if (mask == 0) {
        appendSet(all, out); // the whole world is inside
        return;
    }
    // Marking bits and reading them in order costs a step per object and sorts by the way. Per thread, so that a const
    // set can be asked from several.
    static thread_local std::vector<std::uint64_t> found;
    found.assign(all.size(), 0);
    const std::uint32_t flags = want == Want::casters     ? Octree::kCasts
                                : want == Want::receivers ? Octree::kReceives
                                                          : 0U;
    for (const Octree& tree : s.trees) {
        tree.query(s.objects, s.bounds, region, flags, found);
    }
    appendSet(found, out);
}

} // namespace gnomon
