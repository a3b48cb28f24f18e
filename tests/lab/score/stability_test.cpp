// SPDX-License-Identifier: Apache-2.0
// Shimmer and pop of masks made by hand, whose change from frame to frame is known, and where a real picture's pixels
// were a frame before.
#include "lab/score/stability.h"

#include "lab/score/path_score.h"
#include "lab/score/score.h"

#include "scene/state.h"
#include "worlds/worlds.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

namespace gnomon::lab {
namespace {

constexpr std::uint32_t kWidth = 20;
constexpr std::uint32_t kHeight = 8;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A parallel camera that looks straight down on the ground from x = `shift`: a pixel is a square metre.
struct Frame {
    explicit Frame(double shift) : counted(kWidth, kHeight, 1, 1)
    {
        camera.eye_ws = {shift, 10.0, 0.0};
        camera.clip_from_world = glm::dmat4(0.0);
        camera.clip_from_world[0] = {2.0 / kWidth, 0.0, 0.0, 0.0};
        camera.clip_from_world[1] = {0.0, 0.0, 0.01, 0.0};
        camera.clip_from_world[2] = {0.0, 2.0 / kHeight, 0.0, 0.0};
        camera.clip_from_world[3] = {-2.0 * shift / kWidth - 1.0, -1.0, 0.0, 1.0};
        surfaces.object_ids = ImageOf<std::uint32_t>(kWidth, kHeight, 1, 1);
        surfaces.points = ImageF(kWidth, kHeight, 3);
        surfaces.normals = ImageF(kWidth, kHeight, 3);
        for (std::uint32_t y = 0; y < kHeight; ++y) {
            for (std::uint32_t x = 0; x < kWidth; ++x) {
                float* point = surfaces.points.pixel(x, y);
                point[0] = static_cast<float>(x) + 0.5F;
                point[1] = -10.0F;
                point[2] = static_cast<float>(y) + 0.5F;
                surfaces.normals.pixel(x, y)[1] = 1.0F;
            }
        }
    }
    [[nodiscard]] SeenFrame seen() const { return {camera, surfaces, counted}; }

