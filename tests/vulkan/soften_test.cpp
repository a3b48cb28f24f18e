// SPDX-License-Identifier: Apache-2.0
// soften=blur on a device under the validation layer: against the same blur of the same mask on the CPU, over
// silhouettes, and with lights of other options beside.
#define GNOMON_REAL double
#include "fixture.h"
#include "option_steps.h"
#include "planned_scene.h"

#include <gnomon/error.h>

#include <discs.h>
#include <screen_blur.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace gnomon::test {
namespace {

constexpr VkExtent2D kScreen{160, 101}; // no multiple of 2 or 4
constexpr int kWidth = static_cast<int>(kScreen.width);
constexpr int kHeight = static_cast<int>(kScreen.height);

/// Values between 0 and 1 that are stored in eight bits.
struct Plane {
    int width = 0;
    int height = 0;
    std::vector<double> values;

    Plane(int width_in, int height_in)
        : width(width_in), height(height_in), values(static_cast<std::size_t>(width_in * height_in))
    {
    }
    [[nodiscard]] double& at(int x, int y)
    {
        return values[static_cast<std::size_t>(std::clamp(y, 0, height - 1) * width + std::clamp(x, 0, width - 1))];
    }
    [[nodiscard]] double at(int x, int y) const { return const_cast<Plane*>(this)->at(x, y); }
    /// As a sampler reads it.
    [[nodiscard]] double between(double x, double y) const
    {
        const double u = std::clamp(x, 0.5, width - 0.5) - 0.5;
        const double v = std::clamp(y, 0.5, height - 0.5) - 0.5;
        const int i = static_cast<int>(u);
        const int j = static_cast<int>(v);
        return glm::mix(glm::mix(at(i, j), at(i + 1, j), u - i), glm::mix(at(i, j + 1), at(i + 1, j + 1), u - i),
                        v - j);
    }
    void store(int x, int y, double value) { at(x, y) = std::round(std::clamp(value, 0.0, 1.0) * 255.0) / 255.0; }
};

/// The pass on the CPU.
class Reference {
public:
    Reference(const Picture& picture, const Camera& camera, const ScreenBlurOptions& blur)
        : picture_(picture), camera_(camera), blur_(blur), scale_(static_cast<int>(pixelsPerTexel(blur.size))),
          aware_(blur.edges == ScreenEdges::aware)
    {
    }

