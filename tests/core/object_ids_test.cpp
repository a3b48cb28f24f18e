// SPDX-License-Identifier: Apache-2.0
// Ids of objects: whom they are given, when maps of them are drawn anew, what they cost, and what they do not go with.
#include "worlds.h"

#include <gnomon/object_ids.h>
#include <gnomon/option_table.h>
#include <gnomon/planner.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace gnomon {
namespace {

Aabb cubeAt(float x, float y, float z, float half = 0.5F)
{
    return {{x - half, y - half, z - half}, {x + half, y + half, z + half}};
}

Light sunDown()
{
    Light sun;
    sun.direction_ws = {0.0, -1.0, 0.0};
    return sun;
}

/// A floor that does not cast, and cubes above it.
struct World {
    explicit World(int cubes)
    {
        set.add({{-20, -1, -20}, {20, 0, 20}}, {false, true, false});
        for (int i = 0; i < cubes; ++i) {
            ids.push_back(
                set.add(cubeAt(float(i % 20) * 0.9F - 9.0F, 1.0F + 0.01F * float(i), float(i / 20) * 0.9F - 9.0F)));
        }
        frame.camera = test::perspectiveCamera({0, 30, 30}, {0, 0, 0}, 1.0);
        frame.size_px = {320, 200};
        frame.objects = &set;
    }
    const Plan& plan(Planner& planner)
    {
        frame.lights = lights;
        ++frame.index;
        return planner.plan(frame);
    }

