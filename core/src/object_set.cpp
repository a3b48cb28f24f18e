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
    std::vector<bool> alive;
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
        alive.push_back(false);
        return handle;
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
    s.alive[handle] = true;
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
    if (box.min == bounds_ws.min && box.max == bounds_ws.max)
        return;
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
    s.alive[object] = false;
    s.record(object);
    s.free_handles.push_back(object);
    std::push_heap(s.free_handles.begin(), s.free_handles.end(), std::greater<>());
}

std::uint32_t ObjectSet::size() const
{
    std::size_t end = impl_->alive.size();
    while (end > 0 && !impl_->alive[end - 1])
        --end;
    return static_cast<std::uint32_t>(end);
}

bool ObjectSet::alive(std::uint32_t object) const
{
    return object < impl_->alive.size() && impl_->alive[object];
}

const Aabb& ObjectSet::bounds(std::uint32_t object) const
{
    assert(alive(object));
    return impl_->objects.bounds_ws[object];
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
        for (std::size_t i = 0; i < s.alive.size(); ++i)
            if (s.alive[i])
                s.enter(s.objects.bounds_ws[i]);
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

std::uint64_t ObjectSet::identity() const
{
    return impl_->identity;
}

void ObjectSet::query(std::span<const Plane> planes, Want want, std::vector<std::uint32_t>& out) const
{
    const Impl& s = *impl_;
    // Marking bits and reading them in order costs a step per object and sorts by the way. Per thread, so that a const
    // set can be asked from several.
    static thread_local std::vector<std::uint64_t> bits;
    bits.assign((s.alive.size() + 63) / 64, 0);
    const RegionTest region(planes);
    const std::uint32_t flags = want == Want::casters     ? Octree::kCasts
                                : want == Want::receivers ? Octree::kReceives
                                                          : 0U;
    for (const Octree& tree : s.trees)
        tree.query(s.objects, region, flags, bits);
    for (std::size_t word = 0; word < bits.size(); ++word)
        for (std::uint64_t left = bits[word]; left != 0; left &= left - 1)
            out.push_back(static_cast<std::uint32_t>(64 * word + static_cast<std::size_t>(std::countr_zero(left))));
}

} // namespace gnomon
