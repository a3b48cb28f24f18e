// SPDX-License-Identifier: Apache-2.0
// Filters id and depth-id against what can be said in closed form.
#include "cpu_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace gnomon::shared {
namespace {

constexpr double kIds = 255.0;

class ObjectIds : public testing::Test {
protected:
    ObjectIds()
    {
        input.kernel = glm::dvec4(kIdTestAny, kIds, -1.0, 65535.0);
        input.rows.metric = {0.0, 0.0, 0.1, 0.0}; // depth is z, ten metres of it
        input.object_half = glm::dvec3(1.0);
        point.cap = 1.0;
        point.w = 1.0;
    }
    ~ObjectIds() override
    {
        test::map_texels = nullptr;
        test::map_seconds = nullptr;
    }
    ObjectIds(const ObjectIds&) = delete;
    ObjectIds& operator=(const ObjectIds&) = delete;

    /// Fills the map from the id of the object at each texel.
    template <class IdAt>
    static void draw(IdAt id_at)
    {
        test::map_texels = [id_at](int x, int y) {
            return id_at(x, y) / kIds;
        };
    }
    double seen(double own, double x, double y = 20.5)
    {
        input.id = own;
        point.texel = {x, y};
        return filterId(point, input);
    }

    FilterInput input{};
    MapPoint point{};
};

TEST_F(ObjectIds, oneObjectLightsItself)
{
    draw([](int, int) { return 7; });
    std::mt19937 rng(1);
    std::uniform_real_distribution<double> place(4.0, 60.0);
    for (int i = 0; i < 1000; ++i) {
        EXPECT_EQ(seen(7.0, place(rng), place(rng)), 1.0);
        EXPECT_EQ(seen(8.0, place(rng), place(rng)), 0.0);
    }
}

// As integers have it: they follow the first one, and after the last comes 1.
TEST_F(ObjectIds, thoseOfPiecesFollowTheFirst)
{
    for (const int ids : {255, 65535}) {
        std::mt19937 rng(2);
        for (int i = 0; i < 200000; ++i) {
            const int first = 1 + static_cast<int>(rng() % static_cast<unsigned>(ids));
            const int piece = static_cast<int>(rng() % static_cast<unsigned>(kMostPieces));
            ASSERT_EQ(idOfPiece(double(first), double(piece), double(ids)), (first - 1 + piece) % ids + 1)
                << first << " " << piece << " of " << ids;
        }
        EXPECT_EQ(idOfPiece(double(ids), 1.0, double(ids)), 1.0);
        EXPECT_EQ(idOfPiece(double(ids), 0.0, double(ids)), double(ids));
        EXPECT_EQ(idOfPiece(0.0, 5.0, double(ids)), 0.0); // what has no id has no pieces
    }
}

// A cube under a light from above and the left: its left side has the texels before 10, its top those behind. The
// cube's right side, behind them, is lit as long as the cube has one id, and in its shadow where each face has one.
TEST_F(ObjectIds, aCubeIsInItsOwnShadowByItsFaces)
{
    constexpr double kFirst = 254.0; // so that numbers come again
    const auto id = [](double piece) {
        return idOfPiece(kFirst, piece, kIds);
    };
    draw([](int, int) { return int(kFirst); });
    for (double x = 8.0; x < 12.0; x += 0.01) {
        EXPECT_EQ(seen(kFirst, x), 1.0);
    }
    draw([&](int x, int) { return id(x < 10 ? 0.0 : 4.0); });
    for (double x = 8.0025; x < 12.0; x += 0.01) {
        EXPECT_EQ(seen(id(1.0), x), 0.0) << x;
        EXPECT_EQ(seen(id(0.0), x), x < 10.5 ? 1.0 : 0.0) << x; // lit up to its edge, and no halo there
        EXPECT_EQ(seen(id(4.0), x), x >= 9.5 ? 1.0 : 0.0) << x;
    }
}

// An object covers the texels before 10, so its shadow on the other one ends at 10. Any of four: half a texel less.
TEST_F(ObjectIds, betweenTwoTheShadowIsHalfATexelSmaller)
{
    draw([](int x, int) { return x < 10 ? 3 : 4; });
    for (int i = 0; i < 400; ++i) {
        const double x = 8.0025 + 0.01 * i;
        EXPECT_EQ(seen(4.0, x), x >= 9.5 ? 1.0 : 0.0) << x;
        EXPECT_EQ(seen(3.0, x), x < 10.5 ? 1.0 : 0.0) << x;
    }
    input.kernel.x = kIdTestNearest;
    for (int i = 0; i < 400; ++i) {
        const double x = 8.0025 + 0.01 * i;
        EXPECT_EQ(seen(4.0, x), x >= 10.0 ? 1.0 : 0.0) << x;
    }
}

// Across a corner the nearest four may lie a texel away along the diagonal, and never farther.
TEST_F(ObjectIds, shadowsShrinkByATexelAtTheMost)
{
    draw([](int x, int y) { return x < 30 && y < 20 + x / 3 ? 3 : 4; });
    std::mt19937 rng(2);
    std::uniform_real_distribution<double> place(10.0, 40.0);
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec2 at(place(rng), place(rng));
        if (seen(4.0, at.x, at.y) == 0.0) {
            continue;
        }
        bool is_near = false;
        for (const double dx : {-1.0, 0.0, 1.0}) {
            for (const double dy : {-1.0, 0.0, 1.0}) {
                is_near |= test::map_texels(int(std::floor(at.x + dx)), int(std::floor(at.y + dy))) * kIds > 3.5;
            }
        }
        EXPECT_TRUE(is_near) << at.x << " " << at.y;
    }
}

