// SPDX-License-Identifier: Apache-2.0
// Plans under a sun that moves in steps: which maps there are, where they lie, and how little of them is drawn.
#include "motion/sun_steps.h"
#include "worlds.h"

#include <gnomon/plan_views.h>
#include <gnomon/planner.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace gnomon {
namespace {

using test::Random;

constexpr double kStep = 0.00872664626;
constexpr std::uint32_t kStill = 200;

/// Ground and boxes, of which the last one moves, inside of where the others reach.
struct Village {
    ObjectSet set;
    ObjectId mover;
    std::vector<Light> lights{test::sun({0.3, -1, 0.2})};
    Frame frame;

    Village()
    {
        Random random(8);
        set.add({{-60, -1, -60}, {60, 0, 60}}, {true, true, false});
        for (std::uint32_t i = 1; i < kStill; ++i)
            set.add(test::boxAt(random.inBox({-55, 1, -55}, {55, 1, 55}), {0.7, 1, 0.7}), {true, true, false});
        mover = set.add(test::boxAt({0, 0.9, 0}, glm::dvec3(0.5)), {true, true, true});
        frame.objects = &set;
        frame.lights = lights;
        frame.camera = test::perspectiveCamera({0, 30, 60}, {0, 0, 0}, 1.2, 1.6, 0.5, 300.0);
    }
    void move(double x, double z) { set.update(mover, test::boxAt({x, 0.9, z}, glm::dvec3(0.5))); }
    void shine(double angle)
    {
        lights[0].direction_ws = glm::normalize(glm::dvec3(std::sin(angle), -std::cos(angle), 0.2));
    }
};

ShadowOptions stepped(Motion motion, std::uint32_t map_size = 256)
{
    ShadowOptions options{.technique = kPlainTechnique};
    options.technique.motion = motion;
    options.map_size = map_size;
    return options;
}

bool isRead(const Plan& plan, const View& view)
{
    const SunSteps& steps = plan.lights[view.light].steps;
    return !steps.alternate || steps.read == view.serves.sun;
}

/// Half a day, one box moving: the still casters are drawn once for each position, and the moving one within the few
/// texels where it is or was.
TEST(StepsPlan, DrawStillCastersOnceForEachPosition)
{
    for (const Motion motion : {Motion::step_jump, Motion::step_band, Motion::step_blend, Motion::step_alternate}) {
        SCOPED_TRACE(nameOf(motion));
        Village village;
        Planner planner(stepped(motion));
        std::set<std::array<double, 3>> positions;
        int kept_drawn = 0;
        int at_once = 0;
        int frames = 0;
        std::uint64_t widest = 0;
        for (double angle = -0.6; angle < 0.6; angle += 0.043 * kStep, ++frames) {
            village.shine(angle);
            village.move(20.0 * std::cos(0.05 * frames), 20.0 * std::sin(0.05 * frames));
            const Plan& plan = planner.plan(village.frame);
            for (const View& view : plan.views) {
                const SunSteps& steps = plan.lights[0].steps;
                const glm::dvec3& p = view.serves.sun == SunPosition::later ? steps.later_ws : steps.earlier_ws;
                if (!isRead(plan, view)) {
                    EXPECT_FALSE(view.contents.redraw);
                    continue;
                }
                positions.insert({p.x, p.y, p.z});
                ASSERT_TRUE(view.contents.redraw); // the box moves in each frame
                ASSERT_NE(view.contents.kept_layer, kNoIndex);
                EXPECT_GT(view.casters.still, kStill * 9 / 10);
                EXPECT_EQ(view.casters.count, view.casters.still + 1);
                EXPECT_EQ(plan.casters[view.casters.first + view.casters.still], village.mover.index);
                kept_drawn += view.contents.redraw_kept ? 1 : 0;
                at_once += view.contents.kept_layer == kNoIndex ? 1 : 0;
                if (!view.contents.redraw_kept)
                    widest = std::max(widest, std::uint64_t{view.contents.dirty.width} * view.contents.dirty.height);
            }
        }
        EXPECT_EQ(kept_drawn, static_cast<int>(positions.size()));
        EXPECT_EQ(at_once, 0);
        EXPECT_NEAR(kept_drawn, 1.2 / kStep, 3.0);
        // A metre and the metre that it goes in a frame, or in two by turns, seen slantwise; and a texel around.
        EXPECT_LT(widest, 32U * 32U);
        EXPECT_GT(frames, 3000);
    }
}

TEST(StepsPlan, DrawNothingWhereNothingMoves)
{
    for (const bool paired_maps : {false, true}) {
        Village village;
        village.set.remove(village.mover);
        ShadowOptions options = stepped(Motion::step_blend);
        options.format = paired_maps ? MapFormat::rg16 : MapFormat::d32f;
        Planner planner(options);
        int drawn = 0;
        int steps = 0;
        glm::dvec3 last(0.0);
        for (double angle = -0.2; angle < 0.2; angle += 0.043 * kStep) {
            village.shine(angle);
            const Plan& plan = planner.plan(village.frame);
            for (const View& view : plan.views) {
                drawn += view.contents.redraw ? 1 : 0;
                EXPECT_EQ(view.contents.kept_layer, kNoIndex); // at once
            }
            steps += plan.lights[0].steps.later_ws != last ? 1 : 0;
            last = plan.lights[0].steps.later_ws;
        }
        EXPECT_EQ(drawn, steps);
        EXPECT_GT(steps, 40);
    }
}

/// A position's tile, part and kept layer last as long as it does, and the earlier position's views come first.
TEST(StepsPlan, APositionKeepsItsPlace)
{
    for (const bool paired_maps : {false, true})
        for (const Partition partition : {Partition::single, Partition::cascades}) {
            Village village;
            ShadowOptions options = stepped(Motion::step_blend, 64);
            options.format = paired_maps ? MapFormat::rg16 : MapFormat::d32f;
            options.technique.partition = partition;
            options.cascades.count = 2;
            options.cascades.ends_m[0] = 60.0;
            const std::uint32_t slices = partition == Partition::single ? 1 : 2;
            village.lights.push_back(test::spot({0, 40, 0}, {0, -1, 0}, 0.7)); // no sun: one tile each
            village.lights.back().key = 5;
            village.frame.lights = village.lights;
            Planner planner(options);
            using Place = std::tuple<std::uint32_t, TexelPart, std::uint32_t>;
            std::map<std::array<double, 3>, std::vector<Place>> places;
            for (int frame = 0; frame < 200; ++frame) {
                village.shine(0.11 * kStep * frame);
                village.move(0.03 * frame, 0.0);
                const Plan& plan = planner.plan(village.frame);
                EXPECT_EQ(plan.pages[0].layers, (paired_maps ? 1 : 2) * slices + slices);
                EXPECT_EQ(plan.pages[0].kept_layers, (paired_maps ? 1 : 2) * slices);
                const SunSteps& steps = plan.lights[0].steps;
                ASSERT_EQ(plan.lights[0].view_count, (steps.paired ? 2 : 1) * slices);
                EXPECT_FALSE(plan.lights[1].steps.stepping);
                EXPECT_EQ(plan.lights[1].view_count, slices);
                std::map<std::array<double, 3>, std::vector<Place>> now;
                for (std::uint32_t i = 0; i < plan.views.size(); ++i) {
                    const View& view = plan.views[i];
                    EXPECT_EQ(view.place.part == TexelPart::whole, !paired_maps);
                    if (view.light == 1) {
                        EXPECT_NE(view.place.part, TexelPart::second);
                        EXPECT_EQ(view.contents.kept_layer, kNoIndex);
                        EXPECT_EQ(view.serves.sun, SunPosition::only);
                        continue;
                    }
                    const bool later = i >= slices;
                    EXPECT_EQ(view.serves.sun, !steps.paired ? SunPosition::only
                                               : later       ? SunPosition::later
                                                             : SunPosition::earlier);
                    const glm::dvec3& p = later ? steps.later_ws : steps.earlier_ws;
                    now[{p.x, p.y, p.z}].push_back({view.place.tile.layer, view.place.part, view.contents.kept_layer});
                }
                for (const auto& [position, place] : now) {
                    EXPECT_EQ(place.size(), slices);
                    EXPECT_EQ(places.emplace(position, place).first->second, place) << frame;
                }
            }
            EXPECT_GT(places.size(), 15U);
        }
}

TEST(StepsPlan, PositionsOfOneLightAreTwoRangesOfViews)
{
    Village village;
    ShadowOptions options = stepped(Motion::step_blend, 64);
    options.technique.partition = Partition::cascades;
    options.cascades.count = 2;
    options.cascades.ends_m[0] = 60.0;
    Planner planner(options);
    EXPECT_EQ(viewsOf(planner.plan(village.frame), 0, SunPosition::only).size(), 2U);
    village.shine(0.5);
    (void)planner.plan(village.frame);
    village.shine(0.5 + 0.2 * kStep);
    const Plan& plan = planner.plan(village.frame);
    EXPECT_TRUE(viewsOf(plan, 0, SunPosition::only).empty());
    EXPECT_EQ(viewsOf(plan, 0, SunPosition::earlier).data(), plan.views.data());
    EXPECT_EQ(viewsOf(plan, 0, SunPosition::earlier).size(), 2U);
    EXPECT_EQ(viewsOf(plan, 0, SunPosition::later).data(), plan.views.data() + 2);
    EXPECT_EQ(viewsOf(plan, 0, SunPosition::later).size(), 2U);
    // The maps of a position lie in layers that follow each other: they can be drawn in one pass, where none is kept.
    for (const std::uint32_t first : {0U, 2U})
        EXPECT_EQ(plan.views[first + 1].place.tile.layer, plan.views[first].place.tile.layer + 1);
    EXPECT_EQ(strongerPosition(plan.lights[0].steps), SunPosition::earlier);
    Plan none = plan;
    none.lights[0].outcome.kind = OutcomeKind::no_caster;
    EXPECT_TRUE(viewsOf(none, 0, SunPosition::earlier).empty());
}

/// By turns: the one that is not read is not drawn, and in each frame the one that was not read in the frame before is.
/// After a step too, or its weight is next to nothing.
TEST(StepsPlan, AlternateReadsTheOtherOne)
{
    Village village;
    Planner planner(stepped(Motion::step_alternate, 64));
    std::vector<std::pair<glm::dvec3, std::uint32_t>> read_before;
    int by_turns = 0;
    SunPosition last = SunPosition::only;
    glm::dvec3 last_read(0.0);
    for (int frame = 0; frame < 300; ++frame) {
        village.frame.index += 2; // no matter
        village.shine(0.071 * kStep * frame);
        village.move(0.02 * frame, 1.0);
        const Plan& plan = planner.plan(village.frame);
        const SunSteps& steps = plan.lights[0].steps;
        if (!steps.paired) {
            EXPECT_FALSE(steps.alternate);
            continue;
        }
        EXPECT_TRUE(steps.alternate);
        ASSERT_EQ(plan.views.size(), 2U);
        for (const View& view : plan.views)
            EXPECT_EQ(view.contents.redraw, view.serves.sun == steps.read);
        const bool later = steps.read == SunPosition::later;
        const glm::dvec3 other = later ? steps.earlier_ws : steps.later_ws;
        if (last != SunPosition::only && other != last_read) {
            EXPECT_FALSE(later); // it has a weight of
            EXPECT_LE(steps.share, 0.071 + 1e-6);
        }
        by_turns += other == last_read ? 1 : 0;
        last = steps.read;
        last_read = later ? steps.later_ws : steps.earlier_ws;
    }
    EXPECT_GT(by_turns, 270);
}

/// A map that was not read for a frame is still valid when nothing moved meanwhile.
TEST(StepsPlan, AlternateKeepsWhatIsNotRead)
{
    Village village;
    Planner planner(stepped(Motion::step_alternate, 64));
    village.shine(0.0);
    (void)planner.plan(village.frame);
    village.shine(0.1 * kStep);
    for (int frame = 0; frame < 4; ++frame)
        (void)planner.plan(village.frame);
    for (int frame = 0; frame < 10; ++frame)
        for (const View& view : planner.plan(village.frame).views)
            EXPECT_FALSE(view.contents.redraw);
    village.move(3.0, 4.0);
    int drawn = 0;
    for (int frame = 0; frame < 4; ++frame)
        for (const View& view : planner.plan(village.frame).views)
            drawn += view.contents.redraw ? 1 : 0;
    EXPECT_EQ(drawn, 2); // each once
}

TEST(KeptLayers, AreThereWhenAskedFor)
{
    for (const Motion motion : {Motion::free, Motion::snap, Motion::step_blend})
        for (const KeepStill keep : {KeepStill::automatic, KeepStill::never, KeepStill::always}) {
            Village village;
            ShadowOptions options = stepped(motion, 64);
            options.keep_still = keep;
            Planner planner(options);
            const Plan& plan = planner.plan(village.frame);
            const bool kept =
                keep == KeepStill::always || (keep == KeepStill::automatic && motion == Motion::step_blend);
            EXPECT_EQ(plan.pages[0].kept_layers, kept ? (motion == Motion::step_blend ? 2U : 1U) : 0U);
            EXPECT_EQ(plan.views.at(0).contents.kept_layer, kept ? 0U : kNoIndex);
            if (motion == Motion::free)
                continue; // the mover's box changes the map itself
            village.move(2.0, 3.0);
            const View& moved = planner.plan(village.frame).views.at(0);
            EXPECT_TRUE(moved.contents.redraw);
            EXPECT_FALSE(moved.contents.redraw_kept);
            EXPECT_EQ(moved.contents.dirty.empty(), !kept);
            EXPECT_FALSE(planner.plan(village.frame).views.at(0).contents.redraw);
        }
}

TEST(KeptLayers, AreNotThereForMidpoints)
{
    Village village;
    ShadowOptions options = stepped(Motion::step_blend, 64);
    options.faces = CasterFaces::midpoint;
    Planner planner(options);
    EXPECT_EQ(planner.plan(village.frame).pages[0].kept_layers, 0U);
}

TEST(KeptLayers, FollowWhatComesAndGoesAndStands)
{
    Village village;
    ShadowOptions options = stepped(Motion::snap, 256);
    options.keep_still = KeepStill::always;
    village.frame.camera = test::orthographicCamera({0, 100, 0}, {0, 0, 0}, 20.0, 300.0);
    options.max_distance_m = 150.0;
    Planner planner(options);
    const auto view = [&] {
        return planner.plan(village.frame).views.at(0);
    };
    EXPECT_TRUE(view().contents.redraw_kept);
    EXPECT_FALSE(view().contents.redraw);
    village.set.touch(village.set.idAt(5)); // stands still, but changed
    View now = view();
    EXPECT_TRUE(now.contents.redraw && now.contents.redraw_kept);
    EXPECT_EQ(now.contents.dirty.width, 256U);
    village.set.touch(village.mover);
    now = view();
    EXPECT_TRUE(now.contents.redraw && !now.contents.redraw_kept);
    EXPECT_LT(now.contents.dirty.width, 16U);
    village.set.remove(village.mover); // the last one that moves: restored once more, and then nothing is kept apart
    now = view();
    EXPECT_TRUE(now.contents.redraw && !now.contents.redraw_kept);
    EXPECT_NE(now.contents.kept_layer, kNoIndex);
    EXPECT_EQ(now.casters.count, now.casters.still);
    EXPECT_FALSE(now.contents.dirty.empty());
    now = view();
    EXPECT_FALSE(now.contents.redraw);
    EXPECT_EQ(now.contents.kept_layer, kNoIndex);
    village.mover = village.set.add(test::boxAt({1, 2, 3}, glm::dvec3(0.5)), {true, true, true}); // what is kept holds
    now = view();
    EXPECT_TRUE(now.contents.redraw && !now.contents.redraw_kept);
    EXPECT_LT(now.contents.dirty.width, 16U);
    planner.reset();
    EXPECT_TRUE(view().contents.redraw_kept);
}

TEST(KeptLayers, AreNoMoreThanTheAtlasMayHave)
{
    Village village;
    village.lights.resize(3, village.lights[0]);
    village.frame.lights = village.lights;
    ShadowOptions options = stepped(Motion::step_blend, 64);
    options.format = MapFormat::rg16;
    options.max_layers = 3;
    Planner planner(options);
    const Plan& plan = planner.plan(village.frame);
    // Kept copies share texels as the maps do, so there is room for them wherever there is for maps.
    EXPECT_EQ(plan.pages[0].layers, 3U);
    EXPECT_EQ(plan.pages[0].kept_layers, 3U);
    ASSERT_EQ(plan.views.size(), 3U);
    for (const View& view : plan.views)
        EXPECT_NE(view.contents.kept_layer, kNoIndex);
}

} // namespace
} // namespace gnomon
