// SPDX-License-Identifier: Apache-2.0
// One layer of the maps' image on the CPU: every mip level, up to four channels, read as a sampler reads it.
#pragma once

#include "harness.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace gnomon::test {

struct CpuMap {
    std::uint32_t width = 0; // of the finest level
    std::uint32_t height = 0;
    std::vector<std::vector<glm::vec4>> levels; // finest first; channels that the format lacks are 0

    [[nodiscard]] float depth(std::size_t x, std::size_t y) const { return levels[0][y * width + x].x; }
};

/// The size of a level.
[[nodiscard]] glm::uvec2 sizeOfLevel(const CpuMap& map, std::size_t level);
/// A texel of a level, clamped to its edges.
[[nodiscard]] glm::dvec4 texelAt(const CpuMap& map, std::size_t level, double x, double y);
/// textureLod of a linear sampler that clamps to the edge, exactly; `texel` in texels of the finest level.
[[nodiscard]] glm::dvec4 sampleAt(const CpuMap& map, glm::dvec2 texel, double level);

/// Bytes of a texel of a colour or depth format that maps come in.
[[nodiscard]] std::uint32_t texelBytes(VkFormat format);
/// A texel from its bytes.
[[nodiscard]] glm::vec4 decodeTexel(VkFormat format, const std::byte* bytes);
/// One layer of the image, its first `levels` mip levels.
[[nodiscard]] CpuMap readCpuMap(Gpu& gpu, const vulkan::ImageRef& maps, std::uint32_t layer, std::uint32_t levels = 1);

} // namespace gnomon::test
