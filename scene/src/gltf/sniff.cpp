// SPDX-License-Identifier: Apache-2.0
#include "gltf/decode.h"

#include <cstring>
#include <string_view>

namespace gnomon::scene::gltf {

ImageFormat sniff(std::span<const std::byte> bytes)
{
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (text.starts_with("\x89PNG\r\n\x1a\n")) {
        return ImageFormat::png;
    }
    if (text.starts_with("\xFF\xD8\xFF")) {
        return ImageFormat::jpeg;
    }
    if (text.starts_with("RIFF") && text.size() >= 12 && text.substr(8, 4) == "WEBP") {
        return ImageFormat::webp;
    }
    if (text.starts_with("\xABKTX 20\xBB\r\n\x1A\n")) {
        return ImageFormat::ktx2;
    }
    if (text.size() >= 12 && text.substr(4, 8) == "ftypavif") {
        return ImageFormat::avif;
    }
    return text.starts_with("DDS ") ? ImageFormat::dds : ImageFormat::unknown;
}

const char* mediaType(ImageFormat format)
{
    switch (format) {
    case ImageFormat::png:
        return "image/png";
    case ImageFormat::jpeg:
        return "image/jpeg";
    case ImageFormat::webp:
        return "image/webp";
    case ImageFormat::ktx2:
        return "image/ktx2";
    case ImageFormat::avif:
        return "image/avif";
    case ImageFormat::dds:
        return "image/vnd-ms.dds";
    case ImageFormat::unknown:
        break;
    }
    return "";
}

} // namespace gnomon::scene::gltf
