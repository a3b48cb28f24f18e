// SPDX-License-Identifier: Apache-2.0
#include "geometry/octree.h"

#include <gnomon/object_set.h>

#include <glm/common.hpp>

#include <algorithm>
#include <atomic>
#include <bit>
#include <functional>

namespace gnomon {
namespace {

constexpr Aabb kAnywhere{glm::vec3(-kFarthestBounds_m), glm::vec3(kFarthestBounds_m)};

constexpr ObjectFlags kNothing{.casts = false, .receives = false, .groups = 0};

/// Not so where a coordinate is no number: that fails every comparison.
bool isSomewhere(const Aabb& box, const Aabb& within = kAnywhere)
{
    return within.contains(box) && !box.empty();
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

/// One count for all sets, so that no set takes another's name for one of its own.
std::uint32_t nextGeneration()
{
    static std::atomic<std::uint32_t> last{0};
    const std::uint32_t next = last.fetch_add(1, std::memory_order_relaxed) + 1;
    return next != 0 ? next : last.fetch_add(1, std::memory_order_relaxed) + 1;
}

} // namespace

struct ObjectSet::Impl {
    // By index. Apart from each other, because a plan reads all bounds, then all changes.
    TreeObjects objects; // bounds empty: nowhere, in no tree and without bits
    std::vector<std::uint64_t> changed;
    std::vector<std::uint32_t> generations; // 0: there is no object
    std::vector<ObjectFlags> flags;
    // A bit for each index: somewhere, and somewhere with that flag.
    std::array<std::vector<std::uint64_t>, 3> bits;
    std::vector<std::uint32_t> free_indices; // a heap, the smallest on top: indices stay dense
    std::array<Octree, 2> trees;             // still objects, moving objects: the first one stays as it is
    std::uint64_t version = 0;
    std::uint64_t identity = nextIdentity();
    Aabb bounds;
    bool bounds_loose = false; // an object at the rim left it
    std::uint32_t nowhere = 0;

    [[nodiscard]] bool casts(std::uint32_t index) const { return flags[index].casts && flags[index].groups != 0; }
    void record(std::uint32_t index) { changed[index] = ++version; }
    Octree& treeOf(std::uint32_t index) { return trees[flags[index].dynamic ? 1 : 0]; }
    [[nodiscard]] bool alive(std::size_t index) const { return index < generations.size() && generations[index] != 0; }
    [[nodiscard]] bool names(ObjectId object) const
    {
        return object.index < generations.size() && generations[object.index] == object.generation &&
               object.generation != 0;
    }

