// SPDX-License-Identifier: Apache-2.0
#include <gnomon/plan.h>

#include <gtest/gtest.h>

#include <clocale>
#include <limits>

namespace gnomon {
namespace {

Plan tinyPlan()
{
    Plan plan;
    plan.frame = 7;
    plan.lights.resize(2);
    plan.lights[0].view_count = 1;
    plan.lights[1].first_view = 1;
    plan.lights[1].mask_channel = 1;
    plan.lights[1].outcome = {OutcomeKind::no_caster, "nothing \"casts\""};
    plan.atlas = {1024, 1024, 1};
    plan.mask_layers = 1;
    plan.casters = {1, 4};
    plan.receivers = {0, 4};
    View view;
    view.clip_from_world[0][0] = 0.1;
    view.clip_from_world[3][1] = -0.0;
    view.clip_from_world[3][2] = 1e300;
    view.metric.metric_ws = {1.0 / 3.0, 0.0, -2.5e-7, std::numeric_limits<double>::quiet_NaN()};
    view.metric.near_m = 2.0;
    view.metric.far_m = 5.0;
    view.texel_m = 0.25;
    view.texel_xy_m = {0.25, 0.125};
    view.slice = {{0.0, 0.0, -1.0, 5.0}, 2.0, std::numeric_limits<double>::infinity(), 0.5};
    view.fit = {4.0, {0.0625, 0.03125}, {0.25, 0.125}};
    view.light_place_ws = {1.0, 2.0, 3.0};
    view.tile = {0, 0, 0, 1024, 1024};
    view.caster_count = 2;
    view.redraw = false;
    plan.views = {view};
    return plan;
}

constexpr const char* kGolden = R"({
  "frame": 7,
  "technique": {"partition": "single", "fit": "uniform", "filter": "pcf", "soften": "none", "motion": "free"},
  "atlas": {"width": 1024, "height": 1024, "layers": 1},
  "mask_layers": 1,
  "fade": {"begin_m": 0, "end_m": 0},
  "lights": [
    {"outcome": "ok", "reason": "", "first_view": 0, "view_count": 1, "mask_layer": 0, "mask_channel": 0},
    {"outcome": "no_caster", "reason": "nothing \"casts\"", "first_view": 1, "view_count": 0, "mask_layer": 0, "mask_channel": 1}
  ],
  "views": [
    {
      "light": 0,
      "tile": {"layer": 0, "x": 0, "y": 0, "width": 1024, "height": 1024},
      "redraw": false,
      "orthographic": true,
      "parallel": true,
      "clamp_near": true,
      "texel_m": 0.25,
      "texel_xy_m": [0.25, 0.125],
      "fit": {"strength": 4, "finest_texel": [0.0625, 0.03125], "coarsest_texel": [0.25, 0.125]},
      "slice": {"begin_m": 2, "end_m": null, "blend_m": 0.5, "axis": [0, 0, -1, 5]},
      "light_place_ws": [1, 2, 3],
      "clip_from_world_rows": [
        [0.1, 0, 0, 0],
        [0, 1, 0, 0],
        [0, 0, 1, 1e+300],
        [0, 0, 0, 1]
      ],
      "metric": {"near_m": 2, "far_m": 5, "metric_ws": [0.3333333333333333, 0, -2.5e-07, null]},
      "casters": [1, 4]
    }
  ],
  "objects": [
    {"object": 0, "seen": true, "casts_in_views": []},
    {"object": 1, "seen": false, "casts_in_views": [0]},
    {"object": 4, "seen": true, "casts_in_views": [0]}
  ]
}
)";

TEST(PlanJson, GoldenText)
{
    EXPECT_EQ(toJson(tinyPlan()), kGolden);
}

TEST(PlanJson, DoesNotDependOnTheLocale)
{
    for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "C"})
        if (std::setlocale(LC_ALL, name) != nullptr) {
            EXPECT_EQ(toJson(tinyPlan()), kGolden) << name;
        }
    std::setlocale(LC_ALL, "C");
}

TEST(PlanJson, EmptyPlan)
{
    EXPECT_EQ(toJson(Plan{}), R"({
  "frame": 0,
  "technique": {"partition": "single", "fit": "uniform", "filter": "pcf", "soften": "none", "motion": "free"},
  "atlas": {"width": 0, "height": 0, "layers": 0},
  "mask_layers": 0,
  "fade": {"begin_m": 0, "end_m": 0},
  "lights": [],
  "views": [],
  "objects": []
}
)");
}

TEST(PlanJson, EveryOutcomeHasAName)
{
    for (int kind = 0; kind <= static_cast<int>(OutcomeKind::atlas_full); ++kind)
        EXPECT_NE(nameOf(static_cast<OutcomeKind>(kind)), "?");
}

} // namespace
} // namespace gnomon
