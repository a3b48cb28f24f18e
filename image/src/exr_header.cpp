// SPDX-License-Identifier: Apache-2.0
// Based on: Academy Software Foundation, "OpenEXR File Layout", 2022. OpenEXR trusts the type of an attribute before
// its size, so both must agree here, or the two would read on at different places.
#include "exr_header.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace gnomon {
namespace {

struct FixedSize {
    std::string_view type;
    std::uint32_t bytes;
};
constexpr FixedSize kFixedSizes[] = {
    {"box2f", 16},
    {"box2i", 16},
    {"chromaticities", 32},
    {"compression", 1},
    {"deepImageState", 1},
    {"double", 8},
    {"envmap", 1},
    {"float", 4},
    {"int", 4},
    {"keycode", 28},
    {"lineOrder", 1},
    {"m33d", 72},
    {"m33f", 36},
    {"m44d", 128},
    {"m44f", 64},
    {"rational", 8},
    {"tiledesc", 9},
    {"timecode", 8},
    {"v2d", 16},
    {"v2f", 8},
    {"v2i", 8},
    {"v3d", 24},
    {"v3f", 12},
    {"v3i", 12},
};

class Bytes {
public:
    explicit Bytes(std::string_view bytes) : bytes_(bytes) {}

    [[nodiscard]] bool empty() const { return bytes_.empty(); }
    [[nodiscard]] std::string_view take(std::uint64_t count)
    {
        if (count > bytes_.size()) {
            throw std::runtime_error("its header goes on beyond the file");
        }
        const std::string_view taken = bytes_.substr(0, count);
        bytes_.remove_prefix(count);
        return taken;
    }
    [[nodiscard]] std::uint32_t word()
    {
        std::uint32_t value = 0;
        const std::string_view four = take(4);
        for (std::size_t i = 0; i < 4; ++i) {
            value |= static_cast<std::uint32_t>(static_cast<unsigned char>(four[i])) << (8U * i);
        }
        return value;
    }
    [[nodiscard]] std::string_view name()
    {
        constexpr std::size_t kLongestName = 255;
        const std::size_t length = bytes_.substr(0, kLongestName + 1).find('\0');
        if (length == std::string_view::npos) {
            throw std::runtime_error("a name in its header has no end");
        }
        const std::string_view text = take(length);
        static_cast<void>(take(1));
        return text;
    }

private:
    std::string_view bytes_;
};

/// The parts of one header that decide how much memory its image takes.
struct Image {
    std::uint64_t width = 0;
    std::uint64_t height = 0;
    std::uint64_t tile_texels = 0;
    std::uint64_t pixel_bytes = 0; // bytes of all channels
    unsigned compression = 0;
};

[[noreturn]] void refuse(std::string_view attribute)
{
    throw std::runtime_error("the attribute " + std::string(attribute) + " of its header has the wrong size");
}

std::uint64_t bytesOfChannels(Bytes list)
{
    std::uint64_t bytes = 0;
    while (!list.name().empty()) {
        constexpr std::uint32_t kHalf = 1;
        bytes += list.word() == kHalf ? 2U : 4U;
        static_cast<void>(list.take(12)); // is it linear, how is it sampled
    }
    if (!list.empty()) {
        throw std::runtime_error("its list of channels has the wrong size");
    }
    return bytes;
}

void checkVariable(std::string_view name, std::string_view type, Bytes value, std::uint64_t size)
{
    if (type == "preview") {
        const std::uint64_t width = value.word();
        const std::uint64_t height = value.word();
        if (width > size || height > size || width * height * 4 + 8 != size) {
            refuse(name);
        }
    } else if (type == "stringvector") {
        while (!value.empty()) {
            static_cast<void>(value.take(value.word()));
        }
    } else if (type == "floatvector" && size % 4 != 0) {
        refuse(name);
    } else if (type == "idmanifest") { // OpenEXR 3.1 takes four bytes more than its size, and reads on in the middle
        throw std::runtime_error("the attribute " + std::string(name) + " of its header is an ID manifest");
    }
}

void takeAttribute(std::string_view name, std::string_view type, Bytes value, Image& image, std::uint32_t max_side)
{
    if (name == "dataWindow") {
        std::int64_t corners[4];
        for (std::int64_t& corner : corners) {
            corner = static_cast<std::int32_t>(value.word());
        }
        const std::int64_t width = corners[2] - corners[0] + 1;
        const std::int64_t height = corners[3] - corners[1] + 1;
        if (width < 1 || height < 1 || width > max_side || height > max_side) {
            throw std::runtime_error("the image is empty, or wider or higher than the limit of " +
                                     std::to_string(max_side));
        }
        image.width = static_cast<std::uint64_t>(width);
        image.height = static_cast<std::uint64_t>(height);
    } else if (type == "chlist") {
        image.pixel_bytes += bytesOfChannels(value);
    } else if (name == "tiles") {
        const std::uint64_t width = value.word();
        const std::uint64_t height = value.word();
        if (width < 1 || height < 1 || width > max_side || height > max_side) {
            throw std::runtime_error("its tiles are empty, or wider or higher than the limit of " +
                                     std::to_string(max_side));
        }
        image.tile_texels = width * height;
    } else if (name == "compression") {
        image.compression = static_cast<unsigned char>(value.take(1).front());
    }
}

/// Refuses an image too large for a file of that size under any compression of the format, before memory is taken.
void checkProportion(const Image& image, std::uint64_t file_bytes)
{
    constexpr unsigned kLinesOfBlock[] = {1, 1, 1, 16, 32, 16, 32, 32, 32, 256}; // by the number of the compression
    constexpr unsigned kDwaa = 8;
    const std::uint64_t lines = kLinesOfBlock[std::min<std::size_t>(image.compression, 9)];
    // Deflate makes 1032 bytes of one, and PXR24 leaves out one of four first. DWA ends a block of 64 halves with one
    // half, and deflates that.
    const std::uint64_t expansion = image.compression >= kDwaa ? 66048 : 1376;
    constexpr std::uint64_t kAlways = 16U << 20U; // a block of lines or a tile is made whole, however small the image
    const std::uint64_t pixels = std::max(image.width * std::max(image.height, lines), image.tile_texels);
    if (image.pixel_bytes > file_bytes || pixels * image.pixel_bytes > kAlways + expansion * file_bytes) {
        throw std::runtime_error("too few bytes for " + std::to_string(image.width) + "x" +
                                 std::to_string(image.height));
    }
}

} // namespace

