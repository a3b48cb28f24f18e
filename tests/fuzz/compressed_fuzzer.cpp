// SPDX-License-Identifier: Apache-2.0
// Whatever stands where a glTF file has a stream of Draco or meshopt: reading it ends in a scene or in an Error. The
// first bytes choose what the file around the stream says of it; the rest is the stream.
#include "scene/gltf.h"
#include "scene/state.h"

#include <gnomon/error.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

namespace {

/// The stream as its file describes it.
struct Said {
    unsigned kind = 0;
    unsigned stride = 0;
    unsigned count = 0;
    unsigned filter = 0;
};
constexpr std::size_t kSaidBytes = 5;

Said readSaid(std::span<const std::uint8_t> data)
{
    return {data[0] % 5U, data[1] % 66U * 4U, data[2] + data[3] * 256U, data[4] % 4U};
}

std::string member(const char* name, std::size_t value)
{
    return "\"" + std::string(name) + "\":" + std::to_string(value);
}

/// With all attributes that the reader knows, or with positions alone.
std::string dracoJson(bool all, std::size_t bytes)
{
    const std::string others = R"(,"NORMAL":1,"TEXCOORD_0":2,"JOINTS_0":3,"WEIGHTS_0":4,"COLOR_0":5)";
    const std::string attributes = R"({"POSITION":0)" + (all ? others : std::string()) + "}";
    return R"({"asset":{"version":"2.0"},"buffers":[{)" + member("byteLength", bytes) +
           R"(}],"bufferViews":[{"buffer":0,)" + member("byteLength", bytes) + R"(}],"accessors":[
        {"type":"VEC3","componentType":5126,"count":3},{"type":"VEC3","componentType":5126,"count":3},
        {"type":"VEC2","componentType":5126,"count":3},{"type":"VEC4","componentType":5123,"count":3},
        {"type":"VEC4","componentType":5126,"count":3},
        {"type":"VEC4","componentType":5121,"normalized":true,"count":3}],
        "meshes":[{"primitives":[{"attributes":)" +
           attributes + R"(,"extensions":{"KHR_draco_mesh_compression":{"bufferView":0,"attributes":)" + attributes +
           R"(}}}]}],"nodes":[{"mesh":0}]})";
}

std::string meshoptJson(const Said& said, std::size_t bytes)
{
    static constexpr std::array<const char*, 3> kModes{"ATTRIBUTES", "TRIANGLES", "INDICES"};
    static constexpr std::array<const char*, 4> kFilters{"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL"};
    const bool attributes = said.kind == 2;
    const std::size_t stride = attributes ? said.stride : said.stride % 8 == 0 ? 2 : 4;
    const std::string unpacked = member("byteLength", stride * said.count);
    const bool positions = attributes && stride >= 12 && stride <= 252;
    const std::string view = std::string("{\"buffer\":1,") + (positions ? member("byteStride", stride) + "," : "") +
                             unpacked + R"(,"extensions":{"EXT_meshopt_compression":{"buffer":0,)" +
                             member("byteLength", bytes) + "," + member("byteStride", stride) + "," +
                             member("count", said.count) + R"(,"mode":")" + kModes[said.kind - 2] + R"(","filter":")" +
                             kFilters[said.filter] + "\"}}}";
    const std::string vertices = positions ? R"("bufferView":0,)" + member("count", said.count) : R"("count":300)";
    const std::string indices = attributes ? std::string()
                                           : R"(,{"type":"SCALAR","bufferView":0,"componentType":)" +
                                                 std::string(stride == 2 ? "5123," : "5125,") +
                                                 member("count", said.count) + "}";
    return R"({"asset":{"version":"2.0"},"buffers":[{)" + member("byteLength", bytes) + "},{" + unpacked +
           R"(,"extensions":{"EXT_meshopt_compression":{"fallback":true}}}],"bufferViews":[)" + view +
           R"(],"accessors":[{"type":"VEC3","componentType":5126,)" + vertices + "}" + indices +
           R"(],"meshes":[{"primitives":[{"attributes":{"POSITION":0})" +
           (attributes ? "" : std::string(R"(,"indices":1)")) + R"(}]}],"nodes":[{"mesh":0}]})";
}

void append(std::vector<std::byte>& out, std::uint32_t word)
{
    const auto* const bytes = reinterpret_cast<const std::byte*>(&word);
    out.insert(out.end(), bytes, bytes + sizeof word);
}

void appendChunk(std::vector<std::byte>& out, std::uint32_t type, std::span<const std::byte> bytes, std::byte padding)
{
    const std::size_t padded = (bytes.size() + 3) / 4 * 4;
    append(out, static_cast<std::uint32_t>(padded));
    append(out, type);
    out.insert(out.end(), bytes.begin(), bytes.end());
    out.resize(out.size() + padded - bytes.size(), padding);
}

std::vector<std::byte> container(const std::string& json, std::span<const std::byte> binary)
{
    std::vector<std::byte> out;
    append(out, 0x46546C67); // "glTF"
    append(out, 2);
    append(out, 0); // its length, below
    appendChunk(out, 0x4E4F534A, std::as_bytes(std::span(json)), std::byte{' '});
    appendChunk(out, 0x004E4942, binary, std::byte{0});
    const auto size = static_cast<std::uint32_t>(out.size());
    std::memcpy(out.data() + 8, &size, sizeof size);
    return out;
}

/// Small enough that the fuzzer spends its time on logic, not on zeroing memory.
gnomon::scene::Limits smallLimits()
{
    gnomon::scene::Limits limits;
    limits.max_total_bytes = 4U << 20;
    limits.max_vertices = 1U << 14;
    return limits;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    if (size <= kSaidBytes) {
        return 0;
    }
    const Said said = readSaid({data, kSaidBytes});
    const std::span<const std::byte> stream = std::as_bytes(std::span(data, size)).subspan(kSaidBytes);
    const std::string json =
        said.kind < 2 ? dracoJson(said.kind == 0, stream.size()) : meshoptJson(said, stream.size());
    try {
        const gnomon::scene::Scene scene = gnomon::scene::readGltf(container(json, stream), {}, smallLimits());
        static_cast<void>(gnomon::scene::evaluate(scene, 0.25));
    } catch (const gnomon::Error&) {
        return 0; // the one way to refuse
    }
    return 0;
}
