// SPDX-License-Identifier: Apache-2.0
// Files with more lights than a frame can have, and cameras without perspective.
#include "folder.h"
#include "lights_and_cameras.h"
#include "process.h"

#include "app/command_line.h"
#include "app/shot.h"
#include "image/image_io.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace gnomon {
namespace {

using nlohmann::json;

/// The triangle of kLightsAndCameras, and point lights 10 m apart along x.
json rowOfLights(int count, double range_m)
{
    json gltf = json::parse(test::kLightsAndCameras);
    json lights = json::array();
    json& nodes = gltf["nodes"];
    nodes.erase(1); // the lamp
    json shown = json::array({0, 1, 2});
    for (int i = 0; i < count; ++i) {
        lights.push_back({{"type", "point"}, {"name", "lamp" + std::to_string(i)}, {"range", range_m}});
        nodes.push_back(
            {{"translation", {10.0 * i, 0.5, 2.0}}, {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
        shown.push_back(3 + i);
    }
    gltf["extensions"]["KHR_lights_punctual"]["lights"] = lights;
    gltf["scenes"][0]["nodes"] = shown;
    return gltf;
}

test::Ran rendered(const test::Folder& folder, std::vector<std::string> more)
{
    std::vector<std::string> arguments{"render", "row.gltf", "--size", "32x18",    "--map-size",
                                       "64",     "--ground", "off",    "--camera", "Eye"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return test::gnomon(arguments, {.folder = folder.path()});
}

TEST(ManyLights, TheRestIsCounted)
{
    const test::Folder folder;
    test::spill(folder / "row.gltf", rowOfLights(300, 1e5).dump());
    const test::Ran all = rendered(folder, {"-o", "all.png"});
    ASSERT_EQ(all.status, 0) << all.err;
    EXPECT_NE(all.err.find("300 lights are in sight, and 128 is the most: 172 that give the least here are left out"),
              std::string::npos)
        << all.err;
    // One that is left out can be asked for.
    const test::Ran asked = rendered(folder, {"--mask", "--light", "lamp299", "-o", "mask.png"});
    EXPECT_EQ(asked.status, 0) << asked.err;
    const test::Ran truth = rendered(folder, {"--truth", "hard", "-o", "truth.png"}); // rays for no more either
    EXPECT_EQ(truth.status, 0) << truth.err;
}

app::Settings settingsOf(const test::Folder& folder, const std::string& camera)
{
    app::Settings settings = app::defaultSettings();
    settings.scene = (folder / "a.gltf").string();
    settings.camera = camera;
    return settings;
}

TEST(OrthographicCamera, OfAFileHasItsHeightAndPlanes)
{
    const test::Folder folder;
    test::spill(folder / "a.gltf", test::kLightsAndCameras);
    app::Settings settings = settingsOf(folder, "Map");
    const app::Shot map = app::makeShot(settings);
    EXPECT_EQ(map.eye.height_m, 2.0);
    EXPECT_NEAR(map.eye.near_m, 0.1, 1e-6);
    EXPECT_EQ(map.eye.far_m, 9.0);
    settings.ortho_m = 5.0;
    EXPECT_EQ(app::makeShot(settings).eye.height_m, 5.0);
    settings.camera = "Eye";
    const app::Shot eye = app::makeShot(settings);
    EXPECT_EQ(eye.eye.height_m, 5.0);
    EXPECT_EQ(eye.eye.position_ws, glm::dvec3(0, 0, 5));
}

TEST(OrthographicCamera, IsTheFirstOfAFileWithoutAnother)
{
    const test::Folder folder;
    json gltf = json::parse(test::kLightsAndCameras);
    gltf["cameras"].erase(1);
    gltf["nodes"][3].erase("camera");
    test::spill(folder / "a.gltf", gltf.dump());
    const app::Shot shot = app::makeShot(settingsOf(folder, ""));
    EXPECT_EQ(shot.camera, "camera0");
    EXPECT_EQ(shot.eye.height_m, 2.0);
}

TEST(OrthographicCamera, PutInHasNothingBehindIt)
{
    app::Settings settings = app::defaultSettings();
    const test::Folder folder;
    json gltf = json::parse(test::kLightsAndCameras);
    gltf.erase("cameras");
    gltf["nodes"][2].erase("camera");
    gltf["nodes"][3].erase("camera");
    test::spill(folder / "a.gltf", gltf.dump());
    settings = settingsOf(folder, "");
    settings.ortho_m = 0.01;
    const app::Shot shot = app::makeShot(settings);
    const glm::dvec3 forward = glm::normalize(shot.eye.target_ws - shot.eye.position_ws);
    for (int i = 0; i < 8; ++i) {
        EXPECT_GT(glm::dot(glm::dvec3(shot.state.bounds_ws.corner(i)) - shot.eye.position_ws, forward), 0.0);
    }
}

TEST(OrthographicCamera, HasNoFieldOfView)
{
    const test::Folder folder;
    test::spill(folder / "a.gltf", test::kLightsAndCameras);
    app::Settings settings = settingsOf(folder, "Map");
    settings.fov_deg = 30.0;
    const std::vector<std::string> notices = app::makeShot(settings).notices;
    EXPECT_TRUE(std::ranges::any_of(
        notices, [](const std::string& notice) { return notice.starts_with("--fov has no effect"); }));
}

} // namespace
} // namespace gnomon
