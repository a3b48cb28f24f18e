// SPDX-License-Identifier: Apache-2.0
// Errors of the specification that change nothing of what a file means: docs/scenes.md has each with its reason. What
// does change it is refused, here and in the other tests.
#include "support.h"

#include <algorithm>
#include <functional>

namespace gnomon::scene::test {
namespace {

struct Fault {
    const char* name;
    std::function<void(FileBuilder&)> plant;
    const char* refusal = nullptr;                // part of the message; null: tolerated
    std::function<void(const Primitive&)> expect; // what is read all the same, where the fault could change it
    const char* notice = nullptr;                 // part of a notice that is given
};

/// A triangle with two joints, a material with a texture, and an animation, in which nothing is wrong.
FileBuilder faultless()
{
    FileBuilder file;
    const int position = file.addTriangle();
    file.root["accessors"][0].update({{"min", {0, 0, 0}}, {"max", {1, 1, 0}}});
    const int joints = file.add<std::uint8_t>("VEC4", 5121, 3, {0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0});
    const int weights = file.add<float>("VEC4", 5126, 3, {0.5F, 0.5F, 0, 0, 0.5F, 0.5F, 0, 0, 0.5F, 0.5F, 0, 0});
    const int uv = file.add<float>("VEC2", 5126, 3, {0, 0, 1, 0, 0, 1});
    const int times = file.add<float>("SCALAR", 5126, 2, {0, 1});
    file.root["accessors"][times].update({{"min", {0}}, {"max", {1}}});
    const int moves = file.add<float>("VEC3", 5126, 2, {0, 0, 0, 1, 0, 0});
    file.addMesh(
        {{"attributes", {{"POSITION", position}, {"JOINTS_0", joints}, {"WEIGHTS_0", weights}, {"TEXCOORD_0", uv}}}});
    file.root["nodes"][0]["skin"] = 0;
    file.root["nodes"].push_back({{"children", {2}}});
    file.root["nodes"].push_back(json::object());
    file.root["skins"] = json::array({{{"joints", {1, 2}}}});
    file.root["scenes"] = json::array({{{"nodes", {0, 1}}}});
    file.root["animations"] = json::array(
        {{{"samplers", json::array({{{"input", times}, {"output", moves}}})},
          {"channels", json::array({{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}}})}}});
    return file;
}

json& attributesOf(FileBuilder& file)
{
    return file.root["meshes"][0]["primitives"][0]["attributes"];
}

const Fault kFaults[] = {
    {"PositionWithoutBounds",
     [](FileBuilder& f) {
         f.root["accessors"][0].erase("min");
         f.root["accessors"][0].erase("max");
     }},
    {"KeyTimesWithoutBounds",
     [](FileBuilder& f) {
         f.root["accessors"][4].erase("min");
         f.root["accessors"][4].erase("max");
     }},
    {"NoByteStrideWhereTwoShareAView",
     [](FileBuilder& f) {
         const int view = f.addView<float>({0, 0, 1, 0, 0, 1, 2, 2, 3, 2, 2, 3});
         json accessor = {{"bufferView", view}, {"type", "VEC2"}, {"componentType", 5126}, {"count", 3}};
         attributesOf(f)["TEXCOORD_0"] = f.addAccessor(accessor);
         accessor["byteOffset"] = 24;
         attributesOf(f)["TEXCOORD_1"] = f.addAccessor(accessor);
     },
     nullptr,
     [](const Primitive& read) {
         EXPECT_EQ(read.uv0, (std::vector<glm::vec2>{{0, 0}, {1, 0}, {0, 1}}));
         EXPECT_EQ(read.uv1, (std::vector<glm::vec2>{{2, 2}, {3, 2}, {2, 3}}));
     }},
    {"AttributeThatIsNotAlignedTo4",
     [](FileBuilder& f) { // colours of three bytes each, one after the other
         attributesOf(f)["COLOR_0"] = f.add<std::uint8_t>("VEC3", 5121, 3, {255, 0, 0, 0, 255, 0, 0, 0, 255}, true);
     },
     nullptr,
     [](const Primitive& read) {
         EXPECT_EQ(read.colours, (std::vector<glm::vec4>{{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}}));
     }},
    {"TexcoordsThatSkipASet",
     [](FileBuilder& f) {
         attributesOf(f)["TEXCOORD_1"] = attributesOf(f)["TEXCOORD_0"];
         attributesOf(f).erase("TEXCOORD_0");
     },
     nullptr,
     [](const Primitive& read) {
         EXPECT_TRUE(read.uv0.empty());
         EXPECT_EQ(read.uv1, (std::vector<glm::vec2>{{0, 0}, {1, 0}, {0, 1}}));
     }},
    {"ColoursThatSkipASet",
     [](FileBuilder& f) { attributesOf(f)["COLOR_1"] = f.add<float>("VEC4", 5126, 3, std::vector<float>(12, 0.5F)); },
     nullptr,
     [](const Primitive& read) {
         EXPECT_TRUE(read.colours.empty());
     }},
    {"TextureOfASetThatIsNotThere",
     [](FileBuilder& f) {
         f.root["textures"] = json::array({json::object()});
         f.root["materials"] =
             json::array({{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}, {"texCoord", 1}}}}}}});
         f.root["meshes"][0]["primitives"][0]["material"] = 0;
     }},
    {"WeightsThatDoNotSumToOne",
     [](FileBuilder& f) {
         attributesOf(f)["WEIGHTS_0"] = f.add<float>("VEC4", 5126, 3, {1, 1, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0});
     },
     nullptr,
     [](const Primitive& read) {
         EXPECT_EQ(read.weights, (std::vector<glm::vec4>{{0.5F, 0.5F, 0, 0}, {1, 0, 0, 0}, {1, 0, 0, 0}}));
     }},
    {"AJointTwiceInAVertex",
     [](FileBuilder& f) {
         attributesOf(f)["JOINTS_0"] = f.add<std::uint8_t>("VEC4", 5121, 3, {1, 1, 0, 0, 1, 1, 0, 0, 0, 0, 0, 0});
     }},
    {"SkinWithoutACommonRoot",
     [](FileBuilder& f) {
         f.root["nodes"][1].erase("children");
         f.root["scenes"][0]["nodes"] = {0, 1, 2};
     }},
    {"SkeletonThatIsNoCommonRoot",
     [](FileBuilder& f) {
         f.root["skins"][0]["skeleton"] = 2;
     }},
    {"MatrixThatShears",
     [](FileBuilder& f) {
         f.root["nodes"].push_back({{"matrix", {1, 0, 0, 0, 0.5, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}});
     }},
    {"ExtensionThatIsNotDeclared",
     [](FileBuilder& f) {
         f.root["extensions"] = {{"KHR_lights_punctual", {{"lights", json::array({{{"type", "directional"}}})}}}};
         f.root["nodes"][1]["extensions"] = {{"KHR_lights_punctual", {{"light", 0}}}};
     }},
    {"ImageInAViewWithoutMediaType",
     [](FileBuilder& f) {
         f.root["images"] = json::array(
             {{{"bufferView", f.addView<std::uint8_t>(
                                  {137, 80,  78,  71,  13, 10, 26, 10,  0,   0,  0,   13, 73,  72,  68,  82, 0,
                                   0,   0,   1,   0,   0,  0,  1,  8,   0,   0,  0,   0,  58,  126, 155, 85, 0,
                                   0,   0,   10,  73,  68, 65, 84, 120, 156, 99, 104, 0,  0,   0,   130, 0,  129,
                                   119, 205, 114, 182, 0,  0,  0,  0,   73,  69, 78,  68, 174, 66,  96,  130})}}});
     }},
    {"WordOfGltfThatIsUnknown",
     [](FileBuilder& f) {
         f.root["nodes"][1]["colour"] = "red";
     }},
    // These are refused, since their meaning is unknown.
    {"JointsWithoutWeightsInALaterSet", [](FileBuilder& f) { attributesOf(f)["JOINTS_1"] = 1; },
     "JOINTS_1 and WEIGHTS_1 must come together"},
    {"WeightsWithoutJoints", [](FileBuilder& f) { attributesOf(f).erase("JOINTS_0"); },
     "WEIGHTS_0 and JOINTS_0 must come together"},
    {"TwoChannelsOfOneTarget",
     [](FileBuilder& f) {
         json& channels = f.root["animations"][0]["channels"];
         channels.push_back(channels[0]);
     },
     "two channels animate the same property"},
    {"TwoChannelsOfOneTargetOutsideTheScene",
     [](FileBuilder& f) {
         f.root["nodes"].push_back(json::object());
         json& channels = f.root["animations"][0]["channels"];
         channels[0]["target"]["node"] = 3;
         channels.push_back(channels[0]);
     },
     "two channels animate the same property"},
    {"OffsetThatIsNoMultipleOfTheComponent", [](FileBuilder& f) { f.root["accessors"][3]["byteOffset"] = 2; },
     "must be a multiple of the component's 4 bytes"},
};

