// SPDX-License-Identifier: Apache-2.0
#include "gltf/decode.h"

#include <webp/decode.h>

namespace gnomon::scene::gltf {

std::string decodeWebp(std::span<const std::byte> bytes, const SizeCheck& check, Image& image)
{
    const auto* const data = reinterpret_cast<const std::uint8_t*>(bytes.data());
    WebPBitstreamFeatures features;
    if (WebPGetFeatures(data, bytes.size(), &features) != VP8_STATUS_OK) {
        return "no header of a WebP image";
    }
    if (features.has_animation != 0) {
        return "an animation, which glTF does not allow";
    }
    const auto width = static_cast<std::uint32_t>(features.width);
    const auto height = static_cast<std::uint32_t>(features.height);
    check(width, height); // its sides have 14 bits, and any number of equal texels takes a few bytes
    image.rgba.assign(std::size_t{width} * height * 4, 0);
    image.width = width;
    image.height = height;
    const bool decoded =
        WebPDecodeRGBAInto(data, bytes.size(), image.rgba.data(), image.rgba.size(), features.width * 4) != nullptr;
    return decoded ? std::string() : std::string("damaged data, or data that end early");
}

} // namespace gnomon::scene::gltf
