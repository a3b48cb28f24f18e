// SPDX-License-Identifier: Apache-2.0
// Image data of all kinds, made by the encoders of libpng, libjpeg and libwebp.
#include "support.h"

#include <cstdio> // jpeglib.h needs FILE

#include <jpeglib.h>
#include <png.h>
#include <webp/encode.h>

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

Bytes encodeWebp(int width, int height, const std::vector<std::uint8_t>& rgba, bool lossless)
{
    std::uint8_t* data = nullptr;
    const std::size_t size = lossless ? WebPEncodeLosslessRGBA(rgba.data(), width, height, width * 4, &data)
                                      : WebPEncodeRGBA(rgba.data(), width, height, width * 4, 90.0F, &data);
    EXPECT_GT(size, 0U);
    Bytes out(size);
    std::memcpy(out.data(), data, size);
    WebPFree(data);
    return out;
}

/// A leaf: green, its corner clear.
std::vector<std::uint8_t> leaf()
{
    std::vector<std::uint8_t> rgba;
    for (int i = 0; i < 16 * 16; ++i) {
        const bool clear = i % 16 + i / 16 > 15;
        rgba.insert(rgba.end(), {20, 200, 40, static_cast<std::uint8_t>(clear ? 0 : 255)});
    }
    return rgba;
}

std::string dataUri(const Bytes& encoded, const char* media_type)
{
    return std::string("data:") + media_type + ";base64," + base64(encoded);
}

const Bytes kKtx2 = toBytes("\xABKTX 20\xBB\r\n\x1A\n and no more");

