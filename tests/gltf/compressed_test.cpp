// SPDX-License-Identifier: Apache-2.0
// Meshes and buffers that the encoders of Draco and meshoptimizer compressed are read as what went into them.
#include "compressed.h"
#include "support.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::scene::test {
namespace {

bool contains(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

bool notices(const Scene& scene, const std::string& part)
{
    return std::any_of(scene.notices.begin(), scene.notices.end(),
                       [&](const std::string& notice) { return contains(notice, part); });
}

/// Corners of all triangles, each triangle from its least corner on, in an order of their own.
std::vector<std::array<glm::vec3, 3>> trianglesOf(const std::vector<glm::vec3>& positions,
                                                  const std::vector<std::uint32_t>& indices)
{
    const auto less = [](const glm::vec3& a, const glm::vec3& b) {
        return std::lexicographical_compare(&a.x, &a.x + 3, &b.x, &b.x + 3);
    };
    std::vector<std::array<glm::vec3, 3>> out;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        std::array<glm::vec3, 3> corners{};
        for (std::size_t k = 0; k < 3; ++k) { // onto the grid, so that what quantisation moved sorts alike
            corners[k] = glm::round(positions.at(indices[i + k]) * 64.0F) / 64.0F;
        }
        std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end(), less), corners.end());
        out.push_back(corners);
    }
    std::sort(out.begin(), out.end(), [&](const auto& a, const auto& b) {
        return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), less);
    });
    return out;
}

void expectHill(const Primitive& read, const Hill& hill)
{
    EXPECT_EQ(trianglesOf(read.positions, read.indices), trianglesOf(hill.positions, hill.indices));
    ASSERT_EQ(read.normals.size(), read.positions.size());
    for (std::size_t i = 0; i < read.positions.size(); ++i) {
        const glm::vec3 wanted = hill.normalAt(read.positions[i]);
        EXPECT_GT(glm::dot(read.normals[i], wanted), 0.999F) << i;
    }
}

struct DracoCase {
    const char* name;
    bool sequential;
    const char* mode;
    int index_type; // 0: no accessor of indices
};

class GltfDraco : public testing::TestWithParam<DracoCase> {};

TEST_P(GltfDraco, IsReadAsWhatWasEncoded)
{
    const Hill hill = makeHill(9);
    FileBuilder file = dracoFile(hill, GetParam().sequential);
    json& primitive = file.root["meshes"][0]["primitives"][0];
    if (GetParam().index_type != 0) {
        primitive["indices"] = file.addAccessor(
            {{"type", "SCALAR"}, {"componentType", GetParam().index_type}, {"count", hill.indices.size()}});
    }
    if (std::string(GetParam().mode) == "strip") {
        primitive["mode"] = 5; // the stream has triangles all the same
    }
    const Scene scene = file.read();
    EXPECT_TRUE(scene.notices.empty()) << scene.notices.front();
    const Primitive& read = scene.meshes.at(0).primitives.at(0);
    expectHill(read, hill);
    ASSERT_EQ(read.uv0.size(), read.positions.size());
    ASSERT_EQ(read.joints.size(), read.positions.size());
    for (std::size_t i = 0; i < read.positions.size(); ++i) {
        EXPECT_NEAR(read.uv0[i].x, read.positions[i].x / 8.0F, 0.002F);
        EXPECT_EQ(read.joints[i].y, static_cast<std::uint16_t>(std::lround(read.positions[i].x)));
        EXPECT_NEAR(read.colours.at(i).w, read.positions[i].z / 8.0F, 0.003F);
    }
}

INSTANTIATE_TEST_SUITE_P(Methods, GltfDraco,
                         testing::Values(DracoCase{"Edgebreaker", false, "list", 5123},
                                         DracoCase{"Sequential", true, "list", 5125},
                                         DracoCase{"WithoutIndices", false, "list", 0},
                                         DracoCase{"Strip", false, "strip", 5123}),
                         [](const auto& one) { return one.param.name; });

