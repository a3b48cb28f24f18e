// SPDX-License-Identifier: Apache-2.0
// Which points of the ground of `canopies` are in full shadow and which see all of the sun, against geometry.
#include "stage.h"

#include "worlds/canopies.h"
#include "worlds/worlds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace gnomon::lab::test {
namespace {

using World = worlds::CanopiesWorld;

std::vector<World::Box> roofs()
{
    std::vector<World::Box> all{World::sail, World::awning};
    for (int i = 0; i < World::slats; ++i) {
        all.push_back(World::slat(i));
    }
    return all;
}

struct Tally {
    int in_two_umbrae = 0;
    int in_umbra = 0;
    int lit = 0;
    int wrong = 0;
};

/// Tallies the ground's points. Posts stand in umbrae, so that geometry of the roofs alone decides.
Tally tallyGround(const Subject& subject, const truth::Traced& traced)
{
    Tally tally;
    const std::vector<World::Box> all = roofs();
    for (std::size_t i = 0; i < traced.surfaces.object_ids.values.size(); ++i) {
        const float* p = &traced.surfaces.points.values[3 * i];
        const glm::dvec3 point = subject.eye.position_ws + glm::dvec3(p[0], p[1], p[2]);
        if (traced.surfaces.object_ids.values[i] == 0 || std::abs(point.y) > 1e-3) {
            continue;
        }
        const auto x = static_cast<float>(point.x);
        const auto z = static_cast<float>(point.z);
        const auto umbrae = std::count_if(all.begin(), all.end(),
                                          [&](const World::Box& roof) { return World::umbraOf(roof).holds(x, z); });
        const bool reached = std::any_of(all.begin(), all.end(),
                                         [&](const World::Box& roof) { return World::reachOf(roof).holds(x, z); });
        const float visibility = traced.visibility.visibility.values[i];
        if (umbrae > 0) {
            ++(umbrae > 1 ? tally.in_two_umbrae : tally.in_umbra);
            tally.wrong += visibility == 0.0F ? 0 : 1;
        } else if (!reached) {
            ++tally.lit;
            tally.wrong += visibility == 1.0F ? 0 : 1;
        }
    }
    return tally;
}

class Canopies : public testing::TestWithParam<truth::Kind> {};

TEST_P(Canopies, TheTruthIsWhatGeometrySays)
{
    for (const char* view : {"side", "top"}) {
        SCOPED_TRACE(view);
        Stage stage(worlds::load("canopies", 1), view, {240, 160});
        const truth::Traced traced = GetParam() == truth::Kind::hard ? stage.hardTruth() : stage.areaTruth(64);
        const Tally tally = tallyGround(stage.subject(), traced);
        EXPECT_EQ(tally.wrong, 0);
        EXPECT_GT(tally.in_two_umbrae, 400);
        EXPECT_GT(tally.in_umbra, 1000);
        EXPECT_GT(tally.lit, 3000);
    }
}

INSTANTIATE_TEST_SUITE_P(Kinds, Canopies, testing::Values(truth::Kind::hard, truth::Kind::area),
                         [](const auto& kind) { return kind.param == truth::Kind::hard ? "hard" : "area"; });

} // namespace
} // namespace gnomon::lab::test