    /// For one more index, and for giving every index back: all or nothing, since whatever is taken here may throw.
    void makeRoom()
    {
        const std::size_t room = changed.size() < changed.capacity() ? changed.capacity() : 2 * changed.size() + 16;
        objects.bounds_ws.reserve(room);
        objects.places.reserve(room);
        generations.reserve(room);
        flags.reserve(room);
        for (auto& words : bits) {
            words.reserve(room / 64 + 1);
        }
        free_indices.reserve(room);
        changed.reserve(room);
    }
    std::uint32_t newIndex()
    {
        if (!free_indices.empty()) {
            std::pop_heap(free_indices.begin(), free_indices.end(), std::greater<>());
            const std::uint32_t index = free_indices.back();
            free_indices.pop_back();
            return index;
        }
        const auto index = static_cast<std::uint32_t>(changed.size());
        makeRoom();
        objects.bounds_ws.emplace_back();
        objects.places.emplace_back();
        changed.push_back(0);
        generations.push_back(0);
        flags.emplace_back();
        for (auto& words : bits) {
            words.resize(index / 64 + 1);
        }
        return index;
    }
    [[nodiscard]] std::vector<std::uint64_t>& bitsOf(Want want) { return bits[static_cast<std::size_t>(want)]; }
    void setBits(std::uint32_t index, bool somewhere)
    {
        const std::uint64_t bit = std::uint64_t{1} << (index % 64);
        const auto set = [&](Want want, bool value) {
            std::uint64_t& word = bitsOf(want)[index / 64];
            word = value ? word | bit : word & ~bit;
        };
        set(Want::all, somewhere);
        set(Want::casters, somewhere && casts(index));
        set(Want::receivers, somewhere && flags[index].receives);
    }
    /// Called before an object's box goes or changes.
    void leave(const Aabb& box)
    {
        bounds_loose = bounds_loose || box.min.x <= bounds.min.x || box.min.y <= bounds.min.y ||
                       box.min.z <= bounds.min.z || box.max.x >= bounds.max.x || box.max.y >= bounds.max.y ||
                       box.max.z >= bounds.max.z;
    }
    void enter(const Aabb& box)
    {
        bounds.min = glm::min(bounds.min, box.min);
        bounds.max = glm::max(bounds.max, box.max);
    }
    /// An object that is nowhere gets a place.
    void appear(std::uint32_t index, const Aabb& box)
    {
        const bool receives = flags[index].receives;
        objects.bounds_ws[index] = box;
        setBits(index, true);
        treeOf(index).insert(objects,
                             index | (casts(index) ? Octree::kCasts : 0U) | (receives ? Octree::kReceives : 0U));
        enter(box);
        --nowhere;
    }
    /// Appends all that `want` names, of any group.
    void find(std::span<const Plane> planes, Want want, std::vector<std::uint32_t>& out) const;
    /// An object that has a place loses it.
    void vanish(std::uint32_t index)
    {
        leave(objects.bounds_ws[index]);
        treeOf(index).remove(objects, index);
        objects.bounds_ws[index] = {};
        setBits(index, false);
        ++nowhere;
    }
};

ObjectSet::ObjectSet() : impl_(std::make_unique<Impl>()) {}
ObjectSet::~ObjectSet() = default;
ObjectSet::ObjectSet(ObjectSet&&) noexcept = default;
ObjectSet& ObjectSet::operator=(ObjectSet&&) noexcept = default;

ObjectSet::Impl& ObjectSet::own()
{
    if (impl_ == nullptr) {
        impl_ = std::make_unique<Impl>();
    }
    return *impl_;
}

const ObjectSet::Impl& ObjectSet::read() const
{
    static const Impl empty{};
    return impl_ != nullptr ? *impl_ : empty;
}

ObjectId ObjectSet::add(const Aabb& bounds_ws, ObjectFlags flags)
{
    Impl& s = own();
    if (s.free_indices.empty() && s.changed.size() > Octree::kHandleBits) {
        return {};
    }
    s.trees[flags.dynamic ? 1 : 0].makeRoom();
    const std::uint32_t index = s.newIndex();
    s.generations[index] = nextGeneration();
    s.flags[index] = flags;
    ++s.nowhere;
    if (isSomewhere(bounds_ws)) {
        s.appear(index, bounds_ws);
    }
    s.record(index);
    return {index, s.generations[index]};
}

bool ObjectSet::update(ObjectId object, const Aabb& bounds_ws)
{
    if (!alive(object)) {
        return false;
    }
    Impl& s = *impl_;
    Aabb& box = s.objects.bounds_ws[object.index];
    if (box.min == bounds_ws.min && box.max == bounds_ws.max) {
        return true;
    }
    s.treeOf(object.index).makeRoom();
    const bool was_somewhere = s.objects.places[object.index].node != TreePlace{}.node;
    const bool stays_inside = isSomewhere(bounds_ws, s.bounds); // nearly always
    const bool is_somewhere = stays_inside || isSomewhere(bounds_ws);
    if (was_somewhere && is_somewhere) {
        s.leave(box);
        box = bounds_ws;
        if (!stays_inside) {
            s.enter(bounds_ws);
        }
        s.treeOf(object.index).moved(s.objects, object.index);
    } else if (is_somewhere) {
        s.appear(object.index, bounds_ws);
    } else if (was_somewhere) {
        s.vanish(object.index);
    } else {
        return true; // from nowhere to nowhere
    }
    s.record(object.index);
    return true;
}

bool ObjectSet::touch(ObjectId object)
{
    if (!alive(object)) {
        return false;
    }
    Impl& s = *impl_;
    s.record(object.index);
    return true;
}

bool ObjectSet::setFlags(ObjectId object, const ObjectFlags& flags)
{
    if (!alive(object)) {
        return false;
    }
    Impl& s = *impl_;
    if (s.flags[object.index] == flags) {
        return true;
    }
    s.trees[flags.dynamic ? 1 : 0].makeRoom();
    const Aabb box = s.objects.bounds_ws[object.index];
    if (!box.empty()) { // trees and bits go by the flags
        s.vanish(object.index);
    }
    s.flags[object.index] = flags;
    if (!box.empty()) {
        s.appear(object.index, box);
    }
    s.record(object.index);
    return true;
}

bool ObjectSet::remove(ObjectId object)
{
    if (!alive(object)) {
        return false;
    }
    Impl& s = *impl_;
    if (!s.objects.bounds_ws[object.index].empty()) {
        s.vanish(object.index);
    }
    --s.nowhere;
    s.generations[object.index] = 0;
    s.record(object.index);
    s.free_indices.push_back(object.index);
    std::push_heap(s.free_indices.begin(), s.free_indices.end(), std::greater<>());
    return true;
}

std::uint32_t ObjectSet::size() const
{
    const Impl& s = read();
    std::size_t end = s.generations.size();
    while (end > 0 && s.generations[end - 1] == 0) {
        --end;
    }
    return static_cast<std::uint32_t>(end);
}

bool ObjectSet::alive(ObjectId object) const
{
    return impl_ != nullptr && impl_->names(object);
}

bool ObjectSet::alive(std::uint32_t index) const
{
    return read().alive(index);
}

ObjectId ObjectSet::idAt(std::uint32_t index) const
{
    const Impl& s = read();
    return s.alive(index) ? ObjectId{index, s.generations[index]} : ObjectId{};
}

Aabb ObjectSet::bounds(ObjectId object) const
{
    const Impl& s = read();
    return s.names(object) ? s.objects.bounds_ws[object.index] : Aabb{};
}

Aabb ObjectSet::bounds(std::uint32_t index) const
{
    const Impl& s = read();
    return index < s.objects.bounds_ws.size() ? s.objects.bounds_ws[index] : Aabb{};
}

ObjectFlags ObjectSet::flags(ObjectId object) const
{
    const Impl& s = read();
    return s.names(object) ? s.flags[object.index] : kNothing;
}

ObjectFlags ObjectSet::flags(std::uint32_t index) const
{
    const Impl& s = read();
    return s.alive(index) ? s.flags[index] : kNothing;
}

std::uint32_t ObjectSet::nowhere() const
{
    return read().nowhere;
}

std::span<const Aabb> ObjectSet::allBounds() const
{
    return read().objects.bounds_ws;
}

Aabb ObjectSet::bounds() const
{
    if (impl_ == nullptr) {
        return {};
    }
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
    return read().version;
}

std::uint64_t ObjectSet::changed(std::uint32_t index) const
{
    const std::vector<std::uint64_t>& all = read().changed;
    return index < all.size() ? all[index] : 0;
}

std::span<const std::uint64_t> ObjectSet::allChanges() const
{
    return read().changed;
}

std::uint64_t ObjectSet::identity() const
{
    return read().identity;
}

void ObjectSet::query(std::span<const Plane> planes, Want want, std::vector<std::uint32_t>& out,
                      std::uint32_t groups) const
{
    const Impl& s = read();
    const auto first = static_cast<std::ptrdiff_t>(out.size());
    s.find(planes, want, out);
    if (want == Want::casters && groups != kAllGroups) {
        const auto others = std::remove_if(out.begin() + first, out.end(),
                                           [&](std::uint32_t index) { return (s.flags[index].groups & groups) == 0; });
        out.erase(others, out.end());
    }
}

void ObjectSet::Impl::find(std::span<const Plane> planes, Want want, std::vector<std::uint32_t>& out) const
{
    const RegionTest region(planes);
    const glm::dvec3 low(bounds.min);
    const glm::dvec3 high(bounds.max);
    std::uint32_t mask = region.allPlanes();
    if (bounds.empty() || !region.narrow((low + high) * 0.5, (high - low) * 0.5, mask)) {
        return;
    }
    const std::vector<std::uint64_t>& all = bits[static_cast<std::size_t>(want)];
    if (mask == 0) {
        appendSet(all, out); // the whole world is inside
        return;
    }
    // Marking bits and reading them in order costs a step per object and sorts by the way. Per thread, so that a const
    // set can be asked from several.
    static thread_local std::vector<std::uint64_t> found;
    found.assign(all.size(), 0);
    const std::uint32_t wanted = want == Want::casters     ? Octree::kCasts
                                 : want == Want::receivers ? Octree::kReceives
                                                           : 0U;
    for (const Octree& tree : trees) {
        tree.query(objects, bounds, region, wanted, found);
    }
    appendSet(found, out);
}

std::vector<OctreeCell> ObjectSet::cells() const
{
    std::vector<OctreeCell> cells;
    for (const Octree& tree : read().trees) {
        tree.visitCells([&](const glm::dvec3& centre, double half, std::uint32_t objects) {
            cells.push_back({{glm::vec3(centre - half), glm::vec3(centre + half)}, objects});
        });
    }
    return cells;
}

} // namespace gnomon
