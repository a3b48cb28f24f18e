// SPDX-License-Identifier: Apache-2.0
#include "targets.h"

namespace gnomon::host {

Targets::Targets(Memory& memory, VkExtent2D drawn_size, VkExtent2D shown_size, bool with_toned)
    : drawn(drawn_size), shown(shown_size)
{
    const auto make = [&memory](const char* name, VkFormat format, VkExtent2D extent, VkImageUsageFlags usage) {
        ImageWish wish;
        wish.name = name;
        wish.purpose = "host pictures";
        wish.format = format;
        wish.extent = extent;
        wish.usage = usage | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
        return memory.image(wish);
    };
    constexpr VkImageUsageFlags kSampledColour = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    depth =
        make("depth", kDepthFormat, drawn, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT);
    constexpr std::array<const char*, kGBufferFormats.size()> kNames{"base colour", "normals", "material", "object ids",
                                                                     "smooth surfaces"};
    for (std::size_t i = 0; i < gbuffer.size(); ++i) {
        gbuffer[i] = make(kNames[i], kGBufferFormats[i], drawn, kSampledColour);
    }
    light = make("light", kLightFormat, drawn, kSampledColour);
    if (with_toned) {
        toned = make("toned", kPictureFormat, shown, kSampledColour);
    }
    picture = make("picture", kPictureFormat, shown, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT);
}

} // namespace gnomon::host
