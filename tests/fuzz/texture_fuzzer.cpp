// SPDX-License-Identifier: Apache-2.0
// Whatever a texture's bytes are, PNG or JPEG, they are texels or a sentence that says why not.
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
    const bool png = gltf::sniff(std::as_bytes(std::span(data, size))) == gltf::ImageFormat::png;
    const std::string bytes =
        png ? gnomon::fuzz::withRightChecksums(data, size) : std::string(reinterpret_cast<const char*>(data), size);
    gnomon::scene::Image image;
    try {
        const std::string wrong = png ? gltf::decodePng(std::as_bytes(std::span(bytes)), check, image)
                                      : gltf::decodeJpeg(std::as_bytes(std::span(bytes)), check, image);
        if (wrong.empty() && image.rgba.size() != std::size_t{image.width} * image.height * 4) {
            std::abort();
        }
    } catch (const TooLarge&) {
        return 0;
    }
    return 0;
}
