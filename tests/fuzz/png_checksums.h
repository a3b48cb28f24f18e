// SPDX-License-Identifier: Apache-2.0
// Checksums keep a fuzzer out: of a PNG that it bent, they are made right again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <zlib.h>

namespace gnomon::fuzz {

/// The same bytes with the right CRC after every whole chunk.
inline std::string withRightChecksums(const std::uint8_t* data, std::size_t size)
{
    constexpr std::size_t kSignature = 8;
    constexpr std::size_t kAroundData = 12; // length and type before, CRC behind
    std::string bytes(reinterpret_cast<const char*>(data), size);
    const auto byteAt = [&](std::size_t at) {
        return static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at]));
    };
    for (std::size_t at = kSignature; at + kAroundData <= size;) {
        const std::uint32_t length = byteAt(at) << 24U | byteAt(at + 1) << 16U | byteAt(at + 2) << 8U | byteAt(at + 3);
        if (length > size - at - kAroundData) {
            break;
        }
        const std::size_t end = at + 8 + length;
        const uLong crc = crc32(0, reinterpret_cast<const Bytef*>(bytes.data() + at + 4), length + 4);
        for (std::size_t i = 0; i < 4; ++i) {
            bytes[end + i] = static_cast<char>(crc >> (24U - 8U * i) & 0xFFU);
        }
        at = end + 4;
    }
    return bytes;
}

} // namespace gnomon::fuzz
