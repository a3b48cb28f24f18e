// SPDX-License-Identifier: Apache-2.0
// mask-size=half on a device under the validation layer, against the mask that every pixel reads maps for.
#define GNOMON_REAL double
#include "fixture.h"
#include "option_steps.h"
#include "planned_scene.h"

#include <gnomon/error.h>

#include <gnomon/shared/mask_upsample.h>
#include <gnomon/shared/screen_blur.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace gnomon::test {
namespace {

constexpr VkExtent2D kOdd{257, 131};

int byteOf(std::byte value)
{
    return std::to_integer<int>(value);
}

/// A sun over the boxes and over a post that is about a pixel wide.
struct PostedSun {
    explicit PostedSun(MaskSize size, Filter filter) : bench(kOdd, optionsOf(size, filter))
    {
        post = static_cast<std::uint32_t>(bench.scene.boxes.size()) + 1;
        for (const double x : {-1.0, 0.2, 1.4, 2.6}) {
            bench.scene.boxes.push_back({{x, 2.5, 3.0}, {0.03, 2.5, 0.03}, 0.0});
        }
        bench.setLights({makeSun({0.5, -1.0, -0.3})}, {{0, 0, 0, 256, 256}}, {256, 256, 1});
        bench.prepare();
        bench.record(1);
        mask = bench.readMask(0);
    }
    static ShadowOptions optionsOf(MaskSize size, Filter filter)
    {
        ShadowOptions options = optionsFrom("filter=hard map-size=256");
        options.technique.filter = filter;
        options.mask_size = size;
        return options;
    }
    [[nodiscard]] std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * kOdd.width + x; }
    [[nodiscard]] bool sameSurface(std::size_t a, std::size_t b) const
    {
        return bench.picture.object_plus_one[a] == bench.picture.object_plus_one[b] &&
               glm::dot(bench.picture.normal[a], bench.picture.normal[b]) > 0.999;
    }

    Bench bench;
    std::uint32_t post = 0; // the first one's object
    std::vector<std::byte> mask;
};

/// The pixels that a pixel may take from, with what they count for if they are of its surface.
struct Corner {
    int x = 0;
    int y = 0;
    double share = 0.0;
};
std::array<Corner, 4> cornersOf(int x, int y)
{
    const shared::real2 place(shared::texelOfPixel(x, 2), shared::texelOfPixel(y, 2));
    const shared::real2 cell = glm::floor(place);
    std::array<Corner, 4> corners;
    for (int i = 0; i < 4; ++i) {
        const auto pixel = [](double texel, std::uint32_t size) {
            const int last = static_cast<int>(size);
            return std::min(shared::pixelOfTexel(std::clamp(static_cast<int>(texel), 0, (last - 1) / 2), 2), last - 1);
        };
        corners[i] = {pixel(cell.x + (i & 1), kOdd.width), pixel(cell.y + (i >> 1), kOdd.height),
                      shared::cornerShare(place - cell, i)};
    }
    return corners;
}

/// The value of a pixel in the half mask, where the whole mask decides it. If all corners are of its surface, it is
/// their mean or, if they disagree, the whole mask's value; so it is where no corner is of its object.
std::optional<double> expectedAt(const PostedSun& whole, int x, int y, bool& is_alone)
{
    const std::size_t here = whole.index(x, y);
    double sum = 0.0;
    int least = 255;
    int most = 0;
    std::size_t own = 0;
    std::size_t same = 0;
    std::size_t count = 0;
    for (const Corner& corner : cornersOf(x, y)) {
        if (corner.share > 0.0) {
            const std::size_t there = whole.index(corner.x, corner.y);
            const int value = byteOf(whole.mask[there]);
            ++count;
            same += whole.sameSurface(here, there) ? 1 : 0;
            own += whole.bench.picture.object_plus_one[here] == whole.bench.picture.object_plus_one[there] ? 1 : 0;
            sum += corner.share * value;
            least = std::min(least, value);
            most = std::max(most, value);
        }
    }
    is_alone = own == 0 && whole.bench.picture.object_plus_one[here] > whole.post;
    if (is_alone) {
        return byteOf(whole.mask[here]);
    }
    const double apart = (most - least) / 255.0;
    if (same != count || std::abs(apart - shared::kUpsampleApart) < 0.01) {
        return std::nullopt; // shares of depth, or single precision, may decide otherwise
    }
    return apart > shared::kUpsampleApart ? byteOf(whole.mask[here]) : sum;
}

