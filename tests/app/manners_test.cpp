// SPDX-License-Identifier: Apache-2.0
// The defaults of a file without camera, light and ground: a picture that it fills, a sun, and a ground.
#include "folder.h"
#include "process.h"

#include "app/command_line.h"
#include "app/shot.h"
#include "files/files.h"
#include "image/image_io.h"

#include <gnomon/world_range.h>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace gnomon {
namespace {

struct Box {
    glm::vec3 min;
    glm::vec3 max;
};

/// A file whose scene is boxes: a node each, of one mesh of 24 vertices.
std::string writeBoxes(const std::filesystem::path& folder, const std::vector<Box>& boxes)
{
    std::vector<float> places;
    std::string indices;
    for (int side = 0; side < 6; ++side) {
        const int axis = side / 2;
        const float at = side % 2 == 0 ? 0.0F : 1.0F;
        for (const auto& [u, v] : {std::pair{0.0F, 0.0F}, {1.0F, 0.0F}, {1.0F, 1.0F}, {0.0F, 1.0F}}) {
            glm::vec3 p(at);
            p[(axis + 1) % 3] = side % 2 == 0 ? v : u; // counter-clockwise from outside
            p[(axis + 2) % 3] = side % 2 == 0 ? u : v;
            places.insert(places.end(), {p.x, p.y, p.z});
        }
        for (const int corner : {0, 1, 2, 0, 2, 3}) {
            const auto index = static_cast<std::uint16_t>(4 * side + corner);
            indices.append(reinterpret_cast<const char*>(&index), sizeof index);
        }
    }
    std::string bytes(reinterpret_cast<const char*>(places.data()), places.size() * sizeof(float));
    writeFile(folder / "box.bin", bytes + indices);
    std::string nodes;
    std::string roots;
    for (const Box& box : boxes) {
        const glm::vec3 size = box.max - box.min;
        roots += fmt::format("{}{}", roots.empty() ? "" : ",", std::count(nodes.begin(), nodes.end(), '{'));
        nodes += fmt::format("{}{{\"mesh\":0,\"translation\":[{},{},{}],\"scale\":[{},{},{}]}}",
                             nodes.empty() ? "" : ",", box.min.x, box.min.y, box.min.z, size.x, size.y, size.z);
    }
    const std::string text = fmt::format(
        R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[{}]}}],"nodes":[{}],
"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],
"accessors":[{{"bufferView":0,"componentType":5126,"count":24,"type":"VEC3","min":[0,0,0],"max":[1,1,1]}},
{{"bufferView":1,"componentType":5123,"count":36,"type":"SCALAR"}}],
"bufferViews":[{{"buffer":0,"byteLength":288}},{{"buffer":0,"byteOffset":288,"byteLength":72}}],
"buffers":[{{"uri":"box.bin","byteLength":360}}]}})",
        roots, nodes);
    writeFile(folder / "boxes.gltf", text);
    return (folder / "boxes.gltf").string();
}

std::string sharedScene(const char* name)
{
    const char* given = std::getenv("GNOMON_SHARED");
    return (std::filesystem::path(given != nullptr ? given : GNOMON_SHARED_DIR) / "scenes" / name).string();
}

app::Settings settingsOf(std::vector<std::string> arguments)
{
    arguments.insert(arguments.begin(), "render");
    arguments.insert(arguments.end(), {"--size", "480x270"});
    return app::parseCommandLine(arguments).settings;
}

app::Shot shotOf(const std::vector<std::string>& arguments)
{
    return app::makeShot(settingsOf(arguments));
}

/// The part of the picture that vertices cover, from -1 to 1 both ways.
struct Covered {
    glm::dvec2 least{1e9};
    glm::dvec2 most{-1e9};
    void add(const glm::dmat4& clip_from_world, const glm::dvec3& p)
    {
        const glm::dvec4 clip = clip_from_world * glm::dvec4(p, 1.0);
        ASSERT_GT(clip.w, 0.0);
        least = glm::min(least, glm::dvec2(clip) / clip.w);
        most = glm::max(most, glm::dvec2(clip) / clip.w);
    }
    [[nodiscard]] glm::dvec2 share() const { return (most - least) / 2.0; }
    [[nodiscard]] bool isInside() const { return least.x >= -1.0 && least.y >= -1.0 && most.x <= 1.0 && most.y <= 1.0; }
};

