// SPDX-License-Identifier: Apache-2.0
#include "exr_header.h"
#include "files/files.h"
#include "image/image_io.h"
#include "read_formats.h"

#include <gnomon/error.h>

#include <IexBaseExc.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfThreading.h>

#include <algorithm>
#include <cstring>
#include <half.h>
#include <new>
#include <stdexcept>
#include <vector>

namespace gnomon {
namespace {

/// OpenEXR writes into memory, so that a file is written in one place only (writeFile).
class MemoryOut final : public Imf::OStream {
public:
    MemoryOut() : Imf::OStream("memory") {}
    void write(const char c[], int n) override
    {
        const auto count = static_cast<std::size_t>(n);
        if (place_ + count > bytes.size()) {
            bytes.resize(place_ + count);
        }
        std::memcpy(bytes.data() + place_, c, count);
        place_ += count;
    }
    std::uint64_t tellp() override { return place_; }
    void seekp(std::uint64_t pos) override { place_ = pos; }

    std::string bytes;

private:
    std::size_t place_ = 0;
};

class MemoryIn final : public Imf::IStream {
public:
    explicit MemoryIn(std::string_view source) : Imf::IStream("memory"), bytes_(source) {}
    bool read(char c[], int n) override
    {
        const auto count = static_cast<std::size_t>(n);
        if (n < 0 || place_ > bytes_.size() || count > bytes_.size() - place_) {
            throw std::runtime_error("the file ends too early");
        }
        std::memcpy(c, bytes_.data() + place_, count);
        place_ += count;
        return place_ < bytes_.size();
    }
    std::uint64_t tellg() override { return place_; }
    void seekg(std::uint64_t pos) override { place_ = pos; }
    void clear() override {}

private:
    std::string_view bytes_;
    std::size_t place_ = 0;
};

const std::vector<const char*>& channelNames(std::uint32_t count)
{
    static const std::vector<const char*> grey{"Y"};
    static const std::vector<const char*> colour{"R", "G", "B"};
    static const std::vector<const char*> colour_alpha{"R", "G", "B", "A"};
    return count == 1 ? grey : count == 3 ? colour : colour_alpha;
}

std::string oneLine(std::string text)
{
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

std::string encodeExr(const ImageF& image, bool as_half)
{
    Imf::Header header(static_cast<int>(image.width), static_cast<int>(image.height));
    header.compression() = Imf::ZIP_COMPRESSION;
    std::vector<half> halves;
    if (as_half) {
        halves.reserve(image.values.size());
        for (const float value : image.values) {
            halves.emplace_back(value);
        }
    }
    const Imf::PixelType type = as_half ? Imf::HALF : Imf::FLOAT;
    const std::size_t value_bytes = as_half ? sizeof(half) : sizeof(float);
    const char* first =
        as_half ? reinterpret_cast<const char*>(halves.data()) : reinterpret_cast<const char*>(image.values.data());
    Imf::FrameBuffer frame;
    const auto& names = channelNames(image.channels);
    for (std::size_t c = 0; c < names.size(); ++c) {
        header.channels().insert(names[c], Imf::Channel(type));
        // Imf::Slice takes a pointer that is not const for reading and writing alike.
        frame.insert(names[c], Imf::Slice(type, const_cast<char*>(first) + c * value_bytes, value_bytes * names.size(),
                                          value_bytes * names.size() * image.width));
    }
    MemoryOut out;
    {
        Imf::OutputFile file(out, header, 0);
        file.setFrameBuffer(frame);
        file.writePixels(static_cast<int>(image.height));
    } // the line table is written when the file closes
    return std::move(out.bytes);
}

void requireSize(std::int64_t width, std::int64_t height, std::uint32_t max_side, std::size_t file_bytes)
{
    if (width < 1 || height < 1 || width > max_side || height > max_side) {
        throw std::runtime_error("the image is empty, or wider or higher than the limit of " +
                                 std::to_string(max_side));
    }
    // No compression of the format expands by more; memory is only taken for what the file can really hold.
    constexpr std::uint64_t kMaxExpansion = 4096;
    if (static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) > file_bytes * kMaxExpansion) {
        throw std::runtime_error("too few bytes for " + std::to_string(width) + "x" + std::to_string(height));
    }
}

ImageF decode(std::string_view bytes, std::uint32_t max_side)
{
    checkExrHeaders(bytes, max_side);
    MemoryIn in(bytes);
    Imf::InputFile file(in, 0);
    const Imath::Box2i window = file.header().dataWindow();
    const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
    const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
    requireSize(width, height, max_side, bytes.size());
    const Imf::ChannelList& channels = file.header().channels();
    std::uint32_t count = 1;
    if (channels.findChannel("Y") == nullptr) {
        count = channels.findChannel("A") != nullptr ? 4 : 3;
    }
    ImageF image(static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), count);
    const auto& names = channelNames(count);
    Imf::FrameBuffer frame;
    for (std::size_t c = 0; c < names.size(); ++c) {
        const Imf::Channel* channel = channels.findChannel(names[c]);
        if (channel == nullptr || channel->xSampling != 1 || channel->ySampling != 1) {
            throw std::runtime_error("it has neither a channel Y nor channels R, G and B of full size");
        }
        frame.insert(names[c], Imf::Slice::Make(Imf::FLOAT, image.values.data() + c, window, sizeof(float) * count,
                                                sizeof(float) * count * image.width));
    }
    file.setFrameBuffer(frame);
    file.readPixels(window.min.y, window.max.y);
    return image;
}

} // namespace

void writeExr(const std::filesystem::path& file, const ImageF& image, bool half)
{
    if (image.width == 0 || image.height == 0 || (image.channels != 1 && image.channels != 3 && image.channels != 4)) {
        throw Error("writing " + file.string(), "an EXR has 1, 3 or 4 channels and at least one pixel");
    }
    requireWritable(file);
    std::string bytes;
    try {
        bytes = encodeExr(image, half);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const Iex::ErrnoExc&) { // a stream failed, and all streams here are in memory
        throw std::bad_alloc();
    } catch (const std::exception& problem) {
        throw Error("writing " + file.string(), oneLine(problem.what()));
    }
    writeFile(file, bytes);
}

bool looksLikeExr(std::string_view bytes)
{
    return bytes.starts_with("\x76\x2f\x31\x01");
}

ImageF decodeExr(const std::string& name, std::string_view bytes, std::uint32_t max_side)
{
    try {
        return decode(bytes, max_side);
    } catch (const std::bad_alloc&) {
        throw Error("reading " + name, "it asks for more memory than there is", {}, ErrorKind::out_of_memory);
    } catch (const std::exception& problem) {
        throw Error("reading " + name, "not a valid EXR: " + oneLine(problem.what()));
    }
}

ImageF readImage(const std::filesystem::path& file, std::uint32_t max_side)
{
    // The most that an image of this size can take uncompressed: four 4-byte channels, and room for headers.
    const std::uint64_t max_bytes = std::uint64_t{max_side} * max_side * 16 + (1U << 20U);
    const std::string bytes = readWholeFile(file, max_bytes);
    if (looksLikePng(bytes)) {
        return decodePng(file.string(), bytes, max_side);
    }
    if (looksLikeExr(bytes)) {
        return decodeExr(file.string(), bytes, max_side);
    }
    throw Error("reading " + file.string(), bytes.empty() ? "it is empty" : "it is neither a PNG nor an EXR file");
}

} // namespace gnomon
