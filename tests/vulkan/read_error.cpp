// SPDX-License-Identifier: Apache-2.0
#include "read_error.h"

#include "cpu_map.h"
#include "fixture.h"

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <cmath>
#include <random>

namespace gnomon::test {
namespace {

constexpr std::uint32_t kTexels = 32; // a side
constexpr std::uint32_t kReads = 16;  // of each texel's width
constexpr double kExact = 0.05;       // of a step; single precision alone makes less of a read

bool blits(VkFormat format)
{
    VkFormatProperties from{};
    VkFormatProperties to{};
    vkGetPhysicalDeviceFormatProperties(gpu().view().physical_device, format, &from);
    vkGetPhysicalDeviceFormatProperties(gpu().view().physical_device, VK_FORMAT_R32G32B32A32_SFLOAT, &to);
    constexpr VkFormatFeatureFlags kFrom =
        VK_FORMAT_FEATURE_BLIT_SRC_BIT | VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT;
    return (from.optimalTilingFeatures & kFrom) == kFrom &&
           (to.optimalTilingFeatures & VK_FORMAT_FEATURE_BLIT_DST_BIT) != 0;
}

vulkan::ImageRef refOf(const TestImage& image, std::uint32_t side)
{
    vulkan::ImageRef ref;
    ref.image = image.image;
    ref.view = image.view;
    ref.format = image.format;
    ref.extent = {side, side};
    ref.layers = 1;
    ref.layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    return ref;
}

/// Neighbours are a few steps apart, so that what a sampler's weights lack in bits is nothing beside a step.
std::vector<std::uint16_t> closeTexels(VkFormat format)
{
    std::mt19937 random(7);
    const std::uint16_t base = format == VK_FORMAT_R16G16B16A16_UNORM ? 30000 : glm::packHalf1x16(1.25F);
    std::vector<std::uint16_t> parts(std::size_t{kTexels} * kTexels * 4);
    for (std::uint16_t& part : parts) {
        part = static_cast<std::uint16_t>(base + (random() & 3U));
    }
    return parts;
}

/// In steps of the format where the texels are.
double measure(VkFormat format)
{
    const std::vector<std::uint16_t> parts = closeTexels(format);
    const TestImage from = gpu().makeImage(format, {kTexels, kTexels}, std::as_bytes(std::span(parts)));
    constexpr std::uint32_t kSide = kTexels * kReads;
    const std::vector<glm::vec4> nothing(std::size_t{kSide} * kSide);
    const TestImage to =
        gpu().makeImage(VK_FORMAT_R32G32B32A32_SFLOAT, {kSide, kSide}, std::as_bytes(std::span(nothing)));
    gpu().blit(from, {kTexels, kTexels}, to, {kSide, kSide});
    const CpuMap exact = readCpuMap(gpu(), refOf(from, kTexels), 0);
    const CpuMap read = readCpuMap(gpu(), refOf(to, kSide), 0);
    double worst = 0.0;
    for (std::uint32_t y = 0; y < kSide; ++y) {
        for (std::uint32_t x = 0; x < kSide; ++x) {
            const glm::dvec4 wanted = sampleAt(exact, (glm::dvec2(x, y) + 0.5) / double(kReads), 0.0);
            const glm::dvec4 off = glm::abs(glm::dvec4(texelAt(read, 0, x, y)) - wanted);
            worst = std::max({worst, off.x, off.y, off.z, off.w});
        }
    }
    return worst * (format == VK_FORMAT_R16G16B16A16_UNORM ? 65535.0 : 1024.0);
}

} // namespace

double stepsOfReads(VkFormat format)
{
    static const double unorm = blits(VK_FORMAT_R16G16B16A16_UNORM) ? measure(VK_FORMAT_R16G16B16A16_UNORM) : 0.5;
    static const double half = blits(VK_FORMAT_R16G16B16A16_SFLOAT) ? measure(VK_FORMAT_R16G16B16A16_SFLOAT) : 0.5;
    return format == VK_FORMAT_R16G16B16A16_UNORM ? unorm : half;
}

ReadError readErrorOf(VkFormat format)
{
    if (stepsOfReads(format) < kExact) {
        return {};
    }
    return format == VK_FORMAT_R16G16B16A16_UNORM ? ReadError{0.5 / 65535.0, 0.0} : ReadError{0.0, 0x1p-11};
}

} // namespace gnomon::test
