// SPDX-License-Identifier: Apache-2.0
// Whatever an EXR's bytes are, they are an image of the size that it says, or an Error.
#include "read_formats.h"

#include <gnomon/error.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    constexpr std::uint32_t kMaxSide = 256;
    try {
        const gnomon::ImageF image = gnomon::decodeExr("fuzzed", {reinterpret_cast<const char*>(data), size}, kMaxSide);
        if (image.values.size() != std::size_t{image.width} * image.height * image.channels) {
            std::abort();
        }
    } catch (const gnomon::Error&) {
        return 0;
    }
    return 0;
}