    [[nodiscard]] Plane of(const Plane& mask) const
    {
        const bool twice = blur_.kernel != ScreenKernel::poisson && blur_.passes == 2;
        Plane made = pass(mask, 1, {1.0, 0.0});
        if (twice) {
            made = pass(made, scale_, {0.0, 1.0});
        }
        return spread(made, mask);
    }

private:
    [[nodiscard]] std::size_t indexOf(glm::ivec2 pixel) const
    {
        return static_cast<std::size_t>(pixel.y * kWidth + pixel.x);
    }
    [[nodiscard]] bool isBackground(glm::ivec2 pixel) const { return picture_.object_plus_one[indexOf(pixel)] == 0; }
    [[nodiscard]] glm::ivec2 pixelOf(glm::ivec2 texel) const
    {
        return {std::min(shared::pixelOfTexel(texel.x, scale_), kWidth - 1),
                std::min(shared::pixelOfTexel(texel.y, scale_), kHeight - 1)};
    }
    [[nodiscard]] double shareOf(glm::ivec2 from, glm::ivec2 to) const
    {
        if (isBackground(to)) {
            return 0.0;
        }
        const glm::dvec3 n = picture_.normal[indexOf(from)];
        const glm::dvec3 p = picture_.position[indexOf(from)];
        const glm::dmat4 world_from_ndc = glm::inverse(camera_.clip_from_world);
        const double w = (camera_.clip_from_world * glm::dvec4(p, 1.0)).w;
        const double pixel_m = glm::length(glm::dvec3(world_from_ndc[0])) * (2.0 / kWidth) * w;
        const double off = std::abs(glm::dot(n, picture_.position[indexOf(to)] - p)) / pixel_m;
        return shared::screenDepthShare(off) * shared::screenNormalShare(glm::dot(n, picture_.normal[indexOf(to)]));
    }
    [[nodiscard]] glm::dvec3 tap(int i, glm::dvec2 direction, glm::dvec2 texel) const
    {
        const double strength = static_cast<double>(blur_.strength_px);
        if (blur_.kernel == ScreenKernel::poisson) {
            const double angle = shared::interleavedGradientNoise(shared::real2(texel + 0.5)) * 6.2831853;
            const glm::dvec2 at = glm::dvec2(shared::kPoissonPoints[i]) * shared::kScreenDiscRadius * strength;
            return {at.x * std::cos(angle) - at.y * std::sin(angle), at.x * std::sin(angle) + at.y * std::cos(angle),
                    1.0};
        }
        if (blur_.taps == ScreenTaps::published) {
            return {direction * shared::publishedPlace(i) * strength, shared::publishedWeight(i)};
        }
        const int from_middle = i - shared::screenTapsAside(scale_);
        return {direction * shared::screenTapPlace(from_middle, scale_) * strength,
                shared::screenTapWeight(static_cast<int>(blur_.kernel), from_middle, scale_)};
    }
    [[nodiscard]] int tapCount() const
    {
        if (blur_.kernel == ScreenKernel::poisson) {
            return static_cast<int>(blur_.points);
        }
        return blur_.taps == ScreenTaps::published ? shared::kPublishedTaps : 2 * shared::screenTapsAside(scale_) + 1;
    }
    [[nodiscard]] double texelOf(const Plane& source, int source_scale, glm::ivec2 texel, glm::dvec2 direction) const
    {
        const glm::dvec2 middle = (glm::dvec2(texel) + 0.5) * double(scale_) / double(source_scale);
        const glm::ivec2 pixel = pixelOf(texel);
        const glm::ivec2 own = source_scale == 1 ? pixel : texel;
        if (aware_ && isBackground(pixel)) {
            return source.at(own.x, own.y);
        }
        double sum = 0.0;
        double weights = 0.0;
        for (int i = 0; i < tapCount(); ++i) {
            const glm::dvec3 t = tap(i, direction, texel);
            const glm::dvec2 off = glm::dvec2(t) / double(source_scale);
            if (aware_) {
                const glm::ivec2 there =
                    glm::clamp(own + glm::ivec2(glm::dvec2(shared::nearestPixel(off.x), shared::nearestPixel(off.y))),
                               glm::ivec2(0), glm::ivec2(source.width, source.height) - 1);
                const double weight = t.z * shareOf(pixel, source_scale == 1 ? there : pixelOf(there));
                sum += weight * source.at(there.x, there.y);
                weights += weight;
            } else {
                sum += t.z * source.between(middle.x + off.x, middle.y + off.y);
                weights += t.z;
            }
        }
        const bool published = blur_.taps == ScreenTaps::published;
        return published ? sum : weights > 1e-3 ? sum / weights : source.at(own.x, own.y);
    }
    [[nodiscard]] Plane pass(const Plane& source, int source_scale, glm::dvec2 direction) const
    {
        Plane out((kWidth + scale_ - 1) / scale_, (kHeight + scale_ - 1) / scale_);
        for (int y = 0; y < out.height; ++y) {
            for (int x = 0; x < out.width; ++x) {
                out.store(x, y, texelOf(source, source_scale, {x, y}, direction));
            }
        }
        return out;
    }
    [[nodiscard]] double spreadTo(glm::ivec2 pixel, const Plane& from, double before) const
    {
        if (!aware_) {
            return from.between((pixel.x + 0.5) / scale_, (pixel.y + 0.5) / scale_);
        }
        if (isBackground(pixel)) {
            return before;
        }
        const glm::dvec2 place = (glm::dvec2(pixel) - double(scale_ / 2)) / double(scale_);
        const glm::dvec2 part = place - glm::floor(place);
        double sum = 0.0;
        double weights = 0.0;
        for (int i = 0; i < 4; ++i) {
            const glm::ivec2 corner(i & 1, i >> 1);
            const glm::ivec2 texel = glm::clamp(glm::ivec2(glm::floor(place)) + corner, glm::ivec2(0),
                                                glm::ivec2(from.width, from.height) - 1);
            const glm::dvec2 near = glm::mix(1.0 - part, part, glm::dvec2(corner));
            const double weight = near.x * near.y * shareOf(pixel, pixelOf(texel));
            sum += weight * from.at(texel.x, texel.y);
            weights += weight;
        }
        return weights > 0.01 ? sum / weights : before;
    }
    [[nodiscard]] Plane spread(const Plane& from, const Plane& mask) const
    {
        Plane out = mask;
        for (int y = 0; y < kHeight && scale_ > 1; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                out.store(x, y, spreadTo({x, y}, from, mask.at(x, y)));
            }
        }
        return scale_ > 1 ? out : from;
    }

    const Picture& picture_;
    const Camera& camera_;
    ScreenBlurOptions blur_;
    int scale_;
    bool aware_;
};

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
        Reference(plain.bench.picture, plain.bench.frame.camera, options.screen_blur).of(plain.mask());
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

/// What reaches pixels from other surfaces: those whose own surface has one value as far as the blur reaches.
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
        (void)scene.draw(drawing, frame, plan);
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
        return scene.draw(drawing, frame, planner.plan(frame));
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
        (void)scene.draw(drawing, frame, planner.plan(frame));
    }
    for (const char* const line :
         {"filter=pcf soften=blur motion=step-alternate map-size=64",
          "filter=pcf soften=blur translucent=colour map-size=64", "filter=raymarch soften=blur map-size=64",
          "filter=pcf soften=blur partition=multi map-size=64"}) {
        Drawing other(gpu(), scene.mesh());
        Planner one(optionsFrom(line));
        for (int i = 0; i < 2; ++i) {
            const Frame frame = scene.frameOf(lights);
            (void)scene.draw(other, frame, one.plan(frame));
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
        return scene.draw(drawing, frame, planner.plan(frame));
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