const std::vector<glm::vec3> kTriangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

void expectTriangle(const Primitive& read)
{
    EXPECT_EQ(read.positions, kTriangle);
}

void expectUpNormals(const Primitive& read)
{
    EXPECT_EQ(read.normals, std::vector<glm::vec3>(3, {0, 0, 1}));
    EXPECT_TRUE(read.tangents.empty());
}

/// Adds indices 0 1 2 behind other data of a view that all share, whose stride is `stride` where it is not 0.
void shareView(FileBuilder& f, bool indices_first, std::uint32_t stride)
{
    std::vector<std::uint16_t> both(24, 0); // positions and indices, each 36 and 6 bytes
    const float positions[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    const std::uint16_t indices[3] = {0, 1, 2};
    std::memcpy(both.data() + (indices_first ? 4 : 0), positions, sizeof positions);
    std::memcpy(both.data() + (indices_first ? 0 : 18), indices, sizeof indices);
    const int view = f.addView(both);
    if (stride != 0) {
        f.root["bufferViews"][view]["byteStride"] = stride;
    }
    attributesOf(f)["POSITION"] = f.addAccessor({{"bufferView", view},
                                                 {"byteOffset", indices_first ? 8 : 0},
                                                 {"type", "VEC3"},
                                                 {"componentType", 5126},
                                                 {"count", 3}});
    f.root["meshes"][0]["primitives"][0]["indices"] = f.addAccessor({{"bufferView", view},
                                                                     {"byteOffset", indices_first ? 0 : 36},
                                                                     {"type", "SCALAR"},
                                                                     {"componentType", 5123},
                                                                     {"count", 3}});
}

/// Errors of the specification that a notice tells.
const Fault kTold[] = {
    {"BoundsThatAreRounded",
     [](FileBuilder& f) {
         f.root["accessors"][0]["max"] = {1.0001, 1, 0};
     },
     nullptr,
     [](const Primitive& read) {
         expectTriangle(read);
         EXPECT_EQ(read.bounds.max, glm::vec3(1, 1, 0));
     },
     "differ from its data"},
    {"BoundsOfKeyTimesThatAreRounded", [](FileBuilder& f) { f.root["accessors"][4]["min"] = {0.01}; }, nullptr,
     expectTriangle, "declared bounds of /accessors/4"},
    {"NormalsOfLengthZero",
     [](FileBuilder& f) {
         attributesOf(f)["NORMAL"] = f.add<float>("VEC3", 5126, 3, {0, 0, 0, 0, 0, 1, 0, 0, 1});
     },
     nullptr, expectUpNormals, "1 vectors of /meshes/0/primitives/0/attributes/NORMAL of length 0"},
    {"NormalsThatAreAllZero",
     [](FileBuilder& f) { attributesOf(f)["NORMAL"] = f.add<float>("VEC3", 5126, 3, std::vector<float>(9)); }, nullptr,
     expectUpNormals, "3 vectors of"},
    {"NormalsThatAreNoUnits",
     [](FileBuilder& f) {
         attributesOf(f)["NORMAL"] = f.add<float>("VEC3", 5126, 3, {0, 0, 1.02F, 0, 0, 1e-30F, 0, 0, 1e30F});
     },
     nullptr, expectUpNormals, "not of unit length"},
    {"QuantisedNormalsThatAreNoUnits",
     [](FileBuilder& f) {
         f.root["extensionsUsed"] = {"KHR_mesh_quantization"};
         attributesOf(f)["NORMAL"] = f.add<std::int8_t>("VEC3", 5120, 3, {0, 0, 64, 0, 0, 127, 0, 0, 0}, true);
     },
     nullptr, expectUpNormals, "of length 0"},
    {"TangentsOfLengthZero",
     [](FileBuilder& f) {
         attributesOf(f)["NORMAL"] = f.add<float>("VEC3", 5126, 3, {0, 0, 1, 0, 0, 1, 0, 0, 1});
         attributesOf(f)["TANGENT"] = f.add<float>("VEC4", 5126, 3, {0, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1});
     },
     nullptr, expectUpNormals, "all tangents of the primitive are derived"},
    {"ColoursAboveOne",
     [](FileBuilder& f) {
         attributesOf(f)["COLOR_0"] = f.add<float>("VEC4", 5126, 3, {2, 0, 0, 1, 1, -0.5F, 0, 1.5F, 0, 0, 0.5F, 1});
     },
     nullptr,
     [](const Primitive& read) {
         EXPECT_EQ(read.colours, (std::vector<glm::vec4>{{1, 0, 0, 1}, {1, 0, 0, 1}, {0, 0, 0.5F, 1}}));
     },
     "were clamped to 0 to 1"},
    {"OneViewForVerticesAndIndices", [](FileBuilder& f) { shareView(f, false, 0); }, nullptr, expectTriangle,
     "holds both vertices and indices"},
    {"OneViewForVerticesAndIndicesWithAStride", [](FileBuilder& f) { shareView(f, false, 12); }, nullptr,
     expectTriangle, "with indices has a byteStride; they are taken as packed"},
    {"OneViewForIndicesAndVerticesWithAStride", [](FileBuilder& f) { shareView(f, true, 12); }, nullptr, expectTriangle,
     "they are taken as packed"},
    {"ATargetForVerticesOnIndices",
     [](FileBuilder& f) {
         const int indices = f.add<std::uint16_t>("SCALAR", 5123, 3, {0, 1, 2});
         f.root["bufferViews"][f.root["accessors"][indices]["bufferView"].get<int>()]["target"] = 34962;
         f.root["meshes"][0]["primitives"][0]["indices"] = indices;
     },
     nullptr, expectTriangle, "or its target says so"},
    {"AStrideOnInverseBindMatrices",
     [](FileBuilder& f) {
         std::vector<float> matrices(2 * 16);
         for (const int i : {0, 5, 10, 15, 16, 21, 26, 31}) {
             matrices[i] = 1;
         }
         const int accessor = f.add<float>("MAT4", 5126, 2, matrices);
         f.root["bufferViews"][f.root["accessors"][accessor]["bufferView"].get<int>()]["byteStride"] = 64;
         f.root["skins"][0]["inverseBindMatrices"] = accessor;
     },
     nullptr, expectTriangle, "with inverse bind matrices has a byteStride"},
    {"ASceneThatNamesAChild",
     [](FileBuilder& f) {
         f.root["scenes"][0]["nodes"] = {0, 2, 1};
     },
     nullptr, expectTriangle, "names children of other nodes"},
    {"ASceneThatNamesANodeTwice",
     [](FileBuilder& f) {
         f.root["scenes"][0]["nodes"] = {0, 1, 0};
     },
     nullptr, expectTriangle, "names a node twice"},
    {"JointsOutsideTheScene", [](FileBuilder& f) { f.root["scenes"][0]["nodes"] = {0}; }, nullptr, expectTriangle,
     "joints outside the scene"},
};

class GltfFaults : public testing::TestWithParam<Fault> {};

TEST_P(GltfFaults, IsReadOrRefusedAsDocumented)
{
    FileBuilder file = faultless();
    ASSERT_NO_THROW(static_cast<void>(evaluate(file.read(), 0.5)));
    GetParam().plant(file);
    if (GetParam().refusal != nullptr) {
        const std::string message = file.error();
        EXPECT_NE(message.find(GetParam().refusal), std::string::npos) << message;
        return;
    }
    const Scene scene = file.read();
    const Primitive& read = scene.meshes.at(0).primitives.at(0);
    ASSERT_EQ(read.positions.size(), 3U);
    if (GetParam().expect) {
        GetParam().expect(read);
    }
    if (GetParam().notice != nullptr) {
        EXPECT_TRUE(std::any_of(scene.notices.begin(), scene.notices.end(), [](const std::string& notice) {
            return notice.find(GetParam().notice) != std::string::npos;
        })) << testing::PrintToString(scene.notices);
    }
    EXPECT_FALSE(evaluate(scene, 0.5).objects.empty());
}

INSTANTIATE_TEST_SUITE_P(Kinds, GltfFaults, testing::ValuesIn(kFaults),
                         [](const auto& one) { return std::string(one.param.name); });

INSTANTIATE_TEST_SUITE_P(Told, GltfFaults, testing::ValuesIn(kTold),
                         [](const auto& one) { return std::string(one.param.name); });

/// Time and place of each key one after the other, as in interleaved vertices.
TEST(GltfFaults, AStrideOnKeysOfAnimationsIsObeyed)
{
    FileBuilder file = faultless();
    const int view = file.addView<float>({0, 5, 6, 7, 1, 8, 9, 10});
    file.root["bufferViews"][view]["byteStride"] = 16;
    json keys = {{"bufferView", view}, {"type", "SCALAR"}, {"componentType", 5126}, {"count", 2}};
    file.root["animations"][0]["samplers"][0]["input"] = file.addAccessor(keys);
    keys.update({{"byteOffset", 4}, {"type", "VEC3"}});
    file.root["animations"][0]["samplers"][0]["output"] = file.addAccessor(keys);
    const Scene scene = file.read();
    EXPECT_EQ(scene.animations.at(0).channels.at(0).times_s, (std::vector<float>{0, 1}));
    EXPECT_EQ(scene.animations[0].channels[0].values, (std::vector<float>{5, 6, 7, 8, 9, 10}));
}

TEST(GltfFaults, BehindTheLastColumnOfAMatrixNothingNeedsToBe)
{
    // Two MAT2 of bytes: columns at 0, 4, 8 and 12, and the last ends at 14.
    FileBuilder file;
    const int matrices = file.add<std::uint8_t>("MAT2", 5121, 2, {1, 2, 0, 0, 3, 4, 0, 0, 5, 6, 0, 0, 7, 8});
    file.root["accessors"][matrices].update({{"min", {1, 2, 3, 4}}, {"max", {5, 6, 7, 8}}}); // so all are read
    EXPECT_NO_THROW(static_cast<void>(file.read()));
    file.root["bufferViews"][0]["byteLength"] = 13;
    const std::string message = file.error();
    EXPECT_NE(message.find("offset 0, length 14"), std::string::npos) << message;
}

} // namespace
} // namespace gnomon::scene::test