class HalfMask : public testing::TestWithParam<Filter> {};

TEST_P(HalfMask, IsTheMeanOfItsSurfaceOrWhatThePixelItselfSees)
{
    const PostedSun whole(MaskSize::full, GetParam());
    const PostedSun half(MaskSize::half, GetParam());
    std::size_t told = 0;
    std::size_t alone = 0;
    std::size_t in_between = 0;
    for (int y = 0; y < static_cast<int>(kOdd.height); ++y) {
        for (int x = 0; x < static_cast<int>(kOdd.width); ++x) {
            bool is_alone = false;
            const std::optional<double> expected = expectedAt(whole, x, y, is_alone);
            if (!expected || whole.bench.picture.object_plus_one[whole.index(x, y)] == 0) {
                continue;
            }
            const int found = byteOf(half.mask[half.index(x, y)]);
            EXPECT_NEAR(found, *expected, 1.01) << x << ", " << y << (is_alone ? " of a post" : "");
            ++told;
            alone += is_alone ? 1 : 0;
            in_between += *expected > 0.0 && *expected < 255.0 ? 1 : 0;
        }
    }
    EXPECT_GT(told, whole.mask.size() / 2);
    EXPECT_GT(alone, 20U) << "no pixel of the posts is between others";
    EXPECT_TRUE(GetParam() == Filter::hard || in_between > 100) << in_between;
    expectSilence(gpu());
}

/// Wherever a surface has one value around a pixel, it has that, whatever others beside it have.
TEST_P(HalfMask, NothingBleedsOverSilhouettes)
{
    constexpr int kReach = 2;
    const PostedSun whole(MaskSize::full, GetParam());
    const PostedSun half(MaskSize::half, GetParam());
    std::size_t judged = 0;
    for (int y = kReach; y < static_cast<int>(kOdd.height) - kReach; ++y) {
        for (int x = kReach; x < static_cast<int>(kOdd.width) - kReach; ++x) {
            const std::size_t here = whole.index(x, y);
            bool has_others = false;
            bool is_even = whole.bench.picture.object_plus_one[here] != 0;
            for (int v = y - kReach; v <= y + kReach && is_even; ++v) {
                for (int u = x - kReach; u <= x + kReach && is_even; ++u) {
                    const std::size_t there = whole.index(u, v);
                    has_others =
                        has_others || (!whole.sameSurface(here, there) && whole.mask[there] != whole.mask[here]);
                    is_even = !whole.sameSurface(here, there) || whole.mask[there] == whole.mask[here];
                }
            }
            if (is_even && has_others) {
                ++judged;
                // Over a crease texels of both sides count that agree as far as kUpsampleApart.
                EXPECT_NEAR(byteOf(half.mask[here]), byteOf(whole.mask[here]), 26.0) << x << ", " << y;
            }
        }
    }
    EXPECT_GT(judged, 200U);
}

INSTANTIATE_TEST_SUITE_P(Filters, HalfMask, testing::Values(Filter::hard, Filter::pcf, Filter::pcss),
                         [](const auto& one) { return std::string(nameOf(one.param)); });

class HalfMaskLines : public testing::TestWithParam<const char*> {};

