// SPDX-License-Identifier: Apache-2.0
#include "texels.h"

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <cassert>

namespace gnomon::host {
namespace {

// A multiple of every format's texel, so that a copy may begin anywhere.
constexpr VkDeviceSize kAlignment = 16;

bool isDepth(VkFormat format)
{
    return format == VK_FORMAT_D32_SFLOAT || format == VK_FORMAT_D16_UNORM;
}

} // namespace

TexelForm formOf(VkFormat format)
{
    switch (format) {
    case VK_FORMAT_R8_UNORM:
        return {1, 1, Number::unorm8};
    case VK_FORMAT_R8G8B8A8_UNORM:
        return {4, 4, Number::unorm8};
    case VK_FORMAT_D16_UNORM:
    case VK_FORMAT_R16_UNORM:
        return {1, 2, Number::unorm16};
    case VK_FORMAT_R16G16_UNORM:
        return {2, 4, Number::unorm16};
    case VK_FORMAT_R16G16B16A16_UNORM:
        return {4, 8, Number::unorm16};
    case VK_FORMAT_R16_SFLOAT:
        return {1, 2, Number::half};
    case VK_FORMAT_R16G16_SFLOAT:
        return {2, 4, Number::half};
    case VK_FORMAT_R16G16B16A16_SFLOAT:
        return {4, 8, Number::half};
    case VK_FORMAT_D32_SFLOAT:
    case VK_FORMAT_R32_SFLOAT:
        return {1, 4, Number::single};
    case VK_FORMAT_R32G32_SFLOAT:
        return {2, 8, Number::single};
    case VK_FORMAT_R32G32B32A32_SFLOAT:
        return {4, 16, Number::single};
    case VK_FORMAT_R16G16_SNORM:
        return {2, 4, Number::other};
    case VK_FORMAT_R32G32B32A32_UINT:
        return {4, 16, Number::other};
    default:
        return {};
    }
}

bool convert(const void* texels, Number number, std::vector<float>& out)
{
    const auto from = [&out]<typename Word>(const Word* words, auto&& value) {
        std::transform(words, words + out.size(), out.begin(), value);
        return true;
    };
    const auto* const words = static_cast<const std::uint16_t*>(texels);
    switch (number) {
    case Number::unorm8:
        return from(static_cast<const std::uint8_t*>(texels),
                    [](std::uint8_t v) { return static_cast<float>(v) / 255.0F; });
    case Number::unorm16:
        return from(words, [](std::uint16_t v) { return static_cast<float>(v) / 65535.0F; });
    case Number::half:
        return from(words, [](std::uint16_t v) { return glm::unpackHalf1x16(v); });
    case Number::single:
        return from(static_cast<const float*>(texels), [](float v) { return v; });
    case Number::other:
        break;
    }
    return false;
}

TexelCopies::TexelCopies(const Gpu& gpu) : memory_(gpu) {}

VkDeviceSize TexelCopies::bytesOf(const vulkan::ImageRef& image)
{
    const VkDeviceSize bytes = VkDeviceSize{image.extent.width} * image.extent.height * formOf(image.format).bytes;
    return (bytes + kAlignment - 1) / kAlignment * kAlignment;
}

void TexelCopies::begin(VkDeviceSize bytes)
{
    memory_.grow(buffer_, bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT, "read-back", Place::read_back);
    used_ = 0;
}

const void* TexelCopies::add(VkCommandBuffer commands, const vulkan::ImageRef& image, std::uint32_t layer)
{
    assert(used_ + bytesOf(image) <= buffer_.size);
    const VkImageAspectFlags aspect = isDepth(image.format) ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
    const bool moves = image.layout != kCopySource.layout;
    const Access passes{VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_WRITE_BIT, image.layout};
    if (moves) {
        barrier(commands, image.image, aspect, passes, kCopySource);
    }
    VkBufferImageCopy copy{};
    copy.bufferOffset = used_;
    copy.imageSubresource = {aspect, 0, layer, 1};
    copy.imageExtent = {image.extent.width, image.extent.height, 1};
    vkCmdCopyImageToBuffer(commands, image.image, kCopySource.layout, buffer_.handle, 1, &copy);
    if (moves) {
        const Access after{VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_READ_BIT, image.layout};
        barrier(commands, image.image, aspect, kCopySource, after);
    }
    const void* const where = static_cast<const char*>(buffer_.mapped) + used_;
    used_ += bytesOf(image);
    return where;
}

void TexelCopies::end(VkCommandBuffer commands)
{
    const Access host{VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT};
    memoryBarrier(commands, kCopyTarget, host);
}

} // namespace gnomon::host