/// The model is large in the picture, all of it is there, and so is its shadow on the ground.
void expectFramed(const app::Shot& shot)
{
    const Camera camera = host::cameraOf(shot.eye, 480, 270, shot.state.bounds_ws);
    const Aabb model = app::modelBounds(shot);
    const glm::dvec3 sun = shot.lights.front().caster.direction_ws;
    ASSERT_LT(sun.y, 0.0);
    Covered seen;
    Covered all;
    for (const scene::Object& object : shot.state.objects) {
        if (object.node == shot.ground) {
            continue;
        }
        const auto& still = shot.scene.meshes[object.mesh].primitives[object.primitive].positions;
        const auto& places = object.deformed != scene::kNone ? shot.state.deformed[object.deformed].positions : still;
        for (const glm::vec3& place : places) {
            const glm::dvec3 p(object.world_from_object * glm::vec4(place, 1.0F));
            seen.add(camera.clip_from_world, p);
            all.add(camera.clip_from_world, p);
            if (shot.ground) {
                const double height = p.y - static_cast<double>(model.min.y);
                all.add(camera.clip_from_world, p - sun * (height / sun.y));
            }
        }
    }
    EXPECT_TRUE(all.isInside()) << all.least.x << ' ' << all.least.y << ' ' << all.most.x << ' ' << all.most.y;
    EXPECT_GT(std::max(seen.share().x, seen.share().y), 0.6);
    EXPECT_NEAR(std::max(all.share().x, all.share().y), 0.92, 0.02);
}

TEST(Framing, HasAllOfAModelAndItsShadowAndFillsThePicture)
{
    const test::Folder folder;
    struct Shape {
        const char* name;
        Box box;
    };
    for (const Shape& shape :
         {Shape{"cube", {{0, 0, 0}, {1, 1, 1}}}, Shape{"tower", {{-1, 0, -1}, {1, 12, 1}}},
          Shape{"slab", {{-4, 0, -3}, {4, 0.2F, 3}}}, Shape{"wall", {{-5, 0, 0}, {5, 3, 0.3F}}},
          Shape{"wall along z", {{0, 0, -5}, {0.3F, 3, 5}}}, Shape{"a kilometre", {{-500, 0, -500}, {500, 800, 500}}},
          Shape{"a millimetre", {{0, 0, 0}, {0.001F, 0.001F, 0.001F}}},
          Shape{"far from the origin", {{40000, 100, -70000}, {40004, 103, -69996}}}}) {
        SCOPED_TRACE(shape.name);
        const app::Shot shot = shotOf({writeBoxes(folder.path(), {shape.box})});
        EXPECT_TRUE(shot.ground);
        expectFramed(shot);
    }
}

// A file's own ground, however wide, and a dome around all of it do not count.
TEST(Framing, IsOfTheDetailAndNotOfWhatLiesAroundIt)
{
    const test::Folder folder;
    const Box house{{-2, 0, -1}, {2, 3, 1}};
    const Box shed{{3, 0, 0}, {4, 1, 1}};
    const Box shelf{{-1, 0.5F, -0.5F}, {1, 0.6F, 0.5F}};
    const auto eyeOf = [&](const std::vector<Box>& around) {
        std::vector<Box> boxes{house, shed, shelf};
        boxes.insert(boxes.end(), around.begin(), around.end());
        return shotOf({writeBoxes(folder.path(), boxes)}).eye;
    };
    const host::Eye near = eyeOf({{{-20, -0.1F, -20}, {20, 0, 20}}});
    for (const Box& wide : {Box{{-300, -0.1F, -300}, {300, 0, 300}}, Box{{-3000, -1, -1000}, {9000, 0, 2000}}}) {
        const host::Eye eye = eyeOf({wide});
        EXPECT_NEAR(glm::distance(eye.position_ws, near.position_ws), 0.0, 1e-3);
    }
    const host::Eye domed = eyeOf({{{-300, -0.1F, -300}, {300, 0, 300}}, {{-500, -400, -500}, {500, 500, 500}}});
    EXPECT_NEAR(glm::distance(domed.position_ws, near.position_ws), 0.0, 1e-3);
    // A place that is built over is looked at as a whole.
    const host::Eye town =
        eyeOf({{{-100, 0, -100}, {-90, 9, -90}}, {{90, 0, 90}, {100, 9, 100}}, {{-100, -1, -100}, {100, 0, 100}}});
    EXPECT_GT(glm::length(town.position_ws), 100.0);
}

