// SPDX-License-Identifier: Apache-2.0
// Alpha-masked surfaces let light and sight through exactly where their texture says.
#include "support.h"

#include "alpha.h"
#include "scene_geometry.h"
#include "shadow_rays.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace gnomon::truth::test {
namespace {

/// 4 by 2 texels, no two rows or columns alike: 255 is solid.
scene::Image pattern()
{
    scene::Image image{.name = "pattern", .width = 4, .height = 2};
    for (const std::uint8_t alpha : std::initializer_list<std::uint8_t>{255, 0, 0, 255, 0, 255, 0, 0}) {
        image.rgba.insert(image.rgba.end(), {255, 255, 255, alpha});
    }
    return image;
}

/// A masked leaf [-1, 1] x [-1, 1] at height 1 over the ground, facing down; uv as `ceiling` has it: u along x, v along
/// z.
scene::Scene leaf(const scene::Texture& texture, const scene::TextureUse& use)
{
    scene::Scene scene;
    scene.images.push_back(pattern());
    scene.textures.push_back(texture);
    scene::Material material;
    material.alpha_mode = scene::AlphaMode::mask;
    material.base_colour_texture = use;
    scene.materials.push_back(material);
    place(scene, addQuad(scene, level(0.0F, 8.0F)));
    scene::Node& node = place(scene, addQuad(scene, ceiling(1.0F, -1.0F, 1.0F, 1.0F), 0));
    // A second one beside it, so that the mesh can be instanced.
    node.instances = {glm::mat4(1.0F), glm::translate(glm::mat4(1.0F), glm::vec3(6.0F, 0.0F, 0.0F))};
    return scene;
}

int wrapped(int i, int n, scene::Wrap wrap)
{
    if (wrap == scene::Wrap::clamp_to_edge) {
        return std::min(std::max(i, 0), n - 1);
    }
    const int period = wrap == scene::Wrap::repeat ? n : 2 * n;
    const int k = ((i % period) + period) % period;
    return k < n ? k : 2 * n - 1 - k;
}

/// Alpha at texture coordinates in double precision; `margin` is how far the nearest change of texel is (nearest).
double alphaAt(const scene::Texture& texture, double u, double v, double& margin)
{
    const double x = u * 4.0;
    const double y = v * 2.0;
    static const scene::Image image = pattern();
    const auto texel = [&](int i, int j) {
        return image.rgba[(wrapped(j, 2, texture.wrap_v) * 4 + wrapped(i, 4, texture.wrap_u)) * 4 + 3] / 255.0;
    };
    if (!texture.magnify_linear) {
        margin = std::min(std::abs(x - std::round(x)), std::abs(y - std::round(y)));
        return texel(static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y)));
    }
    const int i = static_cast<int>(std::floor(x - 0.5));
    const int j = static_cast<int>(std::floor(y - 0.5));
    const double a = x - 0.5 - i;
    const double b = y - 0.5 - j;
    const double alpha = (texel(i, j) * (1.0 - a) + texel(i + 1, j) * a) * (1.0 - b) +
                         (texel(i, j + 1) * (1.0 - a) + texel(i + 1, j + 1) * a) * b;
    margin = std::abs(alpha - 0.5);
    return alpha;
}

struct Sampling {
    scene::Texture texture;
    scene::TextureUse use;
};

/// Alpha of the leaf above (x, z), which is on it.
double leafAlpha(const Sampling& sampling, double x, double z, double& margin)
{
    const auto& [texture, use] = sampling;
    const double c = std::cos(double{use.rotation_rad});
    const double s = std::sin(double{use.rotation_rad});
    const double u = (x + 1.0) / 2.0 * use.scale.x;
    const double v = (z + 1.0) / 2.0 * use.scale.y;
    // Counter-clockwise as seen with v down: u towards -v.
    return alphaAt(texture, c * u + s * v + use.offset.x, -s * u + c * v + use.offset.y, margin);
}

/// Visibility of the ground below the leaf, whose triangles are instanced or copied.
class LeafShadow {
public:
    LeafShadow(const Sampling& sampling, bool instanced, const Light& light, const Options& options)
        : scene_(finished(leaf(sampling.texture, sampling.use))), state_(scene::evaluate(scene_, 0.0)),
          geometry_(scene_, state_, instanced ? 0 : 1000), rays_(geometry_, light, options)
    {
        EXPECT_EQ(geometry_.part(1).instanced, instanced);
    }
    [[nodiscard]] double at(double x, double z, std::uint64_t pixel) const
    {
        Receiver receiver{.pixel = pixel};
        receiver.rel = glm::dvec3(x, 1e-5, z) - geometry_.originWs();
        return rays_.trace(receiver).visibility;
    }

private:
    static scene::Scene finished(scene::Scene scene)
    {
        scene::finishScene(scene);
        return scene;
    }
    scene::Scene scene_;
    scene::State state_;
    SceneGeometry geometry_;
    ShadowRays rays_;
};

/// A texture; area or hard; instanced or copied.
class MaskedLeaf : public ::testing::TestWithParam<std::tuple<Sampling, bool, bool>> {};

