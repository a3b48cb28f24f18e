// SPDX-License-Identifier: Apache-2.0
// Little files that ask for much. Memory follows the file: Limits::max_growth.
#include "support.h"

namespace gnomon::scene::test {
namespace {

void expectOutOfProportion(const std::string& message)
{
    EXPECT_NE(message.find("over the limit growth=2048"), std::string::npos) << message;
    EXPECT_NE(message.find("--limit growth=N"), std::string::npos) << message;
}

TEST(GltfProportion, ZerosThatNobodyWrote)
{
    FileBuilder file; // 100 million positions, less than is allowed of vertices, of no data at all
    const int zeros = file.addAccessor({{"type", "VEC3"}, {"componentType", 5126}, {"count", 100'000'000}});
    file.addMesh({{"attributes", {{"POSITION", zeros}}}});
    expectOutOfProportion(file.error());
    file.root["accessors"][0]["count"] = 1000; // what is free of it
    EXPECT_NO_THROW(static_cast<void>(file.read()));
}

TEST(GltfProportion, ZerosButForOne)
{
    FileBuilder file;
    const int indices = file.addView<std::uint32_t>({99'999'999});
    const int values = file.addView<float>({1, 2, 3});
    static_cast<void>(file.addAccessor({{"type", "VEC3"},
                                        {"componentType", 5126},
                                        {"count", 100'000'000},
                                        {"sparse",
                                         {{"count", 1},
                                          {"indices", {{"bufferView", indices}, {"componentType", 5125}}},
                                          {"values", {{"bufferView", values}}}}}}));
    expectOutOfProportion(file.error());
}

TEST(GltfProportion, TheSameDataInManyMeshes)
{
    FileBuilder file; // 60 KB that 9000 meshes of 40 bytes each read anew: half a gigabyte
    const int positions = file.add<float>("VEC3", 5126, 5000, std::vector<float>(3 * 5000, 0.5F));
    for (int i = 0; i < 9000; ++i) {
        file.root["meshes"].push_back({{"primitives", json::array({{{"attributes", {{"POSITION", positions}}}}})}});
    }
    const std::string message = file.error({.max_growth = 16});
    EXPECT_NE(message.find("over the limit growth=16"), std::string::npos) << message;
}

TEST(GltfProportion, LoopsAndDeepTreesOfNodes)
{
    FileBuilder deep;
    for (int i = 1; i < 3'000; ++i) {
        deep.root["nodes"].push_back({{"children", {i}}});
    }
    deep.root["nodes"].push_back(json::object());
    EXPECT_NE(deep.error().find("over the limit node-depth=256"), std::string::npos);
    deep.root["nodes"].back()["children"] = {0};
    EXPECT_NE(deep.error().find("part of a loop"), std::string::npos);
}

} // namespace
} // namespace gnomon::scene::test
