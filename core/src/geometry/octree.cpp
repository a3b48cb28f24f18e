// SPDX-License-Identifier: Apache-2.0
#include "geometry/octree.h"

#include <glm/common.hpp>

#include <algorithm>
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
    // An object that moved may have its centre beyond the cell while its box is still inside the loose bounds; a
    // child's loose bounds would not hold it.
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

std::uint32_t Octree::newBlock(std::uint32_t next)
{
    std::uint32_t index = 0;
    if (free_blocks_.empty()) {
        index = static_cast<std::uint32_t>(blocks_.size());
        blocks_.emplace_back();
        free_blocks_.reserve(blocks_.capacity());
    } else {
        index = free_blocks_.back();
        free_blocks_.pop_back();
    }
    blocks_[index].next = next;
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
        if (apart <= root.half && sizeOf(box) <= 2.0 * root.half) {
            return;
        }
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

void Octree::link(TreeObjects& objects, std::uint32_t item, std::uint32_t index)
{
    std::uint32_t slot = nodes_[index].inFirst();
    if (nodes_[index].count == 0 || slot == kBlockItems) {
        const std::uint32_t block = newBlock(nodes_[index].first);
        nodes_[index].first = block;
        slot = 0;
    }
    Node& node = nodes_[index];
    blocks_[node.first].items[slot] = item;
    ++node.count;
    objects.places[item & kHandleBits] = {index, node.first, slot};
}

/// Fills the gap with the node's last item. Returns the item taken out.
std::uint32_t Octree::unlink(TreeObjects& objects, std::uint32_t handle)
{
    TreePlace& gap = objects.places[handle];
    Node& node = nodes_[gap.node];
    const std::uint32_t item = blocks_[gap.block].items[gap.slot];
    const std::uint32_t last = blocks_[node.first].items[node.inFirst() - 1];
    blocks_[gap.block].items[gap.slot] = last;
    objects.places[last & kHandleBits] = {gap.node, gap.block, gap.slot};
    if (node.inFirst() == 1) {
        free_blocks_.push_back(node.first);
        node.first = blocks_[node.first].next;
    }
    --node.count;
    gap = {};
    return item;
}

void Octree::place(TreeObjects& objects, std::uint32_t item, std::uint32_t index, int depth)
{
    const Aabb& box = objects.bounds_ws[item & kHandleBits];
    const double size = sizeOf(box);
    while (nodes_[index].divided && size <= nodes_[index].half) {
        index = childFor(index, box);
        ++depth;
    }
    link(objects, item, index);
    if (!nodes_[index].divided && nodes_[index].count > kSplitAbove && depth < kMaxDepth) {
        divide(objects, index, depth);
    }
}

void Octree::divide(TreeObjects& objects, std::uint32_t index, int depth)
{
    // Taken out whole and put back one by one: what goes to a child, what stays here.
    std::uint32_t block = nodes_[index].first;
    std::uint32_t in_block = nodes_[index].inFirst();
    nodes_[index].first = kNone;
    nodes_[index].count = 0;
    while (block != kNone) {
        const Block taken = blocks_[block];
        free_blocks_.push_back(block);
        for (std::uint32_t i = 0; i < in_block; ++i) {
            const Aabb& box = objects.bounds_ws[taken.items[i] & kHandleBits];
            if (fitsChild(nodes_[index], box)) {
                nodes_[index].divided = true;
                place(objects, taken.items[i], childFor(index, box), depth + 1);
            } else {
                link(objects, taken.items[i], index);
            }
        }
        block = taken.next;
        in_block = kBlockItems;
    }
}

void Octree::makeRoom()
{
    const auto grow = [](auto& made, std::vector<std::uint32_t>& free) {
        if (made.capacity() - made.size() + free.size() < kMostNew) {
            made.reserve(std::max(2 * made.capacity(), made.size() + kMostNew));
        }
        free.reserve(made.capacity());
    };
    grow(nodes_, free_nodes_);
    grow(blocks_, free_blocks_);
}

void Octree::insert(TreeObjects& objects, std::uint32_t item)
{
    growRoot(objects.bounds_ws[item & kHandleBits]);
    place(objects, item, root_, 0);
}

void Octree::prune(std::uint32_t index)
{
    while (index != root_ && nodes_[index].count == 0 && nodes_[index].child_count == 0) {
        const std::uint32_t parent = nodes_[index].parent;
        Node& above = nodes_[parent];
        for (std::uint32_t& child : above.children) {
            if (child == index) {
                child = kNone;
            }
        }
        // A cell without children is whole again, and fills up before it is divided anew.
        if (--above.child_count == 0) {
            above.divided = false;
        }
        free_nodes_.push_back(index);
        index = parent;
    }
}

void Octree::remove(TreeObjects& objects, std::uint32_t handle)
{
    const std::uint32_t node = objects.places[handle].node;
    unlink(objects, handle);
    prune(node);
}

void Octree::moved(TreeObjects& objects, std::uint32_t handle)
{
    const std::uint32_t node = objects.places[handle].node;
    if (holds(nodes_[node], objects.bounds_ws[handle])) {
        return;
    }
    // Placed before the old node is pruned: the two often share most of their path.
    insert(objects, unlink(objects, handle));
    prune(node);
}

void Octree::query(const TreeObjects& objects, const Aabb& around_ws, const RegionTest& region, std::uint32_t want,
                   std::span<std::uint64_t> bits) const
{
    if (root_ != kNone && !around_ws.empty()) {
        visit({objects, region, want, bits, glm::dvec3(around_ws.min), glm::dvec3(around_ws.max)}, root_,
              region.allPlanes());
    }
}

void Octree::mark(const Walk& walk, const Node& node, std::uint32_t mask) const
{
    std::uint32_t in_block = node.inFirst();
    for (std::uint32_t block = node.first; block != kNone; block = blocks_[block].next) {
        if (blocks_[block].next != kNone) {
            __builtin_prefetch(&blocks_[blocks_[block].next]);
        }
        for (std::uint32_t i = 0; i < in_block; ++i) {
            const std::uint32_t item = blocks_[block].items[i];
            const std::uint32_t handle = item & kHandleBits;
            bool wanted = (item & walk.want) == walk.want;
            if (mask != 0 && wanted) {
                wanted = walk.region.touches(walk.objects.bounds_ws[handle], mask);
            }
            walk.bits[handle / 64] |= std::uint64_t{wanted} << (handle % 64);
        }
        in_block = kBlockItems;
    }
}

void Octree::visit(const Walk& walk, std::uint32_t index, std::uint32_t mask) const
{
    const Node& node = nodes_[index];
    if (mask != 0) {
        const glm::dvec3 low = glm::max(walk.low, node.centre - 2.0 * node.half);
        const glm::dvec3 high = glm::min(walk.high, node.centre + 2.0 * node.half);
        if (!walk.region.narrow((low + high) * 0.5, glm::max((high - low) * 0.5, 0.0), mask)) {
            return;
        }
    }
    mark(walk, node, mask);
    if (node.child_count == 0) {
        return;
    }
    // In a large world nodes and lists come from far memory: asked for together, they are waited for once.
    for (const std::uint32_t child : node.children) {
        if (child != kNone) {
            __builtin_prefetch(&nodes_[child]);
        }
    }
    for (const std::uint32_t child : node.children) {
        if (child != kNone && nodes_[child].first != kNone) {
            __builtin_prefetch(&blocks_[nodes_[child].first]);
        }
    }
    for (const std::uint32_t child : node.children) {
        if (child != kNone) {
            visit(walk, child, mask);
        }
    }
}

} // namespace gnomon
