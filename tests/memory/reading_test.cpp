// SPDX-License-Identifier: Apache-2.0
// Memory that runs out while something is read: it is read whole or not at all, and can be read again.
#include "memory_sweep.h"
#include "tests/gltf/support.h"
#include "tests/image/folder.h"

#include "app/keyframes.h"
#include "app/preset.h"
#include "app/settings.h"
#include "app/src/result_json.h"
#include "image/image_io.h"
#include "scene/hash.h"
#include "worlds/worlds.h"

#include <gtest/gtest.h>

#include <optional>

namespace gnomon::test {
namespace {

using nlohmann::json;

/// A quad with a texture, morphed, moved by a bone, and the animation of both.
scene::test::FileBuilder sceneFile()
{
    scene::test::FileBuilder file;
    const int position = file.add<float>("VEC3", 5126, 4, {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
    file.root["accessors"][0]["min"] = {0, 0, 0};
    file.root["accessors"][0]["max"] = {1, 1, 0};
    const int uv = file.add<float>("VEC2", 5126, 4, {0, 0, 1, 0, 1, 1, 0, 1});
    const int joints = file.add<std::uint8_t>("VEC4", 5121, 4, std::vector<std::uint8_t>(16, 0));
    const int weights = file.add<float>("VEC4", 5126, 4, {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    const int indices = file.add<std::uint16_t>("SCALAR", 5123, 6, {0, 1, 2, 0, 2, 3});
    const int offsets = file.add<float>("VEC3", 5126, 4, {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
    const int times = file.add<float>("SCALAR", 5126, 2, {0, 1});
    file.root["accessors"][times]["min"] = {0};
    file.root["accessors"][times]["max"] = {1};
    const int moves = file.add<float>("VEC3", 5126, 2, {0, 0, 0, 1, 2, 3});
    const int morphs = file.add<float>("SCALAR", 5126, 2, {0, 1});
    const int inverse = file.add<float>("MAT4", 5126, 1, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
    file.addMesh(
        {{"attributes", {{"POSITION", position}, {"TEXCOORD_0", uv}, {"JOINTS_0", joints}, {"WEIGHTS_0", weights}}},
         {"indices", indices},
         {"material", 0},
         {"targets", json::array({{{"POSITION", offsets}}})}});
    file.root["images"] = json::array({{{"uri", "leaf.png"}, {"name", "a name that is not short"}}});
    file.root["samplers"] = json::array({{{"wrapS", 33071}}});
    file.root["textures"] = json::array({{{"source", 0}, {"sampler", 0}}});
    file.root["materials"] = json::array({{{"name", "another name that is not short"},
                                           {"alphaMode", "MASK"},
                                           {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}});
    file.root["nodes"][0]["skin"] = 0;
    file.root["nodes"].push_back({{"name", "bone"}});
    file.root["nodes"].push_back({{"name", "the root of the skeleton"}, {"children", {0, 1}}});
    file.root["skins"] = json::array({{{"joints", {1}}, {"inverseBindMatrices", inverse}}});
    file.root["animations"] = json::array(
        {{{"samplers", json::array({{{"input", times}, {"output", moves}}, {{"input", times}, {"output", morphs}}})},
          {"channels", json::array({{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}},
                                    {{"sampler", 1}, {"target", {{"node", 0}, {"path", "weights"}}}}})}}});
    return file;
}

/// A picture with all values different.
template <typename T>
ImageOf<T> ramp(std::uint32_t width, std::uint32_t height, std::uint32_t channels)
{
    ImageOf<T> image(width, height, channels);
    for (std::size_t i = 0; i < image.values.size(); ++i) {
        image.values[i] = static_cast<T>(i);
    }
    return image;
}

/// Reads until every allocation has failed once; `hashOf` is what must be the same each time.
template <typename Read, typename HashOf>
void sweepReading(const std::string& name, const Read& read, const HashOf& hashOf, bool library_leaks = false)
{
    const auto expected = hashOf(read());
    std::optional<decltype(read())> result;
    const MemorySweep sweep{.name = name, .library_leaks = library_leaks};
    sweepMemory(
        sweep, [&] { result.emplace(read()); },
        [&](bool ended) {
            EXPECT_EQ(result.has_value(), ended);
            if (result) {
                EXPECT_EQ(hashOf(*result), expected);
            }
            result.reset();
            EXPECT_EQ(hashOf(read()), expected);
        });
}

TEST(ReadingMemory, ASceneIsWholeOrNotThere)
{
    const scene::test::TemporaryFolder folder;
    writePng(folder.path() / "leaf.png", ramp<std::uint8_t>(4, 4, 4));
    folder.write("scene.gltf", sceneFile().text());
    sweepReading(
        "reading a scene", [&] { return worlds::load((folder.path() / "scene.gltf").string(), 1); },
        [](const scene::Scene& scene) {
            EXPECT_EQ(scene.skins.size(), 1U);
            EXPECT_EQ(scene.animations.at(0).channels.size(), 2U);
            EXPECT_EQ(scene.images.at(0).width, 4U);
            return std::pair(scene::sceneHash(scene), scene::stateHash(scene::evaluate(scene, 0.4)));
        });
}

std::vector<float> valuesOf(const ImageF& image)
{
    return image.values;
}

TEST(ReadingMemory, APngIsWholeOrNotThere)
{
    const Folder folder;
    writePng(folder / "a.png", ramp<std::uint8_t>(5, 3, 4));
    sweepReading(
        "reading a PNG", [&] { return readImage(folder / "a.png"); }, valuesOf);
}

TEST(ReadingMemory, AnExrIsWholeOrNotThere)
{
    const Folder folder;
    writeExr(folder / "a.exr", ramp<float>(5, 3, 3), true);
    sweepReading(
        "reading an EXR", [&] { return readImage(folder / "a.exr"); }, valuesOf, true);
}

TEST(ReadingMemory, APresetIsWholeOrNotThere)
{
    const Folder folder;
    spill(folder / "preset.json", R"({"settings":{"map-size":"512","light-size":2,"filter":"pcf","size":"320x200",
                                      "camera":"a camera of a name that is not short"}})");
    sweepReading(
        "reading a preset",
        [&] {
            app::Settings settings;
            app::applyPreset(settings, (folder / "preset.json").string(), app::kRender);
            return settings;
        },
        [](const app::Settings& settings) { return app::jsonText(app::settingsJson(settings, app::kRender)); });
}

TEST(ReadingMemory, APathIsWholeOrNotThere)
{
    const std::string text = R"({"keys":[{"at":0,"eye":[0,1,2],"target":[0,0,0]},{"at":1,"eye":[3,4,5],"fov":50},
                                 {"at":2,"eye":[0,9,2],"target":[1,0,0],"fov":60}]})";
    sweepReading(
        "reading a path", [&] { return app::parseKeyframes(text, "a path of a name that is not short"); },
        [](const app::Keyframes& frames) { return frames.eye_ws.at(1.3).y + frames.fov_deg.at(0.7).x; });
}

} // namespace
} // namespace gnomon::test
