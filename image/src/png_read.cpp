// SPDX-License-Identifier: Apache-2.0
#include "read_formats.h"

#include <gnomon/error.h>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <png.h>
#include <vector>

namespace gnomon {
namespace {

struct Source {
    std::string_view bytes;
    std::array<char, 160> problem{}; // no string: an exception must not cross libpng's frames
};

void take(png_structp png, png_bytep data, png_size_t size)
{
    auto* source = static_cast<Source*>(png_get_io_ptr(png));
    if (size > source->bytes.size()) {
        png_error(png, "the file ends too early");
    }
    std::memcpy(data, source->bytes.data(), size);
    source->bytes.remove_prefix(size);
}

void onError(png_structp png, png_const_charp message)
{
    auto& problem = static_cast<Source*>(png_get_error_ptr(png))->problem;
    std::snprintf(problem.data(), problem.size(), "%s", message);
    png_longjmp(png, 1);
}

void onWarning(png_structp, png_const_charp) {}

/// libpng's two structs, freed in every case.
struct Reader {
    png_structp png = nullptr;
    png_infop info = nullptr;

    explicit Reader(Source& source) : png(png_create_read_struct(PNG_LIBPNG_VER_STRING, &source, onError, onWarning))
    {
        if (png != nullptr) {
            info = png_create_info_struct(png);
        }
    }
    ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;
};

/// The header, and the transforms that make every PNG 8- or 16-bit grey, grey-alpha, RGB or RGBA. Jumps stay inside.
bool readHeader(Reader& reader, Source& source, std::uint32_t max_side)
{
    if (reader.info == nullptr || setjmp(png_jmpbuf(reader.png)) != 0) {
        return false;
    }
    png_set_read_fn(reader.png, &source, take);
    png_set_user_limits(reader.png, max_side, max_side);
    constexpr png_alloc_size_t kMaxChunkBytes = 8U << 20U;
    png_set_chunk_malloc_max(reader.png, kMaxChunkBytes);
    png_read_info(reader.png, reader.info);
    png_set_expand(reader.png); // palettes, 1 to 4 bits, tRNS to alpha
    png_set_interlace_handling(reader.png);
    png_read_update_info(reader.png, reader.info);
    return true;
}

/// libpng says "Invalid IHDR data" of a size beyond its limits; people want to read the limit. The two sides are the
/// first numbers of the first chunk, at fixed places.
bool exceeds(std::string_view bytes, std::uint32_t max_side)
{
    const auto number = [&](std::size_t place) {
        std::uint32_t value = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            value = value << 8U | static_cast<unsigned char>(bytes[place + i]);
        }
        return value;
    };
    return bytes.size() >= 24 && (number(16) > max_side || number(20) > max_side);
}

bool readRows(Reader& reader, png_bytepp rows)
{
    if (setjmp(png_jmpbuf(reader.png)) != 0) {
        return false;
    }
    png_read_image(reader.png, rows);
    png_read_end(reader.png, nullptr);
    return true;
}

} // namespace

bool looksLikePng(std::string_view bytes)
{
    constexpr std::size_t kSignature = 8;
    return bytes.size() >= kSignature &&
           png_sig_cmp(reinterpret_cast<png_const_bytep>(bytes.data()), 0, kSignature) == 0;
}

ImageF decodePng(const std::string& name, std::string_view bytes, std::uint32_t max_side)
{
    Source source{bytes, {}};
    Reader reader(source);
    const auto refuse = [&](const std::string& why) {
        throw Error("reading " + name, why);
    };
    if (exceeds(bytes, max_side)) {
        refuse("the image is wider or higher than the limit of " + std::to_string(max_side));
    }
    if (!readHeader(reader, source, max_side)) {
        refuse(std::string("not a valid PNG: ") + source.problem.data());
    }
    const std::uint32_t width = png_get_image_width(reader.png, reader.info);
    const std::uint32_t height = png_get_image_height(reader.png, reader.info);
    const std::uint32_t channels = png_get_channels(reader.png, reader.info);
    const bool is_16_bit = png_get_bit_depth(reader.png, reader.info) == 16;
    const std::size_t row_bytes = png_get_rowbytes(reader.png, reader.info);
    // Deflate cannot expand by more than 1032; a palette or fewer bits by 32 on top. Memory is only taken for what the
    // file can really hold.
    constexpr std::uint64_t kMaxExpansion = 1032ULL * 32ULL;
    if (row_bytes * static_cast<std::uint64_t>(height) > bytes.size() * kMaxExpansion) {
        refuse("not a valid PNG: too few bytes for " + std::to_string(width) + "x" + std::to_string(height));
    }
    std::vector<png_byte> pixels(row_bytes * height);
    std::vector<png_bytep> rows(height);
    for (std::uint32_t y = 0; y < height; ++y) {
        rows[y] = pixels.data() + row_bytes * y;
    }
    if (!readRows(reader, rows.data())) {
        refuse(std::string("not a valid PNG: ") + source.problem.data());
    }
    ImageF image(width, height, channels);
    for (std::size_t i = 0; i < image.values.size(); ++i) {
        image.values[i] = is_16_bit ? static_cast<float>(pixels[2 * i] * 256 + pixels[2 * i + 1]) / 65535.0F
                                    : static_cast<float>(pixels[i]) / 255.0F;
    }
    return image;
}

} // namespace gnomon