TEST_F(ObjectIds, ofFourThatMeetEachIsLitAndAFifthIsNot)
{
    draw([](int x, int y) { return 1 + (x < 10 ? 0 : 1) + (y < 20 ? 0 : 2); });
    for (const double x : {9.6, 10.0, 10.4}) {
        for (const double y : {19.6, 20.0, 20.4}) {
            for (const double own : {1.0, 2.0, 3.0, 4.0}) {
                EXPECT_EQ(seen(own, x, y), 1.0);
            }
            EXPECT_EQ(seen(5.0, x, y), 0.0);
        }
    }
}

// Whatever ids there are: giving an object the id of another one never darkens a receiver.
TEST_F(ObjectIds, collisionsOnlyLoseShadows)
{
    std::mt19937 rng(3);
    std::uniform_int_distribution<int> any_id(0, 6);
    std::uniform_real_distribution<double> place(1.0, 7.0);
    std::size_t lost = 0;
    for (int round = 0; round < 200; ++round) {
        std::vector<int> ids(64);
        for (int& id : ids) {
            id = any_id(rng);
        }
        const int merged = 1 + round % 6;
        for (int i = 0; i < 50; ++i) {
            const double x = place(rng);
            const double y = place(rng);
            const int own = 1 + i % 6;
            draw([&ids](int tx, int ty) { return ids.at(std::size_t(ty * 8 + tx)); });
            const double told_apart = seen(own, x, y);
            draw([&ids, merged](int tx, int ty) {
                const int id = ids.at(std::size_t(ty * 8 + tx));
                return id == 6 ? merged : id;
            });
            const double collided = seen(own == 6 ? merged : own, x, y);
            EXPECT_GE(collided, told_apart);
            lost += collided > told_apart ? 1 : 0;
        }
    }
    EXPECT_GT(lost, 100U);
}

TEST_F(ObjectIds, whereNothingCastsEverythingIsLit)
{
    draw([](int, int) { return 0; });
    EXPECT_EQ(seen(9.0, 10.2), 1.0);
    EXPECT_EQ(seen(0.0, 10.2), 1.0);
    draw([](int, int) { return 9; });
    EXPECT_EQ(seen(0.0, 10.2), 0.0); // the ground under an object
}

TEST_F(ObjectIds, ofTwoIdsTheOneHandedOutLaterIsBehind)
{
    IdRule rule{};
    rule.ids = kIds;
    EXPECT_TRUE(idIsBehind(254.0, 2.0, rule)); // from 1 again
    EXPECT_FALSE(idIsBehind(2.0, 254.0, rule));
    for (const double order : {0.0, 1.0}) {
        rule.order = order;
        EXPECT_TRUE(idIsBehind(3.0, 4.0, rule));
        EXPECT_FALSE(idIsBehind(4.0, 3.0, rule));
        EXPECT_FALSE(idIsBehind(4.0, 4.0, rule));
        EXPECT_FALSE(idIsBehind(0.0, 4.0, rule)); // the ground has nothing behind it
        for (double a = 1.0; a <= kIds; ++a) {
            for (double b = 1.0; b <= kIds; ++b) {
                EXPECT_EQ(idIsBehind(a, b, rule) || idIsBehind(b, a, rule), a != b);
            }
        }
    }
    EXPECT_FALSE(idIsBehind(254.0, 2.0, rule)) << "they do not begin again";
    EXPECT_TRUE(idIsBehind(2.0, 254.0, rule));
}

