// SPDX-License-Identifier: Apache-2.0
#include "lab/compare.h"

#include "stage.h"

#include "worlds/worlds.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace gnomon::lab::test {
namespace {

constexpr glm::uvec2 kSize_px{256, 144};
constexpr std::uint32_t kSun = 0;
constexpr std::uint32_t kSpot = 1;

/// One row of pixels, each said by hand: what both sides see there, at a place with a normal.
class ByHand {
public:
    ByHand() : scene(worlds::load("planes", 1)), state(scene::evaluate(scene, 0.0))
    {
        subject.scene = &scene;
        subject.state = &state;
        subject.eye = {.position_ws = {100.0, 10.0, 0.0}, .target_ws = {0.0, 0.0, 0.0}};
        host::ShadedLight lamp;
        lamp.caster.type = LightType::spot;
        lamp.caster.position_ws = {0.0, 10.0, 0.0};
        lamp.caster.direction_ws = {0.0, -1.0, 0.0};
        lamp.caster.outer_half_angle_rad = 0.5;
        lamp.caster.range_m = 10.5;
        subject.lights = {lamp};
    }
    void add(std::uint32_t exact_id, std::uint32_t drawn_id, glm::dvec3 point_ws, glm::vec3 normal,
             std::optional<glm::vec3> smooth_normal = {})
    {
        const glm::vec3 point(point_ws - subject.eye.position_ws);
        surfaces.object_ids.values.push_back(exact_id);
        surfaces.points.values.insert(surfaces.points.values.end(), {point.x, point.y, point.z});
        surfaces.normals.values.insert(surfaces.normals.values.end(), {normal.x, normal.y, normal.z});
        const glm::vec3 smooth = smooth_normal.value_or(normal);
        surfaces.smooth_normals.values.insert(surfaces.smooth_normals.values.end(), {smooth.x, smooth.y, smooth.z});
        picture.object_ids.values.push_back(drawn_id);
    }
    CountedPixels count()
    {
        const auto width = static_cast<std::uint32_t>(picture.object_ids.values.size());
        const auto shape = [&](auto& image, std::uint32_t channels) {
            image.width = width;
            image.height = 1;
            image.channels = channels;
        };
        shape(surfaces.object_ids, 1);
        shape(surfaces.points, 3);
        shape(surfaces.normals, 3);
        shape(surfaces.smooth_normals, 3);
        shape(picture.object_ids, 1);
        return countPixels(subject, surfaces, picture);
    }
    scene::Scene scene;
    scene::State state;
    Subject subject;
    truth::Surfaces surfaces;
    host::Picture picture;
};

void expectCounts(const PixelCounts& counts, const PixelCounts& expected)
{
    EXPECT_EQ(counts.counted, expected.counted);
    EXPECT_EQ(counts.terminator, expected.terminator);
    EXPECT_EQ(counts.background, expected.background);
    EXPECT_EQ(counts.other_object, expected.other_object);
    EXPECT_EQ(counts.facing_away, expected.facing_away);
    EXPECT_EQ(counts.unlit, expected.unlit);
    EXPECT_EQ(counts.no_receiver, expected.no_receiver);
    EXPECT_EQ(counts.grazing, expected.grazing);
}

constexpr glm::vec3 kUp{0.0F, 1.0F, 0.0F};

TEST(CountPixels, EachIsLeftOutForTheFirstReasonThatHolds)
{
    ByHand all;
    all.state.objects[1].receives = false; // id 2
    all.add(1, 1, {0.0, 0.0, 0.0}, kUp);   // counts
    all.add(0, 0, {0.0, 0.0, 0.0}, kUp);   // background
    all.add(1, 2, {0.0, 0.0, 0.0}, kUp);   // another object
    all.add(0, 1, {0.0, 0.0, 0.0}, kUp);
    all.add(2, 0, {0.0, 0.0, 0.0}, kUp);
    all.add(1, 1, {0.0, 0.0, 0.0}, -kUp); // away
    all.add(1, 1, {6.0, 0.0, 0.0}, kUp);  // beyond the cone: 10 m tan 0.5 is 5.46 m
    all.add(2, 2, {0.0, 0.0, 0.0}, kUp);  // does not receive
    // Several reasons at once.
    all.add(2, 1, {6.0, 0.0, 0.0}, -kUp);
    all.add(2, 2, {6.0, 0.0, 0.0}, -kUp);
    all.add(2, 2, {6.0, 0.0, 0.0}, kUp);
    const CountedPixels pixels = all.count();
    expectCounts(pixels.counts,
                 {.counted = 1, .background = 1, .other_object = 4, .facing_away = 2, .unlit = 2, .no_receiver = 1});
    EXPECT_EQ(pixels.counts.leftOut(), 10U);
    EXPECT_EQ(pixels.counted.values, (std::vector<std::uint8_t>{1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}));
}

TEST(CountPixels, TheLightReachesAsFarAsItsConeRangeAndAngle)
{
    ByHand all;
    const auto at = [&](double x, double y) {
        all.add(1, 1, {x, y, 0.0}, kUp);
    };
    at(5.4, 0.0);  // within the cone and 11.4 m away: beyond the range
    at(0.0, -0.4); // 10.4 m
    at(0.0, -0.6); // 10.6 m
    at(2.7, 5.0);  // 5 m tan 0.5 is 2.73
    at(2.8, 5.0);
    all.add(1, 1, {0.0, 0.0, 0.0}, {std::sqrt(1.0F - 0.06F * 0.06F), 0.06F, 0.0F}); // N·L is 0.06
    all.add(1, 1, {0.0, 0.0, 0.0}, {std::sqrt(1.0F - 0.04F * 0.04F), 0.04F, 0.0F});
    EXPECT_EQ(all.count().counted.values, (std::vector<std::uint8_t>{0, 1, 0, 1, 0, 1, 0}));
    all.subject.lights[0].caster.range_m = 0.0; // as far as the scene goes
    EXPECT_EQ(all.count().counted.values, (std::vector<std::uint8_t>{1, 1, 1, 1, 0, 1, 0}));
    all.subject.lights[0].caster.type = LightType::point; // no cone
    EXPECT_EQ(all.count().counted.values, (std::vector<std::uint8_t>{1, 1, 1, 1, 1, 1, 0}));
    all.subject.lights[0].caster.type = LightType::directional;
    all.subject.lights[0].caster.range_m = 1.0; // means nothing to a sun
    EXPECT_EQ(all.count().counted.values, (std::vector<std::uint8_t>{1, 1, 1, 1, 1, 1, 0}));
}

TEST(CountPixels, TheTerminatorIsWhereTheSmoothNormalAloneFacesTheLight)
{
    const auto leant = [](float facing) {
        return glm::vec3(std::sqrt(1.0F - facing * facing), facing, 0.0F);
    };
    ByHand all;
    all.state.objects[1].receives = false; // id 2
    const auto at = [&](float facing, float smooth, std::uint32_t id = 1) {
        all.add(id, id, {0.0, 0.0, 0.0}, leant(facing), leant(smooth));
    };
    at(0.2F, 0.3F);
    at(-0.1F, 0.06F);
    at(0.06F, -0.1F);
    at(0.04F, 0.04F);
    at(-0.1F, 0.04F);
    at(-0.1F, 0.06F, 2);
    const CountedPixels pixels = all.count();
    expectCounts(pixels.counts, {.counted = 2, .terminator = 1, .facing_away = 1, .no_receiver = 1, .grazing = 2});
    EXPECT_EQ(pixels.counted.values, (std::vector<std::uint8_t>{1, 1, 0, 0, 0, 0}));
    EXPECT_EQ(pixels.terminator.values, (std::vector<std::uint8_t>{0, 1, 0, 0, 0, 0}));
    EXPECT_EQ(pixels.grazing.values, (std::vector<std::uint8_t>{0, 0, 0, 1, 1, 0}));
}

TEST(TruthLight, HasANearDistanceOnlyWhereTheLightGivesOne)
{
    ByHand all;
    Light& light = all.subject.lights[0].caster;
    light.radius_m = 0.25;
    EXPECT_EQ(truthLight(all.subject).near_m, 0.0);
    EXPECT_EQ(truthLight(all.subject).radius_m, 0.25);
    EXPECT_EQ(truthLight(all.subject).type, scene::LightType::spot);
    light.near_m = 0.5;
    EXPECT_EQ(truthLight(all.subject).near_m, 0.5);
    light.type = LightType::directional;
    light.angular_diameter_rad = 0.02;
    EXPECT_EQ(truthLight(all.subject).angular_diameter_rad, 0.02);
}

TEST(TruthNoise, IsTheRootOfTheMeanSquareOverCountedPixels)
{
    truth::Visibility visibility;
    visibility.standard_error = ImageF(3, 1, 1);
    visibility.standard_error.values = {0.03F, 0.9F, 0.04F};
    Counted counted = countAll(3, 1);
    counted.values[1] = 0;
    EXPECT_NEAR(truthNoise(visibility, counted).value(), std::sqrt(0.0025 / 2.0), 1e-8);
    EXPECT_FALSE(truthNoise(visibility, Counted(3, 1, 1)).has_value());
}

TEST(TruthView, SeesTheSamePointsAndObjectsAsThePicture)
{
    Stage stage(worlds::load("planes", 1), "side", kSize_px);
    const truth::Surfaces& surfaces = stage.hardTruth().surfaces;
    const host::Picture picture = stage.geometry();
    const truth::View view = truthView(stage.subject(), kSize_px);
    std::uint64_t same = 0;
    double farthest = 0.0;
    for (std::uint32_t y = 0; y < kSize_px.y; ++y) {
        for (std::uint32_t x = 0; x < kSize_px.x; ++x) {
            if (*surfaces.object_ids.pixel(x, y) != *picture.object_ids.pixel(x, y)) {
                continue;
            }
            ++same;
            if (*surfaces.object_ids.pixel(x, y) == 0) {
                continue;
            }
            const double depth = *picture.depth.pixel(x, y);
            const glm::dvec4 h = view.world_from_clip * glm::dvec4((x + 0.5) / kSize_px.x * 2.0 - 1.0,
                                                                   (y + 0.5) / kSize_px.y * 2.0 - 1.0, depth, 1.0);
            const float* p = surfaces.points.pixel(x, y);
            const glm::dvec3 drawn = glm::dvec3(h) / h.w - view.eye_ws;
            farthest = std::max(farthest, glm::length(drawn - glm::dvec3(p[0], p[1], p[2])));
        }
    }
    EXPECT_GE(same, std::uint64_t{kSize_px.x} * kSize_px.y - 20); // silhouettes may round either way
    EXPECT_LT(farthest, 0.01);                                    // metres, of a ground 40 m wide
}

TEST(CountPixels, OfAWholePictureAddUp)
{
    for (const std::uint32_t light : {kSun, kSpot}) {
        Stage stage(worlds::load("planes", 1), "side", kSize_px, light);
        const CountedPixels pixels = countPixels(stage.subject(), stage.hardTruth().surfaces, stage.geometry());
        EXPECT_EQ(pixels.counts.counted + pixels.counts.leftOut(), kSize_px.x * kSize_px.y);
        EXPECT_EQ(pixels.counts.counted, std::count(pixels.counted.values.begin(), pixels.counted.values.end(), 1));
        EXPECT_GT(pixels.counts.facing_away, 100U); // sides of the box
        EXPECT_EQ(pixels.counts.unlit > 1000U, light == kSpot);
        EXPECT_EQ(pixels.counts.no_receiver, 0U);
        EXPECT_LT(pixels.counts.other_object, 20U);
    }
}

TEST(ScoreTechnique, HardErrsAtEdgesOnly)
{
    for (const std::uint32_t light : {kSun, kSpot}) {
        SCOPED_TRACE(light == kSun ? "sun" : "spot");
        Stage stage(worlds::load("planes", 1), "side", kSize_px, light);
        const Score score = stage.score(hardOptions(1024), true);
        ASSERT_TRUE(score.error && score.classification && score.ssim && score.flip);
        const ClassErrors& errors = score.classification->errors;
        EXPECT_GT(errors.edge, 0.0);
        EXPECT_EQ(errors.acne, 0.0);
        EXPECT_EQ(errors.detached, 0.0);
        EXPECT_EQ(errors.bleeding, 0.0);
        EXPECT_NEAR(errors.edge, score.error->rmse * score.error->rmse, 1e-12);
        EXPECT_LT(score.error->rmse, 0.1);
        EXPECT_GT(*score.ssim, 0.9);
        EXPECT_LT(*score.flip, 0.05);
        EXPECT_EQ(score.outcome.kind, OutcomeKind::ok);
        EXPECT_GT(score.density.p50, 0.0);
        EXPECT_GT(score.fit_efficiency, 0.0);
        EXPECT_LE(score.fit_efficiency, 1.0);
        EXPECT_GE(score.atlas.width, 1024U);
    }
}

TEST(ScoreTechnique, DrawsAtTheTruthsSizeWhateverTheOptionsSay)
{
    Stage stage(worlds::load("planes", 1), "top", kSize_px);
    host::RenderOptions options = hardOptions(512);
    const Score plain = stage.score(options);
    options.anti_aliasing = host::AntiAliasing::ssaa4;
    options.width = 32;
    options.height = 32;
    options.shadows = false;
    const Score same = stage.score(options);
    EXPECT_EQ(plain.mask.values, same.mask.values);
    EXPECT_GT(plain.error.value().rmse, 0.0);
    EXPECT_FALSE(plain.ssim || plain.flip);
}

TEST(ScoreMask, OfTheTruthItselfIsPerfectAndOfItsNegativeIsNot)
{
    Stage stage(worlds::load("planes", 1), "top", kSize_px);
    const host::Picture picture = stage.geometry();
    const ImageF& exact = stage.hardTruth().visibility.visibility;
    const Score perfect = scoreMask(stage.subject(), stage.hardTruth(), picture, exact);
    EXPECT_EQ(perfect.error.value().rmse, 0.0);
    EXPECT_EQ(perfect.ssim.value(), 1.0);
    EXPECT_EQ(perfect.flip.value(), 0.0);
    EXPECT_EQ(perfect.density.counted, 0U);
    EXPECT_EQ(perfect.density.map.width, kSize_px.x);
    EXPECT_EQ(perfect.fit_efficiency, 0.0);

    ImageF negative = exact;
    for (float& value : negative.values) {
        value = 1.0F - value;
    }
    const Score worst = scoreMask(stage.subject(), stage.hardTruth(), picture, negative);
    EXPECT_EQ(worst.error.value().rmse, 1.0);
    EXPECT_LT(worst.ssim.value(), 0.1);
    const ClassErrors& errors = worst.classification.value().errors;
    EXPECT_NEAR(errors.edge + errors.acne + errors.detached + errors.bleeding + errors.terminator, 1.0, 1e-12);
}

TEST(ScoreMask, FromPlainImagesIsTheSame)
{
    Stage stage(worlds::load("planes", 1), "side", kSize_px, kSpot);
    const host::Picture picture = stage.geometry();
    ImageF mask(kSize_px.x, kSize_px.y, 1, 0.75F);
    const Subject& subject = stage.subject();
    const Score with_host = scoreMask(subject, stage.hardTruth(), picture, mask);
    const Camera camera = host::cameraOf(subject.eye, kSize_px.x, kSize_px.y, subject.state->bounds_ws);
    const Light& light = subject.lights[kSpot].caster;
    const Score plain = scoreMask({*subject.state, camera, light}, stage.hardTruth(), picture.object_ids, mask);
    EXPECT_GT(plain.error.value().rmse, 0.2);
    EXPECT_EQ(plain.error->rmse, with_host.error.value().rmse);
    EXPECT_EQ(plain.ssim, with_host.ssim);
    EXPECT_EQ(plain.flip, with_host.flip);
    EXPECT_EQ(plain.pixels.counted.values, with_host.pixels.counted.values);
    EXPECT_EQ(truthLight(light).near_m, truthLight(subject).near_m);
    EXPECT_EQ(truthView(camera, kSize_px).world_from_clip, truthView(subject, kSize_px).world_from_clip);
}

TEST(ScoreMask, OfNothingThatCountsHasNoNumbers)
{
    Stage stage(worlds::load("planes", 1), "top", kSize_px);
    Subject away = stage.subject();
    away.lights[0].caster.direction_ws = {0.0, 1.0, 0.0}; // from below
    const Score score = scoreMask(away, stage.hardTruth(), stage.geometry(), stage.hardTruth().visibility.visibility);
    EXPECT_EQ(score.pixels.counts.counted, 0U);
    EXPECT_FALSE(score.error || score.classification || score.ssim);
}

} // namespace
} // namespace gnomon::lab::test
