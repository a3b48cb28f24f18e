// SPDX-License-Identifier: Apache-2.0
// Whatever a PNG's bytes are, they are an image of the size that it says, or an Error.
#include "png_checksums.h"
#include "read_formats.h"

#include <gnomon/error.h>

#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    constexpr std::uint32_t kMaxSide = 256;
    try {
        const gnomon::ImageF image =
            gnomon::decodePng("fuzzed", gnomon::fuzz::withRightChecksums(data, size), kMaxSide);
        if (image.values.size() != std::size_t{image.width} * image.height * image.channels) {
            std::abort();
        }
    } catch (const gnomon::Error&) {
        return 0;
    }
    return 0;
}
