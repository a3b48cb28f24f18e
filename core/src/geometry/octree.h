// SPDX-License-Identifier: Apache-2.0
// A loose octree over boxes that are kept elsewhere. An object hangs in the smallest node whose cell holds its centre
// and whose cell is as large as it is; so its box is inside the cell grown by half its size on every side, and a
// moving object stays where it is until it leaves that.
// Based on: T. Ulrich, "Loose Octrees", Game Programming Gems, 2000. Departures: a cell is divided only when it holds
// more than a few objects (Ulrich divides by size alone), and the root grows by doubling toward what lies outside it.
#pragma once

#include <gnomon/geometry.h>

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon {

/// What the tree knows of one object: 48 bytes, so that following a node's list touches one cache line each.
struct TreeObject {
    Aabb bounds_ws;
    std::uint32_t next = 0xFFFFFFFFU;
    std::uint32_t previous = 0xFFFFFFFFU;
    std::uint32_t node = 0xFFFFFFFFU;
    std::uint8_t tree = 0; // which of its owner's trees
    bool alive = false;
    bool casts = false;
    bool receives = false;
    std::uint64_t changed = 0;
};

/// The planes of a query, made ready for testing boxes.
class RegionTest {
public:
    /// More than 32 planes: the rest is left out, which only makes the region larger.
    explicit RegionTest(std::span<const Plane> planes);

    [[nodiscard]] std::uint32_t allPlanes() const { return all_; }
    /// Drops from `mask` the planes that the box is inside of; false when it is outside one.
    [[nodiscard]] bool narrow(const glm::dvec3& centre, const glm::dvec3& half, std::uint32_t& mask) const;
    /// The same for a box that is only kept or not.
    [[nodiscard]] bool touches(const Aabb& box, std::uint32_t mask) const;

private:
    static constexpr std::size_t kMaxPlanes = 32;
    struct TestPlane {
        glm::dvec3 normal;
        double d;
        glm::dvec3 size; // |normal|
    };
    std::array<TestPlane, kMaxPlanes> planes_;
    std::uint32_t all_ = 0;
};

class Octree {
public:
    /// Objects are named by their index in `objects`; its links are the tree's to write.
    void insert(std::vector<TreeObject>& objects, std::uint32_t object);
    void remove(std::vector<TreeObject>& objects, std::uint32_t object);
    /// After `bounds_ws` of an object in the tree changed.
    void moved(std::vector<TreeObject>& objects, std::uint32_t object);

    /// Sets the bit of every object that the region may touch and whose flag `want` names is set.
    enum class Want : std::uint8_t { casters, receivers, all };
    void query(const std::vector<TreeObject>& objects, const RegionTest& region, Want want,
               std::span<std::uint64_t> bits) const;

private:
    static constexpr std::uint32_t kNone = 0xFFFFFFFFU;
    static constexpr std::uint32_t kSplitAbove = 12; // objects in an undivided cell
    static constexpr int kMaxDepth = 24;

    struct Node {
        glm::dvec3 centre{0.0};
        double half = 0.0; // of the cell, not of its loose bounds
        std::array<std::uint32_t, 8> children{};
        std::uint32_t parent = kNone;
        std::uint32_t first = kNone; // its own objects
        std::uint32_t count = 0;
        std::uint8_t child_count = 0;
        bool divided = false;
    };
    struct Walk {
        const std::vector<TreeObject>& objects;
        const RegionTest& region;
        Want want;
        std::span<std::uint64_t> bits;
    };

    [[nodiscard]] static bool holds(const Node& node, const Aabb& box);
    [[nodiscard]] static bool fitsChild(const Node& node, const Aabb& box);
    [[nodiscard]] std::uint32_t newNode(const glm::dvec3& centre, double half, std::uint32_t parent);
    [[nodiscard]] std::uint32_t childFor(std::uint32_t node, const Aabb& box);
    void growRoot(const Aabb& box);
    void place(std::vector<TreeObject>& objects, std::uint32_t object, std::uint32_t node, int depth);
    void divide(std::vector<TreeObject>& objects, std::uint32_t node, int depth);
    void link(std::vector<TreeObject>& objects, std::uint32_t object, std::uint32_t node);
    void unlink(std::vector<TreeObject>& objects, std::uint32_t object);
    void prune(std::uint32_t node);
    void visit(const Walk& walk, std::uint32_t node, std::uint32_t mask) const;

    std::vector<Node> nodes_;
    std::vector<std::uint32_t> free_nodes_;
    std::uint32_t root_ = kNone;
};

} // namespace gnomon