    Camera camera;
    truth::Surfaces surfaces;
    Counted counted;
};

/// A mask by the column of its pixels.
ImageF columns(const std::function<double(std::uint32_t x)>& value)
{
    ImageF mask(kWidth, kHeight, 1);
    for (std::uint32_t y = 0; y < kHeight; ++y) {
        for (std::uint32_t x = 0; x < kWidth; ++x) {
            *mask.pixel(x, y) = static_cast<float>(value(x));
        }
    }
    return mask;
}

/// Lit from column `first` on.
ImageF litFrom(std::uint32_t first)
{
    return columns([=](std::uint32_t x) { return x >= first ? 1.0 : 0.0; });
}

/// A frame whose error then is fetched from the pixels around; null at the first.
void add(StabilityMeter& meter, const ImageF& mask, const ImageF& truth, const Reprojection* onto_before)
{
    const std::optional<FrameBefore> before =
        onto_before != nullptr ? std::optional<FrameBefore>(FrameBefore{*onto_before}) : std::nullopt;
    meter.add(mask, truth, before ? &*before : nullptr);
}

TEST(Stability, TheErrorAtThePointItselfGoesBeforeThatOfThePixelsAround)
{
    // Between two pixels an edge is half lit by what is fetched around it, though it stayed where it was.
    const Frame now(0.5);
    const Frame then(0.0);
    const Reprojection onto_before(now.seen(), then.seen());
    const Reprojection here(now.seen(), now.seen());
    const ImageF lit = columns([](std::uint32_t) { return 1.0; });
    for (const bool exact : {false, true}) {
        StabilityMeter meter;
        meter.add(litFrom(6), lit, nullptr);
        const ImageF error_here = errorOf(litFrom(6), lit);
        const FrameBefore before{onto_before, exact ? &here : nullptr, exact ? &error_here : nullptr};
        meter.add(litFrom(6), lit, &before);
        EXPECT_EQ(meter.steps()[0].matched, kWidth * kHeight);
        EXPECT_EQ(meter.stability().value().shimmer == 0.0, exact);
    }
    // Surfaces that the last frame did not see do not count, even where its moment can be seen from here.
    const Frame elsewhere(100.0);
    const Reprojection onto_nothing(now.seen(), elsewhere.seen());
    const ImageF error_here = errorOf(litFrom(6), lit);
    const FrameBefore before{onto_nothing, &here, &error_here};
    StabilityMeter meter;
    meter.add(litFrom(6), lit, nullptr);
    meter.add(litFrom(6), lit, &before);
    EXPECT_EQ(meter.steps()[0].matched, 0U);
}

TEST(Stability, AnErrorThatStaysInTheWorldIsNone)
{
    // The camera goes right by a pixel, so the world goes left; the mask is wrong at the same places of the world.
    StabilityMeter meter;
    const auto error_at = [](std::uint32_t world_x) {
        return world_x % 3 == 0 ? 1.0 : 0.25;
    };
    for (std::uint32_t frame = 0; frame < 4; ++frame) {
        const ImageF mask = columns([&](std::uint32_t x) { return error_at(x + frame); });
        const Reprojection onto_before(Frame(frame).seen(), Frame(frame - 1.0).seen());
        add(meter, mask, columns([](std::uint32_t) { return 0.0; }), frame == 0 ? nullptr : &onto_before);
    }
    ASSERT_EQ(meter.steps().size(), 3U);
    EXPECT_EQ(meter.steps()[0].matched, (kWidth - 1) * kHeight); // the last column was not in the picture
    EXPECT_EQ(meter.stability().value().shimmer, 0.0);
    EXPECT_EQ(meter.stability().value().pop, 0.0);
}

TEST(Stability, AShadowThatMovesAsTheTruthDoesIsNone)
{
    StabilityMeter meter;
    const Frame still(0.0);
    const Reprojection onto_before(still.seen(), still.seen());
    EXPECT_EQ(onto_before.matched(), kWidth * kHeight);
    for (std::uint32_t frame = 0; frame < 4; ++frame) {
        add(meter, litFrom(3 + 2 * frame), litFrom(3 + 2 * frame), frame == 0 ? nullptr : &onto_before);
    }
    EXPECT_EQ(meter.stability().value().shimmer, 0.0);
}

TEST(Stability, AnErrorThatStaysOnTheScreenIs)
{
    // Stripes of a pixel that go along with the camera: at every point of the world the error flips.
    StabilityMeter meter;
    for (std::uint32_t frame = 0; frame < 3; ++frame) {
        const Reprojection onto_before(Frame(frame).seen(), Frame(frame - 1.0).seen());
        add(meter, columns([](std::uint32_t x) { return x % 2; }), columns([](std::uint32_t) { return 0.0; }),
            frame == 0 ? nullptr : &onto_before);
    }
    EXPECT_DOUBLE_EQ(meter.stability().value().shimmer, 1.0);
    EXPECT_DOUBLE_EQ(meter.stability().value().pop, 1.0);
}

TEST(Stability, PopIsTheWorstFrame)
{
    StabilityMeter meter;
    const Frame still(0.0);
    const Reprojection onto_before(still.seen(), still.seen());
    const std::uint32_t edges[] = {4, 5, 5, 9, 8};
    for (std::size_t frame = 0; frame < std::size(edges); ++frame) {
        add(meter, litFrom(edges[frame]), litFrom(4), frame == 0 ? nullptr : &onto_before);
    }
    const Stability stability = meter.stability().value();
    EXPECT_DOUBLE_EQ(stability.pop, 4.0 / kWidth);
    EXPECT_EQ(stability.pop_frame, 3U);
    EXPECT_DOUBLE_EQ(stability.shimmer, std::sqrt((1.0 + 0.0 + 4.0 + 1.0) / (4.0 * kWidth)));
}

TEST(Stability, FetchesBetweenPixels)
{
    const Reprojection onto_before(Frame(0.3).seen(), Frame(0.0).seen());
    const ImageF before = columns([](std::uint32_t x) { return x * x; });
    EXPECT_NEAR(onto_before.fetch(before, 5).value(), 0.7 * 25.0 + 0.3 * 36.0, 1e-4);
    // Beyond the last centre there is but one neighbour.
    EXPECT_NEAR(onto_before.fetch(before, kWidth - 1).value(), 361.0, 1e-4);
    EXPECT_EQ(onto_before.matched(), kWidth * kHeight);
    // So small a shift is rounding: a pixel is fetched as it was.
    const Reprojection at_rest(Frame(0.0005).seen(), Frame(0.0).seen());
    EXPECT_EQ(at_rest.fetch(before, 5).value(), 25.0);
}

TEST(Stability, OnlyTheSameSurfaceMatches)
{
    const Frame now(0.0);
    Frame other(0.0);
    std::fill(other.surfaces.object_ids.values.begin(), other.surfaces.object_ids.values.end(), 2U);
    EXPECT_EQ(Reprojection(now.seen(), other.seen()).matched(), 0U);
    // The same object farther down: by less than the width of a pixel, and by more.
    for (const double depth : {0.9, 1.1}) {
        Frame lower(0.0);
        for (std::size_t i = 1; i < lower.surfaces.points.values.size(); i += 3) {
            lower.surfaces.points.values[i] -= static_cast<float>(depth);
        }
        EXPECT_EQ(Reprojection(now.seen(), lower.seen()).matched(), depth < 1.0 ? kWidth * kHeight : 0U) << depth;
    }
    Frame uncounted(0.0);
    *uncounted.counted.pixel(5, 0) = 0;
    EXPECT_EQ(Reprojection(now.seen(), uncounted.seen()).matched(), kWidth * kHeight - 1);
    EXPECT_EQ(Reprojection(uncounted.seen(), now.seen()).matched(), kWidth * kHeight - 1);
    EXPECT_FALSE(Reprojection(now.seen(), uncounted.seen()).fetch(litFrom(0), 5).has_value());
    // A neighbour that does not match leaves its weight to the others, whatever it holds.
    const Reprojection between(Frame(0.3).seen(), uncounted.seen());
    const ImageF before = columns([](std::uint32_t x) { return x == 5 ? kNan : x; });
    EXPECT_NEAR(between.fetch(before, 4).value(), 4.0, 1e-6);
    EXPECT_NEAR(between.fetch(before, 5).value(), 6.0, 1e-6);
}

TEST(Stability, NothingMatchesNothingIsSaid)
{
    StabilityMeter meter;
    EXPECT_FALSE(meter.stability().has_value());
    const Reprojection elsewhere(Frame(100.0).seen(), Frame(0.0).seen());
    EXPECT_EQ(elsewhere.matched(), 0U);
    add(meter, litFrom(3), litFrom(3), nullptr);
    EXPECT_FALSE(meter.stability().has_value()); // a single frame
    add(meter, litFrom(9), litFrom(3), &elsewhere);
    ASSERT_EQ(meter.steps().size(), 1U);
    EXPECT_EQ(meter.steps()[0].matched, 0U);
    EXPECT_EQ(meter.steps()[0].mean_abs, 0.0);
    EXPECT_FALSE(meter.stability().has_value());
}

TEST(Stability, NotANumberIsNotHidden)
{
    const Frame still(0.0);
    const Reprojection onto_before(still.seen(), still.seen());
    StabilityMeter meter;
    add(meter, litFrom(4), litFrom(4), nullptr);
    add(meter, columns([](std::uint32_t x) { return x == 3 ? kNan : 0.0; }), litFrom(4), &onto_before);
    add(meter, litFrom(5), litFrom(4), &onto_before);
    EXPECT_TRUE(std::isnan(meter.stability().value().shimmer));
    EXPECT_TRUE(std::isnan(meter.stability().value().pop));
}

/// The world `planes` from a camera that moves to the right.
class Walk {
public:
    Walk() : scene_(worlds::load("planes", 1)), state_(scene::evaluate(scene_, 0.0)), tracer_(scene_, state_) {}
    struct Shot {
        Camera camera;
        truth::Surfaces surfaces;
        Counted counted;
    };
    [[nodiscard]] Shot at(double x) const
    {
        constexpr glm::uvec2 kSize_px{96, 64};
        Shot shot;
        glm::dmat4 clip_from_view = glm::perspectiveRH_ZO(0.9, 1.5, 0.1, 200.0);
        clip_from_view[1][1] *= -1.0;
        shot.camera.eye_ws = {6.0 + x, 5.0, 8.0};
        shot.camera.clip_from_world =
            clip_from_view * glm::lookAtRH(shot.camera.eye_ws, glm::dvec3(x, 1.0, 0.0), {0.0, 1.0, 0.0});
        shot.camera.reversed_z = false;
        const truth::Options options{.kind = truth::Kind::hard, .threads = 1};
        shot.surfaces = tracer_.see(truthView(shot.camera, kSize_px), options).value();
        shot.counted = Counted(kSize_px.x, kSize_px.y, 1);
        for (std::size_t i = 0; i < shot.counted.values.size(); ++i) {
            shot.counted.values[i] = shot.surfaces.object_ids.values[i] != 0 ? 1 : 0;
        }
        return shot;
    }

private:
    scene::Scene scene_;
    scene::State state_;
    truth::Tracer tracer_;
};

TEST(Stability, APerspectiveCameraFindsThePointsAgain)
{
    const Walk walk;
    const Walk::Shot before = walk.at(0.0);
    const Walk::Shot now = walk.at(0.13);
    const Reprojection onto_before({now.camera, now.surfaces, now.counted},
                                   {before.camera, before.surfaces, before.counted});
    const auto surfaces =
        static_cast<std::uint64_t>(std::count(now.counted.values.begin(), now.counted.values.end(), std::uint8_t{1}));
    EXPECT_GT(onto_before.matched(), surfaces * 95 / 100);
    EXPECT_LT(onto_before.matched(), surfaces); // what the box hid, and what was outside
    // An image that holds each pixel's place along each axis must give the pixel's own place back. Values linear in the
    // world are not quite so between pixels, nor with a neighbour in place of a pixel without a match.
    for (std::size_t axis = 0; axis < 3; ++axis) {
        ImageF places(before.counted.width, before.counted.height, 1);
        for (std::size_t i = 0; i < places.values.size(); ++i) {
            places.values[i] = before.surfaces.points.values[3 * i + axis] +
                               static_cast<float>(before.camera.eye_ws[static_cast<int>(axis)]);
        }
        double sum = 0.0;
        for (std::size_t i = 0; i < places.values.size(); ++i) {
            if (const auto place = onto_before.fetch(places, i)) {
                sum += std::abs(*place - now.surfaces.points.values[3 * i + axis] -
                                now.camera.eye_ws[static_cast<int>(axis)]);
            }
        }
        EXPECT_LT(sum / static_cast<double>(onto_before.matched()), 0.01) << axis; // a pixel is 0.1 m and more
    }
}

TEST(PathScore, MeansAddUp)
{
    PathScore path;
    Score frame;
    frame.error = ErrorNumbers{0.1, 0.05, -0.01, 0.3};
    frame.classification.emplace();
    frame.classification->errors = {0.006, 0.003, 0.0, 0.0, 0.001};
    frame.ssim = 0.9;
    frame.pixels.counts.counted = 100;
    frame.pixels.counts.terminator = 7;
    frame.density.counted = 100;
    frame.density.p50 = 1.0;
    frame.density.facing.one_to_four = 0.5;
    path.add(frame);
    frame.error = ErrorNumbers{0.3, 0.15, 0.03, 0.5};
    frame.classification->errors = {0.05, 0.0, 0.04, 0.0};
    frame.ssim = 0.7;
    frame.outcome = {OutcomeKind::no_caster, "nothing casts"};
    frame.density.p50 = 3.0;
    frame.density.facing.one_to_four = 1.0;
    path.add(frame);
    Score empty; // no pixel counts: a frame of night
    empty.pixels.counts.background = 100;
    path.add(empty);
    const Score mean = path.mean();
    const ClassErrors& classes = mean.classification.value().errors;
    EXPECT_NEAR(mean.error.value().rmse, std::sqrt((0.01 + 0.09) / 2.0), 1e-15);
    EXPECT_NEAR(classes.edge + classes.acne + classes.detached + classes.bleeding + classes.terminator,
                mean.error->rmse * mean.error->rmse, 1e-15);
    EXPECT_NEAR(classes.terminator, 0.0005, 1e-15);
    EXPECT_EQ(mean.pixels.counts.terminator, 14U);
    EXPECT_NEAR(mean.error->mae, 0.1, 1e-15);
    EXPECT_NEAR(mean.error->bias, 0.01, 1e-15);
    EXPECT_NEAR(mean.error->p99, 0.4, 1e-15);
    EXPECT_NEAR(mean.ssim.value(), 0.8, 1e-15);
    EXPECT_FALSE(mean.flip.has_value());
    EXPECT_EQ(mean.pixels.counts.counted, 200U);
    EXPECT_EQ(mean.pixels.counts.background, 100U);
    EXPECT_EQ(mean.density.p50, 2.0);
    EXPECT_EQ(mean.density.facing.one_to_four, 0.75);
    EXPECT_EQ(mean.outcome.kind, OutcomeKind::no_caster);
    ASSERT_EQ(path.rmse().size(), 3U);
    EXPECT_EQ(path.rmse()[1], 0.3);
    EXPECT_FALSE(path.rmse()[2].has_value());

    PathScore night;
    night.add(empty);
    EXPECT_FALSE(night.mean().error.has_value());
    EXPECT_FALSE(night.mean().classification.has_value());
}

} // namespace
} // namespace gnomon::lab
