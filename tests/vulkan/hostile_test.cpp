// SPDX-License-Identifier: Apache-2.0
// Masks from maps that hold what no pass of ours writes: not numbers, infinities, negative and huge values, denormals,
// any bits. Nothing may go wrong on the device, pixels that no map decides stay as they are, and what one tile holds
// is nothing to another.
#include "cpu_map.h"
#include "fixture.h"
#include "moment_numbers.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <random>

namespace gnomon::test {
namespace {

constexpr VkExtent2D kScreen{160, 100};

struct HostileCase {
    const char* name;
    Filter filter;
    MapFormat format;
    bool logarithmic = false;
};

std::ostream& operator<<(std::ostream& out, const HostileCase& c)
{
    return out << c.name;
}

// A sun and a spot in one layer, drawn once without casters.
class HostileMaps : public testing::TestWithParam<HostileCase> {
protected:
    void make(MapSampling sampling)
    {
        options_.technique.filter = GetParam().filter;
        options_.format = GetParam().format;
        options_.moments.log_space = GetParam().logarithmic;
        options_.moments.sampling = sampling;
        options_.moments.layers = 3;
        options_.moments.samples = 1;
        lights_ = {makeSun({0.8, -0.9, -0.35}), makeSpot({-6.0, 9.0, 5.0}, {0.0, 0.0, 0.0}, 0.6)};
        const Tile tiles[] = {{0, 0, 0, 128, 128}, {0, 128, 0, 128, 128}};
        plan_ = makePlan(scene_, lights_, tiles, {256, 128, 1}, options_);
        plan_.made_for.camera = makeCamera({9.0, 6.0, 11.0}, {0.0, 0.5, 0.0}, double(kScreen.width) / kScreen.height);
        picture_ = tracePicture(scene_, plan_.made_for.camera, kScreen);
        inputs_ = uploadPicture(gpu(), picture_);
        renderer_ = std::make_unique<vulkan::ShadowRenderer>(gpu().view(),
                                                             vulkan::ShadowRendererOptions{.frames_in_flight = 1});
        (void)renderer_->prepare(plan_, kScreen);
        gpu().run([&](VkCommandBuffer commands) {
            renderer_->recordMaps(commands, 0, plan_, [](const vulkan::MapPass&) {});
        });
    }
    std::vector<std::byte> drawMask(std::uint32_t light)
    {
        gpu().run([&](VkCommandBuffer commands) { renderer_->recordMask(commands, 0, plan_, inputs_); });
        return readMaskChannel(gpu(), renderer_->mask(), plan_.lights[light]);
    }
    // Every texel of one view's tile, in every level that it has and every layer of the image.
    template <class Fill>
    void fillTile(std::uint32_t view, Fill fill)
    {
        const vulkan::ImageRef maps = renderer_->maps();
        const std::uint32_t bytes = texelBytes(maps.format);
        const Tile& tile = plan_.views[view].place.tile;
        const std::uint32_t levels = levelsOf(options_, plan_.pages[0]);
        for (std::uint32_t layer = 0; layer < maps.layers; ++layer) {
            for (std::uint32_t level = 0; level < levels; ++level) {
                std::vector<std::byte> texels = gpu().read(maps, layer, bytes, VK_IMAGE_ASPECT_COLOR_BIT, level);
                const std::uint32_t width = maps.extent.width >> level;
                for (std::uint32_t y = tile.y >> level; y < (tile.y + tile.height) >> level; ++y) {
                    for (std::uint32_t x = tile.x >> level; x < (tile.x + tile.width) >> level; ++x) {
                        fill(std::span(&texels[(std::size_t{y} * width + x) * bytes], bytes));
                    }
                }
                gpu().write(maps, layer, level, texels);
            }
        }
    }
    [[nodiscard]] bool isHalf() const
    {
        const MapFormat f = formatOf(options_);
        return f == MapFormat::r16f || f == MapFormat::rg16f || f == MapFormat::rgba16f;
    }
    [[nodiscard]] bool isUnorm() const
    {
        return options_.format == MapFormat::rg16 || options_.format == MapFormat::rgba16;
    }
    // One number in every channel of a texel, in its format.
    void fillWith(std::uint32_t view, float value)
    {
        fillTile(view, [&](std::span<std::byte> texel) {
            const float shown = std::isnan(value) ? 0.0F : std::clamp(value, 0.0F, 1.0F);
            const std::uint16_t small = isUnorm() ? static_cast<std::uint16_t>(shown * 65535.0F) : halfOf(value);
            for (std::size_t i = 0; i < texel.size(); i += isHalf() || isUnorm() ? 2 : 4) {
                if (isHalf() || isUnorm()) {
                    std::memcpy(&texel[i], &small, 2);
                } else {
                    std::memcpy(&texel[i], &value, 4);
                }
            }
        });
    }
    static std::uint16_t halfOf(float value)
    {
        if (std::isnan(value)) {
            return 0x7E00;
        }
        const std::uint16_t sign = std::signbit(value) ? 0x8000 : 0;
        const float size = std::abs(value);
        if (size > 65504.0F) {
            return sign | (std::isinf(size) ? 0x7C00 : 0x7BFF);
        }
        return static_cast<std::uint16_t>(sign | (size < 6e-5F && size > 0.0F ? 1 : size == 1.0F ? 0x3C00 : 0));
    }
    // Pixels that no map decides: the background is lit, and a surface that faces away from the light is dark.
    void expectUndecidedUnchanged(const std::vector<std::byte>& mask, std::uint32_t light, const std::string& what)
    {
        std::size_t away = 0;
        for (std::size_t i = 0; i < mask.size(); ++i) {
            const glm::dvec3 n = picture_.normal[i];
            const Light& l = lights_[light];
            const glm::dvec3 to_light = l.type == LightType::directional
                                            ? -l.direction_ws
                                            : glm::normalize(l.position_ws - picture_.position[i]);
            if (n == glm::dvec3(0.0)) {
                ASSERT_EQ(std::to_integer<int>(mask[i]), 255) << what << ", pixel " << i;
            } else if (glm::dot(n, to_light) < -0.01) {
                ASSERT_EQ(std::to_integer<int>(mask[i]), 0) << what << ", pixel " << i;
                ++away;
            }
        }
        EXPECT_GT(away, 50U);
    }

