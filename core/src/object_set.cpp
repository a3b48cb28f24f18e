// SPDX-License-Identifier: Apache-2.0
#include "geometry/octree.h"

#include <gnomon/object_set.h>

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
    std::vector<TreeObject> objects;
    std::vector<ObjectFlags> flags;
    std::vector<std::uint32_t> free_handles; // a heap, the smallest on top: handles stay dense
    std::array<Octree, 2> trees;             // what stands still, what moves: the first one stays as it is
    std::uint64_t version = 0;
    std::uint64_t identity = nextIdentity();
    Aabb bounds;
    bool bounds_loose = false; // an object at the rim left it

    void record(std::uint32_t object) { objects[object].changed = ++version; }

    /// Called before an object's box goes or changes.
    void leave(const Aabb& box)
    {
        bounds_loose |=
            glm::any(glm::lessThanEqual(box.min, bounds.min)) || glm::any(glm::greaterThanEqual(box.max, bounds.max));
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
    std::uint32_t handle = 0;
    if (s.free_handles.empty()) {
        handle = static_cast<std::uint32_t>(s.objects.size());
        s.objects.emplace_back();
        s.flags.emplace_back();
    } else {
        std::pop_heap(s.free_handles.begin(), s.free_handles.end(), std::greater<>());
        handle = s.free_handles.back();
        s.free_handles.pop_back();
    }
    TreeObject& object = s.objects[handle];
    object.bounds_ws = bounds_ws;
    object.tree = flags.dynamic ? 1 : 0;
    object.alive = true;
    object.casts = flags.casts;
    object.receives = flags.receives;
    s.flags[handle] = flags;
    s.trees[object.tree].insert(s.objects, handle);
    s.bounds = merge(s.bounds, bounds_ws);
    s.record(handle);
    return handle;
}

void ObjectSet::update(std::uint32_t object, const Aabb& bounds_ws)
{
    assert(alive(object) && !bounds_ws.empty() && finite(bounds_ws));
    Impl& s = *impl_;
    TreeObject& entry = s.objects[object];
    if (entry.bounds_ws.min == bounds_ws.min && entry.bounds_ws.max == bounds_ws.max)
        return;
    s.leave(entry.bounds_ws);
    entry.bounds_ws = bounds_ws;
    s.bounds = merge(s.bounds, bounds_ws);
    s.trees[entry.tree].moved(s.objects, object);
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
    TreeObject& entry = s.objects[object];
    s.leave(entry.bounds_ws);
    s.trees[entry.tree].remove(s.objects, object);
    entry.alive = false;
    s.record(object);
    s.free_handles.push_back(object);
    std::push_heap(s.free_handles.begin(), s.free_handles.end(), std::greater<>());
}

std::uint32_t ObjectSet::size() const
{
    std::size_t end = impl_->objects.size();
    while (end > 0 && !impl_->objects[end - 1].alive)
        --end;
    return static_cast<std::uint32_t>(end);
}

bool ObjectSet::alive(std::uint32_t object) const
{
    return object < impl_->objects.size() && impl_->objects[object].alive;
}

const Aabb& ObjectSet::bounds(std::uint32_t object) const
{
    assert(alive(object));
    return impl_->objects[object].bounds_ws;
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
        for (const TreeObject& object : s.objects)
            if (object.alive)
                s.bounds = merge(s.bounds, object.bounds_ws);
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
    assert(object < impl_->objects.size());
    return impl_->objects[object].changed;
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
    bits.assign((s.objects.size() + 63) / 64, 0);
    const RegionTest region(planes);
    const auto wanted = want == Want::casters     ? Octree::Want::casters
                        : want == Want::receivers ? Octree::Want::receivers
                                                  : Octree::Want::all;
    for (const Octree& tree : s.trees)
        tree.query(s.objects, region, wanted, bits);
    for (std::size_t word = 0; word < bits.size(); ++word)
        for (std::uint64_t left = bits[word]; left != 0; left &= left - 1)
            out.push_back(static_cast<std::uint32_t>(64 * word + static_cast<std::size_t>(std::countr_zero(left))));
}

} // namespace gnomon