/// With any technique the pixels that are read equal those of the whole mask, to the last bit.
TEST_P(HalfMaskLines, KeepsThePixelsThatItReads)
{
    PlannedScene scene(gpu(), kOdd);
    scene.remakeViews(kOdd, true, true);
    const std::vector<Light> lights = sunsAndSpots(3);
    const auto drawn = [&](MaskSize size) {
        ShadowOptions options = optionsFrom(GetParam());
        options.mask_size = size;
        Drawing drawing(gpu(), scene.mesh());
        Planner planner(options);
        const Frame frame = scene.frameOf(lights);
        return scene.draw(drawing, planner.plan(frame));
    };
    const std::vector<std::byte> whole = drawn(MaskSize::full);
    const std::vector<std::byte> half = drawn(MaskSize::half);
    ASSERT_EQ(whole.size(), half.size());
    const std::size_t pixels = std::size_t{kOdd.width} * kOdd.height;
    std::size_t wrong = 0;
    std::size_t off = 0;
    std::size_t shadowed = 0;
    for (std::size_t i = 0; i < whole.size(); ++i) {
        const std::size_t pixel = i / 4 % pixels;
        const bool is_read = (pixel % kOdd.width & 1U) != 0 && (pixel / kOdd.width & 1U) != 0;
        wrong += is_read && whole[i] != half[i] ? 1 : 0;
        off += std::abs(byteOf(whole[i]) - byteOf(half[i])) > 26 ? 1 : 0;
        shadowed += byteOf(whole[i]) < 128 ? 1 : 0;
    }
    EXPECT_EQ(wrong, 0U);
    EXPECT_LE(off, whole.size() / 200) << "more is missed than what is thin";
    EXPECT_GT(shadowed, pixels / 20);
    expectSilence(gpu());
}

INSTANTIATE_TEST_SUITE_P(Techniques, HalfMaskLines,
                         testing::Values("filter=pcf map-size=128", "filter=pcf partition=cascades map-size=64",
                                         "filter=pcf pcf.kernel=vogel map-size=64", "filter=raymarch map-size=64",
                                         "filter=vsm map-size=64", "filter=lvsm map-size=64", "filter=esm map-size=64",
                                         "filter=evsm map-size=64", "filter=msm map-size=64", "filter=id map-size=64",
                                         "filter=depth-id map-size=64", "filter=hard soften=smoothies map-size=64",
                                         "filter=smoothies map-size=64", "filter=pcf partition=multi map-size=64",
                                         "filter=pcf translucent=colour map-size=64"),
                         [](const auto& one) { return nameOfBase(one.param); });

TEST(HalfMaskBeside, LightsOfOneLayerHaveEachTheirOwn)
{
    const std::array<ShadowOptions, 3> several{optionsFrom("filter=pcf map-size=64"),
                                               optionsFrom("filter=pcf mask-size=half map-size=64"),
                                               optionsFrom("filter=hard mask-size=half map-size=64")};
    std::array<ShadowOptions, 3> whole = several;
    whole[1].mask_size = whole[2].mask_size = MaskSize::full;
    PlannedScene scene(gpu(), kOdd);
    std::vector<Light> lights = sunsAndSpots(6);
    for (std::uint32_t i = 0; i < lights.size(); ++i) {
        lights[i].options = i < 4 ? i % 3 : 2; // the second layer has lights of half the size alone
    }
    const auto drawn = [&](std::span<const ShadowOptions> options) {
        Drawing drawing(gpu(), scene.mesh());
        Planner planner(options);
        const Frame frame = scene.frameOf(lights);
        return scene.draw(drawing, planner.plan(frame));
    };
    const auto mixed = drawn(several);
    const auto expected = drawn(whole);
    ASSERT_EQ(mixed.size(), expected.size());
    const std::size_t layer = std::size_t{4} * kOdd.width * kOdd.height;
    std::size_t wrong = 0;
    std::size_t off = 0;
    for (std::size_t i = 0; i < mixed.size(); ++i) {
        const std::size_t light = i / layer * 4 + i % 4;
        const std::size_t pixel = i % layer / 4;
        const bool is_read = (pixel % kOdd.width & 1U) != 0 && (pixel / kOdd.width & 1U) != 0;
        const bool is_whole = light >= lights.size() || lights[light].options == 0;
        wrong += (is_whole || is_read) && mixed[i] != expected[i] ? 1 : 0;
        off += mixed[i] != expected[i] ? 1 : 0;
    }
    EXPECT_EQ(wrong, 0U);
    EXPECT_GT(off, 0U) << "nothing is taken from beside";
    expectSilence(gpu());
}

