// SPDX-License-Identifier: Apache-2.0
// Scenes beyond the range of sizes and places: each command that looks at one says so in a line, and writes nothing.
#include "folder.h"
#include "process.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace gnomon {
namespace {

struct FarTriangle {
    std::string name;
    std::string placed;       // members of the node
    bool moves = false;       // from its place at 0 s to x = 1e12 at 1 s
    const char* range = "20"; // of the light
};

/// A triangle of 1 m under a node, and a lamp above it.
std::string textOfScene(const FarTriangle& node)
{
    const std::string animation =
        node.moves ? R"("animations": [{"channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}],
                   "samplers": [{"input": 1, "output": 2}]}],)"
                   : "";
    return R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_lights_punctual"],
  "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "range": )" +
           std::string(node.range) + R"(}]}}, "scene": 0, "scenes": [{"nodes": [0, 1]}], )" + animation +
           R"("nodes": [{"mesh": 0, "name": ")" + node.name + "\"" + (node.placed.empty() ? "" : ", ") + node.placed +
           R"(}, {"translation": [0, 0, 3], "extensions": {"KHR_lights_punctual": {"light": 0}}}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
    {"bufferView": 1, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [1]},
    {"bufferView": 2, "componentType": 5126, "count": 2, "type": "VEC3"}],
  "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 1, "byteLength": 8},
    {"buffer": 1, "byteOffset": 8, "byteLength": 24}],
  "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"},
    {"byteLength": 32, "uri": "data:application/octet-stream;base64,AAAAAAAAgD8AAAAAAAAAAAAAAACl1GhTAAAAAAAAAAA="}]})";
}

const std::vector<std::vector<std::string>> kCommandsOfScenes{
    {"plan", "a.gltf", "--json", "b.json"},
    {"render", "a.gltf", "--out", "b.png"},
    {"render", "a.gltf", "--truth", "hard", "--mask", "--no-cache", "--out", "b.png"},
    {"compare", "a.gltf", "--no-cache", "--json", "b.json"},
    {"bench", "a.gltf", "--json", "b.json"}};

void expectRefusal(const FarTriangle& node, const std::string& part, const std::vector<std::string>& more = {})
{
    SCOPED_TRACE(node.name);
    const test::Folder folder;
    test::spill(folder / "a.gltf", textOfScene(node));
    for (std::vector<std::string> command : kCommandsOfScenes) {
        SCOPED_TRACE(command[0]);
        command.insert(command.end(), {"--size", "32x18"});
        command.insert(command.end(), more.begin(), more.end());
        const test::Ran ran = test::gnomon(command, {.folder = folder.path()});
        EXPECT_EQ(ran.status, 1) << ran.err;
        ASSERT_EQ(ran.errorLines().size(), 1U) << ran.err;
        EXPECT_NE(ran.err.find(part), std::string::npos) << ran.err;
        EXPECT_EQ(folder.names().size(), 1U);
    }
}

TEST(WorldRangeOfProgram, RefusesInOneLine)
{
    constexpr const char* kTooFar = "farther than 1e9 m from the origin";
    constexpr const char* kTooSmall = "smaller than 1e-6 m";
    expectRefusal({"huge", R"("scale": [1e18, 1e18, 1e18])"}, kTooFar);
    expectRefusal({"endless", R"("scale": [1e30, 1e30, 1e30], "translation": [3e38, 3e38, 0])"}, kTooFar);
    expectRefusal({"far", R"("translation": [0, 1e12, 0])"}, kTooFar);
    expectRefusal({"tiny", R"("scale": [1e-7, 1e-7, 1e-7])"}, kTooSmall);
    expectRefusal({"nothing", R"("scale": [0, 0, 0])"}, "the scene has no size");
    expectRefusal({"coarse", R"("translation": [0, 0, 1e6])"}, "1/100000 of its distance");
    expectRefusal({"lamp", "", false, "1e12"}, "the range of light");
}

TEST(WorldRangeOfProgram, RefusesWhatIsNotANumber)
{
    expectRefusal({"overflow", R"("matrix": [3e38, 3e38, 0, 0, 3e38, 3e38, 0, 0, 0, 0, 1, 0, 3e38, 3e38, 0, 1])"},
                  "'overflow' is not finite");
}

TEST(WorldRangeOfProgram, LooksAtEveryFrame)
{
    const test::Folder folder;
    test::spill(folder / "a.gltf", textOfScene({"runaway", "", true}));
    const test::Ran ran =
        test::gnomon({"render", "a.gltf", "--truth", "hard", "--mask", "--no-cache", "--size", "32x18", "--frames",
                      "0-3", "--fps", "4", "--eye", "0,0,5", "--target", "0,0,0", "--out", "b.png"},
                     {.folder = folder.path()});
    EXPECT_EQ(ran.status, 1);
    ASSERT_FALSE(ran.errorLines().empty());
    EXPECT_NE(ran.errorLines().back().find("farther than 1e9 m"), std::string::npos) << ran.err;
    EXPECT_EQ(folder.names().size(), 1U);
}

} // namespace
} // namespace gnomon
