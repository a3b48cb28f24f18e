// SPDX-License-Identifier: Apache-2.0
// T. Forsyth, GDC 2006: a duel, the eye looking into a lamp, is solved by three or four regions at the extreme. Counted
// are the frustums that hold the direction from the lamp to the eye, in which texels differ most.
#include "folder.h"
#include "process.h"

#include "app/command_line.h"
#include "app/shot.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace gnomon {
namespace {

using nlohmann::json;

glm::dvec4 rowOf(const json& row)
{
    return {row[0].get<double>(), row[1].get<double>(), row[2].get<double>(), row[3].get<double>()};
}

bool holds(const json& view, const glm::dvec3& p)
{
    const json& sector = view["sector"];
    const glm::dvec4 at(p, 1.0);
    const double w = glm::dot(rowOf(sector["w"]), at);
    return w > 0.0 && std::abs(glm::dot(rowOf(sector["x"]), at)) <= w &&
           std::abs(glm::dot(rowOf(sector["y"]), at)) <= w;
}

TEST(MultiDuel, HasAtMostFourRegionsTowardsTheEye)
{
    app::Settings settings = app::defaultSettings();
    settings.scene = "ring";
    settings.camera = "duel";
    const glm::dvec3 eye_ws = app::makeShot(settings).eye.position_ws;
    const test::Folder folder;
    const test::Ran ran =
        test::gnomon({"plan", "ring", "--camera", "duel", "--partition", "multi", "--set", "multi.divide=receivers",
                      "--size", "320x180", "--texels", "1572864", "--json", "-"},
                     {.folder = folder.path()});
    ASSERT_EQ(ran.status, 0) << ran.err;
    const json plan = json::parse(ran.out);
    const json& lights = plan["lights"];
    const auto reactor = std::ranges::find_if(lights, [](const json& light) { return light["name"] == "reactor 12"; });
    ASSERT_NE(reactor, lights.end());
    const auto first = plan["views"].begin() + (*reactor)["first_view"].get<std::ptrdiff_t>();
    const auto count = (*reactor)["view_count"].get<std::ptrdiff_t>();
    const auto regions = std::count_if(first, first + count, [&](const json& view) { return holds(view, eye_ws); });
    EXPECT_GE(regions, 2);
    EXPECT_LE(regions, 4);
    EXPECT_GT(count, 4) << "the reactor is amid the hall: no four cones of 120 degrees go around it";
}

} // namespace
} // namespace gnomon
