// SPDX-License-Identifier: Apache-2.0
// Whatever a texture's bytes are, PNG, JPEG or WebP, they are texels or a sentence that says why not.
#include "gltf/decode.h"
#include "png_checksums.h"

#include <cstdlib>
#include <span>
#include <stdexcept>

namespace {

struct TooLarge : std::runtime_error {
    using std::runtime_error::runtime_error;
};

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    namespace gltf = gnomon::scene::gltf;
    constexpr std::uint32_t kMaxSide = 256;
    const gltf::SizeCheck check = [](std::uint32_t width, std::uint32_t height) {
        if (width > kMaxSide || height > kMaxSide) {
            throw TooLarge("over the limit"); // as a scene's limit would
        }
    };
    const gltf::ImageFormat format = gltf::sniff(std::as_bytes(std::span(data, size)));
    const bool png = format == gltf::ImageFormat::png;
    const gltf::Decoder known = gltf::decoderOf(format);
    const gltf::Decoder decoder = known != nullptr ? known : gltf::decodeJpeg;
    const std::string bytes =
        png ? gnomon::fuzz::withRightChecksums(data, size) : std::string(reinterpret_cast<const char*>(data), size);
    gnomon::scene::Image image;
    try {
        const std::string wrong = decoder(std::as_bytes(std::span(bytes)), check, image);
        if (wrong.empty() && image.rgba.size() != std::size_t{image.width} * image.height * 4) {
            std::abort();
        }
    } catch (const TooLarge&) {
        return 0;
    }
    return 0;
}
