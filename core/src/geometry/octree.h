// SPDX-License-Identifier: Apache-2.0
// A loose octree over boxes that are kept elsewhere. An object hangs in the smallest node whose cell holds its centre
// and whose cell is as large as it is; so its box is inside the cell grown by half its size on every side, and a
// moving object stays where it is until it leaves that.
// Based on: T. Ulrich, "Loose Octrees", Game Programming Gems, 2000. Departures: a cell is divided only when it holds
// more than a few objects (Ulrich divides by size alone), and the root grows by doubling toward what lies outside it.
#pragma once

#include "geometry/region_test.h"

#include <gnomon/geometry.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon {

/// Where an object hangs. Written by its tree alone.
struct TreePlace {
    std::uint32_t node = 0xFFFFFFFFU;
    std::uint32_t block = 0;
    std::uint32_t slot = 0;
};

/// The owner's data of all objects, by handle; several trees may share it.
struct TreeObjects {
    std::vector<Aabb> bounds_ws;
    std::vector<TreePlace> places;
};

class Octree {
public:
    /// An object's flags ride in the two upper bits of what a node lists, so that a query reads them without a detour.
    static constexpr std::uint32_t kCasts = 1U << 30;
    static constexpr std::uint32_t kReceives = 1U << 31;
    static constexpr std::uint32_t kHandleBits = kCasts - 1;

    /// Takes all memory that the next insert() or moved() may need, so that neither throws: a tree is never left torn.
    void makeRoom();
    /// `item` is the handle with its flags. After makeRoom().
    void insert(TreeObjects& objects, std::uint32_t item);
    void remove(TreeObjects& objects, std::uint32_t handle);
    /// After the bounds of an object in the tree changed, and makeRoom().
    void moved(TreeObjects& objects, std::uint32_t handle);

    /// Sets the bit of every object that the region may touch and that has all flags of `want`. `around_ws` holds all
    /// objects: a world is mostly flat, and cut by it the high cells of the tree are, too.
    void query(const TreeObjects& objects, const Aabb& around_ws, const RegionTest& region, std::uint32_t want,
               std::span<std::uint64_t> bits) const;

    /// Hands the middle, half the size and the number of objects of each cell that has some to `visit`.
    template <typename Visit>
    void visitCells(const Visit& visit) const
    {
        for (const Node& node : nodes_) { // those that are free have none
            if (node.count != 0) {
                visit(node.centre, node.half, node.count);
            }
        }
    }

private:
    static constexpr std::uint32_t kNone = 0xFFFFFFFFU;
    static constexpr std::uint32_t kSplitAbove = 24; // objects in an undivided cell
    static constexpr int kMaxDepth = 24;
    static constexpr std::uint32_t kBlockItems = 15;
    // Nodes, and blocks, that one insertion may make: the root grows from the smallest float to the largest, and then
    // each of kMaxDepth cells on the way is divided in eight.
    static constexpr std::size_t kMostNew = 277 + 8 * kMaxDepth;

    /// One cache line of a node's list.
    struct alignas(64) Block {
        std::array<std::uint32_t, kBlockItems> items{};
        std::uint32_t next = kNone;
    };
    struct Node {
        glm::dvec3 centre{0.0};
        double half = 0.0; // half the cell's side, without its loose bounds
        std::array<std::uint32_t, 8> children{};
        std::uint32_t parent = kNone;
        std::uint32_t first = kNone; // block; it alone may have room left
        std::uint32_t count = 0;     // number of its own objects
        std::uint8_t child_count = 0;
        bool divided = false;

        [[nodiscard]] std::uint32_t inFirst() const { return count == 0 ? 0 : (count - 1) % kBlockItems + 1; }
    };
    struct Walk {
        const TreeObjects& objects;
        const RegionTest& region;
        std::uint32_t want;
        std::span<std::uint64_t> bits;
        glm::dvec3 low; // corner of the box around all objects
        glm::dvec3 high;
    };

    [[nodiscard]] static bool holds(const Node& node, const Aabb& box);
    [[nodiscard]] static bool fitsChild(const Node& node, const Aabb& box);
    [[nodiscard]] std::uint32_t newNode(const glm::dvec3& centre, double half, std::uint32_t parent);
    [[nodiscard]] std::uint32_t newBlock(std::uint32_t next);
    [[nodiscard]] std::uint32_t childFor(std::uint32_t node, const Aabb& box);
    void growRoot(const Aabb& box);
    void place(TreeObjects& objects, std::uint32_t item, std::uint32_t node, int depth);
    void divide(TreeObjects& objects, std::uint32_t node, int depth);
    void link(TreeObjects& objects, std::uint32_t item, std::uint32_t node);
    std::uint32_t unlink(TreeObjects& objects, std::uint32_t handle);
    void prune(std::uint32_t node);
    void visit(const Walk& walk, std::uint32_t node, std::uint32_t mask) const;
    void mark(const Walk& walk, const Node& node, std::uint32_t mask) const;

    std::vector<Node> nodes_;
    std::vector<std::uint32_t> free_nodes_;
    std::vector<Block> blocks_;
    std::vector<std::uint32_t> free_blocks_;
    std::uint32_t root_ = kNone;
};

} // namespace gnomon
