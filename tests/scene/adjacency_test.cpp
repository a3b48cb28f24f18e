// SPDX-License-Identifier: Apache-2.0
#include "scene/adjacency.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

namespace gnomon::scene {
namespace {

/// Faces share no vertices, as those with normals of their own do not.
Primitive apartTetrahedron()
{
    const glm::vec3 corners[]{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    Primitive primitive;
    for (const std::uint32_t corner : {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}) {
        primitive.indices.push_back(static_cast<std::uint32_t>(primitive.positions.size()));
        primitive.positions.push_back(corners[corner]);
    }
    return primitive;
}

void append(Primitive& to, const Primitive& other, const glm::vec3& by)
{
    const auto first = static_cast<std::uint32_t>(to.positions.size());
    for (const glm::vec3& p : other.positions) {
        to.positions.push_back(p + by);
    }
    for (const std::uint32_t i : other.indices) {
        to.indices.push_back(first + i);
    }
}

/// Each triangle is at its three edges, on the side that the edge says.
void expectSound(const Adjacency& adjacency)
{
    std::vector<int> found(adjacency.triangles.size(), 0);
    const auto runs = [&](std::uint32_t t, std::uint32_t from, std::uint32_t to) {
        ASSERT_LT(t, adjacency.triangles.size());
        const auto& corners = adjacency.triangles[t];
        bool does = false;
        for (std::size_t k = 0; k < 3; ++k) {
            does = does || (corners[k] == from && corners[(k + 1) % 3] == to);
        }
        EXPECT_TRUE(does) << t << ": " << from << " to " << to;
        ++found[t];
    };
    std::uint32_t open = 0;
    for (const MeshEdge& edge : adjacency.edges) {
        runs(edge.left, edge.from, edge.to);
        if (edge.right == kNone) {
            ++open;
        } else {
            runs(edge.right, edge.to, edge.from);
        }
    }
    EXPECT_EQ(open, adjacency.open_edges);
    EXPECT_TRUE(std::ranges::all_of(found, [](int times) { return times == 3; }));
}

TEST(Adjacency, WeldsVerticesInOnePlace)
{
    const Adjacency adjacency = adjacencyOf(apartTetrahedron());
    EXPECT_EQ(adjacency.triangles.size(), 4U);
    EXPECT_EQ(adjacency.edges.size(), 6U);
    EXPECT_EQ(adjacency.open_edges, 0U);
    expectSound(adjacency);
    std::set<std::uint32_t> vertices;
    for (const auto& corners : adjacency.triangles) {
        vertices.insert(corners.begin(), corners.end());
    }
    EXPECT_EQ(vertices.size(), 4U);
}

TEST(Adjacency, CountsWhatIsOpen)
{
    Primitive open = apartTetrahedron();
    open.indices.resize(9);
    EXPECT_EQ(adjacencyOf(open).open_edges, 3U);
    expectSound(adjacencyOf(open));
    Primitive turned = apartTetrahedron();
    std::swap(turned.indices[0], turned.indices[1]);
    EXPECT_EQ(adjacencyOf(turned).open_edges, 6U) << "one face looks inward, and so fits none of its neighbours";
}

TEST(Adjacency, PairsTrianglesWhereMoreThanTwoMeet)
{
    Primitive two = apartTetrahedron();
    Primitive other = apartTetrahedron();
    for (glm::vec3& p : other.positions) { // they share the edge along x
        p = {p.x, -p.y, -p.z};
    }
    append(two, other, {0, 0, 0});
    const Adjacency adjacency = adjacencyOf(two);
    EXPECT_EQ(adjacency.open_edges, 0U);
    EXPECT_EQ(adjacency.edges.size(), 12U);
    expectSound(adjacency);
}

TEST(Adjacency, TakesTrianglesOfNoSenseForWhatTheyAre)
{
    Primitive primitive = apartTetrahedron();
    const auto first = static_cast<std::uint32_t>(primitive.positions.size());
    primitive.positions.emplace_back(std::numeric_limits<float>::quiet_NaN());
    primitive.positions.emplace_back(std::numeric_limits<float>::infinity());
    // No area, beyond the vertices, not a number, twice the same, and two indices that are no triangle.
    primitive.indices.insert(primitive.indices.end(), {0, 0, 1, 0, 1, 4000000000U, 0, first, first + 1});
    primitive.indices.insert(primitive.indices.end(), {0, 1, 2, 0, 1});
    const Adjacency adjacency = adjacencyOf(primitive);
    EXPECT_EQ(adjacency.triangles.size(), 6U);
    EXPECT_EQ(adjacency.open_edges, 6U) << "three of what is not a number, three of a face that is there twice";
    expectSound(adjacency);
    EXPECT_TRUE(adjacencyOf({}).edges.empty());
}

TEST(Adjacency, AMeshMayBeClosedByItsPrimitivesTogether)
{
    Mesh mesh;
    mesh.primitives.assign(2, apartTetrahedron());
    mesh.primitives[0].indices.resize(6);
    mesh.primitives[1].indices.erase(mesh.primitives[1].indices.begin(), mesh.primitives[1].indices.begin() + 6);
    const MeshClosure closure = closureOf(mesh);
    EXPECT_TRUE(closure.closed());
    EXPECT_EQ(closure.open_edges_of, (std::vector<std::uint32_t>{4, 4}));
    mesh.primitives.pop_back();
    EXPECT_FALSE(closureOf(mesh).closed());
    EXPECT_EQ(closureOf(mesh).open_edges, 4U);
    EXPECT_FALSE(closureOf({}).closed()) << "nothing has no inside";
}

} // namespace
} // namespace gnomon::scene
