// SPDX-License-Identifier: Apache-2.0
// soften=blur on a device under the validation layer: against the same blur of the same mask on the CPU, over
// silhouettes, and with lights of other options beside.
#define GNOMON_REAL double
#include "soften_reference.h"

#include "fixture.h"
#include "option_steps.h"
#include "planned_scene.h"

#include <gnomon/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace gnomon::test {
namespace {

Plane planeOf(const std::vector<std::byte>& bytes)
{
    Plane plane(kWidth, kHeight);
    std::ranges::transform(bytes, plane.values.begin(), [](std::byte b) { return std::to_integer<int>(b) / 255.0; });
    return plane;
}

ShadowOptions optionsOf(std::string_view line)
{
    return optionsFrom("filter=hard map-size=256 " + std::string(line));
}

/// A sun over the boxes.
struct OneSun {
    explicit OneSun(const ShadowOptions& options) : bench(kScreen, options)
    {
        bench.setLights({makeSun({0.5, -1.0, -0.3})}, {{0, 0, 0, 256, 256}}, {256, 256, 1});
        bench.prepare();
        bench.record(1);
    }
    [[nodiscard]] Plane mask() { return planeOf(bench.readMask(0)); }

    Bench bench;
};

struct SoftenCase {
    const char* name;
    const char* options;
};
void PrintTo(const SoftenCase& value, std::ostream* out)
{
    *out << value.options;
}

class SoftenParity : public testing::TestWithParam<SoftenCase> {};

TEST_P(SoftenParity, IsTheBlurOfTheMask)
{
    ShadowOptions options = optionsOf(GetParam().options);
    if (std::string_view(GetParam().name).starts_with("Strong")) {
        options.screen_blur.strength_px = 1.75F;
    }
    OneSun blurred(options);
    options.technique.soften = Soften::none;
    OneSun plain(options);
    const Plane expected =
        SoftenReference(plain.bench.picture, plain.bench.camera, options.screen_blur).of(plain.mask());
    const Plane found = blurred.mask();
    // Each pass rounds to eight bits, and halves are common between pixels of 0 and 1: of a smaller size there is a
    // third.
    const double steps = options.screen_blur.size == ScreenSize::full ? 1.001 : 2.001;
    double worst = 0.0;
    std::size_t off = 0;
    std::size_t moved = 0;
    const Plane before = plain.mask();
    for (std::size_t i = 0; i < found.values.size(); ++i) {
        const double difference = std::abs(found.values[i] - expected.values[i]) * 255.0;
        worst = std::max(worst, difference);
        off += difference > steps ? 1 : 0;
        moved += std::abs(found.values[i] - before.values[i]) * 255.0 > 8.0 ? 1 : 0;
    }
    // Where a tap lies between two pixels, or a share is at its end, single precision may choose otherwise.
    EXPECT_LE(off, found.values.size() / 1000) << "of " << found.values.size() << ", by up to " << worst;
    RecordProperty("worst_steps", std::to_string(worst));
    RecordProperty("off", static_cast<int>(off));
    EXPECT_GT(moved, found.values.size() / 100) << "nothing is blurred";
    expectSilence(gpu());
}

INSTANTIATE_TEST_SUITE_P(
    Blur, SoftenParity,
    testing::Values(
        SoftenCase{"EdgeAware", "soften=blur"}, SoftenCase{"Plain", "soften=blur soften.edges=plain"},
        SoftenCase{"Published", "soften=blur soften.edges=plain soften.taps=published"},
        SoftenCase{"PublishedHalf", "soften=blur soften.edges=plain soften.taps=published soften.size=half"},
        SoftenCase{"BoxHalf", "soften=blur soften.kernel=box soften.size=half"},
        SoftenCase{"PlainHalf", "soften=blur soften.size=half soften.edges=plain"},
        SoftenCase{"Quarter", "soften=blur soften.size=quarter"},
        SoftenCase{"Poisson", "soften=blur soften.kernel=poisson"},
        SoftenCase{"PoissonPlainHalf", "soften=blur soften.kernel=poisson soften.edges=plain soften.size=half"},
        SoftenCase{"FirstPass", "soften=blur soften.passes=1"},
        SoftenCase{"StrongPlain", "soften=blur soften.edges=plain"},
        SoftenCase{"StrongHalf", "soften=blur soften.size=half"}),
    [](const auto& one) { return one.param.name; });

/// The light from other surfaces, summed over pixels whose own surface has one value as far as the blur reaches.
double bledOver(const Plane& before, const Plane& after, const Picture& picture)
{
    constexpr int kReach = 8;
    const auto index = [](int x, int y) {
        return static_cast<std::size_t>(y * kWidth + x);
    };
    double sum = 0.0;
    for (int y = kReach; y < kHeight - kReach; ++y) {
        for (int x = kReach; x < kWidth - kReach; ++x) {
            const std::size_t here = index(x, y);
            bool is_even = true;
            for (int v = y - kReach; v <= y + kReach && is_even; ++v) {
                for (int u = x - kReach; u <= x + kReach && is_even; ++u) {
                    const bool same = picture.object_plus_one[index(u, v)] == picture.object_plus_one[here] &&
                                      glm::dot(picture.normal[index(u, v)], picture.normal[here]) > 0.99;
                    is_even = !same || before.at(u, v) == before.at(x, y);
                }
            }
            sum += is_even ? std::abs(after.at(x, y) - before.at(x, y)) : 0.0;
        }
    }
    return sum;
}

TEST(Soften, BleedsOverSilhouettesByAtMostATwentiethOfPlain)
{
    OneSun none(optionsOf("soften=none"));
    const Plane before = none.mask();
    const auto bled = [&](const std::string& line) {
        return bledOver(before, OneSun(optionsOf("soften=blur " + line)).mask(), none.bench.picture);
    };
    for (const char* const size : {"full", "half", "quarter"}) {
        const std::string line = std::string("soften.size=") + size;
        const double plain = bled(line + " soften.edges=plain");
        const double aware = bled(line);
        RecordProperty(std::string("bled_") + size, std::to_string(aware / plain));
        EXPECT_GT(plain, 20.0) << "there is nothing to bleed";
        EXPECT_LE(aware, 0.05 * plain) << size << ": " << aware << " of " << plain;
    }
    expectSilence(gpu());
}

VkDeviceSize bytesOf(const vulkan::ShadowRenderer& renderer, std::string_view purpose)
{
    for (const vulkan::MemoryUse& use : renderer.memory()) {
        if (purpose == use.purpose) {
            return use.bytes;
        }
    }
    return 0;
}

TEST(Soften, EightLightsShareTwoLayersAndTheImagesOfTheBlur)
{
    PlannedScene scene(gpu(), kScreen);
    const std::vector<Light> lights = sunsAndSpots(8);
    std::array<VkDeviceSize, 2> bytes{};
    for (const std::uint32_t count : {2U, 8U}) {
        Drawing drawing(gpu(), scene.mesh());
        Planner planner(optionsFrom("filter=pcf soften=blur map-size=64"));
        const Frame frame = scene.frameOf(std::span(lights).first(count));
        const Plan& plan = planner.plan(frame);
        (void)scene.draw(drawing, plan);
        EXPECT_EQ(plan.mask_layers, count == 8 ? 2U : 1U);
        EXPECT_EQ(drawing.renderer.mask().layers, plan.mask_layers);
        bytes[count == 8 ? 1 : 0] = bytesOf(drawing.renderer, "screen blur");
    }
    EXPECT_EQ(bytes[0], bytes[1]);
    EXPECT_GE(bytes[1], VkDeviceSize{4} * kScreen.width * kScreen.height) << "one image of one layer at full size";
    EXPECT_LT(bytes[1], VkDeviceSize{6} * kScreen.width * kScreen.height);
    expectSilence(gpu());
}

TEST(Soften, LightsOfOneLayerHaveEachTheirOwn)
{
    const std::array<ShadowOptions, 3> several{optionsOf("soften=none"), optionsOf("soften=blur"),
                                               optionsOf("soften=blur soften.kernel=box soften.size=half")};
    PlannedScene scene(gpu(), kScreen);
    std::vector<Light> lights = sunsAndSpots(4);
    for (std::uint32_t i = 0; i < 4; ++i) {
        lights[i].options = i % 3;
    }
    const auto drawn = [&](std::span<const ShadowOptions> options) {
        Drawing drawing(gpu(), scene.mesh());
        Planner planner(options);
        const Frame frame = scene.frameOf(lights);
        return scene.draw(drawing, planner.plan(frame));
    };
    const auto together = drawn(several);
    for (std::uint32_t one = 0; one < 3; ++one) { // all lights by one of them
        const std::array<ShadowOptions, 3> same{several[one], several[one], several[one]};
        const auto alone = drawn(same);
        ASSERT_EQ(alone.size(), together.size());
        std::size_t different = 0;
        for (std::size_t i = 0; i < alone.size(); ++i) {
            different += lights[i % 4].options == one && alone[i] != together[i] ? 1 : 0;
        }
        EXPECT_EQ(different, 0U) << one;
    }
    expectSilence(gpu());
}

TEST(Soften, FollowsEveryOtherPassOfTheMask)
{
    PlannedScene scene(gpu(), kScreen);
    const std::vector<Light> lights = sunsAndSpots(2);
    const std::array<ShadowOptions, 2> mixed{optionsFrom("filter=pcf soften=blur soften.size=half map-size=64"),
                                             optionsFrom("filter=pcf soften=converge map-size=64")};
    std::vector<Light> both = lights;
    both[1].options = 1;
    Drawing drawing(gpu(), scene.mesh());
    Planner planner(mixed);
    for (int i = 0; i < 3; ++i) {
        const Frame frame = scene.frameOf(both);
        (void)scene.draw(drawing, planner.plan(frame));
    }
    for (const char* const line :
         {"filter=pcf soften=blur motion=step-alternate map-size=64",
          "filter=pcf soften=blur translucent=colour map-size=64", "filter=raymarch soften=blur map-size=64",
          "filter=pcf soften=blur partition=multi map-size=64"}) {
        Drawing other(gpu(), scene.mesh());
        Planner one(optionsFrom(line));
        for (int i = 0; i < 2; ++i) {
            const Frame frame = scene.frameOf(lights);
            (void)scene.draw(other, one.plan(frame));
        }
        expectSilence(gpu());
    }
    expectSilence(gpu());
}

TEST(Soften, IsMadeAnewForAnotherSizeAndWithoutNormals)
{
    PlannedScene scene(gpu(), kScreen);
    const std::vector<Light> lights = sunsAndSpots(1);
    Drawing drawing(gpu(), scene.mesh());
    Planner planner(optionsOf("soften=blur soften.size=half"));
    const auto draw = [&] {
        const Frame frame = scene.frameOf(lights);
        return scene.draw(drawing, planner.plan(frame));
    };
    (void)draw();
    const VkDeviceSize before = bytesOf(drawing.renderer, "screen blur");
    scene.remakeViews({96, 60}, false, true);
    EXPECT_EQ(draw().size(), 96U * 60U);
    (void)draw();
    (void)draw(); // by now nothing of the other size is in flight
    EXPECT_LT(bytesOf(drawing.renderer, "screen blur"), before);
    expectSilence(gpu());
}

TEST(Soften, APlanThatWasNotPreparedIsRefused)
{
    OneSun sun(optionsOf("soften=none"));
    ShadowOptions blur = optionsOf("soften=blur");
    sun.bench.plan.options = planOptions(blur);
    EXPECT_THROW(sun.bench.record(1), Error);
}

} // namespace
} // namespace gnomon::test
