// SPDX-License-Identifier: Apache-2.0
// Accessors and meshes: component types, normalisation, sparse data, strides, strips and fans.
#include "support.h"

#include <cmath>
#include <limits>

namespace gnomon::scene::test {
namespace {

const Primitive& onlyPrimitive(const Scene& scene)
{
    return scene.meshes.at(0).primitives.at(0);
}

TEST(GltfGeometry, TriangleGetsFlatNormalAndBounds)
{
    FileBuilder file;
    file.addMesh({{"attributes", {{"POSITION", file.addTriangle()}}}});
    const Scene scene = file.read();
    const Primitive& primitive = onlyPrimitive(scene);
    EXPECT_EQ(primitive.positions.size(), 3U);
    EXPECT_EQ(primitive.indices, (std::vector<std::uint32_t>{0, 1, 2}));
    ASSERT_EQ(primitive.normals.size(), 3U);
    EXPECT_EQ(primitive.normals[0], glm::vec3(0, 0, 1));
    EXPECT_EQ(primitive.bounds.max, glm::vec3(1, 1, 0));
}

TEST(GltfGeometry, IndexComponentTypes)
{
    for (const int type : {5121, 5123, 5125}) {
        FileBuilder file;
        const int position = file.addTriangle();
        const int indices = type == 5121   ? file.add<std::uint8_t>("SCALAR", type, 3, {2, 1, 0})
                            : type == 5123 ? file.add<std::uint16_t>("SCALAR", type, 3, {2, 1, 0})
                                           : file.add<std::uint32_t>("SCALAR", type, 3, {2, 1, 0});
        const int normal = file.add<float>("VEC3", 5126, 3, {0, 0, 1, 0, 0, 1, 0, 0, 1});
        file.addMesh({{"attributes", {{"POSITION", position}, {"NORMAL", normal}}}, {"indices", indices}});
        EXPECT_EQ(onlyPrimitive(file.read()).indices, (std::vector<std::uint32_t>{2, 1, 0})) << type;
    }
}

TEST(GltfGeometry, NormalisedTexcoordsAndColours)
{
    FileBuilder file;
    const int position = file.addTriangle();
    const int uv0 = file.add<std::uint16_t>("VEC2", 5123, 3, {0, 65535, 32768, 0, 0, 0}, true);
    const int uv1 = file.add<std::uint8_t>("VEC2", 5121, 3, {255, 0, 51, 0, 0, 0}, true);
    const int colour = file.add<std::uint8_t>("VEC4", 5121, 3, {255, 0, 51, 102, 0, 0, 0, 0, 0, 0, 0, 0}, true);
    const int normal = file.add<float>("VEC3", 5126, 3, {0, 0, 1, 0, 0, 1, 0, 0, 1});
    file.addMesh({{"attributes",
                   {{"POSITION", position},
                    {"NORMAL", normal},
                    {"TEXCOORD_0", uv0},
                    {"TEXCOORD_1", uv1},
                    {"COLOR_0", colour}}}});
    const Scene scene = file.read();
    const Primitive& primitive = onlyPrimitive(scene);
    EXPECT_EQ(primitive.uv0[0], glm::vec2(0, 1));
    EXPECT_FLOAT_EQ(primitive.uv0[1].x, 32768.0F / 65535.0F);
    EXPECT_EQ(primitive.uv1[0], glm::vec2(1, 0));
    EXPECT_FLOAT_EQ(primitive.uv1[1].x, 0.2F);
    EXPECT_EQ(primitive.colours[0], glm::vec4(1.0F, 0.0F, 0.2F, 0.4F));
}

TEST(GltfGeometry, ThreeComponentColoursAreOpaque)
{
    FileBuilder file;
    const int position = file.addTriangle();
    const int colour = file.add<float>("VEC3", 5126, 3, {0.5F, 0, 0, 0, 0.5F, 0, 0, 0, 0.5F});
    file.addMesh({{"attributes", {{"POSITION", position}, {"COLOR_0", colour}}}});
    EXPECT_EQ(onlyPrimitive(file.read()).colours[0], glm::vec4(0.5F, 0, 0, 1));
}

TEST(GltfGeometry, QuantisedPositionsNeedTheExtension)
{
    FileBuilder file;
    const int position = file.add<std::int16_t>("VEC3", 5122, 3, {-32768, -32767, 0, 32767, 0, 0, 0, 16384, 0}, true);
    file.addMesh({{"attributes", {{"POSITION", position}}}});
    EXPECT_NE(file.error().find("/meshes/0/primitives/0/attributes/POSITION"), std::string::npos);
    file.root["extensionsUsed"] = {"KHR_mesh_quantization"};
    file.root["extensionsRequired"] = {"KHR_mesh_quantization"};
    const Scene scene = file.read();
    const Primitive& primitive = onlyPrimitive(scene);
    EXPECT_EQ(primitive.positions[0], glm::vec3(-1, -1, 0)); // -32768 and -32767 both mean -1
    EXPECT_EQ(primitive.positions[1].x, 1.0F);
    EXPECT_FLOAT_EQ(primitive.positions[2].y, 16384.0F / 32767.0F);
}

TEST(GltfGeometry, QuantisedPositionsMayBeIntegers)
{
    FileBuilder file;
    file.root["extensionsUsed"] = {"KHR_mesh_quantization"};
    // Each element padded to 4 bytes by the stride, as the extension asks.
    const int position = file.add<std::int8_t>("VEC3", 5120, 3, {-128, 0, 0, 99, 127, 0, 0, 99, 0, 5, 0, 99});
    file.root["bufferViews"][0]["byteStride"] = 4;
    file.addMesh({{"attributes", {{"POSITION", position}}}});
    const Scene scene = file.read();
    EXPECT_EQ(onlyPrimitive(scene).positions[0].x, -128.0F);
    EXPECT_EQ(onlyPrimitive(scene).positions[2].y, 5.0F);
}

TEST(GltfGeometry, InterleavedAttributes)
{
    FileBuilder file;
    const int view = file.addView<float>({0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 1});
    file.root["bufferViews"][view]["byteStride"] = 24;
    const int position =
        file.addAccessor({{"bufferView", view}, {"type", "VEC3"}, {"componentType", 5126}, {"count", 3}});
    const int normal = file.addAccessor(
        {{"bufferView", view}, {"byteOffset", 12}, {"type", "VEC3"}, {"componentType", 5126}, {"count", 3}});
    file.addMesh({{"attributes", {{"POSITION", position}, {"NORMAL", normal}}}});
    const Scene scene = file.read();
    EXPECT_EQ(onlyPrimitive(scene).positions[2], glm::vec3(0, 1, 0));
    EXPECT_EQ(onlyPrimitive(scene).normals[2], glm::vec3(0, 0, 1));
}

TEST(GltfGeometry, SparseReplacesElements)
{
    FileBuilder file;
    const int position = file.addTriangle();
    const int indices = file.addView<std::uint16_t>({1});
    const int values = file.addView<float>({7, 8, 9});
    file.root["accessors"][position]["sparse"] = {{"count", 1},
                                                  {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                                                  {"values", {{"bufferView", values}}}};
    file.addMesh({{"attributes", {{"POSITION", position}}}});
    const Scene scene = file.read();
    EXPECT_EQ(onlyPrimitive(scene).positions[0], glm::vec3(0, 0, 0));
    EXPECT_EQ(onlyPrimitive(scene).positions[1], glm::vec3(7, 8, 9));
    EXPECT_EQ(onlyPrimitive(scene).positions[2], glm::vec3(0, 1, 0));
}

TEST(GltfGeometry, SparseWithoutBaseStartsFromZero)
{
    FileBuilder file;
    const int indices = file.addView<std::uint8_t>({0, 2});
    const int values = file.addView<float>({1, 0, 0, 0, 1, 0});
    const json sparse = {{"count", 2},
                         {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                         {"values", {{"bufferView", values}}}};
    const int position =
        file.addAccessor({{"type", "VEC3"}, {"componentType", 5126}, {"count", 3}, {"sparse", sparse}});
    file.addMesh({{"attributes", {{"POSITION", position}}}});
    const Scene scene = file.read();
    EXPECT_EQ(onlyPrimitive(scene).positions[0], glm::vec3(1, 0, 0));
    EXPECT_EQ(onlyPrimitive(scene).positions[1], glm::vec3(0, 0, 0));
    EXPECT_EQ(onlyPrimitive(scene).positions[2], glm::vec3(0, 1, 0));
}

TEST(GltfGeometry, SparseIndicesAreChecked)
{
    for (const std::vector<std::uint8_t>& wrong : {std::vector<std::uint8_t>{0, 3}, {2, 1}, {1, 1}}) {
        FileBuilder file;
        const int position = file.addTriangle();
        const int indices = file.addView(wrong);
        const int values = file.addView<float>({1, 0, 0, 0, 1, 0});
        file.root["accessors"][position]["sparse"] = {{"count", 2},
                                                      {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                                                      {"values", {{"bufferView", values}}}};
        EXPECT_NE(file.error().find("/accessors/0/sparse/indices"), std::string::npos);
    }
}

TEST(GltfGeometry, StripsAndFansBecomeLists)
{
    FileBuilder file;
    const int position = file.add<float>("VEC3", 5126, 5, {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0});
    const int normal = file.add<float>("VEC3", 5126, 5, {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
    const json attributes = {{"POSITION", position}, {"NORMAL", normal}};
    file.addMesh({{"attributes", attributes}, {"mode", 5}});
    file.addMesh({{"attributes", attributes}, {"mode", 6}});
    const int joined = file.add<std::uint16_t>("SCALAR", 5123, 7, {0, 1, 2, 2, 3, 3, 4});
    file.addMesh({{"attributes", attributes}, {"mode", 5}, {"indices", joined}});
    const Scene scene = file.read();
    // Every triangle of the strip keeps the winding of the first.
    EXPECT_EQ(scene.meshes[0].primitives[0].indices, (std::vector<std::uint32_t>{0, 1, 2, 1, 3, 2, 2, 3, 4}));
    EXPECT_EQ(scene.meshes[1].primitives[0].indices, (std::vector<std::uint32_t>{1, 2, 0, 2, 3, 0, 3, 4, 0}));
    EXPECT_EQ(scene.meshes[2].primitives[0].indices, (std::vector<std::uint32_t>{0, 1, 2}));
}

TEST(GltfGeometry, PointsAndLinesAreLeftOutWithANotice)
{
    FileBuilder file;
    file.addMesh({{"attributes", {{"POSITION", file.addTriangle()}}}, {"mode", 1}});
    const Scene scene = file.read();
    EXPECT_TRUE(scene.meshes.at(0).primitives.empty());
    ASSERT_EQ(scene.notices.size(), 1U);
    EXPECT_NE(scene.notices[0].find("points and lines"), std::string::npos);
}

TEST(GltfGeometry, MorphTargetsAndWeights)
{
    FileBuilder file;
    const int position = file.addTriangle();
    const int delta = file.add<float>("VEC3", 5126, 3, {0, 0, 1, 0, 0, 2, 0, 0, 3});
    file.addMesh({{"attributes", {{"POSITION", position}}}, {"targets", json::array({{{"POSITION", delta}}})}});
    file.root["meshes"][0]["weights"] = {0.5};
    file.root["nodes"][0]["weights"] = {0.25};
    const Scene scene = file.read();
    EXPECT_EQ(onlyPrimitive(scene).morph_targets.at(0).positions.at(2), glm::vec3(0, 0, 3));
    EXPECT_EQ(scene.meshes[0].morph_weights, std::vector<float>{0.5F});
    EXPECT_EQ(scene.nodes[0].morph_weights, std::vector<float>{0.25F});
    file.root["nodes"][0]["weights"] = {0.25, 0.5};
    EXPECT_NE(file.error().find("/nodes/0/weights"), std::string::npos);
}

TEST(GltfGeometry, WeightsAreMadeToAddUpToOne)
{
    FileBuilder file;
    const int position = file.addTriangle();
    const int joints = file.add<std::uint8_t>("VEC4", 5121, 3, {0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0});
    const int weights = file.add<std::uint8_t>("VEC4", 5121, 3, {100, 100, 0, 0, 255, 0, 0, 0, 0, 0, 0, 0}, true);
    file.addMesh({{"attributes", {{"POSITION", position}, {"JOINTS_0", joints}, {"WEIGHTS_0", weights}}}});
    const Scene scene = file.read();
    EXPECT_EQ(onlyPrimitive(scene).weights[0], glm::vec4(0.5F, 0.5F, 0, 0));
    EXPECT_EQ(onlyPrimitive(scene).weights[2], glm::vec4(1, 0, 0, 0));
    EXPECT_EQ(onlyPrimitive(scene).joints[0], glm::u16vec4(0, 1, 0, 0));
    file.root["nodes"][0]["skin"] = 0;
    file.root["nodes"].push_back({{"name", "bone"}});
    file.root["skins"] = json::array({{{"joints", {1}}}});
    EXPECT_NE(file.error().find("a vertex names a joint"), std::string::npos);
}

TEST(GltfGeometry, NotANumberIsRefused)
{
    FileBuilder file;
    static_cast<void>(file.add<float>("VEC3", 5126, 1, {0, std::numeric_limits<float>::quiet_NaN(), 0}));
    EXPECT_NE(file.error().find("at /accessors/0: found NaN"), std::string::npos);
}

} // namespace
} // namespace gnomon::scene::test
