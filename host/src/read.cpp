// SPDX-License-Identifier: Apache-2.0
// Images back from the GPU, as plain numbers.
#include "renderer_impl.h"

#include <gnomon/error.h>

#define GNOMON_REAL float
#include "octahedral.h"

#include <glm/gtc/packing.hpp>

#include <algorithm>

namespace gnomon::host {
namespace {

// How the texels of an image lie in memory.
enum class Number : std::uint8_t { unorm8, unorm16, half, single, other };
struct TexelForm {
    std::uint32_t channels = 1;
    std::uint32_t bytes = 4; // of all channels
    Number number = Number::other;
};

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
    case VK_FORMAT_R16G16B16A16_SNORM:
        return {4, 8, Number::other};
    case VK_FORMAT_R32G32_UINT:
        return {2, 8, Number::other};
    default:
        return {};
    }
}

std::uint32_t texelBytes(VkFormat format)
{
    return formOf(format).bytes;
}

// Texels as plain numbers; false for forms that are not read this way.
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

bool isDepth(VkFormat format)
{
    return format == VK_FORMAT_D32_SFLOAT || format == VK_FORMAT_D16_UNORM;
}

struct Source {
    VkImage image = VK_NULL_HANDLE;
    VkFormat format = VK_FORMAT_UNDEFINED;
    VkExtent2D extent{};
    std::uint32_t layer = 0;
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED; // before and after
};

Source sourceOf(const Image& image, VkImageLayout layout)
{
    return {image.handle, image.format, image.extent, 0, layout};
}

Source sourceOf(const vulkan::ImageRef& image, std::uint32_t layer)
{
    return {image.image, image.format, image.extent, layer, image.layout};
}

// The image's texels, in mapped memory until the next call.
template <typename Impl>
const void* fetch(Impl& self, const Source& from)
{
    const VkDeviceSize bytes = VkDeviceSize{from.extent.width} * from.extent.height * texelBytes(from.format);
    self.memory.grow(self.read_back, bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT, "read-back");
    const VkImageAspectFlags aspect = isDepth(from.format) ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
    // The frame has been waited for, so nothing has to be waited for here but the change of layout.
    const Access before{VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_NONE, from.layout};
    VkCommandBuffer cmd = self.commands.begin();
    if (from.layout != kCopySource.layout) {
        barrier(cmd, from.image, aspect, before, kCopySource);
    }
    VkBufferImageCopy copy{};
    copy.imageSubresource = {aspect, 0, from.layer, 1};
    copy.imageExtent = {from.extent.width, from.extent.height, 1};
    vkCmdCopyImageToBuffer(cmd, from.image, kCopySource.layout, self.read_back.handle, 1, &copy);
    if (from.layout != kCopySource.layout) {
        barrier(cmd, from.image, aspect, kCopySource, before);
    }
    const Access host{VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT};
    memoryBarrier(cmd, kCopyTarget, host);
    self.commands.finish();
    return self.read_back.mapped;
}

// With supersampling: the top left of each four for what cannot be averaged.
template <typename Texel, typename Take>
void eachPixel(const void* texels, VkExtent2D drawn, VkExtent2D shown, Take&& take)
{
    const std::uint32_t scale = drawn.width / shown.width;
    const auto* const all = static_cast<const Texel*>(texels);
    for (std::uint32_t y = 0; y < shown.height; ++y) {
        for (std::uint32_t x = 0; x < shown.width; ++x) {
            take(x, y, all[std::size_t{y} * scale * drawn.width + std::size_t{x} * scale]);
        }
    }
}

// ... and the average of the four for what can: `value(i)` is texel i's number.
template <typename Value>
void averageInto(ImageF& image, std::uint32_t channel, VkExtent2D drawn, Value&& value)
{
    const std::uint32_t scale = drawn.width / image.width;
    const float weight = 1.0F / static_cast<float>(scale * scale);
    for (std::uint32_t y = 0; y < image.height; ++y) {
        for (std::uint32_t x = 0; x < image.width; ++x) {
            float sum = 0.0F;
            for (std::uint32_t s = 0; s < scale * scale; ++s) {
                const std::size_t row = std::size_t{y} * scale + s / scale;
                sum += value(row * drawn.width + std::size_t{x} * scale + s % scale);
            }
            image.pixel(x, y)[channel] = sum * weight;
        }
    }
}

} // namespace

void Renderer::Impl::readColour(Picture& picture)
{
    const VkExtent2D shown = targets.shown;
    picture.colour = Image8(shown.width, shown.height, 3);
    using Rgba = std::array<std::uint8_t, 4>;
    eachPixel<Rgba>(
        fetch(*this, sourceOf(targets.picture, kCopySource.layout)), shown, shown,
        [&](std::uint32_t x, std::uint32_t y, const Rgba& c) { std::copy_n(c.data(), 3, picture.colour.pixel(x, y)); });
}

