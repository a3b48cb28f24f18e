// SPDX-License-Identifier: Apache-2.0
#include "targets.h"

namespace gnomon::host {
namespace {

constexpr VkImageUsageFlags kSampledColour = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;

Image make(Memory& memory, const char* name, VkFormat format, VkExtent2D extent, VkImageUsageFlags usage)
{
    ImageWish wish;
    wish.name = name;
    wish.purpose = "host pictures";
    wish.format = format;
    wish.extent = extent;
    wish.usage = usage | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    return memory.image(wish);
}

} // namespace

Targets::Targets(Memory& memory, VkExtent2D drawn_size, VkExtent2D shown_size, bool with_toned)
    : drawn(drawn_size), shown(shown_size)
{
    depth = make(memory, "depth", kDepthFormat, drawn,
                 VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT);
    light = make(memory, "light", kLightFormat, drawn, kSampledColour);
    if (with_toned) {
        toned = make(memory, "toned", kPictureFormat, shown, kSampledColour);
    }
    picture = make(memory, "picture", kPictureFormat, shown, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT);
}

void Targets::needGBuffer(Memory& memory, const GBufferFormats& formats, const GBufferShape& shape)
{
    constexpr std::array<const char*, std::tuple_size_v<GBufferFormats>> kNames{"surfaces", "normals", "receivers",
                                                                                "smooth surfaces"};
    for (std::size_t i = 0; i < shape.count(); ++i) {
        const std::size_t which = shape.image(i);
        if (gbuffer[which].handle == VK_NULL_HANDLE) {
            gbuffer[which] = make(memory, kNames[which], formats[which], drawn, kSampledColour);
        }
    }
}

} // namespace gnomon::host
