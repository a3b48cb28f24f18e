// SPDX-License-Identifier: Apache-2.0
#include "gltf/glb.h"

#include "files/files.h"

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>

namespace gnomon::scene::gltf {

namespace {

constexpr std::uint32_t kMagic = 0x46546C67;     // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A; // "JSON"
constexpr std::uint32_t kBinaryChunk = 0x004E4942;
constexpr std::size_t kHeaderBytes = 12;
constexpr std::size_t kChunkHeaderBytes = 8;

std::uint32_t word(std::span<const std::byte> bytes, std::size_t offset)
{
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        value |= static_cast<std::uint32_t>(bytes[offset + i]) << (8 * i);
    }
    return value;
}

std::string byteAt(std::size_t offset)
{
    return "byte " + std::to_string(offset) + " of the GLB container";
}

std::string hex(std::uint32_t value)
{
    char text[16];
    std::snprintf(text, sizeof text, "0x%08x", value);
    return text;
}

bool isJsonStart(std::byte byte)
{
    const char c = static_cast<char>(byte);
    return c == '{' || c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

void checkHeader(const Context& context, std::span<const std::byte> file)
{
    if (file.size() < kHeaderBytes) {
        context.fail(byteAt(file.size()), "the header ends early", std::to_string(file.size()) + " bytes of 12");
    }
    const std::uint32_t version = word(file, 4);
    if (version != 2) {
        context.fail(byteAt(4), "only version 2 of the container is supported", std::to_string(version));
    }
    const std::uint32_t length = word(file, 8);
    if (length < kHeaderBytes + kChunkHeaderBytes) {
        context.fail(byteAt(8), "the declared length has no room for a chunk", std::to_string(length));
    }
    if (length > file.size()) {
        context.fail(byteAt(file.size()), "the file ends before its declared length of " + std::to_string(length),
                     std::to_string(file.size()) + " bytes", "the file is probably truncated");
    }
}

} // namespace

Container openContainer(Context& context, std::span<const std::byte> file)
{
    if (file.size() < 4 || word(file, 0) != kMagic) {
        // JSON by a wrong name is read all the same.
        if (hasExtension(context.label(), ".glb") && (file.empty() || !isJsonStart(file.front()))) {
            context.fail(byteAt(0), "a GLB container begins with \"glTF\"",
                         file.size() < 4 ? std::to_string(file.size()) + " bytes" : hex(word(file, 0)));
        }
        return {file, {}, false, false};
    }
    checkHeader(context, file);
    const std::size_t end = word(file, 8);
    if (end < file.size()) {
        context.notice("bytes after the declared end of the GLB container were left out");
    }
    Container container{{}, {}, true, false};
    std::size_t chunk = 0;
    for (std::size_t at = kHeaderBytes; at < end; ++chunk) {
        if (end - at < kChunkHeaderBytes) {
            context.fail(byteAt(at), "the header of chunk " + std::to_string(chunk) + " ends early",
                         std::to_string(end - at) + " bytes of 8");
        }
        const std::uint32_t length = word(file, at);
        const std::uint32_t type = word(file, at + 4);
        const std::size_t body = at + kChunkHeaderBytes;
        if (chunk == 0 && type != kJsonChunk) {
            context.fail(byteAt(at + 4), "the first chunk must be the JSON chunk", hex(type));
        }
        if (length % 4 != 0) {
            context.fail(byteAt(at), "a chunk's length must be a multiple of 4", std::to_string(length));
        }
        if (length > end - body) {
            context.fail(byteAt(at),
                         "chunk " + std::to_string(chunk) + " is longer than the " + std::to_string(end - body) +
                             " bytes left",
                         std::to_string(length));
        }
        if (type == kJsonChunk && chunk > 0) {
            context.fail(byteAt(at + 4), "there must be one JSON chunk", "a second");
        }
        if (type == kJsonChunk) {
            container.json = file.subspan(body, length);
        } else if (type == kBinaryChunk) {
            if (chunk != 1) {
                context.fail(byteAt(at + 4), "the binary chunk must be the second chunk",
                             "it as chunk " + std::to_string(chunk));
            }
            container.binary = file.subspan(body, length);
            container.has_binary = true;
        } else {
            context.notice("a chunk of unknown type " + hex(type) + " was left out");
        }
        at = body + length;
    }
    return container;
}

} // namespace gnomon::scene::gltf
