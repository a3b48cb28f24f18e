// SPDX-License-Identifier: Apache-2.0
#include "gltf/decode.h"

#include <csetjmp>
#include <cstdio> // jpeglib.h needs FILE

#include <jerror.h>
#include <jpeglib.h>

#include <cstring>

namespace gnomon::scene::gltf {

namespace {

/// Plain data, because longjmp skips destructors. `manager` comes first: libjpeg hands its address back.
struct JpegReader {
    jpeg_error_mgr manager;
    jpeg_progress_mgr progress;
    std::jmp_buf jump;
    jpeg_decompress_struct jpeg;
    char message[JMSG_LENGTH_MAX];
};

void onError(j_common_ptr jpeg)
{
    auto* reader = reinterpret_cast<JpegReader*>(jpeg->err);
    jpeg->err->format_message(jpeg, reader->message);
    std::longjmp(reader->jump, 1);
}

/// Corrupt data are a warning to libjpeg, which goes on with grey; to us they are an error.
void onMessage(j_common_ptr jpeg, int level)
{
    if (level < 0 && jpeg->err->msg_code != JWRN_EXTRANEOUS_DATA) {
        onError(jpeg);
    }
}

/// A progressive file may hold any number of scans over one large image; honest ones have about ten.
void onProgress(j_common_ptr jpeg)
{
    constexpr int kMaxScans = 200;
    auto* reader = reinterpret_cast<JpegReader*>(jpeg->err);
    if (jpeg->is_decompressor != 0 && reader->jpeg.input_scan_number > kMaxScans) {
        std::snprintf(reader->message, sizeof reader->message, "more than %d scans", kMaxScans);
        std::longjmp(reader->jump, 1);
    }
}

bool readHeader(JpegReader& reader, std::span<const std::byte> bytes)
{
    if (setjmp(reader.jump) != 0) {
        return false;
    }
    jpeg_create_decompress(&reader.jpeg);
    reader.progress.progress_monitor = onProgress;
    reader.jpeg.progress = &reader.progress;
    jpeg_mem_src(&reader.jpeg, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    jpeg_read_header(&reader.jpeg, TRUE);
    if (reader.jpeg.jpeg_color_space == JCS_CMYK || reader.jpeg.jpeg_color_space == JCS_YCCK) {
        std::snprintf(reader.message, sizeof reader.message, "CMYK colours, which glTF does not allow");
        return false;
    }
    reader.jpeg.out_color_space = JCS_EXT_RGBA;
    return true;
}

bool readPixels(JpegReader& reader, std::uint8_t* rgba)
{
    if (setjmp(reader.jump) != 0) {
        return false;
    }
    jpeg_start_decompress(&reader.jpeg);
    while (reader.jpeg.output_scanline < reader.jpeg.output_height) {
        JSAMPROW row = rgba + std::size_t{reader.jpeg.output_scanline} * reader.jpeg.output_width * 4;
        jpeg_read_scanlines(&reader.jpeg, &row, 1);
    }
    jpeg_finish_decompress(&reader.jpeg);
    return true;
}

} // namespace

std::string decodeJpeg(std::span<const std::byte> bytes, const SizeCheck& check, Image& image)
{
    JpegReader reader;
    std::memset(&reader, 0, sizeof reader);
    reader.jpeg.err = jpeg_std_error(&reader.manager);
    reader.manager.error_exit = onError;
    reader.manager.emit_message = onMessage;
    struct Closer {
        JpegReader& reader;
        ~Closer() { jpeg_destroy_decompress(&reader.jpeg); }
    } const closer{reader};
    if (!readHeader(reader, bytes)) {
        return reader.message;
    }
    check(reader.jpeg.image_width, reader.jpeg.image_height);
    // A block of 8x8 takes a bit at least, coded by Huffman's method. The arithmetic one takes less of a flat image,
    // which nobody ships; eight times less is allowed.
    constexpr std::uint64_t kMaxTexelsOfByte = 4096;
    if (std::uint64_t{reader.jpeg.image_width} * reader.jpeg.image_height > bytes.size() * kMaxTexelsOfByte) {
        return "too few bytes for " + std::to_string(reader.jpeg.image_width) + "x" +
               std::to_string(reader.jpeg.image_height);
    }
    image.rgba.assign(std::size_t{reader.jpeg.image_width} * reader.jpeg.image_height * 4, 0);
    image.width = reader.jpeg.image_width;
    image.height = reader.jpeg.image_height;
    return readPixels(reader, image.rgba.data()) ? std::string() : std::string(reader.message);
}

} // namespace gnomon::scene::gltf