    ObjectSet set;
    std::vector<ObjectId> ids;
    std::vector<Light> lights{sunDown()};
    Frame frame;
};

ShadowOptions optionsOf(Filter filter)
{
    ShadowOptions options{.technique = kPlainTechnique};
    options.technique.filter = filter;
    return options;
}

TEST(HandOutIds, GoesFromFrontToBackAndLeavesTheGround)
{
    ObjectSet set;
    set.add(cubeAt(0, 0, 0));
    set.add(cubeAt(0, 5, 0));
    set.add({{-9, -2, -9}, {9, -1, 9}}, {false, true, false});
    set.add(cubeAt(0, 2, 0));
    set.add({});
    IdScratch scratch;
    std::vector<std::uint16_t> ids;
    handOutIds(sunDown(), set, {.most = 255}, scratch, ids);
    EXPECT_EQ(ids, (std::vector<std::uint16_t>{3, 1, 0, 2, 0}));
    Light lamp;
    lamp.type = LightType::point;
    lamp.position_ws = {0.0, 0.0, 3.0};
    handOutIds(lamp, set, {.most = 2}, scratch, ids); // appended; from 1 again
    EXPECT_EQ(std::vector<std::uint16_t>(ids.begin() + 5, ids.end()), (std::vector<std::uint16_t>{1, 1, 0, 2, 0}));
}

TEST(HandOutIds, SurfacesInOnePlaneShareOne)
{
    ObjectSet set;
    set.add({{-6, 0, -6}, {6, 0, 6}});
    set.add({{-3, 0, -3}, {3, 0, 3}});                  // a road in the ground's plane
    set.add(cubeAt(0, 0.5F, 0));                        // stands on both
    set.add({{-0.2F, 1, -0.2F}, {0.2F, 1, 0.2F}});      // a decal on its top
    set.add({{0.5F, 0.3F, -0.2F}, {0.5F, 0.7F, 0.2F}}); // and on its side
    set.add({{-2, 1.5F, -2}, {2, 1.5F, 2}});            // a canopy above
    set.add({{-0.1F, 0, -0.1F}, {0.1F, 0, 0.1F}});      // a rug in the ground's plane, under the cube
    IdScratch scratch;
    std::vector<std::uint16_t> ids;
    Light sun;
    sun.direction_ws = {-0.6, -0.8, 0.0};
    handOutIds(sun, set, {.most = 255}, scratch, ids);
    EXPECT_EQ(ids[0], ids[1]);
    EXPECT_EQ(ids[0], ids[6]);
    EXPECT_EQ(ids[2], ids[3]);
    EXPECT_EQ(ids[2], ids[4]);
    EXPECT_NE(ids[2], ids[0]);
    EXPECT_NE(ids[5], ids[0]);
    EXPECT_NE(ids[5], ids[2]);
    std::vector<Aabb> bounds;
    shareIdBounds(set, scratch, bounds);
    EXPECT_EQ(bounds[1].max.x, 6.0F) << "depths of one id are counted within the same bounds";
    EXPECT_EQ(bounds[3].min.y, bounds[2].min.y);
    EXPECT_EQ(bounds[5].max, set.bounds(5U).max);
    ids.clear();
    sun.direction_ws = {0.6, -0.8, 0.0}; // the decal on the side is on the far side of the cube
    handOutIds(sun, set, {.most = 255}, scratch, ids);
    EXPECT_EQ(ids[2], ids[3]);
    EXPECT_NE(ids[2], ids[4]);
}

TEST(HandOutIds, ThoseWithOneIdAreFarApart)
{
    ObjectSet set;
    for (int i = 0; i < 1000; ++i) {
        set.add(cubeAt(0.0F, float(i * 37 % 1000), 0.0F));
    }
    IdScratch scratch;
    std::vector<std::uint16_t> ids;
    handOutIds(sunDown(), set, {.most = 255}, scratch, ids);
    for (std::uint32_t a = 0; a < 1000; ++a) {
        for (std::uint32_t b = 0; b < a; ++b) {
            if (ids[a] == ids[b]) {
                EXPECT_GE(std::abs(set.bounds(a).min.y - set.bounds(b).min.y), 255.0F);
            }
        }
    }
}

/// With more objects than ids a higher id is always behind, and as few as possible share one.
TEST(HandOutIds, NeighboursShareOneInOrder)
{
    ObjectSet set;
    for (int i = 0; i < 1000; ++i) {
        set.add(cubeAt(0.0F, float(i * 37 % 1000), 0.0F));
    }
    const IdHandout shared{255, IdOf::object, idSharingOf(Filter::depth_id, IdOf::object)};
    ASSERT_EQ(shared.sharing, IdSharing::neighbours);
    EXPECT_EQ(idSharingOf(Filter::depth_id, IdOf::face), IdSharing::far);
    EXPECT_EQ(idSharingOf(Filter::id, IdOf::object), IdSharing::far);
    IdScratch scratch;
    std::vector<std::uint16_t> ids;
    handOutIds(sunDown(), set, shared, scratch, ids);
    std::vector<int> sharing(256, 0);
    for (std::uint32_t a = 0; a < 1000; ++a) {
        ++sharing.at(ids[a]);
        for (std::uint32_t b = 0; b < a; ++b) {
            if (set.bounds(a).min.y > set.bounds(b).min.y) {
                EXPECT_LE(ids[a], ids[b]) << "the sun is above";
            }
        }
    }
    EXPECT_EQ(sharing[0], 0);
    EXPECT_EQ(*std::ranges::max_element(sharing), 4);
    EXPECT_EQ(*std::min_element(sharing.begin() + 1, sharing.end()), 3);
    std::vector<std::uint16_t> many;
    handOutIds(sunDown(), set, {65535, IdOf::object, IdSharing::neighbours}, scratch, many);
    std::vector<std::uint16_t> far;
    handOutIds(sunDown(), set, {65535, IdOf::object, IdSharing::far}, scratch, far);
    EXPECT_EQ(many, far) << "where there are enough, both are one for each";
}

/// A cube of six pieces.
ObjectFlags inFaces(std::uint16_t pieces = 6)
{
    ObjectFlags flags;
    flags.pieces = pieces;
    return flags;
}

TEST(HandOutIds, GivesEachPieceOne)
{
    ObjectSet set;
    set.add(cubeAt(0, 0, 0), inFaces(3));
    set.add(cubeAt(0, 5, 0), inFaces());
    set.add({{-9, -2, -9}, {9, -1, 9}}, {false, true, false});
    set.add(cubeAt(0, 2, 0), inFaces(250));
    IdScratch scratch;
    std::vector<std::uint16_t> ids;
    handOutIds(sunDown(), set, {.most = 255, .of = IdOf::face}, scratch, ids);
    EXPECT_EQ(ids, (std::vector<std::uint16_t>{2, 1, 0, 7})); // 7 to 255 and 1
    ids.clear();
    handOutIds(sunDown(), set, {.most = 65535, .of = IdOf::face}, scratch, ids);
    EXPECT_EQ(ids, (std::vector<std::uint16_t>{257, 1, 0, 7}));
}

TEST(PlannedIds, OfPiecesNeedTheirNumber)
{
    World world(0);
    const ObjectId cube = world.set.add(cubeAt(0.0F, 1.0F, 0.0F), inFaces());
    ShadowOptions options = optionsOf(Filter::id);
    options.ids.of = IdOf::face;
    Planner planner(options);
    const Plan& plan = world.plan(planner);
    ASSERT_EQ(plan.lights[0].outcome.kind, OutcomeKind::ok) << plan.lights[0].outcome.reason;
    EXPECT_EQ(plan.object_pieces, (std::vector<std::uint16_t>{0, 6})); // of the floor nobody asks
    EXPECT_EQ(objectIdsOf(plan, 0)[cube.index], 1);
    world.set.add(cubeAt(3.0F, 1.0F, 0.0F));
    const Outcome& refused = world.plan(planner).lights[0].outcome;
    EXPECT_EQ(refused.kind, OutcomeKind::refused);
    EXPECT_EQ(refused.reason,
              "id.of face: an object that casts does not say of how many pieces it is (ObjectFlags::pieces)");
    EXPECT_TRUE(planner.plan(world.frame).object_ids.empty());
    Planner whole(optionsOf(Filter::id));
    EXPECT_EQ(world.plan(whole).lights[0].outcome.kind, OutcomeKind::ok);
    EXPECT_TRUE(world.plan(whole).object_pieces.empty());
}

TEST(PlannedIds, AreOfNoMoreObjectsThanAPixelCanName)
{
    World world(3);
    const auto add = [&](std::uint32_t count) {
        while (world.set.size() < count) {
            world.set.add({}); // nowhere, but it has an index
        }
        Planner planner(optionsOf(Filter::id));
        return world.plan(planner).lights[0].outcome;
    };
    EXPECT_EQ(add(1000).kind, OutcomeKind::ok);
    EXPECT_EQ(pixelObject(kMostIdObjects - 1, kMostPieces - 1), 0xFFFFFFFFU);
    EXPECT_EQ(pixelObject(4), 5U);
    const Outcome refused = add(kMostIdObjects + 1);
    EXPECT_EQ(refused.kind, OutcomeKind::refused);
    EXPECT_EQ(refused.reason, "ids tell at most 1048575 objects apart");
}

TEST(PlannedIds, AreThoseOfEachLightThatHasAny)
{
    World world(12);
    world.lights.push_back(sunDown());
    world.lights[1].direction_ws = {0.3, -1.0, 0.2};
    world.lights[1].options = 1;
    const std::vector<ShadowOptions> both{optionsOf(Filter::depth_id), optionsOf(Filter::hard)};
    Planner planner(both);
    const Plan& plan = world.plan(planner);
    ASSERT_EQ(plan.lights[0].outcome.kind, OutcomeKind::ok);
    EXPECT_EQ(plan.object_bounds.size(), 13U);
    ASSERT_EQ(objectIdsOf(plan, 0).size(), 13U);
    EXPECT_EQ(objectIdsOf(plan, 0)[0], 0);
    EXPECT_EQ(objectIdsOf(plan, 0)[12], 1); // the highest
    EXPECT_TRUE(objectIdsOf(plan, 1).empty());
    EXPECT_NE(plan.views[0].contents.ids_key, 0U);
    EXPECT_EQ(plan.views[1].contents.ids_key, 0U);
    // The floor is drawn, too.
    const View& view = plan.views[0];
    EXPECT_EQ(plan.casters[view.casters.first], 0U);
    EXPECT_EQ(view.casters.count, 13U);
    Planner none(optionsOf(Filter::pcf));
    EXPECT_TRUE(world.plan(none).object_bounds.empty());
}

// A map of ids is of the order that it was drawn in.
TEST(PlannedIds, OthersMakeAMapOutOfDate)
{
    World world(12);
    const ObjectId far = world.set.add(cubeAt(0.0F, 3.0F, -900.0F)); // casts on nothing that is seen
    for (const bool with_ids : {true, false}) {
        Planner planner(optionsOf(with_ids ? Filter::id : Filter::hard));
        world.set.update(far, cubeAt(0.0F, 3.0F, -900.0F));
        EXPECT_TRUE(world.plan(planner).views.at(0).contents.redraw);
        EXPECT_FALSE(world.plan(planner).views.at(0).contents.redraw);
        const std::uint64_t key = planner.plan(world.frame).views.at(0).contents.ids_key;
        world.set.update(far, cubeAt(0.0F, 0.6F, -900.0F)); // now behind all others, whose ids are one less
        const View& view = world.plan(planner).views.at(0);
        EXPECT_EQ(view.contents.ids_key != key, with_ids);
        EXPECT_EQ(view.contents.redraw, with_ids);
    }
}

TEST(IdCollisions, AreOfThoseThatOverlapAndHaveOneId)
{
    World world(0);
    // A column of 300, all over each other: of 255 ids 45 come twice.
    for (int i = 0; i < 300; ++i) {
        world.set.add(cubeAt(0.0F, 1.0F + 0.02F * float(i), 0.0F));
    }
    ShadowOptions options = optionsOf(Filter::id);
    options.format = MapFormat::r8;
    Planner few(options);
    const IdCollisions counted = countIdCollisions(world.plan(few), 0);
    EXPECT_EQ(counted.casters, 300U);
    EXPECT_EQ(counted.ids, 255U);
    EXPECT_EQ(counted.taken, 300U);
    EXPECT_EQ(counted.pairs, 300U * 299U / 2U);
    EXPECT_EQ(counted.collisions, 45U);
    options.format = MapFormat::r16;
    Planner many(options);
    EXPECT_EQ(countIdCollisions(world.plan(many), 0).collisions, 0U);
    Planner none(optionsOf(Filter::pcf));
    EXPECT_EQ(countIdCollisions(world.plan(none), 0).ids, 0U);
    EXPECT_NE(toJson(world.plan(few)).find("\"collisions\": 45"), std::string::npos);
    EXPECT_EQ(toJson(world.plan(none)).find("\"collisions\""), std::string::npos);
}

// Two that overlap lose a shadow where any piece of one has the id of any of the other.
TEST(IdCollisions, OfPiecesAreOfAnyThatBothHave)
{
    for (const auto& [between, collisions] :
         {std::pair{240, 0U}, std::pair{243, 0U}, std::pair{244, 1U}, // 1 .. 6 again
          std::pair{249, 1U}, std::pair{254, 1U}, std::pair{255, 0U}}) {
        World world(0);
        world.set.add(cubeAt(0.0F, 3.0F, 0.0F), inFaces());
        world.set.add(cubeAt(5.0F, 2.0F, 0.0F), inFaces(static_cast<std::uint16_t>(between)));
        world.set.add(cubeAt(0.0F, 1.0F, 0.0F), inFaces());
        ShadowOptions options = optionsOf(Filter::id);
        options.format = MapFormat::r8;
        options.ids.of = IdOf::face;
        Planner planner(options);
        const IdCollisions counted = countIdCollisions(world.plan(planner), 0);
        EXPECT_EQ(counted.pairs, 1U);
        EXPECT_EQ(counted.casters, 3U);
        EXPECT_EQ(counted.taken, 12U + static_cast<unsigned>(between));
        EXPECT_EQ(counted.collisions, collisions) << between;
    }
}

std::string refusalOf(Filter filter, void (*change)(ShadowOptions&))
{
    ShadowOptions options = optionsOf(filter);
    change(options);
    return resolve(options).refusal;
}

TEST(IdOptions, SayWhatTheyDoNotGoWith)
{
    for (const Filter filter : {Filter::id, Filter::depth_id}) {
        EXPECT_EQ(refusalOf(filter, [](ShadowOptions&) {}), "");
        EXPECT_EQ(
            refusalOf(filter, [](ShadowOptions& o) { o.draw_budget_texels = 1024; }),
            "draw-budget: ids are handed out anew in each frame, and a light that waits has those of an older one");
        EXPECT_EQ(refusalOf(filter, [](ShadowOptions& o) { o.cascades.pass = CascadePass::layered; }),
                  "cascades.pass layered: maps of ids are drawn one by one; draw each in a pass of its own");
        EXPECT_NE(refusalOf(filter, [](ShadowOptions& o) { o.faces = CasterFaces::midpoint; }), "");
        EXPECT_NE(refusalOf(filter, [](ShadowOptions& o) { o.format = MapFormat::d32f; }), "");
        ShadowOptions bent = optionsOf(filter);
        bent.technique.partition = Partition::paraboloid;
        EXPECT_NE(resolve(bent).refusal.find("paraboloid"), std::string::npos);
    }
    EXPECT_EQ(refusalOf(Filter::id, [](ShadowOptions& o) { o.ids.depth = IdDepth::global; }),
              "id.depth global: filter id keeps no depth; depth-id does");
    EXPECT_EQ(refusalOf(Filter::id, [](ShadowOptions& o) { o.ids.bias = 0.1F; }),
              "id.bias: filter id compares no depths, so there is nothing to move; depth-id has it");
    EXPECT_EQ(refusalOf(Filter::depth_id, [](ShadowOptions& o) { o.ids.bias = 1.5F; }),
              "id.bias is 1.5; it can be 0 to 1 of the radius");
}

// An option without effect must be refused where it is given.
TEST(IdOptions, LeaveTheBiasToWhoComparesDepths)
{
    for (const char* key : {"bias.constant", "bias.slope", "bias.normal", "bias.receiver-plane"}) {
        ShadowOptions options = optionsOf(Filter::id);
        EXPECT_FALSE(findOption(key)->used(options)) << key;
        options.technique.filter = Filter::depth_id;
        EXPECT_TRUE(findOption(key)->used(options)) << key;
        options.ids.bias = 0.1F;
        EXPECT_FALSE(findOption(key)->used(options)) << key;
        options.technique.filter = Filter::hard;
        EXPECT_TRUE(findOption(key)->used(options)) << key;
    }
}

TEST(IdOptions, TheTestIsTheFiltersOwn)
{
    EXPECT_EQ(resolvedOrThrow(optionsOf(Filter::id)).idTest(), IdTest::any);
    EXPECT_EQ(resolvedOrThrow(optionsOf(Filter::depth_id)).idTest(), IdTest::priority);
    ShadowOptions asked = optionsOf(Filter::depth_id);
    asked.ids.test = IdTest::nearest;
    EXPECT_EQ(resolvedOrThrow(asked).idTest(), IdTest::nearest);
    EXPECT_FALSE(resolvedOrThrow(asked).paired_maps());
}

TEST(OverW, IsALampsAlone)
{
    World world(3);
    for (const Filter filter : {Filter::hard, Filter::pcf, Filter::vsm}) {
        ShadowOptions options = optionsOf(filter);
        options.moments.metric = DepthMetricKind::z_over_w;
        Planner planner(options);
        world.lights = {sunDown()};
        const Outcome& of_sun = world.plan(planner).lights[0].outcome;
        EXPECT_EQ(of_sun.kind, OutcomeKind::refused);
        EXPECT_EQ(
            of_sun.reason,
            "depth-metric z-over-w is what a lamp's perspective makes of depth; a sun has none, and needs linear");
        world.lights[0].type = LightType::spot;
        world.lights[0].position_ws = {0.0, 12.0, 0.0};
        world.lights[0].outer_half_angle_rad = 0.9;
        EXPECT_EQ(world.plan(planner).lights[0].outcome.kind, OutcomeKind::ok);
    }
}

TEST(OverW, IsWhatTheRasteriserKeeps)
{
    const auto over_w = [](ShadowOptions& o) {
        o.moments.metric = DepthMetricKind::z_over_w;
    };
    EXPECT_EQ(refusalOf(Filter::hard, over_w), "");
    EXPECT_EQ(refusalOf(Filter::pcf,
                        [](ShadowOptions& o) {
                            o.moments.metric = DepthMetricKind::z_over_w;
                            o.format = MapFormat::r32f;
                        }),
              "depth-metric z-over-w: it is what the rasteriser keeps by itself, in a map of d32f, d24 or d16");
    EXPECT_EQ(refusalOf(Filter::hard,
                        [](ShadowOptions& o) {
                            o.moments.metric = DepthMetricKind::z_over_w;
                            o.technique.fit = Fit::lispsm;
                        }),
              "depth-metric z-over-w: a warp has a w of its own, and the lamp's is shown without one; it needs fit "
              "uniform");
    EXPECT_NE(refusalOf(Filter::hard,
                        [](ShadowOptions& o) {
                            o.moments.metric = DepthMetricKind::z_over_w;
                            o.faces = CasterFaces::midpoint;
                        }),
              "");
}

} // namespace
} // namespace gnomon
