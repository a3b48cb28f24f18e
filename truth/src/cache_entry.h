// SPDX-License-Identifier: Apache-2.0
// The bytes of one entry of the cache: a header, a checksum of everything else, and seven images, packed.
//
// A packed image is one bit per pixel, in order from the top (bit i % 8 of byte i / 8), which says whether the pixel
// differs from the one before it (the first: from zero bits), and then the pixels that differ. Most of a truth's 44
// bytes per pixel repeat: whole triangles have one normal, whole surfaces are lit, and hard truths have no error.
// Numbers lie as they do in memory; the magic number of a machine with another byte order is another.
#pragma once

#include "truth/cache.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace gnomon::truth {

inline constexpr std::uint32_t kMaxCachedSide = 16384;

/// Free of padding, so that its bytes are all defined.
struct EntryHeader {
    std::uint64_t magic = 0;
    std::uint32_t format_version = 0;
    std::uint32_t kind = 0;
    scene::Hash128 key;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint64_t rays = 0;
    double seconds = 0.0;
    std::uint64_t payload_bytes = 0;
    scene::Hash128 checksum; // the checksum of the header up to here, and of the payload
};
inline constexpr std::size_t kEntryHeaderBytes = 80;
static_assert(sizeof(EntryHeader) == kEntryHeaderBytes);

/// The facts that an entry must have.
struct EntryOf {
    scene::Hash128 key;
    glm::uvec2 size_px{0};
    Kind kind = Kind::area;
};

/// Nothing when the images' sizes do not fit together, are empty or above kMaxCachedSide, or a value is none that a
/// truth has.
[[nodiscard]] std::optional<std::string> encodeEntry(const scene::Hash128& key, const Traced& traced);

/// The header at the start of a file of `file_bytes` bytes; nothing unless it is `asked` in this format and
/// all its sizes agree with the file's. Takes no memory, whatever the header says.
[[nodiscard]] std::optional<EntryHeader> parseHeader(std::string_view bytes, std::uint64_t file_bytes,
                                                     const EntryOf& asked);

/// Nothing when the checksum is wrong, the payload is not what the header says or a value is none that a truth has.
[[nodiscard]] std::optional<Traced> decodePayload(const EntryHeader& header, std::string_view payload);

} // namespace gnomon::truth