TEST(HalfMaskBeside, GoesWithEveryOtherPassOfTheMask)
{
    PlannedScene scene(gpu(), kOdd);
    const std::vector<Light> lights = sunsAndSpots(2);
    for (const char* const line :
         {"filter=pcf mask-size=half motion=step-alternate map-size=64",
          "filter=pcf mask-size=half motion=step-band map-size=64", "filter=pcf mask-size=half soften=blur map-size=64",
          "filter=pcf mask-size=half partition=sdsm map-size=64"}) {
        ShadowOptions options = optionsFrom(line);
        const auto drawn = [&](MaskSize size) {
            options.mask_size = size;
            Drawing drawing(gpu(), scene.mesh());
            Planner planner(options);
            std::vector<std::byte> mask;
            for (int i = 0; i < 3; ++i) {
                const Frame frame = scene.frameOf(lights);
                mask = scene.draw(drawing, planner.plan(frame));
            }
            return mask;
        };
        const auto half = drawn(MaskSize::half);
        const auto whole = drawn(MaskSize::full);
        std::size_t off = 0;
        for (std::size_t i = 0; i < half.size(); ++i) {
            off += std::abs(byteOf(whole[i]) - byteOf(half[i])) > 26 ? 1 : 0;
        }
        EXPECT_LE(off, half.size() / 100) << line;
        EXPECT_NE(half, whole) << line;
        expectSilence(gpu());
    }
    std::vector<Light> both = lights;
    both[1].options = 1;
    Drawing drawing(gpu(), scene.mesh());
    Planner planner(std::array{optionsFrom("filter=pcf mask-size=half map-size=64"),
                               optionsFrom("filter=pcf soften=converge map-size=64")});
    for (int i = 0; i < 3; ++i) {
        const Frame frame = scene.frameOf(both);
        (void)scene.draw(drawing, planner.plan(frame));
    }
    expectSilence(gpu());
}

VkDeviceSize bytesOf(const vulkan::ShadowRenderer& renderer)
{
    for (const vulkan::MemoryUse& use : renderer.memory()) {
        if (std::string_view(use.purpose) == "half mask") {
            return use.bytes;
        }
    }
    return 0;
}

TEST(HalfMaskImages, FollowTheSizeTheOptionsAndTheInputs)
{
    PlannedScene scene(gpu(), kOdd);
    const std::vector<Light> lights = sunsAndSpots(1);
    Drawing kept(gpu(), scene.mesh());
    const auto draw = [&](Drawing& drawing, MaskSize size) {
        ShadowOptions options = optionsFrom("filter=pcf map-size=64");
        options.mask_size = size;
        Planner planner(options);
        const Frame frame = scene.frameOf(lights);
        return scene.draw(drawing, planner.plan(frame));
    };
    const auto isAsIfFresh = [&](MaskSize size) {
        Drawing fresh(gpu(), scene.mesh());
        return draw(kept, size) == draw(fresh, size);
    };
    EXPECT_TRUE(isAsIfFresh(MaskSize::full));
    EXPECT_EQ(bytesOf(kept.renderer), 0U);
    EXPECT_TRUE(isAsIfFresh(MaskSize::half));
    const VkDeviceSize before = bytesOf(kept.renderer);
    EXPECT_GE(before, VkDeviceSize{129} * 66);
    EXPECT_TRUE(isAsIfFresh(MaskSize::full));
    EXPECT_TRUE(isAsIfFresh(MaskSize::half));
    for (const VkExtent2D size : {VkExtent2D{96, 61}, VkExtent2D{1, 1}, VkExtent2D{2, 3}}) {
        scene.remakeViews(size, false, true);
        EXPECT_TRUE(isAsIfFresh(MaskSize::half)) << size.width;
        EXPECT_TRUE(isAsIfFresh(MaskSize::half)) << size.width;
    }
    (void)draw(kept, MaskSize::half); // by now nothing of the other size is in flight
    EXPECT_LT(bytesOf(kept.renderer), before);
    expectSilence(gpu());
}

TEST(HalfMaskImages, OfAPlanThatWasNotPreparedAreRefused)
{
    Bench bench(kOdd, optionsFrom("filter=hard map-size=256"));
    bench.setLights({makeSun({0.5, -1.0, -0.3})}, {{0, 0, 0, 256, 256}}, {256, 256, 1});
    bench.prepare();
    bench.record(1);
    bench.plan.options = planOptions(optionsFrom("filter=hard mask-size=half map-size=256"));
    EXPECT_THROW(bench.record(1), Error);
    bench.prepare();
    bench.record(1);
    expectSilence(gpu());
}

} // namespace
} // namespace gnomon::test