TEST(Framing, HasAllOfSkinnedModelsAsTheyMove)
{
    for (const char* const name : {"skinned/Fox.glb", "skinned/CesiumMan.glb", "kaykit_adventurers/Knight.glb",
                                   "kaykit_adventurers/Rogue_Hooded.glb"}) {
        SCOPED_TRACE(name);
        const std::string file = sharedScene(name);
        if (!std::filesystem::exists(file)) {
            GTEST_SKIP() << file << " is not there";
        }
        for (const char* const time : {"0", "0.7"}) {
            expectFramed(shotOf({file, "--time", time}));
        }
    }
}

/// From above, the model's shaded side is not the one that is looked at.
TEST(DefaultSun, LightsWhatIsLookedAtFromTheSide)
{
    const test::Folder folder;
    for (const Box& box : {Box{{0, 0, 0}, {1, 1, 1}}, Box{{-5, 0, 0}, {5, 3, 0.3F}}, Box{{0, 0, -5}, {0.3F, 3, 5}}}) {
        const app::Shot shot = shotOf({writeBoxes(folder.path(), {box})});
        const glm::dvec3 sun = shot.lights.front().caster.direction_ws;
        const glm::dvec3 look = glm::normalize(shot.eye.target_ws - shot.eye.position_ws);
        const glm::dvec2 along = glm::normalize(glm::dvec2(look.x, look.z));
        const glm::dvec2 sunlight = glm::normalize(glm::dvec2(sun.x, sun.z));
        EXPECT_GT(glm::dot(along, sunlight), 0.5);
        EXPECT_LT(glm::dot(along, sunlight), 0.95);
        const glm::dvec3 face = box.max.x - box.min.x < 1.0F ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
        EXPECT_GT(glm::dot(face, -sun), 0.3) << "the side that is seen most";
    }
}

TEST(Ground, IsPutUnderWhatHasNone)
{
    const test::Folder folder;
    const Box thing{{-1, 0.2F, -1}, {1, 2, 1}};
    const auto hasGround = [&](const std::vector<Box>& boxes, const char* ground) {
        const std::string file = writeBoxes(folder.path(), boxes);
        return shotOf({file, "--ground", ground}).ground.has_value();
    };
    EXPECT_TRUE(hasGround({thing}, "auto"));
    EXPECT_FALSE(hasGround({thing}, "off"));
    const Box slab{{-4, 0, -4}, {4, 0.2F, 4}};
    EXPECT_FALSE(hasGround({thing, slab}, "auto")) << "it stands on something";
    EXPECT_TRUE(hasGround({thing, slab}, "on"));
    EXPECT_TRUE(hasGround({slab}, "auto")) << "it is the thing itself";
    EXPECT_TRUE(hasGround({thing, {{-4, 3, -4}, {4, 3.2F, 4}}}, "auto")) << "that is a roof";
    EXPECT_TRUE(hasGround({{{-1, 0, -0.5F}, {1, 0.1F, 0.5F}}, {{-1, 0.1F, -0.1F}, {1, 4, 0.1F}}}, "auto"))
        << "a wall on its foot";
    EXPECT_FALSE(shotOf({"planes"}).ground) << "built-in worlds are as they are";
    EXPECT_TRUE(shotOf({"planes", "--ground"}).ground);
}

