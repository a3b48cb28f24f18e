// SPDX-License-Identifier: Apache-2.0
// The colours of vertices count where casters are masked or blended: alpha is texture x vertex, of every kind of map.
#include "fixture.h"
#include "misuser.h"

#include <glm/gtc/packing.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <string>

namespace gnomon::test {
namespace {

using vulkan::CasterDrawerOptions;

constexpr VkExtent2D kScreen{48, 32};

struct ColourCase {
    const char* name;
    VkFormat format;
    std::uint32_t bytes;
    void (*put)(std::byte* to, const glm::vec4& colour);
};

template <class T>
void putBytes(std::byte* to, const T& value)
{
    std::memcpy(to, &value, sizeof value);
}

const std::array<ColourCase, 4> kFormats{
    {{"unorm8", VK_FORMAT_R8G8B8A8_UNORM, 4,
      [](std::byte* to, const glm::vec4& c) {
          putBytes(to, glm::packUnorm4x8(c));
      }},
     {"unorm16", VK_FORMAT_R16G16B16A16_UNORM, 8,
      [](std::byte* to, const glm::vec4& c) {
          putBytes(to, glm::packUnorm4x16(c));
      }},
     {"half", VK_FORMAT_R16G16B16A16_SFLOAT, 8,
      [](std::byte* to, const glm::vec4& c) {
          putBytes(to, glm::packHalf4x16(c));
      }},
     {"float", VK_FORMAT_R32G32B32A32_SFLOAT, 16, [](std::byte* to, const glm::vec4& c) {
          putBytes(to, c);
      }}}};

/// Boxes with an opaque white texture and these vertex colours, one for all; and the map's texels that are not empty.
class VertexColours : public testing::TestWithParam<ColourCase> {
protected:
    [[nodiscard]] static std::vector<std::vector<float>> mapsWith(const ShadowOptions& options, float alpha,
                                                                  bool counts)
    {
        const ColourCase& format = GetParam();
        Bench bench(kScreen, options);
        bench.setLights({makeSun({0.8, -0.9, -0.35}), makeSpot({-6.0, 9.0, 5.0}, {0.0, 0.0, 0.0}, 0.6)},
                        {{0, 0, 0, 128, 128}, {1, 0, 0, 128, 128}}, {128, 128, 2});
        bench.maskBoxes();
        bench.mesh.batches[1].uv_scale = {0.0F, 1.0F}; // the solid half of the texture
        bench.mesh.batches[1].uv_offset = {0.75F, 0.0F};
        bench.mesh.batches[1].vertex_colours = counts;
        const std::uint32_t stride = format.bytes + 4; // no format's own, so that stride and offset count
        const TestBuffer colours =
            gpu().makeBuffer(std::size_t{bench.mesh.vertex_count} * stride, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
        for (std::uint32_t i = 0; i < bench.mesh.vertex_count; ++i) {
            format.put(static_cast<std::byte*>(colours.mapped) + std::size_t{i} * stride + 4,
                       {1.0F, 0.5F, 0.25F, alpha});
        }
        bench.mesh.geometry.colours = colours.buffer;
        CasterDrawerOptions with;
        with.vertices.colour = {format.format, stride, 4};
        CasterDrawer drawer(gpu().view(), with);
        drawer.setScene(bench.mesh.parts, bench.mesh.objects, bench.mesh.batches);
        (void)bench.renderer.prepare(bench.plan, kScreen);
        const std::vector<vulkan::Rows3x4> transforms = bench.scene.transforms();
        gpu().run([&](VkCommandBuffer commands) {
            drawer.beginFrame(0, bench.plan, bench.mesh.geometry, transforms);
            bench.renderer.recordMaps(commands, 0, bench.plan, [&](const vulkan::MapPass& pass) { drawer.draw(pass); });
        });
        return {bench.readMap(0), bench.readMap(1)};
    }
};

/// For the sun and for the spot light, whose maps need shaders of their own.
TEST_P(VertexColours, DecideWhatIsMasked)
{
    for (const MapFormat map : {MapFormat::d32f, MapFormat::r32f}) {
        const ShadowOptions options{.technique = kPlainTechnique, .format = map};
        const auto solid = mapsWith(options, 0.75F, true);
        EXPECT_TRUE(solid == mapsWith(options, 0.25F, false)) << "they count where the batch says so";
        EXPECT_TRUE(solid == mapsWith(options, 0.5F, true)) << "the cutoff itself is solid";
        const auto clear = mapsWith(options, 0.25F, true);
        for (std::size_t light = 0; light < 2; ++light) {
            std::size_t farther = 0;
            for (std::size_t i = 0; i < solid[light].size(); ++i) {
                farther += clear[light][i] > solid[light][i] ? 1 : 0;
            }
            EXPECT_GT(farther, 300U) << "where boxes were, there is the ground: light " << light;
        }
    }
    expectSilence(gpu());
}

INSTANTIATE_TEST_SUITE_P(Formats, VertexColours, testing::ValuesIn(kFormats),
                         [](const auto& test_case) { return std::string(test_case.param.name); });

TEST(MissingVertexColours, AreAnError)
{
    Misuser without;
    without.batches[1].vertex_colours = true; // of no texture: nobody reads them
    without.drawer.setScene(without.parts, without.objects, without.batches);
    without.record();
    without.batches[1].texture = reinterpret_cast<VkDescriptorSet>(without.driver.makeBuffer());
    expectRefused(without, "fill in CasterVertices::colour",
                  [&] { without.drawer.setScene(without.parts, without.objects, without.batches); });

    vulkan::CasterDrawerOptions with;
    with.vertices.colour = {VK_FORMAT_R8G8B8A8_UNORM, 4, 0};
    Misuser host({}, with);
    host.batches[1].texture = reinterpret_cast<VkDescriptorSet>(host.driver.makeBuffer());
    host.batches[1].vertex_colours = true;
    host.geometry.uvs = host.driver.makeBuffer();
    host.drawer.setScene(host.parts, host.objects, host.batches);
    expectRefused(host, "fill in CasterGeometry::colours", [&] { host.begin(); });
    host.geometry.colours = host.driver.makeBuffer();
    host.record();
}

} // namespace
} // namespace gnomon::test
