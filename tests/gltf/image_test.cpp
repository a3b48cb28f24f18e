// SPDX-License-Identifier: Apache-2.0
// Image data of all kinds, made by the encoders of libpng and libjpeg.
#include "support.h"

#include <cstdio> // jpeglib.h needs FILE

#include <jpeglib.h>
#include <png.h>

namespace gnomon::scene::test {
namespace {

using Bytes = std::vector<std::byte>;

Scene readImage(const Bytes& encoded, const char* media_type = "image/png")
{
    const json file = {
        {"asset", {{"version", "2.0"}}},
        {"images", json::array({{{"uri", std::string("data:") + media_type + ";base64," + base64(encoded)}}})}};
    return readText(file.dump());
}

struct PngSource {
    std::uint32_t width;
    std::uint32_t height;
    std::uint32_t format; // of libpng's simplified writer
    std::vector<std::uint8_t> pixels;
    std::vector<std::uint8_t> palette; // RGB
};

Bytes encodePng(const PngSource& source)
{
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = source.width;
    image.height = source.height;
    image.format = source.format;
    image.colormap_entries = static_cast<png_uint_32>(source.palette.size() / 3);
    png_alloc_size_t size = 0;
    const void* palette = source.palette.empty() ? nullptr : source.palette.data();
    EXPECT_NE(png_image_write_to_memory(&image, nullptr, &size, 0, source.pixels.data(), 0, palette), 0);
    Bytes out(size);
    EXPECT_NE(png_image_write_to_memory(&image, out.data(), &size, 0, source.pixels.data(), 0, palette), 0);
    return out;
}

Bytes encodeJpeg(int width, int height, J_COLOR_SPACE space, int components)
{
    jpeg_compress_struct jpeg{};
    jpeg_error_mgr errors{};
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    unsigned char* data = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&jpeg, &data, &size);
    jpeg.image_width = static_cast<JDIMENSION>(width);
    jpeg.image_height = static_cast<JDIMENSION>(height);
    jpeg.input_components = components;
    jpeg.in_color_space = space;
    jpeg_set_defaults(&jpeg);
    jpeg_start_compress(&jpeg, TRUE);
    std::vector<std::uint8_t> row(static_cast<std::size_t>(width) * components, 200);
    while (jpeg.next_scanline < jpeg.image_height) {
        JSAMPROW rows = row.data();
        jpeg_write_scanlines(&jpeg, &rows, 1);
    }
    jpeg_finish_compress(&jpeg);
    Bytes out(size);
    std::memcpy(out.data(), data, size);
    jpeg_destroy_compress(&jpeg);
    std::free(data);
    return out;
}

TEST(GltfImage, PngColourTypes)
{
    const Scene rgba = readImage(encodePng({2, 1, PNG_FORMAT_RGBA, {1, 2, 3, 4, 5, 6, 7, 8}, {}}));
    EXPECT_EQ(rgba.images.at(0).rgba, (std::vector<std::uint8_t>{1, 2, 3, 4, 5, 6, 7, 8}));
    EXPECT_EQ(rgba.images[0].width, 2U);
    EXPECT_EQ(rgba.images[0].height, 1U);
    const Scene rgb = readImage(encodePng({1, 2, PNG_FORMAT_RGB, {1, 2, 3, 4, 5, 6}, {}}));
    EXPECT_EQ(rgb.images.at(0).rgba, (std::vector<std::uint8_t>{1, 2, 3, 255, 4, 5, 6, 255}));
    const Scene grey = readImage(encodePng({2, 1, PNG_FORMAT_GRAY, {9, 90}, {}}));
    EXPECT_EQ(grey.images.at(0).rgba, (std::vector<std::uint8_t>{9, 9, 9, 255, 90, 90, 90, 255}));
    const Scene palette = readImage(encodePng({3, 1, PNG_FORMAT_RGB_COLORMAP, {1, 0, 1}, {10, 20, 30, 40, 50, 60}}));
    EXPECT_EQ(palette.images.at(0).rgba,
              (std::vector<std::uint8_t>{40, 50, 60, 255, 10, 20, 30, 255, 40, 50, 60, 255}));
}

TEST(GltfImage, SixteenBitPngKeepsItsCodeValues)
{
    // 0xABCD scales to 0xAB; a colour-managed reader would change it, and glTF says to ignore colour profiles.
    const Scene scene = readImage(encodePng({1, 1, PNG_FORMAT_LINEAR_Y, {0xCD, 0xAB}, {}}));
    EXPECT_NEAR(scene.images.at(0).rgba[0], 0xAB, 1);
    EXPECT_EQ(scene.images[0].rgba[3], 255);
}

TEST(GltfImage, EveryTruncationIsRefused)
{
    const Bytes png = encodePng({8, 8, PNG_FORMAT_RGBA, std::vector<std::uint8_t>(256, 77), {}});
    const Bytes jpeg = encodeJpeg(16, 16, JCS_RGB, 3);
    EXPECT_NO_THROW(static_cast<void>(readImage(png)));
    for (std::size_t size = 0; size < png.size(); ++size) {
        EXPECT_THROW(static_cast<void>(readImage(Bytes(png.begin(), png.begin() + static_cast<long>(size)))), Error);
    }
    for (std::size_t size = 0; size + 2 < jpeg.size(); ++size) {
        EXPECT_THROW(
            static_cast<void>(readImage(Bytes(jpeg.begin(), jpeg.begin() + static_cast<long>(size)), "image/jpeg")),
            Error)
            << size;
    }
}

TEST(GltfImage, JpegColourSpaces)
{
    const Scene rgb = readImage(encodeJpeg(5, 3, JCS_RGB, 3), "image/jpeg");
    EXPECT_EQ(rgb.images.at(0).rgba.size(), 60U);
    EXPECT_NEAR(rgb.images[0].rgba[0], 200, 2);
    EXPECT_EQ(rgb.images[0].rgba[3], 255);
    const Scene grey = readImage(encodeJpeg(5, 3, JCS_GRAYSCALE, 1), "image/jpeg");
    EXPECT_NEAR(grey.images.at(0).rgba[2], 200, 2);
    try {
        static_cast<void>(readImage(encodeJpeg(5, 3, JCS_CMYK, 4), "image/jpeg"));
        FAIL() << "CMYK was not refused";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("CMYK"), std::string::npos);
    }
}

TEST(GltfImage, MediaTypeMustBeTrueButMayBeMissing)
{
    const Bytes jpeg = encodeJpeg(4, 4, JCS_RGB, 3);
    EXPECT_THROW(static_cast<void>(readImage(jpeg, "image/png")), Error);
    EXPECT_NO_THROW(static_cast<void>(readImage(jpeg, "")));
    EXPECT_NO_THROW(static_cast<void>(readImage(jpeg, "application/octet-stream")));
    EXPECT_THROW(static_cast<void>(readImage(toBytes("GIF89a..............."), "image/gif")), Error);
}

} // namespace
} // namespace gnomon::scene::test