/// So that the picture of another moment, or of a window in which time passes, is of the same place in the same light.
TEST(Ground, AndSunAreTheSameAtAnyTime)
{
    const std::string file = sharedScene("skinned/Fox.glb");
    if (!std::filesystem::exists(file)) {
        GTEST_SKIP() << file << " is not there";
    }
    const app::Shot first = shotOf({file});
    const app::Shot later = shotOf({file, "--time", "0.5", "--animation", "Run"});
    ASSERT_TRUE(first.ground && later.ground);
    EXPECT_EQ(first.lights.front().caster.direction_ws, later.lights.front().caster.direction_ws);
    EXPECT_EQ(first.scene.meshes.back().primitives.front().positions,
              later.scene.meshes.back().primitives.front().positions);
}

TEST(Ground, StaysInTheWorldThatThereIs)
{
    const test::Folder folder;
    const float half = 0.9F * static_cast<float>(kFarthestPlace_m);
    const app::Shot shot = shotOf({writeBoxes(folder.path(), {{{-half, 0, -half}, {half, 1e6F, half}}}), "--ground",
                                   "--eye", "0,1e8,1e8", "--target", "0,0,0"});
    EXPECT_TRUE(rangeFault(shot.state.bounds_ws).empty());
}

TEST(Ground, OptionTakesAWordOnlyIfItIsAValueOfIts)
{
    const auto groundOf = [](const std::vector<std::string>& arguments) {
        return settingsOf(arguments).ground;
    };
    EXPECT_EQ(groundOf({"planes"}), app::Ground::automatic);
    EXPECT_EQ(groundOf({"--ground", "planes"}), app::Ground::on);
    EXPECT_EQ(settingsOf({"--ground", "planes"}).scene, "planes");
    EXPECT_EQ(groundOf({"--ground", "off", "planes"}), app::Ground::off);
    EXPECT_EQ(groundOf({"planes", "--ground=auto"}), app::Ground::automatic);
    EXPECT_EQ(groundOf({"planes", "--set", "ground=off"}), app::Ground::off);
    EXPECT_THROW((void)groundOf({"planes", "--ground=maybe"}), app::UsageError);
}

/// Rows of one column of the picture, from the sky down to the ground: no step is an edge.
TEST(Ground, FadesIntoTheSky)
{
    const test::Folder folder;
    const std::string file = writeBoxes(folder.path(), {{{-1, 0, -1}, {1, 1, 1}}});
    for (const char* const shading : {"deferred", "forward"}) {
        const test::Ran ran =
            test::gnomon({"render", file, "--eye", "6,0.6,3", "--target", "0,0.5,-7", "--size", "32x240", "--filter",
                          "hard", "--shading", shading, "--set", "dither=0", "-o", "a.png"},
                         {.folder = folder.path()});
        ASSERT_EQ(ran.status, 0) << ran.err;
        const ImageF picture = readImage(folder.path() / "a.png");
        float most = 0.0F;
        for (std::uint32_t y = 1; y < picture.height; ++y) {
            most = std::max(most, std::abs(picture.pixel(31, y)[0] - picture.pixel(31, y - 1)[0]));
        }
        EXPECT_LT(most, 4.5F / 255.0F) << shading;
    }
}

/// However wide the ground is, a lamp is as bright as without it, and what is near by hides as much of the sky.
TEST(Ground, LeavesTheModelAsItIs)
{
    const test::Folder folder;
    const std::string file = writeBoxes(folder.path(), {{{-1, 0, -1}, {1, 1, 1}}});
    const auto topOf = [&](const char* ground) {
        const test::Ran ran = test::gnomon({"render", file, "--eye", "2.5,2.5,4", "--target", "0,1,0", "--point",
                                            "0.7,2.5,0.9,10", "--exposure", "-2", "--size", "64x36", "--set",
                                            "dither=0", "--ground", ground, "-o", "a.png"},
                                           {.folder = folder.path()});
        EXPECT_EQ(ran.status, 0) << ran.err;
        const ImageF picture = readImage(folder.path() / "a.png");
        return picture.pixel(32, 18)[1];
    };
    const float without = topOf("off");
    EXPECT_GT(without, 0.2F);
    EXPECT_LT(without, 0.95F);
    EXPECT_NEAR(topOf("on"), without, 2.5F / 255.0F);
}

