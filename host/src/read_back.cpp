// SPDX-License-Identifier: Apache-2.0
// Images of a frame back from the GPU, as plain numbers.
#include "texels.h"

#include "host/present.h"

#define GNOMON_REAL float
#include "gnomon/shared/octahedral.h"

#include <gnomon/error.h>

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <array>

namespace gnomon::host {
namespace {

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

struct ReadBack::Impl {
    Impl(const Gpu& gpu, const WantedImages& the_wanted) : wanted(the_wanted), copies(gpu) {}

    const WantedImages wanted;
    TexelCopies copies;
    /// The images of the frame that was recorded last; null where nothing was wanted.
    struct {
        VkExtent2D drawn{};
        VkExtent2D shown{};
        VkExtent2D glow_extent{};
        const void* picture = nullptr;
        const void* light = nullptr;
        const void* glow = nullptr;
        const void* depth = nullptr;
        const void* normals = nullptr;
        Number normal_number = Number::other;
        const void* ids = nullptr;
    } at;
    /// One channel of a layer of the masks.
    struct Mask {
        const void* texels = nullptr; // null: lit everywhere
        std::uint32_t stride = 1;
        std::uint32_t channel = 0;
    };
    std::vector<Mask> masks;

    [[nodiscard]] VkDeviceSize bytesFor(const FinishedFrame& frame) const;
    void recordMasks(VkCommandBuffer commands, const FinishedFrame& frame);
    void readColour(Picture& picture) const;
    void readLinear(Picture& picture) const;
    void readGlow(Picture& picture) const;
    void readMasks(Picture& picture) const;
    void readGeometry(Picture& picture) const;
};

VkDeviceSize ReadBack::Impl::bytesFor(const FinishedFrame& frame) const
{
    VkDeviceSize bytes = 0;
    const auto add = [&bytes](bool is_wanted, const vulkan::ImageRef& image, std::uint32_t layers = 1) {
        bytes += is_wanted && image.image != VK_NULL_HANDLE ? TexelCopies::bytesOf(image) * layers : 0;
    };
    add(wanted.colour, frame.picture);
    add(wanted.linear, frame.light);
    add(wanted.glow, frame.glow);
    add(wanted.masks, frame.masks, frame.masks.layers);
    for (const vulkan::ImageRef* image : {&frame.depth, &frame.normals, &frame.ids}) {
        add(wanted.geometry, *image);
    }
    return bytes;
}

void ReadBack::Impl::recordMasks(VkCommandBuffer commands, const FinishedFrame& frame)
{
    const bool shadowed = wanted.masks && frame.masks.image != VK_NULL_HANDLE;
    if (shadowed && frame.compact_masks) {
        throw Error("reading masks", "a compact mask has no channel for each light", "let it not be compact");
    }
    std::vector<const void*> layers;
    for (std::uint32_t layer = 0; shadowed && layer < frame.masks.layers; ++layer) {
        layers.push_back(copies.add(commands, frame.masks, layer));
    }
    for (std::uint32_t light = 0; wanted.masks && light < frame.light_count; ++light) {
        const std::uint32_t layer = frame.plan != nullptr ? frame.plan->lights[light].mask_layer : light / 4;
        const std::uint32_t channel = frame.plan != nullptr ? frame.plan->lights[light].mask_channel : light % 4;
        masks.push_back(shadowed ? Mask{layers.at(layer), formOf(frame.masks.format).bytes, channel} : Mask{});
    }
}

void ReadBack::Impl::readColour(Picture& picture) const
{
    picture.colour = Image8(at.shown.width, at.shown.height, 3);
    using Rgba = std::array<std::uint8_t, 4>;
    eachPixel<Rgba>(at.picture, at.shown, at.shown, [&](std::uint32_t x, std::uint32_t y, const Rgba& c) {
        std::copy_n(c.data(), 3, picture.colour.pixel(x, y));
    });
}

void ReadBack::Impl::readLinear(Picture& picture) const
{
    picture.linear = ImageF(at.shown.width, at.shown.height, 3);
    const auto* halves = static_cast<const std::uint16_t*>(at.light);
    for (std::uint32_t c = 0; c < 3; ++c) {
        averageInto(picture.linear, c, at.drawn, [&](std::size_t i) { return glm::unpackHalf1x16(halves[i * 4 + c]); });
    }
}

void ReadBack::Impl::readGlow(Picture& picture) const
{
    picture.glow = ImageF(at.glow_extent.width, at.glow_extent.height, 3);
    const auto* halves = static_cast<const std::uint16_t*>(at.glow);
    for (std::size_t i = 0; i < picture.glow.values.size(); ++i) {
        picture.glow.values[i] = glm::unpackHalf1x16(halves[i / 3 * 4 + i % 3]);
    }
}

void ReadBack::Impl::readMasks(Picture& picture) const
{
    for (const Mask& mask : masks) {
        picture.masks.emplace_back(at.shown.width, at.shown.height, 1U, 1.0F);
        if (mask.texels == nullptr) {
            continue;
        }
        const auto* bytes = static_cast<const std::uint8_t*>(mask.texels);
        averageInto(picture.masks.back(), 0, at.drawn,
                    [&](std::size_t i) { return static_cast<float>(bytes[i * mask.stride + mask.channel]) / 255.0F; });
    }
}

void ReadBack::Impl::readGeometry(Picture& picture) const
{
    const VkExtent2D drawn = at.drawn;
    const VkExtent2D shown = at.shown;
    picture.depth = ImageF(shown.width, shown.height, 1);
    eachPixel<float>(at.depth, drawn, shown,
                     [&](std::uint32_t x, std::uint32_t y, float z) { *picture.depth.pixel(x, y) = z; });
    picture.object_ids = ImageOf<std::uint32_t>(shown.width, shown.height, 1);
    using Surface = std::array<std::uint32_t, 4>;
    eachPixel<Surface>(at.ids, drawn, shown, [&](std::uint32_t x, std::uint32_t y, const Surface& surface) {
        // Where nothing was drawn there may be anything.
        *picture.object_ids.pixel(x, y) = *picture.depth.pixel(x, y) != 0.0F ? surface[3] : 0;
    });
    picture.normals = ImageF(shown.width, shown.height, 3);
    const auto put = [&](std::uint32_t x, std::uint32_t y, const glm::vec2& e) {
        glm::vec3 n{0.0F}; // the background has no normal
        if (*picture.object_ids.pixel(x, y) != 0) {
            n = shared::octahedralDecode(e);
        }
        std::copy_n(&n.x, 3, picture.normals.pixel(x, y));
    };
    if (at.normal_number == Number::single) {
        eachPixel<glm::vec2>(at.normals, drawn, shown, put);
    } else {
        eachPixel<std::uint32_t>(at.normals, drawn, shown, [&](std::uint32_t x, std::uint32_t y, std::uint32_t e) {
            put(x, y, glm::unpackSnorm2x16(e));
        });
    }
}

namespace {

/// Throws Error for wanted images that the frame lacks because of how it was shaded.
void checkWanted(const WantedImages& wanted, const FinishedFrame& frame)
{
    if ((wanted.masks || wanted.geometry) && frame.normals.image == VK_NULL_HANDLE) {
        throw Error("reading a frame back", "it was shaded forward, which makes no masks and keeps no geometry",
                    "shade it deferred");
    }
    if (wanted.linear && frame.light.image == VK_NULL_HANDLE) {
        throw Error("reading a frame back", "its light went through the tone curve at once",
                    "say beforehand that the renderer keeps light");
    }
}

} // namespace

ReadBack::ReadBack(const Gpu& gpu, const WantedImages& wanted) : impl_(std::make_unique<Impl>(gpu, wanted)) {}

ReadBack::~ReadBack() = default;

void ReadBack::record(VkCommandBuffer commands, const FinishedFrame& frame)
{
    Impl& self = *impl_;
    const auto copy = [&](bool is_wanted, const vulkan::ImageRef& image) -> const void* {
        return is_wanted && image.image != VK_NULL_HANDLE ? self.copies.add(commands, image, 0) : nullptr;
    };
    checkWanted(self.wanted, frame);
    self.masks.clear();
    self.copies.begin(self.bytesFor(frame));
    self.at.drawn = frame.drawn;
    self.at.shown = frame.shown;
    self.at.glow_extent = frame.glow.extent;
    self.at.picture = copy(self.wanted.colour, frame.picture);
    self.at.light = copy(self.wanted.linear, frame.light);
    self.at.glow = copy(self.wanted.glow, frame.glow);
    self.at.depth = copy(self.wanted.geometry, frame.depth);
    self.at.normals = copy(self.wanted.geometry, frame.normals);
    self.at.normal_number = formOf(frame.normals.format).number;
    self.at.ids = copy(self.wanted.geometry, frame.ids);
    self.recordMasks(commands, frame);
    TexelCopies::end(commands);
}

Picture ReadBack::picture() const
{
    const Impl& self = *impl_;
    self.copies.makeVisible();
    Picture picture;
    if (self.at.picture != nullptr) {
        self.readColour(picture);
    }
    if (self.at.light != nullptr) {
        self.readLinear(picture);
    }
    if (self.at.glow != nullptr) {
        self.readGlow(picture);
    }
    self.readMasks(picture);
    if (self.at.depth != nullptr) {
        self.readGeometry(picture);
    }
    return picture;
}

} // namespace gnomon::host
