// SPDX-License-Identifier: Apache-2.0
#include "gltf/decode.h"

#include <png.h>

#include <csetjmp>
#include <cstdio>
#include <cstring>

namespace gnomon::scene::gltf {

namespace {

/// Plain data, because longjmp skips destructors.
struct PngReader {
    png_structp png = nullptr;
    png_infop info = nullptr;
    const std::byte* at = nullptr;
    std::size_t left = 0;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    char message[160] = {};
};

void onError(png_structp png, png_const_charp message)
{
    auto* reader = static_cast<PngReader*>(png_get_error_ptr(png));
    std::snprintf(reader->message, sizeof reader->message, "%s", message);
    std::longjmp(png_jmpbuf(png), 1);
}

void onWarning(png_structp /*png*/, png_const_charp /*message*/) {}

void onRead(png_structp png, png_bytep out, png_size_t size)
{
    auto* reader = static_cast<PngReader*>(png_get_io_ptr(png));
    if (size > reader->left) {
        png_error(png, "the data end early");
    }
    std::memcpy(out, reader->at, size);
    reader->at += size;
    reader->left -= size;
}

/// Reads up to the pixels and asks for 8-bit RGBA. Colour space chunks are left alone: glTF says to ignore them.
bool readHeader(PngReader& reader)
{
    if (setjmp(png_jmpbuf(reader.png)) != 0) {
        return false;
    }
    png_set_read_fn(reader.png, &reader, onRead);
    constexpr png_alloc_size_t kLargestChunk = 1U << 20;
    png_set_chunk_malloc_max(reader.png, kLargestChunk);
    png_set_user_limits(reader.png, 0x7FFFFFFF, 0x7FFFFFFF); // our own limit is checked with a better message
    png_read_info(reader.png, reader.info);
    reader.width = png_get_image_width(reader.png, reader.info);
    reader.height = png_get_image_height(reader.png, reader.info);
    png_set_expand(reader.png);
    png_set_scale_16(reader.png);
    png_set_gray_to_rgb(reader.png);
    png_set_add_alpha(reader.png, 0xFF, PNG_FILLER_AFTER);
    return true;
}

bool readPixels(PngReader& reader, std::uint8_t* rgba)
{
    if (setjmp(png_jmpbuf(reader.png)) != 0) {
        return false;
    }
    const int passes = png_set_interlace_handling(reader.png);
    png_read_update_info(reader.png, reader.info);
    const std::size_t row_bytes = std::size_t{reader.width} * 4;
    if (png_get_rowbytes(reader.png, reader.info) != row_bytes) {
        png_error(reader.png, "unexpected row size");
    }
    for (int pass = 0; pass < passes; ++pass) {
        for (std::uint32_t y = 0; y < reader.height; ++y) {
            png_read_row(reader.png, rgba + y * row_bytes, nullptr);
        }
    }
    png_read_end(reader.png, nullptr);
    return true;
}

} // namespace

std::string decodePng(std::span<const std::byte> bytes, const SizeCheck& check, Image& image)
{
    PngReader reader;
    reader.at = bytes.data();
    reader.left = bytes.size();
    struct Closer {
        PngReader& reader;
        ~Closer() { png_destroy_read_struct(&reader.png, &reader.info, nullptr); }
    } const closer{reader};
    reader.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &reader, onError, onWarning);
    reader.info = reader.png != nullptr ? png_create_info_struct(reader.png) : nullptr;
    if (reader.info == nullptr) {
        return "libpng could not be started";
    }
    if (!readHeader(reader)) {
        return reader.message;
    }
    check(reader.width, reader.height);
    // Deflate makes at most 1032 of a byte, of which the sparsest rows hold eight texels each.
    constexpr std::uint64_t kMaxTexelsOfByte = 1032 * 8;
    if (std::uint64_t{reader.width} * reader.height > bytes.size() * kMaxTexelsOfByte) {
        return "too few bytes for " + std::to_string(reader.width) + "x" + std::to_string(reader.height);
    }
    image.rgba.assign(std::size_t{reader.width} * reader.height * 4, 0);
    image.width = reader.width;
    image.height = reader.height;
    return readPixels(reader, image.rgba.data()) ? std::string() : std::string(reader.message);
}

} // namespace gnomon::scene::gltf
