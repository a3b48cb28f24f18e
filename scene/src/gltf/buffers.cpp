// SPDX-License-Identifier: Apache-2.0
#include "gltf/document.h"
#include "gltf/meshopt.h"
#include "gltf/uri.h"

namespace gnomon::scene::gltf {

namespace {

Buffer readBuffer(const Document& document, const JsonView& view, bool first)
{
    Buffer buffer;
    checkExtensions(view, Place::buffer);
    buffer.length = view.at("byteLength").uint(1);
    if (isMeshoptFallback(view)) {
        return buffer; // for readers that cannot unpack the views on it
    }
    if (const std::optional<JsonView> uri = view.find("uri")) {
        buffer.owned = fetch(*uri).bytes;
        buffer.bytes = buffer.owned;
        buffer.has_content = true;
    } else if (first && document.container.is_glb) {
        if (!document.container.has_binary) {
            view.failFound("the buffer needs the binary chunk of the container", "no such chunk");
        }
        buffer.bytes = document.container.binary;
        buffer.has_content = true;
    }
    if (buffer.has_content && buffer.bytes.size() < buffer.length) {
        view.failFound("the data are shorter than byteLength " + std::to_string(buffer.length),
                       std::to_string(buffer.bytes.size()) + " bytes", "the file is probably truncated");
    }
    if (!buffer.has_content) {
        document.context().notice("buffer " + view.pointer() + " names no data; what it holds was taken as absent");
    }
    return buffer;
}

BufferView readView(Document& document, const JsonView& view)
{
    checkExtensions(view, Place::buffer_view);
    BufferView out;
    out.buffer = view.at("buffer").index(document.buffers.size());
    out.offset = view.uint("byteOffset", 0);
    out.length = view.at("byteLength").uint(1);
    const Buffer& buffer = document.buffers[out.buffer];
    if (out.offset > buffer.length || out.length > buffer.length - out.offset) {
        view.failFound("the buffer view does not fit its buffer of " + std::to_string(buffer.length) + " bytes",
                       "offset " + std::to_string(out.offset) + ", length " + std::to_string(out.length));
    }
    if (const std::optional<JsonView> stride = view.find("byteStride")) {
        out.stride = static_cast<std::uint32_t>(stride->uint(4, 252));
        if (out.stride % 4 != 0) {
            stride->fail("byteStride must be a multiple of 4");
        }
    }
    if (const std::optional<JsonView> target = view.find("target")) {
        constexpr std::uint64_t kArrayBuffer = 34962;
        constexpr std::uint64_t kElementArrayBuffer = 34963;
        const std::uint64_t value = target->uint();
        out.use = value == kArrayBuffer          ? ViewUse::vertices
                  : value == kElementArrayBuffer ? ViewUse::indices
                                                 : ViewUse::none;
        if (out.use == ViewUse::none) {
            target->fail("the target must be 34962 or 34963");
        }
    }
    if (const std::optional<JsonView> packed = meshoptOf(view)) {
        out.bytes = unpackMeshopt(document, *packed, out.length);
        out.has_content = !out.bytes.empty();
        return out;
    }
    out.has_content = buffer.has_content;
    if (buffer.has_content) {
        out.bytes = buffer.bytes.subspan(out.offset, out.length);
    }
    return out;
}

} // namespace

void readBuffers(Document& document)
{
    const std::size_t buffer_count = topLevelCount(document, "buffers");
    document.buffers.reserve(buffer_count); // views keep spans into them
    for (std::size_t i = 0; i < buffer_count; ++i) {
        document.buffers.push_back(readBuffer(document, document.root.at("buffers").element(i), i == 0));
    }
    const std::size_t view_count = topLevelCount(document, "bufferViews");
    document.views.reserve(view_count);
    for (std::size_t i = 0; i < view_count; ++i) {
        document.views.push_back(readView(document, document.root.at("bufferViews").element(i)));
    }
}

} // namespace gnomon::scene::gltf
