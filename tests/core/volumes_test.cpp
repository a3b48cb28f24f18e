// SPDX-License-Identifier: Apache-2.0
// Filter volumes: what a plan says of it, and what it does not go with.
#include <gnomon/choices.h>
#include <gnomon/option_table.h>
#include <gnomon/planner.h>

#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace gnomon {
namespace {

ShadowOptions countingVolumes()
{
    ShadowOptions options;
    options.technique.filter = Filter::volumes;
    return options;
}

Aabb boxAt(const glm::vec3& centre, const glm::vec3& half)
{
    return {centre - half, centre + half};
}

/// A floor that receives alone, a post on it, one that stands far away, and one that is open.
struct Yard {
    ObjectSet objects;
    ObjectId floor = objects.add(boxAt({0, -0.1F, 0}, {20, 0.1F, 20}), {.casts = false});
    ObjectId post = objects.add(boxAt({0, 1, 0}, {0.5F, 1, 0.5F}), {.closed = true});
    ObjectId far_post = objects.add(boxAt({0, 1, 400}, {0.5F, 1, 0.5F}), {.closed = true});
    std::vector<Light> lights;
    Frame frame;

    Yard()
    {
        frame.camera.eye_ws = {0, 4, 10};
        glm::dmat4 projection = glm::perspectiveRH_ZO(0.9, 1.0, 100.0, 0.1); // reversed
        projection[1][1] = -projection[1][1];
        frame.camera.clip_from_world =
            projection * glm::lookAtRH(frame.camera.eye_ws, glm::dvec3(0.0), glm::dvec3(0.0, 1.0, 0.0));
        frame.size_px = {64, 64};
        frame.objects = &objects;
        lights.resize(3);
        lights[0].direction_ws = glm::normalize(glm::dvec3(0.4, -1.0, 0.1));
        lights[1].type = LightType::spot;
        lights[1].position_ws = {1, 6, 0};
        lights[1].range_m = 20.0;
        lights[2].type = LightType::point;
        lights[2].position_ws = {-1, 3, 1};
        lights[2].range_m = 20.0;
        for (std::uint32_t i = 0; i < lights.size(); ++i) {
            lights[i].key = i;
        }
        frame.lights = lights;
    }
};

std::vector<std::uint32_t> volumesOf(const Plan& plan, std::size_t light)
{
    const auto first = plan.casters.begin() + plan.lights[light].first_volume;
    return {first, first + plan.lights[light].volume_count};
}

TEST(Volumes, OfAnyLightHaveCastersAndNoViews)
{
    Yard yard;
    for (const Partition partition : {Partition::single, Partition::automatic}) {
        ShadowOptions options = countingVolumes();
        options.technique.partition = partition;
        Planner planner(options);
        for (int frame = 0; frame < 3; ++frame) { // the last of which repeats the one before
            const Plan& plan = planner.plan(yard.frame);
            EXPECT_TRUE(plan.views.empty());
            EXPECT_EQ(plan.pages[0].layers, 0U);
            for (std::size_t light = 0; light < yard.lights.size(); ++light) {
                EXPECT_EQ(plan.lights[light].outcome.kind, OutcomeKind::ok) << plan.lights[light].outcome.reason;
                EXPECT_EQ(volumesOf(plan, light), (std::vector<std::uint32_t>{yard.post.index})) << light;
                EXPECT_EQ(plan.lights[light].left_out, 0U);
            }
        }
    }
}

TEST(Volumes, OfOpenCastersAreRefusedUnlessTheyAreSkipped)
{
    Yard yard;
    const ObjectId open = yard.objects.add(boxAt({2, 1, 0}, {0.5F, 1, 0.5F}), {});
    ShadowOptions options = countingVolumes();
    Planner strict(options);
    for (const LightPlan& light : strict.plan(yard.frame).lights) {
        EXPECT_EQ(light.outcome.kind, OutcomeKind::refused);
        EXPECT_EQ(light.volume_count, 0U);
        EXPECT_EQ(light.left_out, 1U);
        EXPECT_NE(light.outcome.reason.find("ObjectFlags::closed"), std::string_view::npos);
    }
    EXPECT_TRUE(strict.plan(yard.frame).casters.empty());
    options.volumes.open = OpenCasters::skip;
    Planner lenient(options);
    EXPECT_EQ(volumesOf(lenient.plan(yard.frame), 0), (std::vector<std::uint32_t>{yard.post.index}));
    yard.objects.remove(yard.post);
    yard.objects.remove(yard.far_post);
    EXPECT_EQ(lenient.plan(yard.frame).lights[0].outcome.kind, OutcomeKind::no_caster);
    yard.objects.remove(open);
    EXPECT_EQ(lenient.plan(yard.frame).lights[0].outcome.kind, OutcomeKind::no_caster);
}

/// Beside lights with maps, of other options.
TEST(Volumes, ShareAPlanWithMaps)
{
    Yard yard;
    yard.lights[1].options = 1;
    ShadowOptions mapped;
    mapped.technique = kPlainTechnique;
    const std::vector<ShadowOptions> options{countingVolumes(), mapped};
    Planner planner(options);
    const Plan& plan = planner.plan(yard.frame);
    EXPECT_EQ(plan.views.size(), 1U);
    EXPECT_EQ(plan.lights[1].view_count, 1U);
    EXPECT_EQ(plan.lights[1].volume_count, 0U);
    EXPECT_EQ(volumesOf(plan, 0), (std::vector<std::uint32_t>{yard.post.index}));
    EXPECT_EQ(volumesOf(plan, 2), (std::vector<std::uint32_t>{yard.post.index}));
}

TEST(Volumes, RefuseWhatIsSaidOfMaps)
{
    EXPECT_TRUE(resolve(countingVolumes()));
    EXPECT_FALSE(hasMaps(countingVolumes()));
    EXPECT_TRUE(hasMaps({}));
    const auto refusedWith = [](auto&& change) {
        ShadowOptions options = countingVolumes();
        change(options);
        return resolve(options).refusal;
    };
    EXPECT_NE(refusedWith([](ShadowOptions& o) { o.format = MapFormat::d32f; }), "");
    EXPECT_EQ(refusedWith([](ShadowOptions& o) { o.map_size = 512; }), "") << "presets have one";
    EXPECT_NE(refusedWith([](ShadowOptions& o) { o.budget_texels = 1U << 20U; }), "");
    EXPECT_NE(refusedWith([](ShadowOptions& o) { o.draw_budget_texels = 1U << 20U; }), "");
    EXPECT_NE(refusedWith([](ShadowOptions& o) { o.keep_still = KeepStill::always; }), "");
    EXPECT_NE(refusedWith([](ShadowOptions& o) { o.mask_size = MaskSize::half; }), "");
    EXPECT_NE(refusedWith([](ShadowOptions& o) { o.faces = CasterFaces::back; }), "");
    EXPECT_NE(refusedWith([](ShadowOptions& o) { o.translucent = Translucent::colour; }), "");
    EXPECT_NE(refusedWith([](ShadowOptions& o) { o.technique.partition = Partition::cascades; }), "");
    EXPECT_NE(refusedWith([](ShadowOptions& o) { o.technique.fit = Fit::lispsm; }), "");
    EXPECT_NE(refusedWith([](ShadowOptions& o) { o.technique.motion = Motion::snap; }), "");
    EXPECT_NE(refusedWith([](ShadowOptions& o) { o.technique.soften = Soften::converge; }), "");
    for (const char* key :
         {"map-size", "map-format", "bias.slope", "cascades.count", "texels", "keep-still", "border"}) {
        EXPECT_FALSE(findOption(key)->used(countingVolumes())) << key;
    }
    EXPECT_TRUE(findOption("volumes.open")->used(countingVolumes()));
    EXPECT_FALSE(findOption("volumes.open")->used({}));
}

TEST(Volumes, GoWithEveryLightAndWithSingleAndAutoAlone)
{
    for (const LightType light : {LightType::directional, LightType::spot, LightType::point}) {
        for (const ChoiceValue& row : choiceValues()) {
            if (row.choice == "partition") {
                const Technique technique{.partition = static_cast<Partition>(row.value), .filter = Filter::volumes};
                EXPECT_EQ(!refusal(light, technique), row.name == "single" || row.name == "auto") << row.name;
            }
        }
    }
}

} // namespace
} // namespace gnomon