    Scene scene_ = makeScene();
    ShadowOptions options_{.technique = kPlainTechnique};
    std::vector<Light> lights_;
    Plan plan_;
    Picture picture_;
    vulkan::MaskInputs inputs_;
    std::unique_ptr<vulkan::ShadowRenderer> renderer_;
};

TEST_P(HostileMaps, spoilNothingElse)
{
    std::mt19937 rng(3);
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    for (const MapSampling sampling : {MapSampling::trilinear, MapSampling::anisotropic}) {
        make(sampling);
        const std::vector<std::byte> spot = drawMask(1);
        const auto check = [&](const std::string& what) {
            expectUndecidedUnchanged(drawMask(0), 0, what);
            EXPECT_EQ(drawMask(1), spot) << "the spot's own tile is as it was: " << what;
        };
        for (const float value : {std::numeric_limits<float>::quiet_NaN(), kInfinity, -kInfinity, 3.4e38F, -3.4e38F,
                                  -1.0F, 0.0F, 1.0F, 1e-40F}) {
            fillWith(0, value);
            check(std::to_string(value));
        }
        fillTile(0, [&](std::span<std::byte> texel) {
            for (std::byte& b : texel) {
                b = static_cast<std::byte>(rng());
            }
        });
        check("any bits");
    }
    expectSilence(gpu());
}

INSTANTIATE_TEST_SUITE_P(Filters, HostileMaps,
                         testing::Values(HostileCase{"vsm_rg32f", Filter::vsm, MapFormat::rg32f},
                                         HostileCase{"vsm_rg16", Filter::vsm, MapFormat::rg16},
                                         HostileCase{"vsm_rg16f", Filter::vsm, MapFormat::rg16f},
                                         HostileCase{"lvsm_rgba16", Filter::lvsm, MapFormat::rgba16},
                                         HostileCase{"lvsm_rgba16f", Filter::lvsm, MapFormat::rgba16f},
                                         HostileCase{"lvsm_rgba32f", Filter::lvsm, MapFormat::rgba32f},
                                         HostileCase{"esm_r32f", Filter::esm, MapFormat::r32f},
                                         HostileCase{"esm_r16f", Filter::esm, MapFormat::r16f},
                                         HostileCase{"esm_r16f_logarithmic", Filter::esm, MapFormat::r16f, true},
                                         HostileCase{"evsm_rgba32f", Filter::evsm, MapFormat::rgba32f},
                                         HostileCase{"evsm_rgba16f", Filter::evsm, MapFormat::rgba16f},
                                         HostileCase{"evsm_rg32f", Filter::evsm, MapFormat::rg32f},
                                         HostileCase{"evsm_rg16f", Filter::evsm, MapFormat::rg16f},
                                         HostileCase{"evsm_rgba32f_logarithmic", Filter::evsm, MapFormat::rgba32f,
                                                     true},
                                         HostileCase{"msm_rgba16", Filter::msm, MapFormat::rgba16},
                                         HostileCase{"msm_rgba32f", Filter::msm, MapFormat::rgba32f}),
                         [](const auto& test_case) { return std::string(test_case.param.name); });

} // namespace
} // namespace gnomon::test