/// A material that is masked by a texture, which names images by an extension and by itself; -1: not.
FileBuilder maskedFile(const char* extension, int other, int plain)
{
    FileBuilder file;
    const std::vector<std::uint8_t> rgba = leaf();
    file.root["images"] = json::array({{{"uri", dataUri(encodeWebp(16, 16, rgba, true), "image/webp")}},
                                       {{"uri", dataUri(kKtx2, "image/ktx2")}},
                                       {{"uri", dataUri(encodePng({16, 16, PNG_FORMAT_RGBA, rgba, {}}), "image/png")}},
                                       {{"uri", dataUri(toBytes("BM is another format"), "")}}});
    json texture = json::object();
    if (other >= 0) {
        texture["extensions"][extension]["source"] = other;
    }
    if (plain >= 0) {
        texture["source"] = plain;
    }
    file.root["textures"] = json::array({texture});
    file.root["materials"] = json::array({{{"name", "leaves"},
                                           {"alphaMode", "MASK"},
                                           {"emissiveFactor", {1, 1, 1}},
                                           {"emissiveTexture", {{"index", 0}}},
                                           {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}});
    return file;
}

bool says(const Scene& scene, const std::string& part)
{
    for (const std::string& notice : scene.notices) {
        if (notice.find(part) != std::string::npos) {
            return true;
        }
    }
    return false;
}

TEST(GltfImage, WebpKeepsItsTexels)
{
    const std::vector<std::uint8_t> rgba = leaf();
    const Scene lossless = readImage(encodeWebp(16, 16, rgba, true), "image/webp");
    ASSERT_EQ(lossless.images.at(0).rgba.size(), rgba.size());
    for (std::size_t i = 0; i < rgba.size(); i += 4) {
        EXPECT_EQ(lossless.images[0].rgba[i + 3], rgba[i + 3]);
        if (rgba[i + 3] > 0) { // the encoder drops the colour of clear texels
            EXPECT_EQ(lossless.images[0].rgba[i + 1], rgba[i + 1]);
        }
    }
    const Scene lossy = readImage(encodeWebp(16, 16, rgba, false), "image/webp");
    EXPECT_NEAR(lossy.images.at(0).rgba[1], 200, 12);
    EXPECT_EQ(lossy.images[0].rgba[3], 255);
    EXPECT_TRUE(lossy.notices.empty());
}

TEST(GltfImage, EveryTruncationOfWebpIsRefused)
{
    for (const bool lossless : {true, false}) {
        const Bytes webp = encodeWebp(16, 16, leaf(), lossless);
        for (std::size_t size = 0; size < webp.size(); ++size) {
            EXPECT_THROW(
                static_cast<void>(readImage(Bytes(webp.begin(), webp.begin() + static_cast<long>(size)), "image/webp")),
                Error)
                << size;
        }
    }
}

TEST(GltfImage, TexturesTakeTheFirstSourceThatCanBeRead)
{
    struct Case {
        const char* extension;
        int other;
        int plain;
        std::uint32_t taken;
    };
    for (const Case& c :
         {Case{"EXT_texture_webp", 0, 2, 0}, Case{"EXT_texture_webp", 0, -1, 0}, Case{"KHR_texture_basisu", 1, 2, 2},
          Case{"EXT_texture_avif", 1, 2, 2}, Case{"MSFT_texture_dds", 1, 2, 2}, Case{"", -1, 0, 0}}) {
        FileBuilder file = maskedFile(c.extension, c.other, c.plain);
        if (c.plain < 0) {
            file.root["extensionsUsed"] = {c.extension};
            file.root["extensionsRequired"] = {c.extension};
        }
        const Scene scene = file.read();
        EXPECT_EQ(scene.textures.at(0).image, c.taken) << c.extension;
        EXPECT_EQ(scene.materials.at(0).base_colour_texture.texture, 0U);
        EXPECT_FALSE(says(scene, "seen through"));
    }
}

TEST(GltfImage, MaskThatCannotBeReadIsTold)
{
    for (const char* const extension : {"KHR_texture_basisu", "EXT_texture_avif", "MSFT_texture_dds"}) {
        FileBuilder file = maskedFile(extension, 1, -1);
        file.root["extensionsUsed"] = {extension};
        file.root["extensionsRequired"] = {extension};
        const Scene scene = file.read();
        EXPECT_EQ(scene.materials.at(0).base_colour_texture.texture, kNone);
        EXPECT_EQ(scene.materials[0].emissive, glm::vec3(0.0F)); // not bright all over
        EXPECT_TRUE(says(scene, "image /images/1 is image/ktx2, which cannot be decoded"));
        EXPECT_TRUE(says(scene, "material /materials/0 'leaves' lacks the texture that says where it is seen through"));
    }
    const Scene unknown = maskedFile("", -1, 3).read();
    EXPECT_TRUE(says(unknown, "image /images/3 is of an unknown format"));
    EXPECT_TRUE(says(unknown, "seen through"));
    FileBuilder solid = maskedFile("", -1, 3);
    solid.root["materials"][0].erase("alphaMode");
    EXPECT_FALSE(says(solid.read(), "seen through"));
}

TEST(GltfImage, MissingFileIsTold)
{
    const TemporaryFolder folder;
    FileBuilder file = maskedFile("", -1, 0);
    file.root["images"][0] = {{"uri", "textures/leaf.png"}};
    folder.write("scene.gltf", file.text());
    const Scene scene = readGltf(folder.path() / "scene.gltf");
    EXPECT_TRUE(says(scene, "image /images/0 names a file that is not there, textures/leaf.png"));
    EXPECT_TRUE(says(scene, "seen through"));
    EXPECT_EQ(scene.materials.at(0).base_colour_texture.texture, kNone);
    // A path that leads out of the folder is no missing file.
    file.root["images"][0] = {{"uri", "../leaf.png"}};
    folder.write("scene.gltf", file.text());
    EXPECT_THROW(static_cast<void>(readGltf(folder.path() / "scene.gltf")), Error);
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
    EXPECT_THROW(static_cast<void>(readImage(toBytes("GIF89a..............."), "image/png")), Error);
    EXPECT_TRUE(says(readImage(toBytes("GIF89a..............."), "image/gif"), "cannot be decoded"));
}

} // namespace
} // namespace gnomon::scene::test
