// SPDX-License-Identifier: Apache-2.0
// Hosts of other conventions: cameras whose depth is OpenGL's, and left-handed worlds and cameras.
#include "fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gnomon::test {
namespace {

constexpr VkExtent2D kScreen{160, 100};
constexpr std::uint32_t kSide = 512;
const std::vector<Tile> kTiles{{0, 0, 0, kSide, kSide}, {1, 0, 0, kSide, kSide}};

/// A bench with a sun and a spot.
struct Stage : Bench {
    explicit Stage(bool reversed_z = true) : Bench(kScreen, ShadowOptions{.technique = kPlainTechnique}, reversed_z)
    {
        setLights({makeSun({0.8, -0.9, -0.35}), makeSpot({-6.0, 9.0, 5.0}, {0.0, 0.0, 0.0}, 0.6)}, kTiles,
                  {kSide, kSide, 2});
    }
};

std::vector<std::byte> maskOf(Bench& bench, std::uint32_t light)
{
    bench.prepare();
    bench.record(1);
    return bench.readMask(light);
}

/// Pixels that differ by more than a step of 255.
std::size_t countOff(const std::vector<std::byte>& a, const std::vector<std::byte>& b)
{
    EXPECT_EQ(a.size(), b.size());
    std::size_t off = 0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
        off += std::abs(std::to_integer<int>(a[i]) - std::to_integer<int>(b[i])) > 1 ? 1 : 0;
    }
    return off;
}

std::size_t countShadowed(const std::vector<std::byte>& mask)
{
    return static_cast<std::size_t>(std::count(mask.begin(), mask.end(), std::byte{0}));
}

/// z from -w to w. The depth buffer is as it was: OpenGL's holds z / w * 0.5 + 0.5.
void giveOpenGlDepth(Camera& camera)
{
    for (int column = 0; column < 4; ++column) {
        glm::dvec4& c = camera.clip_from_world[column];
        c.z = 2.0 * c.z - c.w;
    }
}

TEST(Handedness, ofOpenGlsDepthIsOneFlag)
{
    for (const bool reversed_z : {false, true}) {
        for (std::uint32_t light = 0; light < 2; ++light) {
            Stage bench(reversed_z);
            bench.inputs.normal = light == 0 ? bench.inputs.normal : VK_NULL_HANDLE; // then they come from depth
            const auto plain = maskOf(bench, light);
            EXPECT_GT(countShadowed(plain), plain.size() / 50);
            giveOpenGlDepth(bench.camera);
            const auto unsaid = maskOf(bench, light);
            EXPECT_GT(countOff(plain, unsaid), plain.size() / 50) << "surfaces are taken to be elsewhere";
            bench.camera.clip_depth = ClipDepth::minus_one_to_one;
            EXPECT_LE(countOff(plain, maskOf(bench, light)), 2U);
        }
    }
    expectSilence(gpu());
}

/// All numbers of a left-handed world are those of its image in a mirror. Its masks are the same, but that light's maps
/// may lie otherwise over it, and so edges of shadows.
TEST(Handedness, aLeftHandedWorldHasTheMasksOfItsMirrorImage)
{
    const auto mirrored = [](glm::dvec3 v) {
        v.x = -v.x;
        return v;
    };
    for (const bool has_normals : {true, false}) {
        Stage bench;
        Bench left(kScreen, ShadowOptions{.technique = kPlainTechnique});
        for (Box& box : left.scene.boxes) {
            box.centre = mirrored(box.centre);
            box.angle = -box.angle;
        }
        const glm::dmat4 mirror(-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);
        left.camera.eye_ws = mirrored(left.camera.eye_ws);
        left.camera.clip_from_world = left.camera.clip_from_world * mirror;
        left.setLights(
            {makeSun(mirrored({0.8, -0.9, -0.35})), makeSpot(mirrored({-6.0, 9.0, 5.0}), {0.0, 0.0, 0.0}, 0.6)}, kTiles,
            {kSide, kSide, 2});
        if (!has_normals) {
            bench.inputs.normal = VK_NULL_HANDLE;
            left.inputs.normal = VK_NULL_HANDLE;
        }
        for (std::uint32_t light = 0; light < 2; ++light) {
            const auto mask = maskOf(bench, light);
            const auto seen = maskOf(left, light);
            EXPECT_GT(countShadowed(mask), mask.size() / 50);
            EXPECT_LE(countOff(mask, seen), mask.size() / 25) << light << has_normals;
        }
    }
    expectSilence(gpu());
}

} // namespace
} // namespace gnomon::test
