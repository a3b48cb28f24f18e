// SPDX-License-Identifier: Apache-2.0
#include "cpu_map.h"

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace gnomon::test {
namespace {

struct Layout {
    std::uint32_t channels;
    enum class Kind { unorm8, unorm16, unorm24, half, single } kind;
};

Layout layoutOf(VkFormat format)
{
    switch (format) {
    case VK_FORMAT_D16_UNORM:
        return {1, Layout::Kind::unorm16};
    case VK_FORMAT_R16_UNORM:
        return {1, Layout::Kind::unorm16};
    case VK_FORMAT_R8_UNORM:
        return {1, Layout::Kind::unorm8};
    case VK_FORMAT_R8G8_UNORM:
        return {2, Layout::Kind::unorm8};
    case VK_FORMAT_X8_D24_UNORM_PACK32:
        return {1, Layout::Kind::unorm24};
    case VK_FORMAT_R8G8B8A8_UNORM:
        return {4, Layout::Kind::unorm8};
    case VK_FORMAT_R16G16_UNORM:
        return {2, Layout::Kind::unorm16};
    case VK_FORMAT_R16G16B16A16_UNORM:
        return {4, Layout::Kind::unorm16};
    case VK_FORMAT_R16_SFLOAT:
        return {1, Layout::Kind::half};
    case VK_FORMAT_R16G16_SFLOAT:
        return {2, Layout::Kind::half};
    case VK_FORMAT_R16G16B16A16_SFLOAT:
        return {4, Layout::Kind::half};
    case VK_FORMAT_R32G32_SFLOAT:
        return {2, Layout::Kind::single};
    case VK_FORMAT_R32G32B32A32_SFLOAT:
        return {4, Layout::Kind::single};
    default: // D32, R32F
        return {1, Layout::Kind::single};
    }
}

bool isDepth(VkFormat format)
{
    return format == VK_FORMAT_D16_UNORM || format == VK_FORMAT_X8_D24_UNORM_PACK32 || format == VK_FORMAT_D32_SFLOAT;
}

glm::dvec4 bilinear(const CpuMap& map, glm::dvec2 texel, std::size_t level)
{
    const glm::dvec2 size(sizeOfLevel(map, level));
    const glm::dvec2 at = texel * size / glm::dvec2(map.width, map.height) - 0.5;
    const glm::dvec2 cell = glm::floor(at);
    const glm::dvec2 part = at - cell;
    const glm::dvec4 above =
        glm::mix(texelAt(map, level, cell.x, cell.y), texelAt(map, level, cell.x + 1.0, cell.y), part.x);
    const glm::dvec4 below =
        glm::mix(texelAt(map, level, cell.x, cell.y + 1.0), texelAt(map, level, cell.x + 1.0, cell.y + 1.0), part.x);
    return glm::mix(above, below, part.y);
}

} // namespace

glm::uvec2 sizeOfLevel(const CpuMap& map, std::size_t level)
{
    return {std::max(map.width >> level, 1U), std::max(map.height >> level, 1U)};
}

glm::dvec4 texelAt(const CpuMap& map, std::size_t level, double x, double y)
{
    const glm::uvec2 size = sizeOfLevel(map, level);
    const auto clamped = [](double v, std::uint32_t count) {
        return v >= 0.0 ? static_cast<std::size_t>(std::min(v, count - 1.0)) : std::size_t{0};
    };
    return map.levels[level][clamped(y, size.y) * size.x + clamped(x, size.x)];
}

glm::dvec4 sampleAt(const CpuMap& map, glm::dvec2 texel, double level)
{
    const double last = static_cast<double>(map.levels.size()) - 1.0;
    const double bounded = level >= 0.0 ? std::min(level, last) : 0.0;
    const auto finer = static_cast<std::size_t>(bounded);
    const double part = bounded - static_cast<double>(finer);
    const glm::dvec4 fine = bilinear(map, texel, finer);
    return part > 0.0 ? glm::mix(fine, bilinear(map, texel, finer + 1), part) : fine;
}

std::uint32_t texelBytes(VkFormat format)
{
    const Layout layout = layoutOf(format);
    const bool is_word = layout.kind == Layout::Kind::single || layout.kind == Layout::Kind::unorm24;
    return layout.channels * (is_word ? 4U : layout.kind == Layout::Kind::unorm8 ? 1U : 2U);
}

glm::vec4 decodeTexel(VkFormat format, const std::byte* bytes)
{
    const Layout layout = layoutOf(format);
    glm::vec4 texel(0.0F);
    for (std::uint32_t i = 0; i < layout.channels; ++i) {
        float& channel = texel[static_cast<int>(i)];
        if (layout.kind == Layout::Kind::single) {
            std::memcpy(&channel, bytes + std::size_t{4} * i, 4);
            continue;
        }
        if (layout.kind == Layout::Kind::unorm24) { // copied as words whose upper byte is undefined
            std::uint32_t bits = 0;
            std::memcpy(&bits, bytes, 4);
            channel = static_cast<float>(bits & 0xFFFFFFU) / 16777215.0F;
            continue;
        }
        if (layout.kind == Layout::Kind::unorm8) {
            channel = static_cast<float>(std::to_integer<int>(bytes[i])) / 255.0F;
            continue;
        }
        std::uint16_t bits = 0;
        std::memcpy(&bits, bytes + std::size_t{2} * i, 2);
        channel = layout.kind == Layout::Kind::half ? glm::unpackHalf1x16(bits) : static_cast<float>(bits) / 65535.0F;
    }
    return texel;
}

CpuMap readCpuMap(Gpu& gpu, const vulkan::ImageRef& maps, std::uint32_t layer, std::uint32_t levels)
{
    CpuMap map;
    map.width = maps.extent.width;
    map.height = maps.extent.height;
    const std::uint32_t bytes = texelBytes(maps.format);
    const VkImageAspectFlags aspect = isDepth(maps.format) ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
    for (std::uint32_t level = 0; level < levels; ++level) {
        const std::vector<std::byte> raw = gpu.read(maps, layer, bytes, aspect, level);
        std::vector<glm::vec4>& texels = map.levels.emplace_back(raw.size() / bytes);
        for (std::size_t i = 0; i < texels.size(); ++i) {
            texels[i] = decodeTexel(maps.format, &raw[i * bytes]);
        }
    }
    return map;
}

} // namespace gnomon::test
