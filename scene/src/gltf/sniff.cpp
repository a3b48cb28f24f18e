// SPDX-License-Identifier: Apache-2.0
#include "gltf/decode.h"

#include <algorithm>
#include <iterator>
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

Decoder decoderOf(ImageFormat format)
{
    switch (format) {
    case ImageFormat::png:
        return decodePng;
    case ImageFormat::jpeg:
        return decodeJpeg;
    case ImageFormat::webp:
        return decodeWebp;
    default:
        return nullptr;
    }
}

namespace {

struct Name {
    ImageFormat format;
    const char* media_type;
};
constexpr Name kNames[] = {{ImageFormat::png, "image/png"},   {ImageFormat::jpeg, "image/jpeg"},
                           {ImageFormat::webp, "image/webp"}, {ImageFormat::ktx2, "image/ktx2"},
                           {ImageFormat::avif, "image/avif"}, {ImageFormat::dds, "image/vnd-ms.dds"}};

} // namespace

const char* mediaType(ImageFormat format)
{
    const auto* const name =
        std::find_if(std::begin(kNames), std::end(kNames), [&](const Name& n) { return n.format == format; });
    return name != std::end(kNames) ? name->media_type : "";
}

ImageFormat formatNamed(std::string_view media_type)
{
    const auto* const name =
        std::find_if(std::begin(kNames), std::end(kNames), [&](const Name& n) { return n.media_type == media_type; });
    return name != std::end(kNames) ? name->format : ImageFormat::unknown;
}

} // namespace gnomon::scene::gltf