TEST(GltfDracoFile, MayBeRequiredAndSharesAccessors)
{
    // Two primitives name the same accessors, each with a mesh of its own behind them.
    const Hill large = makeHill(9);
    const Hill small = makeHill(4);
    FileBuilder file = dracoFile(large, false);
    file.root["extensionsUsed"] = {"KHR_draco_mesh_compression"};
    file.root["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    json second = file.root["meshes"][0]["primitives"][0];
    second["extensions"]["KHR_draco_mesh_compression"]["bufferView"] = file.addView(encodeDraco(small, true));
    file.root["meshes"][0]["primitives"].push_back(second);
    const Scene scene = file.read();
    expectHill(scene.meshes.at(0).primitives.at(0), large);
    expectHill(scene.meshes.at(0).primitives.at(1), small);
    EXPECT_TRUE(notices(scene, "differs from that of its Draco data"));
}

TEST(GltfDracoFile, SaysWhatIsWrong)
{
    const FileBuilder good = dracoFile(makeHill(4), false);
    const auto errorOf = [&](const auto& change) {
        FileBuilder file = good;
        change(file, file.root["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]);
        return file.error();
    };
    EXPECT_TRUE(contains(errorOf([](FileBuilder& f, json&) { f.data.at(0) = std::byte{'d'}; }), "no Draco mesh"));
    EXPECT_TRUE(contains(errorOf([](FileBuilder& f, json&) { f.data.at(6) = std::byte{1}; }), "version 2.2"));
    EXPECT_TRUE(contains(errorOf([](FileBuilder&, json& d) { d["attributes"]["POSITION"] = 77; }),
                         "no such attribute at /meshes/0/primitives/0/extensions/KHR_draco_mesh_compression"));
    EXPECT_TRUE(contains(errorOf([](FileBuilder&, json& d) { d["attributes"].erase("POSITION"); }), "POSITION"));
    EXPECT_TRUE(contains(errorOf([](FileBuilder&, json& d) { d["attributes"]["NORMAL"] = 2; }), "components"));
    EXPECT_TRUE(contains(errorOf([](FileBuilder&, json& d) { d["attributes"]["COLOR_3"] = 1; }), "no such attribute"));
}

TEST(GltfDracoFile, EveryTruncationIsRefused)
{
    for (const bool sequential : {false, true}) {
        const Hill hill = makeHill(4);
        const std::vector<std::byte> whole = encodeDraco(hill, sequential);
        FileBuilder file = dracoFile(hill, sequential);
        for (std::size_t size = 1; size < whole.size(); ++size) {
            file.root["bufferViews"][0]["byteLength"] = size;
            EXPECT_THROW(static_cast<void>(file.read()), Error) << size;
        }
    }
}

TEST(GltfDracoFile, CountsAreChargedBeforeTheyAreAllocated)
{
    // The stream says 2^28 - 1 points and faces: its varints lie behind the 11 bytes of its header.
    FileBuilder file = dracoFile(makeHill(4), true);
    const std::array<std::uint8_t, 8> huge{0xFF, 0xFF, 0xFF, 0x7F, 0xFF, 0xFF, 0xFF, 0x7F};
    std::memcpy(file.data.data() + 11, huge.data(), huge.size());
    EXPECT_TRUE(contains(file.error(), "over the limit vertices="));
}

TEST(GltfMeshopt, EveryModeAndFilterIsReadAsWhatWasEncoded)
{
    const Hill hill = makeHill(9);
    for (const char* const mode : {"TRIANGLES", "INDICES"}) {
        for (const bool wide : {false, true}) {
            for (const char* const extension : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
                const Scene scene = meshoptFile(hill, mode, wide, extension).read();
                const Primitive& read = scene.meshes.at(0).primitives.at(0);
                expectHill(read, hill);
                EXPECT_TRUE(scene.notices.empty()) << scene.notices.front();
                for (std::size_t i = 0; i < read.positions.size(); ++i) {
                    EXPECT_NEAR(read.uv0.at(i).x, read.positions[i].x / 8.0F, 1e-4F); // EXPONENTIAL
                }
                const std::vector<float>& turns = scene.animations.at(0).channels.at(0).values;
                EXPECT_NEAR(turns.at(4), std::sqrt(0.5F), 2e-3F); // QUATERNION
                EXPECT_NEAR(turns.at(7), std::sqrt(0.5F), 2e-3F);
            }
        }
    }
}

TEST(GltfMeshopt, FallbackBufferNeedsNoFile)
{
    FileBuilder file = meshoptFile(makeHill(4), "TRIANGLES", false, "EXT_meshopt_compression");
    file.root["extensionsUsed"] = {"EXT_meshopt_compression", "KHR_mesh_quantization"};
    file.root["extensionsRequired"] = file.root["extensionsUsed"];
    file.root["buffers"][1]["uri"] = "scene.fallback.bin";
    expectHill(file.read().meshes.at(0).primitives.at(0), makeHill(4));
    file.root["buffers"][1].erase("uri");
    EXPECT_TRUE(file.read().notices.empty());
}

TEST(GltfMeshopt, SaysWhatIsWrong)
{
    const FileBuilder good = meshoptFile(makeHill(4), "TRIANGLES", false, "EXT_meshopt_compression");
    const auto errorOf = [&](std::size_t view, const char* key, const json& value) {
        FileBuilder file = good;
        file.root["bufferViews"][view]["extensions"]["EXT_meshopt_compression"][key] = value;
        return file.error();
    };
    EXPECT_TRUE(contains(errorOf(0, "byteStride", 10), "multiple of 4"));
    EXPECT_TRUE(contains(errorOf(0, "byteStride", 260), "256 at most"));
    EXPECT_TRUE(contains(errorOf(0, "count", 17), "must multiply to the view's byteLength"));
    EXPECT_TRUE(contains(errorOf(0, "count", 4000000000U), "too few bytes"));
    EXPECT_TRUE(contains(errorOf(0, "mode", "VERTICES"), "ATTRIBUTES, TRIANGLES or INDICES"));
    EXPECT_TRUE(contains(errorOf(0, "filter", "COLOR"), "EXPONENTIAL"));
    EXPECT_TRUE(contains(errorOf(0, "filter", "QUATERNION"), "elements of another size"));
    EXPECT_TRUE(contains(errorOf(3, "filter", "EXPONENTIAL"), "only ATTRIBUTES"));
    EXPECT_TRUE(contains(errorOf(3, "byteStride", 8), "2 or 4"));
    EXPECT_TRUE(contains(errorOf(0, "byteLength", 1U << 30), "do not fit their buffer"));
    EXPECT_TRUE(contains(errorOf(0, "buffer", 9), "/bufferViews/0"));
}

TEST(GltfMeshopt, EveryTruncationIsRefused)
{
    FileBuilder file = meshoptFile(makeHill(4), "INDICES", false, "EXT_meshopt_compression");
    for (json& view : file.root["bufferViews"]) {
        json& length = view["extensions"]["EXT_meshopt_compression"]["byteLength"];
        const auto whole = length.get<std::size_t>();
        for (std::size_t size = 1; size < whole; ++size) {
            length = size;
            EXPECT_THROW(static_cast<void>(file.read()), Error) << size << " of " << whole;
        }
        length = whole;
    }
    EXPECT_NO_THROW(static_cast<void>(file.read()));
}

TEST(GltfMeshopt, NewerStreamsAreNamed)
{
    FileBuilder file = meshoptFile(makeHill(4), "TRIANGLES", false, "KHR_meshopt_compression");
    file.data.at(0) = std::byte{0xA1};
    file.root["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64(file.data);
    EXPECT_TRUE(contains(file.error(), "newer version"));
}

} // namespace
} // namespace gnomon::scene::test
