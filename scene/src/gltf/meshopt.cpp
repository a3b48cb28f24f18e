// SPDX-License-Identifier: Apache-2.0
// Based on: Khronos Group, "EXT_meshopt_compression", 2022. meshoptimizer decodes streams and filters; it asserts what
// it is called with, so everything that a file says is checked here.
#include "gltf/meshopt.h"

#include <meshoptimizer.h>

namespace gnomon::scene::gltf {

namespace {

struct Stream {
    std::string mode;
    std::string filter;
    std::size_t count = 0;
    std::size_t stride = 0;
    std::span<const std::byte> bytes;
};

void checkFilter(const JsonView& packed, const Stream& stream)
{
    if (stream.filter == "NONE") {
        return;
    }
    const JsonView where = packed.at("filter");
    const bool known = stream.filter == "OCTAHEDRAL" || stream.filter == "QUATERNION" || stream.filter == "EXPONENTIAL";
    if (!known) {
        where.failFound("the filter must be NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL",
                        "'" + escapeKey(stream.filter) + "'");
    }
    if (stream.mode != "ATTRIBUTES") {
        where.failFound("only ATTRIBUTES have a filter", escapeKey(stream.mode));
    }
    if ((stream.filter == "OCTAHEDRAL" && stream.stride != 4 && stream.stride != 8) ||
        (stream.filter == "QUATERNION" && stream.stride != 8)) {
        where.failFound("the filter " + stream.filter + " has elements of another size",
                        std::to_string(stream.stride) + " bytes");
    }
}

/// Least bytes that the stream's elements can take, so that nothing is allocated for what cannot be there. Of
/// attributes, each byte of 64 elements takes a byte of their headers.
std::uint64_t leastBytes(const Stream& stream)
{
    constexpr std::uint64_t kElementsOfHeader = 64;
    return stream.mode == "ATTRIBUTES"  ? 1 + stream.stride + stream.count / kElementsOfHeader * stream.stride
           : stream.mode == "TRIANGLES" ? 1 + stream.count / 3
                                        : 1 + stream.count;
}

void checkStream(const JsonView& packed, const Stream& stream)
{
    const bool attributes = stream.mode == "ATTRIBUTES";
    if (!attributes && stream.mode != "TRIANGLES" && stream.mode != "INDICES") {
        packed.at("mode").failFound("the mode must be ATTRIBUTES, TRIANGLES or INDICES",
                                    "'" + escapeKey(stream.mode) + "'");
    }
    constexpr std::size_t kLargestVertex = 256;
    const bool strides_fit = attributes ? stream.stride % 4 == 0 && stream.stride > 0 && stream.stride <= kLargestVertex
                                        : stream.stride == 2 || stream.stride == 4;
    if (!strides_fit) {
        packed.at("byteStride")
            .failFound(attributes ? "byteStride must be a multiple of 4, and 256 at most" : "byteStride must be 2 or 4",
                       std::to_string(stream.stride));
    }
    if (stream.mode == "TRIANGLES" && stream.count % 3 != 0) {
        packed.at("count").failFound("the count of TRIANGLES must be a multiple of 3", std::to_string(stream.count));
    }
    checkFilter(packed, stream);
    if (stream.bytes.size() < leastBytes(stream)) {
        packed.failFound("too few bytes for " + std::to_string(stream.count) + " elements",
                         std::to_string(stream.bytes.size()));
    }
    // The first byte has the version below, and streams of version 1 came with a later meshoptimizer.
    if (attributes && (std::to_integer<unsigned>(stream.bytes[0]) & 0x0FU) > 0) {
        packed.fail("the attributes are compressed by a newer version than can be read",
                    "compress the file by EXT_meshopt_compression (gltfpack -c), or leave it as it is");
    }
}

Stream readStream(const Document& document, const JsonView& packed)
{
    Stream stream;
    const Buffer& buffer = document.buffers[packed.at("buffer").index(document.buffers.size())];
    const std::uint64_t offset = packed.uint("byteOffset", 0);
    const std::uint64_t length = packed.at("byteLength").uint(1);
    if (offset > buffer.length || length > buffer.length - offset) {
        packed.failFound("the compressed data do not fit their buffer of " + std::to_string(buffer.length) + " bytes",
                         "offset " + std::to_string(offset) + ", length " + std::to_string(length));
    }
    stream.mode = packed.at("mode").string();
    stream.filter = packed.string("filter", "NONE");
    stream.count = static_cast<std::size_t>(packed.at("count").uint(1, UINT32_MAX));
    stream.stride = static_cast<std::size_t>(packed.at("byteStride").uint(1, UINT32_MAX));
    if (buffer.has_content) {
        stream.bytes = buffer.bytes.subspan(offset, length);
        checkStream(packed, stream);
    }
    return stream;
}

void applyFilter(const Stream& stream, std::vector<std::byte>& out)
{
    if (stream.filter == "OCTAHEDRAL") {
        meshopt_decodeFilterOct(out.data(), stream.count, stream.stride);
    } else if (stream.filter == "QUATERNION") {
        meshopt_decodeFilterQuat(out.data(), stream.count, stream.stride);
    } else if (stream.filter == "EXPONENTIAL") {
        meshopt_decodeFilterExp(out.data(), stream.count, stream.stride);
    }
}

} // namespace

std::optional<JsonView> meshoptOf(const JsonView& object)
{
    const std::optional<JsonView> found = extension(object, "EXT_meshopt_compression");
    return found ? found : extension(object, "KHR_meshopt_compression");
}

bool isMeshoptFallback(const JsonView& buffer)
{
    const std::optional<JsonView> found = meshoptOf(buffer);
    return found && found->boolean("fallback", false);
}

std::span<const std::byte> unpackMeshopt(Document& document, const JsonView& packed, std::uint64_t length)
{
    const Stream stream = readStream(document, packed);
    const std::uint64_t bytes = std::uint64_t{stream.count} * stream.stride;
    if (bytes != length) {
        packed.failFound("count and byteStride must multiply to the view's byteLength " + std::to_string(length),
                         std::to_string(stream.count) + " x " + std::to_string(stream.stride));
    }
    if (stream.bytes.empty()) {
        return {};
    }
    document.context().chargeBytes(bytes, packed.pointer());
    std::vector<std::byte>& out = document.unpacked.emplace_back(static_cast<std::size_t>(bytes));
    const auto* const data = reinterpret_cast<const unsigned char*>(stream.bytes.data());
    const int failed =
        stream.mode == "ATTRIBUTES"
            ? meshopt_decodeVertexBuffer(out.data(), stream.count, stream.stride, data, stream.bytes.size())
        : stream.mode == "TRIANGLES"
            ? meshopt_decodeIndexBuffer(out.data(), stream.count, stream.stride, data, stream.bytes.size())
            : meshopt_decodeIndexSequence(out.data(), stream.count, stream.stride, data, stream.bytes.size());
    if (failed != 0) {
        packed.failFound("the compressed data are invalid", failed == -1 ? "no such stream" : "damaged data");
    }
    applyFilter(stream, out);
    return out;
}

} // namespace gnomon::scene::gltf