TEST_P(MaskedLeaf, shadow_is_the_texture)
{
    const auto& [sampling, with_area, instanced] = GetParam();
    // So small a sun blurs by a twentieth of a millimetre.
    const LeafShadow shadow(sampling, instanced, sun({0.0, -1.0, 0.0}, 1e-4), with_area ? area(64) : hard());
    std::uint32_t solid = 0;
    std::uint32_t open = 0;
    for (std::uint32_t y = 0; y < 100; ++y) {
        for (std::uint32_t x = 0; x < 100; ++x) {
            const double px = (x + 0.5) / 50.0 - 1.0;
            const double pz = (y + 0.5) / 50.0 - 1.0;
            double margin = 0.0;
            const double alpha = leafAlpha(sampling, px, pz, margin);
            if (margin < (with_area ? 2e-3 : 1e-4)) {
                continue;
            }
            ASSERT_EQ(shadow.at(px, pz, y * 100 + x), alpha >= 0.5 ? 0.0 : 1.0) << px << ' ' << pz << ' ' << alpha;
            ++(alpha >= 0.5 ? solid : open);
        }
    }
    EXPECT_GT(solid, 800U);
    EXPECT_GT(open, 800U);
}

TEST_P(MaskedLeaf, soft_shadow_is_the_mean_of_the_texture)
{
    const auto& [sampling, with_area, instanced] = GetParam();
    const double tangent = with_area ? 0.1 : 0.0;
    const LeafShadow shadow(sampling, instanced, sun({0.0, -1.0, 0.0}, 2.0 * std::atan(tangent)), area(1024));
    double of_texture = 0.0;
    double of_rays = 0.0;
    double worst = 0.0;
    for (std::uint32_t y = 0; y < 9; ++y) {
        for (std::uint32_t x = 0; x < 9; ++x) {
            const double px = (x + 0.5) / 5.0 - 0.87;
            const double pz = (y + 0.5) / 5.0 - 0.89;
            double open = 0.0;
            for (int i = 0; i < 2000; ++i) {
                const double rho = tangent * std::sqrt((i + 0.5) / 2000.0);
                const double turn = 2.0 * std::numbers::pi * std::numbers::phi * i;
                double margin = 0.0;
                const double ax = px + rho * std::cos(turn);
                const double az = pz + rho * std::sin(turn);
                const bool beside = std::max(std::abs(ax), std::abs(az)) > 1.0;
                open += beside || leafAlpha(sampling, ax, az, margin) < 0.5 ? 1.0 / 2000.0 : 0.0;
            }
            const double traced = shadow.at(px, pz, y * 9 + x);
            worst = std::max(worst, std::abs(traced - open));
            of_texture += open / 81.0;
            of_rays += traced / 81.0;
        }
    }
    EXPECT_LT(worst, 0.03);
    EXPECT_NEAR(of_rays, of_texture, 0.003);
    EXPECT_GT(of_texture, 0.1);
    EXPECT_LT(of_texture, 0.9);
}

using scene::Wrap;
INSTANTIATE_TEST_SUITE_P(
    samplings, MaskedLeaf,
    ::testing::Combine(
        ::testing::Values(
            Sampling{{0, Wrap::repeat, Wrap::repeat, false}, {0}}, Sampling{{0, Wrap::repeat, Wrap::repeat, true}, {0}},
            Sampling{{0, Wrap::repeat, Wrap::repeat, false}, {0, 0, {0.3F, -7.1F}, {2.5F, 3.0F}, 0.0F}},
            Sampling{{0, Wrap::mirrored_repeat, Wrap::repeat, false}, {0, 0, {-1.3F, 0.1F}, {3.0F, 2.0F}, 0.0F}},
            Sampling{{0, Wrap::mirrored_repeat, Wrap::mirrored_repeat, true},
                     {0, 0, {-1.3F, 0.1F}, {3.0F, 3.0F}, 0.0F}},
            Sampling{{0, Wrap::clamp_to_edge, Wrap::repeat, true}, {0, 0, {-0.4F, 0.1F}, {1.7F, 2.0F}, 0.0F}},
            Sampling{{0, Wrap::repeat, Wrap::clamp_to_edge, false}, {0, 0, {0.0F, -0.6F}, {2.0F, 2.0F}, 0.0F}},
            Sampling{{0, Wrap::repeat, Wrap::mirrored_repeat, false}, {0, 0, {0.2F, 0.1F}, {2.0F, 1.5F}, 0.6F}},
            Sampling{{0, Wrap::repeat, Wrap::repeat, true}, {0, 0, {0.2F, 0.1F}, {2.0F, 1.5F}, -2.2F}}),
        ::testing::Bool(), ::testing::Bool()));

