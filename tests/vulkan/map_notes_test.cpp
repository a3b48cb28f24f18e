// SPDX-License-Identifier: Apache-2.0
// The notes of a backend of its maps' texels: maps recover after a skipped frame, with a new renderer, and when they
// come back to sight.
#include "fixture.h"

#include <gnomon/pack/map_notes.h>

#include <gtest/gtest.h>

namespace gnomon::test {
namespace {

using pack::MapNotes;
using pack::ViewWork;

View viewOf(MapId map, Tile tile, ContentNumber presumes, ContentNumber makes)
{
    View view;
    view.place.map = map;
    view.place.tile = tile;
    view.contents.presumes = presumes;
    view.contents.makes = makes;
    view.contents.redraw = presumes != makes;
    return view;
}

Plan planOf(std::vector<View> views)
{
    Plan plan;
    plan.lights.resize(1);
    plan.views = std::move(views);
    plan.map_count = 8;
    return plan;
}

ViewWork drawn(MapNotes& contents, const Plan& plan)
{
    const ViewWork work = contents.workFor(plan)[0];
    contents.done(plan);
    return work;
}

constexpr Tile kTile{0, 0, 0, 64, 64};

TEST(MapNotes, whatHoldsIsLeftAlone)
{
    MapNotes contents;
    EXPECT_TRUE(drawn(contents, planOf({viewOf({1, 0}, kTile, 7, 7)})).draw) << "never drawn here";
    EXPECT_FALSE(drawn(contents, planOf({viewOf({1, 0}, kTile, 7, 7)})).draw);
    EXPECT_TRUE(drawn(contents, planOf({viewOf({1, 0}, kTile, 7, 8)})).draw);
    EXPECT_FALSE(drawn(contents, planOf({viewOf({1, 0}, kTile, 8, 8)})).draw);
    EXPECT_TRUE(drawn(contents, planOf({viewOf({1, 0}, {1, 0, 0, 64, 64}, 8, 8)})).draw) << "it lies elsewhere";
    View half = viewOf({1, 0}, kTile, 8, 8);
    EXPECT_TRUE(drawn(contents, planOf({half})).draw);
    half.place.part = TexelPart::first;
    EXPECT_TRUE(drawn(contents, planOf({half})).draw) << "it has a part of its texels alone";
}

TEST(MapNotes, aSkippedFrameIsMadeUpFor)
{
    MapNotes contents;
    View view = viewOf({1, 0}, kTile, 0, 1);
    view.contents.kept_layer = 0;
    view.contents.kept_map = {2, 0};
    view.contents.kept_presumes = 0;
    view.contents.kept_makes = 5;
    view.contents.redraw_kept = true;
    EXPECT_TRUE(drawn(contents, planOf({view})).draw_kept);
    view.contents.presumes = 1;
    view.contents.makes = 2;
    view.contents.kept_presumes = 5;
    view.contents.redraw_kept = false;
    view.contents.dirty = {0, 0, 4, 4};
    ViewWork work = drawn(contents, planOf({view}));
    EXPECT_TRUE(work.draw);
    EXPECT_FALSE(work.whole || work.draw_kept);
    view.contents.presumes = 3; // 2 to 3 was planned and not recorded
    view.contents.makes = 4;
    work = drawn(contents, planOf({view}));
    EXPECT_TRUE(work.whole);
    EXPECT_FALSE(work.draw_kept) << "what stands still is there";
    contents.lose(0);
    view.contents.makes = 6;
    view.contents.redraw = true;
    work = drawn(contents, planOf({view}));
    EXPECT_TRUE(work.whole && work.draw_kept);
}

TEST(MapNotes, whatLiesUnderAnotherMapIsGone)
{
    MapNotes contents;
    (void)drawn(contents, planOf({viewOf({1, 0}, kTile, 0, 1)}));
    (void)drawn(contents, planOf({viewOf({2, 0}, {1, 0, 0, 64, 64}, 0, 2)}));
    (void)drawn(contents, planOf({viewOf({3, 0}, {0, 32, 32, 64, 64}, 0, 3)}));
    EXPECT_TRUE(drawn(contents, planOf({viewOf({1, 0}, kTile, 1, 1)})).draw);
    EXPECT_FALSE(drawn(contents, planOf({viewOf({2, 0}, {1, 0, 0, 64, 64}, 2, 2)})).draw);
    View part = viewOf({4, 0}, {1, 0, 0, 64, 64}, 0, 9);
    part.place.part = TexelPart::first;
    (void)drawn(contents, planOf({part}));
    View other = part;
    other.place.map = {5, 0};
    other.place.part = TexelPart::second;
    (void)drawn(contents, planOf({other}));
    part.contents.presumes = 9;
    part.contents.redraw = false;
    EXPECT_FALSE(drawn(contents, planOf({part})).draw) << "they share their texels";
}

TEST(MapNotes, whatNobodyReadsIsLeftAlone)
{
    MapNotes contents;
    EXPECT_FALSE(drawn(contents, planOf({viewOf({1, 0}, kTile, 3, 0)})).draw);
    View by_hand; // without a name: as it says
    by_hand.place.tile = kTile;
    EXPECT_TRUE(drawn(contents, planOf({by_hand})).draw);
    by_hand.contents.redraw = false;
    EXPECT_FALSE(drawn(contents, planOf({by_hand})).draw);
}

// Three spots with maps of layered variances, whose layers are placed where depths gather and then stay.
class Layered : public testing::Test {
protected:
    Layered() : bench_({96, 64}, optionsOf())
    {
        const std::vector<Light> spots{makeSpot({-6.0, 9.0, 5.0}, {0.0, 0.0, 0.0}, 0.6),
                                       makeSpot({7.0, 4.0, 2.0}, {0.0, 0.0, 0.0}, 0.5),
                                       makeSpot({1.0, 12.0, -6.0}, {0.0, 0.0, 0.0}, 0.3)};
        bench_.setLights(spots, {{0, 0, 0, 64, 64}, {1, 0, 0, 64, 64}, {2, 0, 0, 64, 64}}, {64, 64, 3});
        for (std::uint32_t i = 0; i < 3; ++i) {
            bench_.plan.views[i].place.map = {i, 0};
            bench_.plan.views[i].contents.makes = 100 + i;
        }
        bench_.plan.map_count = 3;
        all_ = bench_.plan;
    }
    static ShadowOptions optionsOf()
    {
        ShadowOptions options{.technique = kPlainTechnique};
        options.technique.filter = Filter::lvsm;
        options.technique.motion = Motion::snap;
        options.format = MapFormat::rgba16;
        options.moments.placement = LayerPlacement::lloyd;
        return options;
    }
    /// Records a frame in which only these lights have views.
    void record(std::initializer_list<std::uint32_t> lights, bool drawn_before)
    {
        bench_.plan.views.clear();
        for (LightPlan& light : bench_.plan.lights) {
            light.first_view = 0;
            light.view_count = 0;
            light.outcome.kind = OutcomeKind::no_receiver;
        }
        for (const std::uint32_t light : lights) {
            View view = all_.views[light];
            view.contents.presumes = drawn_before ? view.contents.makes : 0;
            view.contents.redraw = !drawn_before;
            bench_.plan.lights[light].first_view = static_cast<std::uint32_t>(bench_.plan.views.size());
            bench_.plan.lights[light].view_count = 1;
            bench_.plan.lights[light].outcome.kind = OutcomeKind::ok;
            bench_.plan.views.push_back(view);
        }
        bench_.prepare();
        bench_.record(1);
    }