// Beside an edge of the receiver the nearest texel has what is behind: a dark halo, unless order says so.
TEST_F(ObjectIds, priorityHasNoHalosAndShadowsAsLargeAsTheyAre)
{
    input.kernel.x = kIdTestPriority;
    draw([](int x, int) { return x < 10 ? 3 : 4; }); // 3 is in front of 4
    EXPECT_EQ(seen(3.0, 10.2), 1.0);                 // its own edge
    EXPECT_EQ(seen(3.0, 11.2), 0.0);                 // where it has no texel
    EXPECT_EQ(seen(4.0, 9.8), 0.0);                  // its shadow on what is behind
    EXPECT_EQ(seen(4.0, 10.2), 1.0);
    input.kernel.x = kIdTestNearest;
    EXPECT_EQ(seen(3.0, 10.2), 0.0);
}

// Over two metres 8 bits are 7.8 mm, "about a centimetre".
TEST_F(ObjectIds, eightBitsOverTwoMetresAreACentimetre)
{
    const glm::dvec3 along(0.0, 0.0, 0.1);
    const double extent = objectExtent(along, {0.3, 0.3, 1.0});
    EXPECT_NEAR(2.0 * extent, 0.2, 0.001);
    const double step_m = 2.0 * extent * 10.0 / 255.0;
    EXPECT_NEAR(step_m, 0.0078, 0.0001);
    EXPECT_LT(step_m, 0.01);
    for (double z = -0.99; z < 0.98; z += 0.01) {
        const auto stored = [&](double at) {
            return std::round(objectDepth(along, {0.0, 0.0, at}, extent) * 255.0);
        };
        EXPECT_GT(stored(z + 0.01), stored(z));
    }
}

TEST_F(ObjectIds, aBoxesOwnDepthsAreInsideOfItsRange)
{
    std::mt19937 rng(4);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 along = glm::dvec3(any(rng), any(rng), any(rng)) * 0.05;
        const glm::dvec3 half(std::abs(any(rng)), std::abs(any(rng)), i % 7 == 0 ? 0.0 : std::abs(any(rng)));
        const double extent = objectExtent(along, half);
        double least = 1.0;
        double most = 0.0;
        for (int k = 0; k < 8; ++k) {
            const glm::dvec3 corner = half * glm::dvec3((k & 1) * 2 - 1, (k & 2) - 1, (k & 4) / 2 - 1);
            const double depth = objectDepth(along, corner, extent);
            least = std::min(least, depth);
            most = std::max(most, depth);
        }
        EXPECT_GE(least, 0.0);
        EXPECT_LE(most, 1.0);
        EXPECT_NEAR(least + most, 1.0, 1e-9);
    }
}

/// A receiver at this height over its object's middle, along the light, where the map has the object at `stored_m`.
double seenWithin(FilterInput& input, MapPoint& point, double own, double stored_m, double z_m)
{
    const glm::dvec3 along(0.0, 0.0, 0.1);
    const double extent = objectExtent(along, input.object_half);
    const double steps = std::abs(input.kernel.w);
    test::map_texels = [](int, int) {
        return 3 / kIds;
    };
    test::map_seconds = [=](int, int) {
        return std::round(objectDepth(along, {0.0, 0.0, stored_m}, extent) * steps) / steps;
    };
    input.id = own;
    input.object_centre = {0.0, 0.0, 5.0};
    input.place = {0.0, 0.0, 5.0 + z_m};
    point.texel = {10.3, 10.6};
    point.depth = 0.1 * (5.0 + z_m);
    return filterDepthId(point, input);
}

TEST_F(ObjectIds, withinAnObjectItsDepthsAreCompared)
{
    for (const double steps : {255.0, 65535.0}) {
        input.kernel = glm::dvec4(kIdTestPriority, kIds, -1.0, steps);
        const double step_m = 2.0 / steps;
        for (double z_m = -0.8; z_m < 0.9; z_m += 0.037) {
            EXPECT_EQ(seenWithin(input, point, 3.0, z_m, z_m), 1.0) << "its own surface, however it was rounded";
            EXPECT_EQ(seenWithin(input, point, 3.0, z_m - 2.0 * step_m, z_m), 0.0) << "under what is in front";
            EXPECT_EQ(seenWithin(input, point, 4.0, z_m + 0.1, z_m), 0.0) << "another object, whatever its depth";
        }
        input.kernel.z = 0.1; // of the radius, the square root of 3
        EXPECT_EQ(seenWithin(input, point, 3.0, 0.2 - 0.16, 0.2), 1.0);
        EXPECT_EQ(seenWithin(input, point, 3.0, 0.2 - 0.2, 0.2), 0.0);
    }
}

} // namespace
} // namespace gnomon::shared
