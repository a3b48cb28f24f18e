// SPDX-License-Identifier: Apache-2.0
// Two things thousands of kilometres apart: each is seen from near by, and the program says what is lost.
#include "folder.h"
#include "process.h"

#include "app/command_line.h"
#include "app/shot.h"
#include "host/view.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace gnomon {
namespace {

using nlohmann::json;

/// A box on a plate, and a copy of both `apart_m` metres away.
json twoPlaces(double apart_m)
{
    json gltf = json::parse(R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 2, 3]}],
      "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
      "accessors": [{"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3", "min": [-1, -1, -1], "max": [1, 1, 1]},
                    {"bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR"}],
      "bufferViews": [{"buffer": 0, "byteLength": 96}, {"buffer": 0, "byteOffset": 96, "byteLength": 72}],
      "buffers": [{"byteLength": 168, "uri": "data:application/octet-stream;base64,AACAvwAAgL8AAIC/AACAPwAAgL8AAIC/AACAvwAAgD8AAIC/AACAPwAAgD8AAIC/AACAvwAAgL8AAIA/AACAPwAAgL8AAIA/AACAvwAAgD8AAIA/AACAPwAAgD8AAIA/AQADAAcAAQAHAAUAAAAEAAYAAAAGAAIAAgAGAAcAAgAHAAMABAAFAAcABAAHAAYAAAACAAMAAAADAAEAAAABAAUAAAAFAAQA"}]})");
    for (const double x : {0.0, apart_m}) {
        gltf["nodes"].push_back({{"mesh", 0}, {"translation", {x, -0.5, 0.0}}, {"scale", {9.0, 0.5, 9.0}}});
        gltf["nodes"].push_back({{"mesh", 0}, {"translation", {x, 1.0, 0.0}}});
    }
    return gltf;
}

/// The words of the program, with a camera that looks at one of the two places.
std::string said(const test::Folder& folder, double x, std::vector<std::string> arguments)
{
    const std::vector<std::string> camera{"far.gltf", fmt::format("--eye={:.0f},6,12", x + 8.0),
                                          fmt::format("--target={:.0f},0.5,0", x), "--size=96x64", "--ground=off"};
    arguments.insert(arguments.begin() + 1, camera.begin(), camera.end());
    const test::Ran ran = test::gnomon(arguments, {.folder = folder.path()});
    EXPECT_EQ(ran.status, 0) << ran.err;
    return ran.err;
}

TEST(FarApart, IsToldWithTheStepsOfCoordinates)
{
    struct Case {
        double apart_m;
        std::string reach;
        std::string step;
    };
    for (const Case& at : {Case{2e6, "2000 km", "0.125 m"}, Case{2e7, "20000 km", "2 m"}}) {
        const test::Folder folder;
        test::spill(folder / "far.gltf", twoPlaces(at.apart_m).dump());
        const std::string words = fmt::format("the scene reaches {} from the origin, where single precision has steps "
                                              "of {}: shadows of 4 of its 4 objects",
                                              at.reach, at.step);
        for (const double x : {0.0, at.apart_m}) {
            for (const std::vector<std::string>& run : {std::vector<std::string>{"render", "-o", "a.png"},
                                                        {"render", "--truth", "hard", "-o", "a.png"},
                                                        {"compare", "--truth", "hard", "--repetitions", "1", "--warmup",
                                                         "0", "--techniques", "hard,pcf+multi"}}) {
                const std::string err = said(folder, x, run);
                EXPECT_NE(err.find(words), std::string::npos) << err;
            }
        }
    }
}

TEST(FarApart, IsNotToldOfAWorldOfAFewKilometres)
{
    const test::Folder folder;
    test::spill(folder / "far.gltf", twoPlaces(5e3).dump());
    EXPECT_EQ(said(folder, 0.0, {"render", "-o", "a.png"}).find("single precision"), std::string::npos);
}

// A near plane by the scene's diagonal alone would be 100 m before the camera.
TEST(FarApart, CutsNothingAwayBeforeTheCamera)
{
    const test::Folder folder;
    test::spill(folder / "far.gltf", twoPlaces(2e6).dump());
    app::Settings settings = app::defaultSettings();
    settings.scene = (folder / "far.gltf").string();
    const app::Shot shot = app::makeShot(settings);
    const host::Eye eye{.position_ws = {8.0, 6.0, 12.0}, .target_ws = {0.0, 0.5, 0.0}};
    const Camera camera = host::cameraOf(eye, 96, 64, shot.state.bounds_ws);
    const glm::dvec3 before = eye.position_ws + glm::normalize(eye.target_ws - eye.position_ws);
    const glm::dvec4 clip = camera.clip_from_world * glm::dvec4(before, 1.0);
    EXPECT_LT(clip.z, clip.w) << "a metre before the eye";
}

} // namespace
} // namespace gnomon
