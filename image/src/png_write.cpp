// SPDX-License-Identifier: Apache-2.0
#include "files/files.h"
#include "image/image_io.h"

#include <gnomon/error.h>

#include <array>
#include <bit>
#include <csetjmp>
#include <cstdio>
#include <exception>
#include <png.h>
#include <string>
#include <utility>
#include <vector>

namespace gnomon {
namespace {

struct Sink {
    std::string bytes;
    bool full = false; // no memory for more bytes
    std::array<char, 160> problem{};
};

void append(png_structp png, png_bytep data, png_size_t size)
{
    auto* sink = static_cast<Sink*>(png_get_io_ptr(png));
    try {
        sink->bytes.append(reinterpret_cast<const char*>(data), size);
    } catch (const std::exception&) {
        sink->full = true; // an exception must not cross libpng's frames
    }
    if (sink->full) {
        png_error(png, "out of memory");
    }
}

void flushNothing(png_structp) {}

void onError(png_structp png, png_const_charp message)
{
    auto& problem = static_cast<Sink*>(png_get_error_ptr(png))->problem;
    std::snprintf(problem.data(), problem.size(), "%s", message);
    png_longjmp(png, 1);
}

void onWarning(png_structp, png_const_charp) {}

struct Layout {
    std::uint32_t width;
    std::uint32_t height;
    int bits;
    int colour_type;
    bool srgb;
    bool linear;
    const png_bytep* rows;
};

/// Holds no object with a destructor, because libpng's errors jump out of it.
bool encode(Sink& sink, const Layout& layout)
{
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &sink, onError, onWarning);
    if (png == nullptr) {
        return false;
    }
    png_infop info = png_create_info_struct(png);
    if (info == nullptr || setjmp(png_jmpbuf(png)) != 0) {
        png_destroy_write_struct(&png, &info);
        return false;
    }
    png_set_write_fn(png, &sink, append, flushNothing);
    png_set_IHDR(png, info, layout.width, layout.height, layout.bits, layout.colour_type, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (layout.srgb) {
        png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    } else if (layout.linear) {
        png_set_gAMA(png, info, 1.0);
    }
    png_write_info(png, info);
    if (layout.bits == 16 && std::endian::native == std::endian::little) {
        png_set_swap(png);
    }
    png_write_image(png, const_cast<png_bytepp>(layout.rows));
    png_write_end(png, nullptr);
    png_destroy_write_struct(&png, &info);
    return true;
}

/// `what` begins the line of an Error.
template <typename T>
std::string encoded(const std::string& what, const ImageOf<T>& image)
{
    constexpr int kColourTypes[] = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                                    PNG_COLOR_TYPE_RGB_ALPHA};
    if (image.width == 0 || image.height == 0 || image.channels == 0 || image.channels > 4) {
        throw Error(what, "the image is empty or has more than 4 channels");
    }
    std::vector<png_bytep> rows(image.height);
    for (std::uint32_t y = 0; y < image.height; ++y) {
        // libpng takes rows as not const and does not write to them.
        rows[y] = reinterpret_cast<png_bytep>(const_cast<T*>(image.pixel(0, y)));
    }
    const bool is_16_bit = sizeof(T) == 2;
    const Layout layout{image.width,
                        image.height,
                        is_16_bit ? 16 : 8,
                        kColourTypes[image.channels - 1],
                        !is_16_bit && image.channels >= 3,
                        is_16_bit,
                        rows.data()};
    Sink sink;
    if (!encode(sink, layout)) {
        // libpng says nothing where it has no memory to begin with.
        const bool no_memory = sink.full || sink.problem.front() == '\0';
        throw Error(what, no_memory ? "out of memory" : sink.problem.data(), {},
                    no_memory ? ErrorKind::out_of_memory : ErrorKind::other);
    }
    return std::move(sink.bytes);
}

template <typename T>
void write(const std::filesystem::path& file, const ImageOf<T>& image)
{
    requireWritable(file); // before the work of compressing
    writeFile(file, encoded("writing " + file.string(), image));
}

} // namespace

void writePng(const std::filesystem::path& file, const Image8& image)
{
    write(file, image);
}

std::string encodePng(const Image8& image)
{
    return encoded("compressing a picture", image);
}

void writePng(const std::filesystem::path& file, const Image16& image)
{
    write(file, image);
}

} // namespace gnomon
