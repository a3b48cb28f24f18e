// SPDX-License-Identifier: Apache-2.0
#include "cache_entry.h"

#include <bit>
#include <cstring>
#include <limits>
#include <span>

namespace gnomon::truth {
namespace {

constexpr std::uint64_t kMagic = 0x31485452'4D4F4E47ULL; // "GNOMTRH1" on a little-endian machine
constexpr std::uint32_t kFormatVersion = 2;
constexpr std::uint64_t kImages = 8;
constexpr std::uint64_t kBytesPerPixel = 56; // all images together: five numbers and thrice xyz, 4 bytes each
constexpr std::uint64_t kBitsPerByte = 8;

std::uint64_t maskBytes(std::uint64_t pixels)
{
    return (pixels + kBitsPerByte - 1) / kBitsPerByte;
}

template <typename T>
std::size_t pixelBytes(const ImageOf<T>& image)
{
    return image.channels * sizeof(T);
}

/// Calls `visit` with every image of `traced` and the channels that it must have, in the order of the file.
template <typename AnyTraced, typename Visit>
void visitImages(AnyTraced& traced, Visit visit)
{
    visit(traced.surfaces.object_ids, 1U);
    visit(traced.surfaces.triangle_ids, 1U);
    visit(traced.surfaces.points, 3U);
    visit(traced.surfaces.normals, 3U);
    visit(traced.surfaces.smooth_normals, 3U);
    visit(traced.visibility.visibility, 1U);
    visit(traced.visibility.standard_error, 1U);
    visit(traced.visibility.first_blocker_m, 1U);
}

bool fitsTogether(const Traced& traced)
{
    const std::uint32_t width = traced.surfaces.object_ids.width;
    const std::uint32_t height = traced.surfaces.object_ids.height;
    bool fits = width >= 1 && height >= 1 && width <= kMaxCachedSide && height <= kMaxCachedSide;
    visitImages(traced, [&](const auto& image, std::uint32_t channels) {
        fits = fits && image.width == width && image.height == height && image.channels == channels &&
               image.values.size() == std::size_t{width} * height * channels;
    });
    return fits;
}

/// Whether every value v of `image` has low <= v <= high, which NaN has not. Without a branch in the loop, so that it
/// takes several at a time.
bool allWithin(const ImageF& image, float low, float high)
{
    unsigned outside = 0;
    for (const float value : image.values) {
        outside |= static_cast<unsigned>(!(value >= low)) | static_cast<unsigned>(!(value <= high));
    }
    return outside == 0;
}

bool hasValuesOfATruth(const Traced& traced)
{
    constexpr float kLargest = std::numeric_limits<float>::max();
    constexpr float kLongestAxis = 1.0F + 0x1p-20F; // the largest axis of a unit vector, after rounding
    const Visibility& visibility = traced.visibility;
    return visibility.seconds >= 0.0 && visibility.seconds <= std::numeric_limits<double>::max() &&
           allWithin(traced.surfaces.points, -kLargest, kLargest) &&
           allWithin(traced.surfaces.normals, -kLongestAxis, kLongestAxis) &&
           allWithin(traced.surfaces.smooth_normals, -kLongestAxis, kLongestAxis) &&
           allWithin(visibility.visibility, 0.0F, 1.0F) && allWithin(visibility.standard_error, 0.0F, 1.0F) &&
           allWithin(visibility.first_blocker_m, 0.0F, std::numeric_limits<float>::infinity());
}

template <typename T>
void pack(std::string& out, const ImageOf<T>& image)
{
    const std::size_t size = pixelBytes(image);
    const std::size_t pixels = image.values.size() / image.channels;
    const char* const values = reinterpret_cast<const char*>(image.values.data());
    const std::size_t mask_at = out.size();
    out.resize(mask_at + maskBytes(pixels), '\0');
    const std::string zero(size, '\0');
    const char* before = zero.data();
    for (std::size_t i = 0; i < pixels; ++i) {
        const char* const now = values + i * size;
        if (std::memcmp(now, before, size) != 0) {
            out[mask_at + i / kBitsPerByte] |= static_cast<char>(1U << (i % kBitsPerByte));
            out.append(now, size);
        }
        before = now;
    }
}

/// Fills `image` from the front of `bytes`, which it takes away. False when there are too few, or bits beyond the
/// image.
template <typename T>
bool unpack(std::string_view& bytes, ImageOf<T>& image)
{
    const std::size_t size = pixelBytes(image);
    const std::size_t pixels = image.values.size() / image.channels;
    if (bytes.size() < maskBytes(pixels)) {
        return false;
    }
    const std::string_view mask = bytes.substr(0, maskBytes(pixels));
    bytes.remove_prefix(mask.size());
    std::size_t differing = 0;
    for (const char byte : mask) {
        differing += static_cast<std::size_t>(std::popcount(static_cast<unsigned char>(byte)));
    }
    const bool surplus_bits =
        pixels % kBitsPerByte != 0 && (static_cast<unsigned char>(mask.back()) >> (pixels % kBitsPerByte)) != 0;
    if (surplus_bits || bytes.size() / size < differing) {
        return false;
    }
    char* to = reinterpret_cast<char*>(image.values.data());
    const std::string zero(size, '\0');
    const char* value = zero.data();
    const char* next = bytes.data();
    for (std::size_t i = 0; i < pixels; ++i, to += size) {
        if (((static_cast<unsigned char>(mask[i / kBitsPerByte]) >> (i % kBitsPerByte)) & 1U) != 0) {
            value = next;
            next += size;
        }
        std::memcpy(to, value, size);
    }
    bytes.remove_prefix(differing * size);
    return true;
}

scene::Hash128 checksumOf(const EntryHeader& header, std::string_view payload)
{
    scene::Hasher hasher;
    hasher.addBytes(std::as_bytes(std::span(&header, 1)).first(offsetof(EntryHeader, checksum)));
    hasher.addBytes(std::as_bytes(std::span(payload)));
    return hasher.value();
}

} // namespace

std::optional<std::string> encodeEntry(const scene::Hash128& key, const Traced& traced)
{
    if (!fitsTogether(traced) || !hasValuesOfATruth(traced)) {
        return std::nullopt;
    }
    EntryHeader header;
    header.magic = kMagic;
    header.format_version = kFormatVersion;
    header.kind = static_cast<std::uint32_t>(traced.visibility.kind);
    header.key = key;
    header.width = traced.surfaces.object_ids.width;
    header.height = traced.surfaces.object_ids.height;
    header.rays = traced.visibility.rays;
    header.seconds = traced.visibility.seconds;
    std::string bytes(kEntryHeaderBytes, '\0');
    visitImages(traced, [&](const auto& image, std::uint32_t /*channels*/) { pack(bytes, image); });
    header.payload_bytes = bytes.size() - kEntryHeaderBytes;
    header.checksum = checksumOf(header, std::string_view(bytes).substr(kEntryHeaderBytes));
    std::memcpy(bytes.data(), &header, sizeof(header));
    return bytes;
}

std::optional<EntryHeader> parseHeader(std::string_view bytes, std::uint64_t file_bytes, const EntryOf& asked)
{
    EntryHeader header;
    if (bytes.size() < sizeof(header) || file_bytes < sizeof(header)) {
        return std::nullopt;
    }
    std::memcpy(&header, bytes.data(), sizeof(header));
    const bool ours = header.magic == kMagic && header.format_version == kFormatVersion && header.key == asked.key;
    const bool as_asked = header.kind == static_cast<std::uint32_t>(asked.kind) && header.width == asked.size_px.x &&
                          header.height == asked.size_px.y;
    const bool sides =
        header.width >= 1 && header.width <= kMaxCachedSide && header.height >= 1 && header.height <= kMaxCachedSide;
    if (!ours || !as_asked || !sides || header.payload_bytes != file_bytes - sizeof(header)) {
        return std::nullopt;
    }
    // The unpacked images are thus at most some fifty times the file.
    const std::uint64_t pixels = std::uint64_t{header.width} * header.height;
    const std::uint64_t masks = kImages * maskBytes(pixels);
    if (header.payload_bytes < masks || header.payload_bytes > masks + kBytesPerPixel * pixels) {
        return std::nullopt;
    }
    return header;
}

std::optional<Traced> decodePayload(const EntryHeader& header, std::string_view payload)
{
    if (payload.size() != header.payload_bytes || checksumOf(header, payload) != header.checksum) {
        return std::nullopt;
    }
    Traced traced;
    bool whole = true;
    visitImages(traced, [&](auto& image, std::uint32_t channels) {
        image = {header.width, header.height, channels};
        whole = whole && unpack(payload, image);
    });
    if (!whole || !payload.empty()) {
        return std::nullopt;
    }
    traced.visibility.kind = static_cast<Kind>(header.kind);
    traced.visibility.rays = header.rays;
    traced.visibility.seconds = header.seconds;
    if (!hasValuesOfATruth(traced)) {
        return std::nullopt;
    }
    return traced;
}

} // namespace gnomon::truth