    Bench bench_;
    Plan all_;
};

TEST_F(Layered, mapsThatComeBackToSightAreReadWithTheirOwnLayers)
{
    record({0, 1, 2}, false);
    const auto mask = bench_.readMask(2);
    const auto layers = bench_.renderer.depthLayers(bench_.plan, 2);
    record({0}, true);
    record({0, 2}, true);
    EXPECT_EQ(bench_.renderer.reuse(0).held, 2U);
    const auto later = bench_.renderer.depthLayers(bench_.plan, 1);
    ASSERT_EQ(later.size(), layers.size());
    for (std::size_t i = 0; i < layers.size(); ++i) {
        EXPECT_EQ(later[i].begins, layers[i].begins) << i;
        EXPECT_EQ(later[i].near, layers[i].near) << i;
    }
    EXPECT_EQ(bench_.readMask(2), mask);
    expectSilence(gpu());
}

TEST_F(Layered, layersAreCopiedWhenTheirBufferGrows)
{
    record({0, 1, 2}, false);
    const auto mask = bench_.readMask(1);
    bench_.plan.map_count = 9;
    bench_.plan.pages[0].layers = 5;
    bench_.plan.pages[0].width = 128;
    record({0, 1, 2}, true);
    EXPECT_EQ(bench_.renderer.reuse(0).held, 3U);
    EXPECT_EQ(bench_.readMask(1), mask);
    expectSilence(gpu());
}

TEST_F(Layered, aRendererMadeAnewDrawsWhatThePlanThinksIsThere)
{
    record({0, 1, 2}, false);
    const auto mask = bench_.readMask(1);
    Bench other({96, 64}, optionsOf());
    other.setLights(bench_.lights, {{0, 0, 0, 64, 64}, {1, 0, 0, 64, 64}, {2, 0, 0, 64, 64}}, {64, 64, 3});
    other.plan = bench_.plan;
    for (View& view : other.plan.views) {
        view.contents.presumes = view.contents.makes;
        view.contents.redraw = false;
    }
    other.prepare();
    other.record(1);
    EXPECT_EQ(other.renderer.reuse(0).drawn, 3U);
    EXPECT_EQ(other.readMask(1), mask);
    expectSilence(gpu());
}

} // namespace
} // namespace gnomon::test