void Renderer::Impl::readLinear(Picture& picture)
{
    picture.linear = ImageF(targets.shown.width, targets.shown.height, 3);
    const auto* halves = static_cast<const std::uint16_t*>(fetch(*this, sourceOf(targets.light, kSampled.layout)));
    for (std::uint32_t c = 0; c < 3; ++c) {
        averageInto(picture.linear, c, targets.drawn,
                    [&](std::size_t i) { return glm::unpackHalf1x16(halves[i * 4 + c]); });
    }
}

void Renderer::Impl::readGlow(Picture& picture)
{
    const Image& glow = bloom->result();
    picture.glow = ImageF(glow.extent.width, glow.extent.height, 3);
    const auto* halves = static_cast<const std::uint16_t*>(fetch(*this, sourceOf(glow, kSampled.layout)));
    for (std::size_t i = 0; i < picture.glow.values.size(); ++i) {
        picture.glow.values[i] = glm::unpackHalf1x16(halves[i / 3 * 4 + i % 3]);
    }
}

void Renderer::Impl::readMasks(Picture& picture)
{
    for (std::uint32_t light = 0; light < light_count; ++light) {
        picture.masks.emplace_back(targets.shown.width, targets.shown.height, 1U, 1.0F);
        if (plan == nullptr && !mask_instead) {
            continue; // no shadows wanted: everything is lit
        }
        const std::uint32_t layer = plan != nullptr ? plan->lights[light].mask_layer : light / 4;
        const std::uint32_t channel = plan != nullptr ? plan->lights[light].mask_channel : light % 4;
        const Source from = plan != nullptr
                                ? sourceOf(shadows->mask(), layer)
                                : Source{instead.handle, instead.format, targets.drawn, layer, kSampled.layout};
        const std::uint32_t stride = texelBytes(from.format);
        const auto* bytes = static_cast<const std::uint8_t*>(fetch(*this, from));
        averageInto(picture.masks.back(), 0, targets.drawn,
                    [&](std::size_t i) { return static_cast<float>(bytes[i * stride + channel]) / 255.0F; });
    }
}

void Renderer::Impl::readGeometry(Picture& picture)
{
    const VkExtent2D drawn = targets.drawn;
    const VkExtent2D shown = targets.shown;
    picture.depth = ImageF(shown.width, shown.height, 1);
    eachPixel<float>(fetch(*this, sourceOf(targets.depth, kDepthRead.layout)), drawn, shown,
                     [&](std::uint32_t x, std::uint32_t y, float z) { *picture.depth.pixel(x, y) = z; });
    picture.object_ids = ImageOf<std::uint32_t>(shown.width, shown.height, 1);
    using Ids = std::array<std::uint32_t, 2>;
    eachPixel<Ids>(fetch(*this, sourceOf(targets.ids(), kSampled.layout)), drawn, shown,
                   [&](std::uint32_t x, std::uint32_t y, const Ids& id) { *picture.object_ids.pixel(x, y) = id[1]; });
    picture.normals = ImageF(shown.width, shown.height, 3);
    using Normals = std::array<std::int16_t, 4>;
    const auto snorm = [](std::int16_t v) {
        return std::max(static_cast<float>(v) / 32767.0F, -1.0F);
    };
    eachPixel<Normals>(fetch(*this, sourceOf(targets.normals(), kSampled.layout)), drawn, shown,
                       [&](std::uint32_t x, std::uint32_t y, const Normals& e) {
                           glm::vec3 n{0.0F}; // the background has no normal
                           if (*picture.object_ids.pixel(x, y) != 0) {
                               n = shared::octahedralDecode({snorm(e[0]), snorm(e[1])});
                           }
                           std::copy_n(&n.x, 3, picture.normals.pixel(x, y));
                       });
}

Picture Renderer::read(const WantedImages& wanted)
{
    if (impl_->next_index == 0) {
        throw Error("reading a picture back", "nothing has been drawn yet");
    }
    Picture picture;
    if (wanted.colour) {
        impl_->readColour(picture);
    }
    if (wanted.linear) {
        impl_->readLinear(picture);
    }
    if (wanted.glow && impl_->bloom) {
        impl_->readGlow(picture);
    }
    if (wanted.masks) {
        impl_->readMasks(picture);
    }
    if (wanted.geometry) {
        impl_->readGeometry(picture);
    }
    return picture;
}

ImageF Renderer::readMap(std::uint32_t layer)
{
    Impl& self = *impl_;
    constexpr const char* kTried = "reading a shadow map back";
    if (self.plan == nullptr) {
        throw Error(kTried, "the last frame had no shadow map");
    }
    const vulkan::ImageRef maps = self.shadows->maps();
    if (layer >= maps.layers) {
        throw Error(kTried, "layer " + std::to_string(layer) + " of " + std::to_string(maps.layers));
    }
    const TexelForm form = formOf(maps.format);
    ImageF image(maps.extent.width, maps.extent.height, form.channels);
    if (!convert(fetch(self, sourceOf(maps, layer)), form.number, image.values)) {
        throw Error(kTried, "its format cannot be read");
    }
    return image;
}

} // namespace gnomon::host
