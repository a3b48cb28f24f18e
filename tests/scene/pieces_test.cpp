// SPDX-License-Identifier: Apache-2.0
#include "scene/pieces.h"

#include <glm/gtc/constants.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <utility>

namespace gnomon::scene {
namespace {

/// With vertices of its own.
void addQuad(Primitive& to, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d)
{
    const auto first = static_cast<std::uint32_t>(to.positions.size());
    to.positions.insert(to.positions.end(), {a, b, c, d});
    for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) {
        to.indices.push_back(first + i);
    }
}

/// A prism with `sides` sides, each with vertices of its own.
Primitive prism(std::uint32_t sides)
{
    Primitive made;
    const auto rim = [&](std::uint32_t i, float y) {
        const float angle = glm::two_pi<float>() * static_cast<float>(i % sides) / static_cast<float>(sides);
        return glm::vec3(std::cos(angle), y, -std::sin(angle));
    };
    for (std::uint32_t i = 0; i < sides; ++i) {
        addQuad(made, rim(i, 0.0F), rim(i + 1, 0.0F), rim(i + 1, 1.0F), rim(i, 1.0F));
    }
    for (std::uint32_t i = 1; i + 1 < sides; ++i) {
        const auto first = static_cast<std::uint32_t>(made.positions.size());
        made.positions.insert(made.positions.end(), {rim(0, 1.0F), rim(i, 1.0F), rim(i + 1, 1.0F)});
        made.positions.insert(made.positions.end(), {rim(0, 0.0F), rim(i + 1, 0.0F), rim(i, 0.0F)});
        for (std::uint32_t k = 0; k < 6; ++k) {
            made.indices.push_back(first + k);
        }
    }
    return made;
}

/// Two squares that share an edge, the second one turned up by `angle` radians.
Primitive bentSheet(double angle)
{
    Primitive made;
    const auto x = static_cast<float>(1.0 + std::cos(angle));
    const auto y = static_cast<float>(std::sin(angle));
    addQuad(made, {0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0});
    addQuad(made, {1, 0, 0}, {1, 0, 1}, {x, y, 1}, {x, y, 0});
    return made;
}

void expectSound(const Primitive& primitive, const Pieces& pieces)
{
    ASSERT_EQ(pieces.of_vertex.size(), primitive.positions.size());
    for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        const std::uint16_t piece = pieces.of_vertex[primitive.indices[i]];
        EXPECT_EQ(pieces.of_vertex[primitive.indices[i + 1]], piece);
        EXPECT_EQ(pieces.of_vertex[primitive.indices[i + 2]], piece);
        EXPECT_LT(piece, pieces.count);
    }
}

TEST(Pieces, EndAtCreases)
{
    // Its sides meet at 60 degrees; of 32 sides at 11, so they are one, and with top and bottom three.
    for (const auto& [sides, count] : {std::pair{3U, 5U}, std::pair{4U, 6U}, std::pair{6U, 8U}, std::pair{8U, 10U},
                                       std::pair{10U, 3U}, std::pair{32U, 3U}}) {
        const Primitive made = prism(sides);
        const Pieces pieces = piecesOf(made);
        EXPECT_EQ(pieces.count, count) << sides;
        expectSound(made, pieces);
        EXPECT_EQ(pieces.of_vertex[0], 0);
    }
    EXPECT_EQ(piecesOf(bentSheet(kCreaseAngle_rad - 0.01)).count, 1U);
    EXPECT_EQ(piecesOf(bentSheet(kCreaseAngle_rad + 0.01)).count, 2U);
    EXPECT_EQ(piecesOf(bentSheet(-kCreaseAngle_rad - 0.01)).count, 2U);
}

// Faces that share vertices are shaded as one surface, and a vertex has only one number.
TEST(Pieces, AreOneWhereVerticesAreShared)
{
    Primitive cube;
    for (int i = 0; i < 8; ++i) {
        cube.positions.emplace_back((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1);
    }
    cube.indices = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 4, 6, 0, 6, 2,
                    1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3};
    EXPECT_EQ(piecesOf(cube).count, 1U);
    Primitive apart;
    for (const std::uint32_t i : cube.indices) {
        apart.indices.push_back(static_cast<std::uint32_t>(apart.positions.size()));
        apart.positions.push_back(cube.positions[i]);
    }
    EXPECT_EQ(piecesOf(apart).count, 6U);
    expectSound(apart, piecesOf(apart));
}

// Faces that do not touch are separate pieces, wherever they lie; and numbers repeat.
TEST(Pieces, AreCountedUpToTheMostThatThereAre)
{
    Primitive many;
    for (std::uint32_t i = 0; i < kMostPieces + 3; ++i) {
        const auto x = 2.0F * static_cast<float>(i);
        addQuad(many, {x, 0, 0}, {x, 0, 1}, {x + 1, 0, 1}, {x + 1, 0, 0});
    }
    const Pieces pieces = piecesOf(many);
    EXPECT_EQ(pieces.count, kMostPieces);
    expectSound(many, pieces);
    EXPECT_EQ(pieces.of_vertex[std::size_t{4} * 7], 7);
    EXPECT_EQ(pieces.of_vertex.back(), 2);
}

TEST(Pieces, AreOfAnyNumbers)
{
    EXPECT_EQ(piecesOf({}).count, 1U);
    Primitive wrong = bentSheet(1.0);
    wrong.indices.push_back(900);
    wrong.indices.push_back(0);
    wrong.indices.push_back(1);
    wrong.indices.push_back(2); // and one that is no triangle
    wrong.positions[3].x = std::numeric_limits<float>::quiet_NaN();
    expectSound(bentSheet(1.0), piecesOf(bentSheet(1.0)));
    EXPECT_LE(piecesOf(wrong).count, 3U);
    std::mt19937 rng(5);
    for (int run = 0; run < 200; ++run) {
        Primitive any;
        for (int i = 0; i < 12; ++i) {
            any.positions.emplace_back(rng() % 3, rng() % 3, rng() % 3);
        }
        for (int i = 0; i < 30; ++i) {
            any.indices.push_back(static_cast<std::uint32_t>(rng() % any.positions.size()));
        }
        expectSound(any, piecesOf(any));
    }
}

} // namespace
} // namespace gnomon::scene