TEST(MaskedQuad, factor_texture_and_vertex_colour_multiply_and_the_cutoff_is_solid)
{
    const auto visibility = [](float factor, float of_vertices, float cutoff) {
        scene::Scene scene = leaf({0, Wrap::repeat, Wrap::repeat, false}, {});
        scene.materials[0].base_colour.a = factor;
        scene.materials[0].alpha_cutoff = cutoff;
        scene.meshes[1].primitives[0].colours.assign(4, glm::vec4(1.0F, 1.0F, 1.0F, of_vertices));
        return trace(scene, lookDown(0.0, 0.5, 0.2, {4, 4}), sun({0.0, -1.0, 0.0}), hard()).at(1, 1);
    };
    EXPECT_EQ(visibility(0.5F, 1.0F, 0.5F), 0.0);
    EXPECT_EQ(visibility(0.49F, 1.0F, 0.5F), 1.0);
    EXPECT_EQ(visibility(0.75F, 0.75F, 0.5F), 0.0);
    EXPECT_EQ(visibility(0.75F, 0.5F, 0.5F), 1.0);
    EXPECT_EQ(visibility(0.1F, 0.1F, 0.0F), 0.0);
    EXPECT_EQ(visibility(1.0F, 1.0F, 1.5F), 1.0);
}

TEST(MaskedQuad, camera_looks_through_its_holes)
{
    scene::Scene scene = leaf({0, Wrap::repeat, Wrap::repeat, false}, {0});
    scene.materials[0].double_sided = true;
    // From above the leaf: 4 by 2 texels over the picture, v downwards along +z.
    const Traced traced = trace(scene, lookDown(0.0, 2.0, 1.6, {160, 160}), sun({0.0, -1.0, 0.0}), hard());
    for (std::uint32_t j = 0; j < 2; ++j) {
        for (std::uint32_t i = 0; i < 4; ++i) {
            // The leaf is half as far away as the ground, so it is 200 px wide and reaches past the picture's rim.
            const double u = (-1.0 + (i + 0.5) * 0.5) / 0.8;
            const double v = (-1.0 + (j + 0.5)) / 0.8;
            if (std::abs(u) >= 1.0 || std::abs(v) >= 1.0) {
                continue;
            }
            const auto x = static_cast<std::uint32_t>((u + 1.0) * 80.0);
            const auto y = static_cast<std::uint32_t>((v + 1.0) * 80.0);
            const bool solid = pattern().rgba[(j * 4 + i) * 4 + 3] != 0;
            EXPECT_EQ(traced.id(x, y), solid ? 2U : 1U) << i << ' ' << j;
        }
    }
}

TEST(SampleAlpha, coordinates_that_are_no_numbers_or_huge_do_no_harm)
{
    const scene::Image image = pattern();
    for (const Wrap wrap : {Wrap::repeat, Wrap::mirrored_repeat, Wrap::clamp_to_edge}) {
        for (const bool linear : {false, true}) {
            for (const float u : {NAN, INFINITY, -INFINITY, 3e38F, -3e38F, -1e-30F, 1.0F, 2.0F, -1.0F}) {
                for (const float v : {NAN, 3e38F, -1e-30F, 1.0F}) {
                    const float alpha = sampleAlpha(image, {0, wrap, wrap, linear}, {u, v});
                    EXPECT_TRUE(alpha >= 0.0F && alpha <= 1.0F) << u << ' ' << v;
                }
            }
        }
    }
}

/// Wherever on its triangle: weights and texels are off by their last bits.
TEST(AlphaAtTheCutoff, IsSolid)
{
    scene::Scene scene;
    scene.images.push_back({.name = "even", .width = 2, .height = 2});
    scene.textures.push_back({.image = 0});
    scene.materials.resize(1);
    scene::Primitive primitive;
    primitive.positions.assign(3, glm::vec3(0.0F));
    primitive.indices = {0, 1, 2};
    primitive.uv0 = {{0.1F, 0.2F}, {5.3F, 0.7F}, {0.4F, 6.1F}};
    for (int byte = 1; byte < 256; ++byte) {
        const auto texel = static_cast<std::uint8_t>(byte);
        scene.images[0].rgba.assign(16, texel);
        const float alpha = static_cast<float>(byte) / 255.0F;
        for (const bool by_texture : {false, true}) {
            scene::Material& material = scene.materials[0];
            material.base_colour_texture.texture = by_texture ? 0 : scene::kNone;
            primitive.colours.assign(3, glm::vec4(by_texture ? 1.0F : alpha));
            material.alpha_cutoff = alpha;
            const AlphaTest at(scene, primitive, material);
            material.alpha_cutoff = alpha + 0.0001F;
            const AlphaTest below(scene, primitive, material);
            for (int i = 0; i < 64; ++i) {
                const float u = static_cast<float>(i) / 97.0F;
                const float v = (1.0F - u) * static_cast<float>((i * 29) % 64) / 67.0F;
                ASSERT_TRUE(at.isSolid(0, u, v)) << byte << ' ' << by_texture << ' ' << u << ' ' << v;
                ASSERT_FALSE(below.isSolid(0, u, v)) << byte << ' ' << by_texture << ' ' << u << ' ' << v;
            }
        }
    }
}

} // namespace
} // namespace gnomon::truth::test
