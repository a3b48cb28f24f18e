// SPDX-License-Identifier: Apache-2.0
// CasterDrawer draws the same from whatever the host's vertices are stored as.
#include "fixture.h"

#include <gnomon/error.h>

#include <glm/gtc/packing.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace gnomon::test {
namespace {

using vulkan::CasterDrawer;
using vulkan::CasterDrawerOptions;
using vulkan::CasterVertices;
using vulkan::Rows3x4;

constexpr VkExtent2D kScreen{48, 32};
constexpr std::uint32_t kVertices = 12; // four of the ground, eight of the cube
constexpr std::uint32_t kIndices = 42;

struct FormatCase {
    const char* name;
    VkFormat position;
    VkFormat uv;
    VkIndexType index;
    bool interleaved;
};

std::ostream& operator<<(std::ostream& out, const FormatCase& c)
{
    return out << c.name;
}

template <class T>
void put(std::byte* to, const T& value)
{
    std::memcpy(to, &value, sizeof value);
}

void putPosition(std::byte* to, VkFormat format, glm::vec3 p)
{
    const glm::vec4 all(p, 0.25F); // the fourth number must not count
    switch (format) {
    case VK_FORMAT_R32G32B32_SFLOAT:
        put(to, p);
        break;
    case VK_FORMAT_R32G32B32A32_SFLOAT:
        put(to, all);
        break;
    case VK_FORMAT_R16G16B16A16_SFLOAT:
        put(to, glm::packHalf4x16(all));
        break;
    case VK_FORMAT_R16G16B16A16_SNORM:
        put(to, glm::packSnorm4x16(all));
        break;
    default:
        put(to, glm::packUnorm4x16(all));
    }
}

void putUv(std::byte* to, VkFormat format, glm::vec2 uv)
{
    switch (format) {
    case VK_FORMAT_R32G32_SFLOAT:
        put(to, uv);
        break;
    case VK_FORMAT_R16G16_SFLOAT:
        put(to, glm::packHalf2x16(uv));
        break;
    default:
        put(to, glm::packUnorm2x16(uv));
    }
}

// Sizes that are no format's own, so that stride and offset count.
CasterVertices verticesOf(const FormatCase& c)
{
    CasterVertices vertices;
    vertices.position = {c.position, 20, 4};
    vertices.uv = {c.uv, 12, 4};
    if (c.interleaved) {
        vertices.position = {c.position, 36, 8};
        vertices.uv = {c.uv, 36, 24};
    }
    vertices.index = c.index;
    return vertices;
}

class VertexFormats : public testing::TestWithParam<FormatCase> {
protected:
    VertexFormats() : bench_(kScreen, MapFormat::d32f)
    {
        bench_.setLights({makeSun({0.8, -0.9, -0.35}), makeSpot({-6.0, 9.0, 5.0}, {0.0, 0.0, 0.0}, 0.6)},
                         {{0, 0, 0, 128, 128}, {1, 0, 0, 128, 128}}, {128, 128, 2});
        bench_.maskBoxes();
        bench_.prepare();
    }
    [[nodiscard]] vulkan::CasterGeometry makeGeometry(const CasterVertices& vertices)
    {
        std::array<glm::vec3, kVertices> positions{{{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}}};
        for (std::uint32_t i = 0; i < 8; ++i) {
            positions[4 + i] = {(i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1};
        }
        const bool unorm = vertices.position.format == VK_FORMAT_R16G16B16A16_UNORM;
        const TestBuffer position = gpu().makeBuffer(kVertices * 36 + 64, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
        const TestBuffer uv = gpu().makeBuffer(kVertices * 36 + 64, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
        const bool one = vertices.position.stride == vertices.uv.stride;
        for (std::uint32_t i = 0; i < kVertices; ++i) {
            const glm::vec3 stored =
                unorm ? glm::vec3(0.5F) * (positions[i] + glm::vec3(1, i < 4 ? 0 : 1, 1)) : positions[i];
            putPosition(static_cast<std::byte*>(position.mapped) + std::size_t{i} * vertices.position.stride +
                            vertices.position.offset,
                        vertices.position.format, stored);
            putUv(static_cast<std::byte*>((one ? position : uv).mapped) + std::size_t{i} * vertices.uv.stride +
                      vertices.uv.offset,
                  vertices.uv.format, {i >= 4 && (i & 1) != 0 ? 1.0F / 3.0F : 0.0F, 0.5F});
        }
        const TestBuffer index = gpu().makeBuffer(kIndices * 4, VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
        const auto* const source = static_cast<const std::uint32_t*>(bench_.mesh.mapped_indices);
        for (std::uint32_t i = 0; i < kIndices; ++i) {
            if (vertices.index == VK_INDEX_TYPE_UINT16) {
                static_cast<std::uint16_t*>(index.mapped)[i] = static_cast<std::uint16_t>(source[i]);
            } else {
                static_cast<std::uint32_t*>(index.mapped)[i] = source[i];
            }
        }
        return {position.buffer, 0, one ? position.buffer : uv.buffer, 0, index.buffer, 0};
    }
    /// For positions in 0 .. 1 in place of -1 .. 1; the ground is flat and stays at 0.
    [[nodiscard]] std::vector<Rows3x4> transformsFor(const CasterVertices& vertices) const
    {
        std::vector<Rows3x4> transforms = bench_.scene.transforms();
        if (vertices.position.format != VK_FORMAT_R16G16B16A16_UNORM) {
            return transforms;
        }
        for (std::size_t i = 0; i < transforms.size(); ++i) {
            for (glm::vec4* const row : {&transforms[i].x, &transforms[i].y, &transforms[i].z}) {
                const float y = i == 0 ? 0.0F : row->y;
                *row = {2.0F * row->x, 2.0F * row->y, 2.0F * row->z, row->w - row->x - y - row->z};
            }
        }
        return transforms;
    }

    Bench bench_;
};

/// How many texels are nearer or farther than all nine around the same place of another map.
std::size_t beyondNeighbours(const std::vector<float>& map, const std::vector<float>& other)
{
    const auto side = static_cast<std::ptrdiff_t>(std::lround(std::sqrt(double(map.size()))));
    std::size_t beyond = 0;
    for (std::ptrdiff_t y = 0; y < side; ++y) {
        for (std::ptrdiff_t x = 0; x < side; ++x) {
            float low = 2.0F;
            float high = -1.0F;
            for (std::ptrdiff_t row = std::max(y - 1, std::ptrdiff_t{0}); row <= std::min(y + 1, side - 1); ++row) {
                for (std::ptrdiff_t at = std::max(x - 1, std::ptrdiff_t{0}); at <= std::min(x + 1, side - 1); ++at) {
                    const float depth = other[static_cast<std::size_t>(row * side + at)];
                    low = std::min(low, depth);
                    high = std::max(high, depth);
                }
            }
            const float depth = map[static_cast<std::size_t>(y * side + x)];
            beyond += depth < low - 1e-5F || depth > high + 1e-5F ? 1 : 0;
        }
    }
    return beyond;
}

TEST_P(VertexFormats, giveTheSameMaps)
{
    bench_.record(1);
    const std::vector<std::vector<float>> expected{bench_.readMap(0), bench_.readMap(1)};
    CasterDrawerOptions options;
    options.vertices = verticesOf(GetParam());
    CasterDrawer drawer(gpu().view(), options);
    drawer.setScene(bench_.mesh.parts, bench_.mesh.objects, bench_.mesh.batches);
    const vulkan::CasterGeometry geometry = makeGeometry(options.vertices);
    const std::vector<Rows3x4> transforms = transformsFor(options.vertices);
    gpu().run([&](VkCommandBuffer commands) {
        drawer.beginFrame(0, bench_.plan, geometry, transforms);
        bench_.renderer.recordMaps(commands, 0, bench_.plan, [&](const vulkan::MapPass& pass) { drawer.draw(pass); });
    });
    for (std::uint32_t layer = 0; layer < 2; ++layer) {
        const std::vector<float> map = bench_.readMap(layer);
        std::size_t off = 0;
        for (std::size_t i = 0; i < map.size(); ++i) {
            off += std::abs(map[i] - expected[layer][i]) > 1e-5F ? 1 : 0;
        }
        // UNORM alone has other transforms, whose products a device may round otherwise: 111 of 16384 on one.
        const std::size_t share = GetParam().position == VK_FORMAT_R16G16B16A16_UNORM ? 100 : 200;
        EXPECT_LT(off, map.size() / share) << "rounding may move an edge by a texel";
        EXPECT_LE(beyondNeighbours(map, expected[layer]), map.size() / 1000) << "and by no more";
    }
    expectSilence(gpu());
}

INSTANTIATE_TEST_SUITE_P(
    All, VertexFormats,
    testing::Values(
        FormatCase{"packed_elsewhere", VK_FORMAT_R32G32B32_SFLOAT, VK_FORMAT_R32G32_SFLOAT, VK_INDEX_TYPE_UINT32,
                   false},
        FormatCase{"interleaved", VK_FORMAT_R32G32B32_SFLOAT, VK_FORMAT_R32G32_SFLOAT, VK_INDEX_TYPE_UINT16, true},
        FormatCase{"four_floats", VK_FORMAT_R32G32B32A32_SFLOAT, VK_FORMAT_R16G16_SFLOAT, VK_INDEX_TYPE_UINT32, true},
        FormatCase{"halves", VK_FORMAT_R16G16B16A16_SFLOAT, VK_FORMAT_R16G16_SFLOAT, VK_INDEX_TYPE_UINT16, false},
        FormatCase{"snorm", VK_FORMAT_R16G16B16A16_SNORM, VK_FORMAT_R16G16_UNORM, VK_INDEX_TYPE_UINT16, true},
        FormatCase{"unorm", VK_FORMAT_R16G16B16A16_UNORM, VK_FORMAT_R16G16_UNORM, VK_INDEX_TYPE_UINT32, false}),
    [](const auto& test_case) { return std::string(test_case.param.name); });

TEST(VertexFormatsRefused, areNamed)
{
    CasterDrawerOptions options;
    options.vertices.position.format = VK_FORMAT_R8G8B8A8_SNORM;
    EXPECT_THROW(CasterDrawer(gpu().view(), options), Error);
    options = {};
    options.vertices.uv.format = VK_FORMAT_R8G8_UNORM;
    EXPECT_THROW(CasterDrawer(gpu().view(), options), Error);
    options = {};
    options.vertices.index = VK_INDEX_TYPE_NONE_KHR;
    EXPECT_THROW(CasterDrawer(gpu().view(), options), Error);
    options = {};
    options.vertices.colour.format = VK_FORMAT_R8G8B8_UNORM;
    EXPECT_THROW(CasterDrawer(gpu().view(), options), Error);
}

} // namespace
} // namespace gnomon::test
