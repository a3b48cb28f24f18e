// SPDX-License-Identifier: Apache-2.0
// The promises of a run: the same bits from any number of threads, a seed that matters, progress, an end when asked.
#include "support.h"

#include "light_samples.h"
#include "parallel.h"

#include "worlds/worlds.h"

#include <gnomon/error.h>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>
#include <stdexcept>
#include <thread>

namespace gnomon::truth::test {
namespace {

const Light kSun = sun({3.0, -4.0, 0.5}, 0.1);
const View kView = lookAt({6.5, 5.0, 9.5}, {0.6, 1.0, 0.0}, 0.75, {100, 70});

TEST(Run, bits_do_not_depend_on_threads_and_do_on_the_seed)
{
    scene::Scene scene = worlds::load("planes", 1);
    const Traced one = trace(scene, kView, kSun, area(64, 1));
    for (const std::uint32_t threads : {1U, 2U, 3U}) {
        const Traced other = trace(scene, kView, kSun, area(64, threads));
        EXPECT_EQ(one.surfaces.points.values, other.surfaces.points.values);
        EXPECT_EQ(one.surfaces.triangle_ids.values, other.surfaces.triangle_ids.values);
        EXPECT_EQ(one.visibility.visibility.values, other.visibility.visibility.values);
        EXPECT_EQ(one.visibility.standard_error.values, other.visibility.standard_error.values);
        EXPECT_EQ(one.visibility.first_blocker_m.values, other.visibility.first_blocker_m.values);
        EXPECT_EQ(one.visibility.rays, other.visibility.rays);
    }
    Options options = area(64);
    options.seed = 2;
    const Traced reseeded = trace(scene, kView, kSun, options);
    EXPECT_NE(one.visibility.visibility.values, reseeded.visibility.visibility.values);
    EXPECT_GT(one.visibility.rays, 64U * 1000U);
    EXPECT_GT(one.visibility.seconds, 0.0);
}

TEST(Run, ends_when_cancelled)
{
    scene::Scene scene = worlds::load("planes", 1);
    const Traced traced = trace(scene, kView, kSun, hard());
    const Tracer tracer(scene, traced.state);
    std::atomic<bool> cancel{true};
    Options options = area(4096);
    options.cancel = &cancel;
    EXPECT_FALSE(tracer.see(kView, options).has_value());
    EXPECT_FALSE(tracer.trace(traced.surfaces, kView, kSun, options).has_value());
    // In the middle of it: the image has 35 tiles, and no thread takes another one once the first was told of.
    cancel = false;
    options.samples = kMaxSamples;
    double told = -1.0;
    options.progress = [&](double share) {
        if (share > 0.0 && !cancel) {
            told = share;
            cancel = true;
        }
    };
    EXPECT_FALSE(tracer.trace(traced.surfaces, kView, kSun, options).has_value());
    EXPECT_GT(told, 0.0);
    EXPECT_LT(told, 1.0);
}

TEST(RunDeathTest, EndsWhereRaysDoNotComeBack)
{
    Options options{.threads = 2};
    options.patience_s = 2;
    const auto standStill = [&] {
        (void)forEachTile({32, 32}, options, [](const Tile& tile) {
            tile.forEachPixel([](std::uint32_t x, std::uint32_t y) {
                while (x == 17 && y == 9) {
                    std::this_thread::sleep_for(std::chrono::milliseconds(10));
                }
            });
        });
    };
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_EXIT(standStill(), testing::ExitedWithCode(1), "^gnomon: error: tracing rays: .* for 2 s,");
}

TEST(Run, IsPatientWithSlowRows)
{
    Options options{.threads = 2};
    options.patience_s = 2;
    EXPECT_TRUE(forEachTile({32, 4}, options, [](const Tile& tile) {
        tile.forEachPixel([](std::uint32_t x, std::uint32_t) {
            std::this_thread::sleep_for(std::chrono::milliseconds(x == 0 ? 1000 : 0));
        });
    }));
}

/// Enough triangles that Embree reports a building's progress more than once.
scene::Scene balls(std::uint32_t count)
{
    scene::Scene scene;
    const std::uint32_t ball = addBall(scene, 60);
    for (std::uint32_t i = 0; i < count; ++i) {
        place(scene, ball, glm::translate(glm::mat4(1.0F), glm::vec3(3.0F * static_cast<float>(i), 0.0F, 0.0F)));
    }
    scene.nodes[0].casts = false; // so that there are two structures
    scene::finishScene(scene);
    return scene;
}

TEST(Building, tells_how_far_it_is_and_ends_when_cancelled)
{
    const scene::Scene scene = balls(8);
    const scene::State state = scene::evaluate(scene, 0.0);
    std::vector<double> shares;
    Options options = hard();
    options.progress = [&, caller = std::this_thread::get_id()](double share) {
        EXPECT_EQ(std::this_thread::get_id(), caller);
        shares.push_back(share);
    };
    const View view = lookDown(0.0, 5.0, 2.0, {4, 4});
    EXPECT_TRUE(Tracer(scene, state, options).see(view, hard()).has_value());
    ASSERT_GE(shares.size(), 4U);
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
    EXPECT_GE(shares[0], 0.0);
    EXPECT_TRUE(std::any_of(shares.begin(), shares.end(), [](double share) { return share > 0.0 && share < 0.5; }));
    EXPECT_GT(shares.back(), 0.99);
    EXPECT_LE(shares.back(), 1.0);
    // Cancelled within the first structure, within the second, and before it starts.
    for (const double when : {0.01, 0.6, -1.0}) {
        std::atomic<bool> cancel{when < 0.0};
        double told = when;
        options.cancel = &cancel;
        options.progress = [&](double share) {
            EXPECT_FALSE(cancel);
            told = share;
            cancel = share >= when;
        };
        const Tracer tracer(scene, state, options);
        cancel = false; // so that it is the lack of a structure that ends them
        EXPECT_FALSE(tracer.see(view, hard()).has_value());
        const Surfaces none;
        EXPECT_FALSE(tracer.trace(none, {.size_px = {0, 0}}, kSun, hard()).has_value());
        EXPECT_GE(told, when);
        EXPECT_LT(told, when + 0.4);
    }
    options.cancel = nullptr;
    options.progress = [](double) {
        throw std::logic_error("no");
    };
    EXPECT_THROW(Tracer(scene, state, options), std::logic_error);
}

TEST(Options, samples_that_do_not_divide_into_sets_are_refused)
{
    scene::Scene scene = worlds::load("planes", 1);
    const Traced traced = trace(scene, kView, kSun, hard());
    const Tracer tracer(scene, traced.state);
    for (const std::uint32_t samples : {0U, 1U, 3U, 5U, 255U, kMaxSamples + kSampleSets, 0xFFFFFFFCU}) {
        EXPECT_THROW((void)tracer.trace(traced.surfaces, kView, kSun, area(samples)), Error) << samples;
        Options one_ray = hard();
        one_ray.samples = samples;
        EXPECT_TRUE(tracer.trace(traced.surfaces, kView, kSun, one_ray).has_value());
    }
    const Visibility least = tracer.trace(traced.surfaces, kView, kSun, area(kSampleSets)).value();
    for (const float v : least.visibility.values) {
        ASSERT_TRUE(v >= 0.0F && v <= 1.0F) << v;
    }
}

TEST(Run, progress_rises_to_one_on_the_calling_thread)
{
    scene::Scene scene = worlds::load("planes", 1);
    const Traced traced = trace(scene, kView, kSun, hard());
    const Tracer tracer(scene, traced.state);
    std::vector<double> shares;
    Options options = area(8192);
    options.progress = [&, caller = std::this_thread::get_id()](double share) {
        EXPECT_EQ(std::this_thread::get_id(), caller);
        shares.push_back(share);
    };
    ASSERT_TRUE(tracer.trace(traced.surfaces, kView, kSun, options).has_value());
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
    EXPECT_TRUE(std::any_of(shares.begin(), shares.end(), [](double share) { return share > 0.0 && share < 1.0; }));
    ASSERT_FALSE(shares.empty());
    EXPECT_GE(shares.front(), 0.0);
    EXPECT_EQ(shares.back(), 1.0);
}

TEST(Tiles, cover_each_pixel_once_and_hand_on_what_is_thrown)
{
    for (const glm::uvec2 size : {glm::uvec2(1, 1), glm::uvec2(16, 16), glm::uvec2(17, 33), glm::uvec2(100, 3)}) {
        std::vector<std::atomic<int>> visits(std::size_t{size.x} * size.y);
        ASSERT_TRUE(forEachTile(size, {.threads = 3}, [&](const Tile& tile) {
            for (std::uint32_t y = tile.min.y; y < tile.max.y; ++y) {
                for (std::uint32_t x = tile.min.x; x < tile.max.x; ++x) {
                    ++visits[std::size_t{y} * size.x + x];
                }
            }
        }));
        EXPECT_TRUE(std::all_of(visits.begin(), visits.end(), [](const auto& n) { return n == 1; }));
    }
    const auto fail = [](const Tile&) {
        throw std::runtime_error("no");
    };
    EXPECT_THROW((void)forEachTile({64, 64}, {.threads = 2}, fail), std::runtime_error);
    const Options bad_progress{.threads = 2, .progress = [](double) {
                                   throw std::logic_error("no");
                               }};
    EXPECT_THROW((void)forEachTile({64, 64}, bad_progress, [](const Tile&) {}), std::logic_error);
}

TEST(DiscSet, is_stratified_and_uniform)
{
    for (const std::uint32_t count : {1U, 3U, 16U, 64U, 1000U}) {
        std::set<int> rings;
        glm::dvec2 mean(0.0);
        double second = 0.0;
        for (const DiscPoint& base : makeDiscSet(count)) {
            const DiscPoint point = moved(base, shiftOf(1, 7, 2));
            ASSERT_TRUE(point.area >= 0.0F && point.area < 1.0F);
            ASSERT_NEAR(glm::length(point.direction), 1.0F, 1e-5F);
            rings.insert(static_cast<int>(base.area * static_cast<float>(count)));
            mean += glm::dvec2(point.direction) * std::sqrt(double{point.area}) / double(count);
            second += double{point.area} / count;
        }
        EXPECT_EQ(rings.size(), count); // one in each ring of equal area
        if (count >= 64) {
            EXPECT_LT(glm::length(mean), 0.03);
            EXPECT_NEAR(second, 0.5, 0.02);
        }
    }
}

TEST(DiscShift, differs_by_seed_pixel_and_set_and_fills_the_unit_interval)
{
    std::set<float> areas;
    double mean = 0.0;
    glm::dvec2 turn(0.0);
    constexpr int kShifts = 4096;
    for (int i = 0; i < kShifts; ++i) {
        const DiscShift shift =
            shiftOf(i % 4, static_cast<std::uint64_t>(i / 16), static_cast<std::uint32_t>(i / 4 % 4));
        areas.insert(shift.area);
        mean += double{shift.area} / kShifts;
        turn += glm::dvec2(shift.turn) / double(kShifts);
    }
    EXPECT_GT(areas.size(), kShifts - 8U);
    EXPECT_NEAR(mean, 0.5, 0.02);
    EXPECT_LT(glm::length(turn), 0.05);
}

TEST(StandardError, is_that_of_the_mean_of_four)
{
    const std::array<double, kSampleSets> estimates{0.0, 0.0, 1.0, 1.0};
    EXPECT_NEAR(standardError(estimates), std::sqrt(1.0 / 3.0 / 4.0), 1e-15); // sample variance 1/3, over four
    const std::array<double, kSampleSets> equal{0.3, 0.3, 0.3, 0.3};
    EXPECT_NEAR(standardError(equal), 0.0, 1e-15);
}

} // namespace
} // namespace gnomon::truth::test
