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
    plan.options = std::make_shared<const std::vector<ResolvedOptions>>(1, resolvedOrThrow({}));
    plan.frame = 7;
    plan.lights.resize(2);
    plan.lights[0].view_count = 1;
    plan.lights[1].first_view = 1;
    plan.lights[1].mask_channel = 1;
    plan.lights[1].outcome = {OutcomeKind::no_caster, "nothing \"casts\""};
    plan.lights[1].options = 1;
    plan.lights[1].sample = {true, {1.0, 2.0, 3.0}, {0.0, -1.0, 0.0}};
    SunSteps& steps = plan.lights[1].steps;
    steps.stepping = true;
    steps.paired = true;
    steps.later_ws = {0.6, -0.8, 0.0};
    steps.share = 0.25;
    steps.smooth = true;
    steps.band = 0.5;
    steps.edge = 0.375;
    plan.pages[0] = {1024, 1024, 1};
    plan.pages[0].kept_layers = 2;
    plan.pages[0].wanted_texels = 4096 * 4096;
    plan.pages[0].given_texels = 1024 * 1024;
    plan.pages[0].drawn_texels = 512 * 1024;
    plan.pages[0].waiting_lights = 1;
    plan.pages[0].waiting_maps = 3;
    plan.pages[0].longest_wait = 5;
    plan.lights[0].halved = 2;
    plan.lights[0].waited = 5;
    plan.mask_layers = 1;
    plan.casters = {4, 1}; // what moves comes last
    plan.receivers = {0, 4};
    View view;
    view.projection.clip_from_world[0][0] = 0.1;
    view.projection.clip_from_world[3][1] = -0.0;
    view.projection.clip_from_world[3][2] = 1e300;
    view.projection.metric.metric_ws = {1.0 / 3.0, 0.0, -2.5e-7, std::numeric_limits<double>::quiet_NaN()};
    view.projection.metric.near_m = 2.0;
    view.projection.metric.far_m = 5.0;
    view.projection.texel_m = 0.25;
    view.projection.texel_xy_m = {0.25, 0.125};
    view.serves.slice = {
        {0.0, 0.0, -1.0, 5.0}, 2.0, std::numeric_limits<double>::infinity(), 0.5, {0.0, -1.0, 0.0, 3.0}};
    view.fit = {4.0, {0.0625, 0.03125}, {0.25, 0.125}};
    view.projection.light_place_ws = {1.0, 2.0, 3.0};
    view.place.tile = {0, 0, 0, 1024, 1024};
    view.casters.count = 2;
    view.place.part = TexelPart::second;
    view.serves.sun = SunPosition::later;
    view.casters.still = 1;
    view.contents.kept_layer = 1;
    view.contents.dirty = {3, 4, 5, 6};
    view.place.map = {3, 2};
    view.contents.waited = 2;
    plan.views = {view};
    return plan;
}

constexpr const char* kGolden = R"({
  "frame": 7,
  "technique": {"partition": "auto", "fit": "auto", "filter": "raymarch", "soften": "none", "motion": "free"},
  "pages": [
    {"width": 1024, "height": 1024, "layers": 1, "kept_layers": 2, "wanted_texels": 16777216, "given_texels": 1048576, "drawn_texels": 524288, "waiting_lights": 1, "waiting_maps": 3, "longest_wait": 5}
  ],
  "mask_layers": 1,
  "fade": {"begin_m": 0, "end_m": 0},
  "lights": [
    {"outcome": "ok", "reason": "", "first_view": 0, "view_count": 1, "mask_layer": 0, "mask_channel": 0, "mask_coloured": false, "options": 0, "halved": 2, "waited": 5, "steps": null, "sample": null},
    {"outcome": "no_caster", "reason": "nothing \"casts\"", "first_view": 1, "view_count": 0, "mask_layer": 0, "mask_channel": 1, "mask_coloured": false, "options": 1, "halved": 0, "waited": 0, "steps": {"paired": true, "earlier_ws": [0, -1, 0], "later_ws": [0.6, -0.8, 0], "share": 0.25, "smooth": true, "band": 0.5, "edge": 0.375, "alternate": false, "read": "earlier"}, "sample": {"position_ws": [1, 2, 3], "direction_ws": [0, -1, 0]}}
  ],
  "views": [
    {
      "light": 0,
      "map": {"index": 3, "generation": 2},
      "tile": {"layer": 0, "x": 0, "y": 0, "width": 1024, "height": 1024},
      "part": "second",
      "sun": "later",
      "redraw": true,
      "waited": 2,
      "kept": {"map": null, "layer": 1, "redraw": false, "still_count": 1, "dirty": {"x": 3, "y": 4, "width": 5, "height": 6}},
      "orthographic": true,
      "parallel": true,
      "clamp_near": true,
      "texel_m": 0.25,
      "texel_xy_m": [0.25, 0.125],
      "fit": {"strength": 4, "finest_texel": [0.0625, 0.03125], "coarsest_texel": [0.25, 0.125]},
      "slice": {"begin_m": 2, "end_m": null, "blend_m": 0.5, "axis": [0, 0, -1, 5], "over": [0, -1, 0, 3]},
      "light_place_ws": [1, 2, 3],
      "clip_from_world_rows": [
        [0.1, 0, 0, 0],
        [0, 1, 0, 0],
        [0, 0, 1, 1e+300],
        [0, 0, 0, 1]
      ],
      "metric": {"near_m": 2, "far_m": 5, "metric_ws": [0.3333333333333333, 0, -2.5e-07, null]},
      "casters": [4, 1]
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

TEST(PlanJson, WhatIsDrawnAllAtOnceHasNothingKept)
{
    Plan plan = tinyPlan();
    plan.views[0].contents.kept_layer = kNoIndex;
    plan.casters = {1, 4}; // then all are ascending
    const std::string text = toJson(plan);
    EXPECT_NE(text.find("\"kept\": null"), std::string::npos);
    EXPECT_NE(text.find("{\"object\": 1, \"seen\": false, \"casts_in_views\": [0]}"), std::string::npos);
    EXPECT_NE(text.find("{\"object\": 4, \"seen\": true, \"casts_in_views\": [0]}"), std::string::npos);
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
  "technique": {"partition": "auto", "fit": "auto", "filter": "raymarch", "soften": "none", "motion": "free"},
  "pages": [
    {"width": 0, "height": 0, "layers": 0, "kept_layers": 0, "wanted_texels": 0, "given_texels": 0, "drawn_texels": 0, "waiting_lights": 0, "waiting_maps": 0, "longest_wait": 0}
  ],
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