void checkExrHeaders(std::string_view bytes, std::uint32_t max_side)
{
    constexpr std::uint32_t kDeep = 0x800;
    constexpr std::uint32_t kManyParts = 0x1000;
    Bytes rest(bytes);
    static_cast<void>(rest.word()); // the magic number
    const std::uint32_t version = rest.word();
    if ((version & kDeep) != 0) {
        throw std::runtime_error("its data are deep");
    }
    do {
        Image image;
        std::string_view name = rest.name();
        if (name.empty()) { // after the last part
            break;
        }
        for (; !name.empty(); name = rest.name()) {
            const std::string_view type = rest.name();
            const std::uint32_t size = rest.word();
            const Bytes value(rest.take(size));
            const auto* fixed = std::find_if(std::begin(kFixedSizes), std::end(kFixedSizes),
                                             [&](const FixedSize& one) { return one.type == type; });
            if (fixed != std::end(kFixedSizes) && fixed->bytes != size) {
                refuse(name);
            }
            checkVariable(name, type, value, size);
            if (name == "chunkCount" && Bytes(value).word() > bytes.size() / 8) {
                throw std::runtime_error("it has fewer chunks than its header says");
            }
            takeAttribute(name, type, value, image, max_side);
        }
        checkProportion(image, bytes.size());
    } while ((version & kManyParts) != 0);
}

} // namespace gnomon
