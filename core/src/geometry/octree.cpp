// SPDX-License-Identifier: Apache-2.0
#include "geometry/octree.h"

#include <glm/common.hpp>

#include <algorithm>
#include <bit>
#include <cmath>

namespace gnomon {
namespace {

glm::dvec3 centreOf(const Aabb& box)
{
    return (glm::dvec3(box.min) + glm::dvec3(box.max)) * 0.5;
}

double sizeOf(const Aabb& box)
{
    const glm::dvec3 extent = glm::dvec3(box.max) - glm::dvec3(box.min);
    return std::max({extent.x, extent.y, extent.z});
}

} // namespace

RegionTest::RegionTest(std::span<const Plane> planes)
{
    std::size_t count = 0;
    for (const Plane& plane : planes.first(std::min(planes.size(), kMaxPlanes)))
        planes_[count++] = {plane.normal, plane.d, glm::abs(plane.normal)};
    all_ = static_cast<std::uint32_t>((std::uint64_t{1} << count) - 1);
}

bool RegionTest::narrow(const glm::dvec3& centre, const glm::dvec3& half, std::uint32_t& mask) const
{
    for (std::uint32_t left = mask; left != 0; left &= left - 1) {
        const TestPlane& plane = planes_[static_cast<std::size_t>(std::countr_zero(left))];
        const double distance = glm::dot(plane.normal, centre) + plane.d;
        // Rounding must not push out what touches the plane.
        const double reach =
            glm::dot(plane.size, half) + 1e-12 * (std::abs(plane.d) + glm::dot(plane.size, glm::abs(centre)));
        if (distance < -reach)
            return false;
        if (distance > reach)
            mask &= ~(left & (~left + 1));
    }
    return true;
}

bool RegionTest::touches(const Aabb& box, std::uint32_t mask) const
{
    if (mask == 0)
        return true;
    const glm::dvec3 low(box.min);
    const glm::dvec3 high(box.max);
    return narrow((low + high) * 0.5, (high - low) * 0.5, mask);
}

bool Octree::holds(const Node& node, const Aabb& box)
{
    const double reach = 2.0 * node.half;
    const glm::dvec3 low = glm::dvec3(box.min) - node.centre;
    const glm::dvec3 high = glm::dvec3(box.max) - node.centre;
    return low.x >= -reach && low.y >= -reach && low.z >= -reach && high.x <= reach && high.y <= reach &&
           high.z <= reach;
}

bool Octree::fitsChild(const Node& node, const Aabb& box)
{
    // What moved may have its centre beyond the cell while its box is still inside the loose bounds; a child's loose
    // bounds would not hold it.
    const glm::dvec3 offset = glm::abs(centreOf(box) - node.centre);
    return std::max({offset.x, offset.y, offset.z}) <= node.half && sizeOf(box) <= node.half;
}

std::uint32_t Octree::newNode(const glm::dvec3& centre, double half, std::uint32_t parent)
{
    std::uint32_t index = 0;
    if (free_nodes_.empty()) {
        index = static_cast<std::uint32_t>(nodes_.size());
        nodes_.emplace_back();
        // A freed node must find room without allocating.
        free_nodes_.reserve(nodes_.capacity());
    } else {
        index = free_nodes_.back();
        free_nodes_.pop_back();
        nodes_[index] = Node{};
    }
    Node& node = nodes_[index];
    node.centre = centre;
    node.half = half;
    node.parent = parent;
    node.children.fill(kNone);
    return index;
}

std::uint32_t Octree::childFor(std::uint32_t index, const Aabb& box)
{
    const glm::dvec3 centre = centreOf(box);
    const glm::dvec3 offset = centre - nodes_[index].centre;
    const std::size_t octant = (offset.x >= 0.0 ? 1U : 0U) | (offset.y >= 0.0 ? 2U : 0U) | (offset.z >= 0.0 ? 4U : 0U);
    if (nodes_[index].children[octant] == kNone) {
        const double half = nodes_[index].half * 0.5;
        const glm::dvec3 child_centre =
            nodes_[index].centre +
            glm::dvec3(offset.x >= 0.0 ? half : -half, offset.y >= 0.0 ? half : -half, offset.z >= 0.0 ? half : -half);
        const std::uint32_t child = newNode(child_centre, half, index);
        nodes_[index].children[octant] = child;
        ++nodes_[index].child_count;
    }
    return nodes_[index].children[octant];
}

void Octree::growRoot(const Aabb& box)
{
    const glm::dvec3 centre = centreOf(box);
    if (root_ == kNone) {
        // A power of two keeps every cell's centre exact in binary for a long way down.
        const double half = std::exp2(std::ceil(std::log2(std::max(sizeOf(box), 1.0))));
        root_ = newNode(centre, half, kNone);
        return;
    }
    for (;;) {
        const Node& root = nodes_[root_];
        const glm::dvec3 offset = centre - root.centre;
        const double apart = std::max({std::abs(offset.x), std::abs(offset.y), std::abs(offset.z)});
        if (apart <= root.half && sizeOf(box) <= 2.0 * root.half)
            return;
        const glm::dvec3 toward(offset.x >= 0.0 ? 1.0 : -1.0, offset.y >= 0.0 ? 1.0 : -1.0,
                                offset.z >= 0.0 ? 1.0 : -1.0);
        const double half = root.half;
        const std::uint32_t old_root = root_;
        root_ = newNode(root.centre + toward * half, 2.0 * half, kNone);
        // Seen from the new centre the old cell lies the other way.
        const std::size_t octant = (toward.x < 0.0 ? 1U : 0U) | (toward.y < 0.0 ? 2U : 0U) | (toward.z < 0.0 ? 4U : 0U);
        nodes_[root_].children[octant] = old_root;
        nodes_[root_].child_count = 1;
        nodes_[root_].divided = true;
        nodes_[old_root].parent = root_;
    }
}

void Octree::link(std::vector<TreeObject>& objects, std::uint32_t object, std::uint32_t index)
{
    Node& node = nodes_[index];
    TreeObject& entry = objects[object];
    entry.node = index;
    entry.previous = kNone;
    entry.next = node.first;
    if (node.first != kNone)
        objects[node.first].previous = object;
    node.first = object;
    ++node.count;
}

void Octree::unlink(std::vector<TreeObject>& objects, std::uint32_t object)
{
    TreeObject& entry = objects[object];
    Node& node = nodes_[entry.node];
    if (entry.previous != kNone)
        objects[entry.previous].next = entry.next;
    else
        node.first = entry.next;
    if (entry.next != kNone)
        objects[entry.next].previous = entry.previous;
    --node.count;
    entry.node = kNone;
    entry.next = kNone;
    entry.previous = kNone;
}

void Octree::place(std::vector<TreeObject>& objects, std::uint32_t object, std::uint32_t index, int depth)
{
    const Aabb& box = objects[object].bounds_ws;
    const double size = sizeOf(box);
    while (nodes_[index].divided && size <= nodes_[index].half) {
        index = childFor(index, box);
        ++depth;
    }
    link(objects, object, index);
    if (!nodes_[index].divided && nodes_[index].count > kSplitAbove && depth < kMaxDepth)
        divide(objects, index, depth);
}

void Octree::divide(std::vector<TreeObject>& objects, std::uint32_t index, int depth)
{
    bool any_small = false;
    for (std::uint32_t i = nodes_[index].first; i != kNone && !any_small; i = objects[i].next)
        any_small = fitsChild(nodes_[index], objects[i].bounds_ws);
    if (!any_small)
        return;
    nodes_[index].divided = true;
    std::uint32_t next = kNone;
    for (std::uint32_t i = nodes_[index].first; i != kNone; i = next) {
        next = objects[i].next;
        if (!fitsChild(nodes_[index], objects[i].bounds_ws))
            continue;
        unlink(objects, i);
        place(objects, i, childFor(index, objects[i].bounds_ws), depth + 1);
    }
}

void Octree::insert(std::vector<TreeObject>& objects, std::uint32_t object)
{
    growRoot(objects[object].bounds_ws);
    place(objects, object, root_, 0);
}

void Octree::prune(std::uint32_t index)
{
    while (index != root_ && nodes_[index].count == 0 && nodes_[index].child_count == 0) {
        const std::uint32_t parent = nodes_[index].parent;
        Node& above = nodes_[parent];
        for (std::uint32_t& child : above.children)
            if (child == index)
                child = kNone;
        // A cell without children is whole again, and fills up before it is divided anew.
        if (--above.child_count == 0)
            above.divided = false;
        free_nodes_.push_back(index);
        index = parent;
    }
}

void Octree::remove(std::vector<TreeObject>& objects, std::uint32_t object)
{
    const std::uint32_t node = objects[object].node;
    unlink(objects, object);
    prune(node);
}

void Octree::moved(std::vector<TreeObject>& objects, std::uint32_t object)
{
    if (holds(nodes_[objects[object].node], objects[object].bounds_ws))
        return;
    // Placed before the old node is pruned: the two often share most of their path.
    const std::uint32_t node = objects[object].node;
    unlink(objects, object);
    insert(objects, object);
    prune(node);
}

void Octree::query(const std::vector<TreeObject>& objects, const RegionTest& region, Want want,
                   std::span<std::uint64_t> bits) const
{
    if (root_ != kNone)
        visit({objects, region, want, bits}, root_, region.allPlanes());
}

void Octree::visit(const Walk& walk, std::uint32_t index, std::uint32_t mask) const
{
    const Node& node = nodes_[index];
    if (mask != 0 && !walk.region.narrow(node.centre, glm::dvec3(2.0 * node.half), mask))
        return;
    for (std::uint32_t i = node.first; i != kNone; i = walk.objects[i].next) {
        const TreeObject& object = walk.objects[i];
        const bool wanted = walk.want == Want::all || (walk.want == Want::casters ? object.casts : object.receives);
        if (wanted && walk.region.touches(object.bounds_ws, mask))
            walk.bits[i / 64] |= std::uint64_t{1} << (i % 64);
    }
    if (node.child_count != 0)
        for (const std::uint32_t child : node.children)
            if (child != kNone)
                visit(walk, child, mask);
}

} // namespace gnomon