/// It receives, and what the ray tracer says of it is said of the same ground.
TEST(Ground, ReceivesAndIsInTheTruth)
{
    const test::Folder folder;
    const std::string file = writeBoxes(folder.path(), {{{-1, 0, -1}, {1, 1, 1}}});
    const auto maskOf = [&](std::vector<std::string> with) {
        with.insert(with.begin(), {"render", file, "--size", "96x54", "--mask", "-o", "m.png"});
        const test::Ran ran = test::gnomon(with, {.folder = folder.path()});
        EXPECT_EQ(ran.status, 0) << ran.err;
        return readImage(folder.path() / "m.png");
    };
    const ImageF drawn = maskOf({"--filter", "hard", "--map-size", "1024"});
    const ImageF truth = maskOf({"--truth", "hard"});
    const ImageF without = maskOf({"--truth", "hard", "--ground", "off"});
    const auto shadowed = [](const ImageF& mask) {
        return std::ranges::count_if(mask.values, [](float v) { return v < 0.5F; });
    };
    EXPECT_GT(shadowed(truth), shadowed(without) + 50);
    EXPECT_NEAR(static_cast<double>(shadowed(drawn)), static_cast<double>(shadowed(truth)), 40.0);
}

TEST(UpAxis, TurnsAFile)
{
    const test::Folder folder;
    const std::string file = writeBoxes(folder.path(), {{{0, 0, 0}, {1, 2, 3}}});
    const Aabb as_it_is = app::modelBounds(shotOf({file}));
    const Aabb turned = app::modelBounds(shotOf({file, "--up-axis", "z"}));
    EXPECT_EQ(as_it_is.max, glm::vec3(1, 2, 3));
    EXPECT_NEAR(turned.max.y, 3.0F, 1e-5F);
    EXPECT_NEAR(turned.min.z, -2.0F, 1e-5F);
    EXPECT_NEAR(turned.max.x, 1.0F, 1e-5F);
    EXPECT_EQ(shotOf({"planes", "--up-axis", "z"}).notices.size(), 1U) << "a built-in world has y up";
}

TEST(UpAxis, IsAskedAboutWhereATownStandsOnEdge)
{
    const test::Folder folder;
    std::vector<Box> town{{{-10, -10, 0}, {10, 10, 0.1F}}};
    for (int i = 0; i < 9; ++i) {
        const glm::vec3 corner(-9 + 6 * (i % 3), -9 + 6 * (i / 3), 0.1F);
        town.push_back({corner, corner + glm::vec3(2, 2, 1 + i % 2)});
    }
    const auto saysSo = [](const app::Shot& shot) {
        return std::ranges::any_of(
            shot.notices, [](const std::string& text) { return text.find("--up-axis z") != std::string::npos; });
    };
    const std::string file = writeBoxes(folder.path(), town);
    EXPECT_TRUE(saysSo(shotOf({file})));
    const app::Shot turned = shotOf({file, "--up-axis", "z"});
    EXPECT_FALSE(saysSo(turned));
    EXPECT_FALSE(turned.ground) << "it has its own";
    const std::string picture_on_a_wall =
        writeBoxes(folder.path(), {{{-2, 0, 0}, {2, 3, 0.1F}}, {{-1.8F, 0.2F, 0.1F}, {1.8F, 2.8F, 0.2F}}});
    EXPECT_FALSE(saysSo(shotOf({picture_on_a_wall})));
}

} // namespace
} // namespace gnomon
