// SPDX-License-Identifier: Apache-2.0
// Objects under spot lights that project a texture, the setting of A. Shastry, "Soft-Edged Shadows", 2005.
// Views `stage` and `close`.
#include "mesh_maker.h"
#include "rng.h"
#include "scene_maker.h"
#include "stage_props.h"
#include "textures.h"

#include "scene/state.h"

#include <glm/geometric.hpp>

#include <array>

namespace gnomon::worlds {

namespace {

StagePalette addPalette(Scene& scene)
{
    StagePalette p;
    const std::uint32_t tiles = addTexture(scene, marbleTiles());
    const std::uint32_t normals = addTexture(scene, marbleTileNormals());
    const std::uint32_t wall = addTexture(scene, plaster());
    const std::uint32_t boards = addTexture(scene, planks());
    p.floor = addMaterial(scene, "tiles", {.roughness = 0.38F, .texture = tiles, .normal_texture = normals});
    p.wall = addMaterial(scene, "plaster", {.base_colour = rgb(0xB9AA98), .roughness = 0.95F, .texture = wall});
    p.marble = addMaterial(scene, "marble", {.base_colour = rgb(0xE6DED0), .texture = wall, .phong_exponent = 22.0F});
    p.bronze = addMaterial(scene, "bronze", {.base_colour = rgb(0xB07B45), .phong_exponent = 34.0F});
    p.glaze = addMaterial(scene, "glaze", {.base_colour = rgb(0x2F8F8B), .phong_exponent = 70.0F});
    p.lacquer = addMaterial(scene, "lacquer", {.base_colour = rgb(0xC4372C), .phong_exponent = 90.0F});
    p.pearl = addMaterial(scene, "pearl", {.base_colour = rgb(0xEFE9E2), .roughness = 0.3F});
    p.brass = addMaterial(scene, "brass", {.base_colour = rgb(0xD9B35B), .phong_exponent = 50.0F});
    p.wood = addMaterial(scene, "wood", {.roughness = 0.85F, .texture = boards});
    p.iron = addMaterial(scene, "iron", {.base_colour = rgb(0x2B2C30), .roughness = 0.6F});
    p.glow = addMaterial(scene, "glow", {.emissive = {12.5F, 11.2F, 9.6F}});
    return p;
}

void addRoom(Scene& scene, const StagePalette& palette)
{
    MeshMaker floor;
    Part& tiles = floor.with(palette.floor);
    tiles.uv_per_metre = 0.25F; // tiles of one metre
    tiles.quad({-20, 0, 10}, {20, 0, 10}, {20, 0, -4.6F}, {-20, 0, -4.6F});
    addNode(scene, "floor", addMesh(scene, floor.take("floor")), {});
    MeshMaker wall;
    Part& plastered = wall.with(palette.wall);
    plastered.uv_per_metre = 0.3F;
    plastered.quad({-20, 0, -4.6F}, {20, 0, -4.6F}, {20, 9, -4.6F}, {-20, 9, -4.6F});
    Part& trim = wall.with(palette.marble);
    trim.box({-20, 0, -4.6F}, {20, 0.45F, -4.42F});
    trim.box({-20, 6.2F, -4.6F}, {20, 6.5F, -4.35F}, 1.0F, true);
    addNode(scene, "wall", addMesh(scene, wall.take("wall")), {});
}

/// A row of four columns that carry three arches.
void addArcade(Scene& scene, const StagePalette& palette)
{
    const std::uint32_t column = addMesh(scene, makeColumn(palette, 3.2F));
    const std::uint32_t arch = addMesh(scene, makeArch(palette, 3.0F));
    for (int i = 0; i < 4; ++i) {
        const float x = 3.0F * (static_cast<float>(i) - 1.5F);
        addNode(scene, "column/" + std::to_string(i), column, standing({x, 0, -2.9F}));
        if (i < 3) {
            addNode(scene, "arch/" + std::to_string(i), arch, standing({x + 1.5F, 3.2F, -2.9F}));
        }
    }
}

struct Turning {
    std::uint32_t rings = 0; // the armillary sphere's first ring; two more follow
    std::uint32_t gear_lamp = 0;
    glm::quat gear_rest{1.0F, 0.0F, 0.0F, 0.0F};
};

std::uint32_t addArmillary(Scene& scene, const StagePalette& palette, const glm::vec3& centre)
{
    const std::uint32_t ring = addMesh(scene, makeRing(palette, 0.62F, 0.035F));
    std::uint32_t parent = kNone;
    std::uint32_t first = 0;
    for (int i = 0; i < 3; ++i) { // each ring hangs in the one around it
        Transform transform = standing(i == 0 ? centre : glm::vec3(0.0F), 0.0F, i == 0 ? 1.0F : 0.84F);
        const std::uint32_t node = addNode(scene, "ring/" + std::to_string(i), ring, transform, parent);
        scene.nodes[node].dynamic = true;
        first = i == 0 ? node : first;
        parent = node;
    }
    MeshMaker core;
    core.with(palette.lacquer).ball(0.3F, 3);
    addNode(scene, "core", addMesh(scene, core.take("core")), standing(centre));
    return first;
}

std::uint32_t addSculptures(Scene& scene, const StagePalette& palette)
{
    const auto put = [&](const char* name, Mesh mesh, const Transform& transform) {
        addNode(scene, name, addMesh(scene, std::move(mesh)), transform);
    };
    put("pedestal", makePedestal(palette, 0.75F, 0.8F), standing({0, 0, -0.9F}));
    put("figure", makeFigure(palette), standing({0, 0.8F, -0.9F}, 0.25F));
    put("teapot", makeTeapot(palette), standing({2.6F, 0.0F, 1.5F}, -0.5F, 1.25F));
    put("urn", makeUrn(palette), standing({-2.7F, 0, 0.1F}, 0.0F, 1.0F));
    put("crates", makeCrateStack(palette), standing({4.6F, 0, -0.6F}, 0.3F));
    put("broken column", makeColumn(palette, 1.15F), standing({-4.6F, 0, 0.9F}, 0.2F));
    put("armillary stand", makePedestal(palette, 0.42F, 1.1F), standing({-1.55F, 0, 1.9F}));
    const std::uint32_t rings = addArmillary(scene, palette, {-1.55F, 1.85F, 1.9F});
    MeshMaker pearl;
    pearl.with(palette.pearl).ball(0.5F, 3);
    const std::uint32_t ball = addMesh(scene, pearl.take("pearl"));
    MeshMaker lacquer;
    lacquer.with(palette.lacquer).ball(0.5F, 3);
    const std::uint32_t red = addMesh(scene, lacquer.take("lacquer ball"));
    addNode(scene, "ball/0", ball, standing({1.05F, 0.5F, 2.5F}));
    addNode(scene, "ball/1", red, standing({1.95F, 0.3F, 3.1F}, 0.0F, 0.6F));
    addNode(scene, "ball/2", ball, standing({-3.5F, 0.28F, 2.6F}, 0.0F, 0.56F));
    addNode(scene, "ball/3", red, standing({-4.6F, 1.55F, 0.9F}, 0.0F, 0.8F));
    const std::uint32_t piece = addMesh(scene, makeChessPiece(palette));
    for (int i = 0; i < 5; ++i) {
        const auto s = static_cast<float>(i);
        addNode(
            scene, "piece/" + std::to_string(i), piece,
            standing({3.2F + 0.62F * s, 0, 3.3F - 0.55F * s - 0.25F * static_cast<float>(i & 1)}, s, 1.0F - 0.07F * s));
    }
    return rings;
}

struct Lamp {
    const char* name;
    glm::vec3 position;
    glm::vec3 target;
    glm::vec3 colour;
    float intensity;
    float outer_rad;
};

std::uint32_t addLamp(Scene& scene, const Lamp& lamp, std::uint32_t cookie, std::uint32_t housing)
{
    Light light;
    light.name = lamp.name;
    light.type = LightType::spot;
    light.colour = lamp.colour;
    light.intensity = lamp.intensity;
    light.range_m = 30.0F;
    light.outer_cone_rad = lamp.outer_rad;
    light.inner_cone_rad = lamp.outer_rad * 0.85F;
    light.radius_m = 0.08F;
    light.cookie = cookie;
    const std::uint32_t node = addLight(scene, light, lamp.position, lamp.target - lamp.position);
    const std::uint32_t can = addNode(scene, std::string(lamp.name) + " housing", housing, {}, node);
    scene.nodes[can].casts = false; // it stands around its own light
    return node;
}

std::uint32_t addLamps(Scene& scene, const StagePalette& palette)
{
    const auto cookie = [&](Image image) {
        scene.images.push_back(std::move(image));
        return static_cast<std::uint32_t>(scene.images.size() - 1);
    };
    const std::uint32_t window_cookie = cookie(windowCookie());
    const std::uint32_t foliage_cookie = cookie(foliageCookie());
    const std::uint32_t gear_cookie = cookie(gearCookie());
    const std::uint32_t housing = addMesh(scene, makeLampHousing(palette));
    addLamp(scene, {"window", {-6.4F, 6.6F, 6.2F}, {0.3F, 1.5F, -2.6F}, {1.0F, 0.74F, 0.44F}, 560.0F, 0.46F},
            window_cookie, housing);
    addLamp(scene, {"foliage", {7.2F, 6.2F, 5.4F}, {0.2F, 1.2F, -1.2F}, {0.34F, 0.56F, 1.0F}, 470.0F, 0.50F},
            foliage_cookie, housing);
    return addLamp(scene, {"gear", {0.4F, 8.2F, 3.6F}, {0.2F, 0.0F, 1.5F}, {1.0F, 0.95F, 0.88F}, 430.0F, 0.46F},
                   gear_cookie, housing);
}

glm::quat aboutAxis(const glm::vec3& axis, double turns)
{
    const double half = 0.5 * turns;
    const auto t = static_cast<float>(half - std::floor(half));
    const float s = sineOfTurns(t);
    return {cosineOfTurns(t), axis.x * s, axis.y * s, axis.z * s};
}

} // namespace

Scene makeSpotlit(std::uint64_t /*seed*/)
{
    Scene scene;
    scene.name = "spotlit";
    const StagePalette palette = addPalette(scene);
    addRoom(scene, palette);
    addArcade(scene, palette);
    Turning turning;
    turning.rings = addSculptures(scene, palette);
    turning.gear_lamp = addLamps(scene, palette);
    turning.gear_rest = scene.nodes[turning.gear_lamp].transform.rotation;
    scene.nodes[turning.gear_lamp].dynamic = true;
    scene.environment.sky_zenith = {0.021F, 0.025F, 0.042F};
    scene.environment.sky_horizon = {0.062F, 0.062F, 0.079F};
    scene.environment.ground = {0.042F, 0.033F, 0.025F};
    scene.environment.ambient = 1.7F;
    scene.environment.exposure = 0.6F;
    scene.views = {
        {.name = "stage", .eye = {0.9F, 3.3F, 10.6F}, .target = {0.1F, 2.05F, -1.0F}, .fov_y_rad = 0.72F},
        {.name = "close", .eye = {4.6F, 2.1F, 6.2F}, .target = {0.9F, 1.15F, 0.4F}, .fov_y_rad = 0.68F},
    };
    scene.procedural = [turning](double time_s, std::vector<Node>& nodes) {
        nodes[turning.rings].transform.rotation = aboutAxis({0, 1, 0}, 0.05 * time_s + 0.09);
        nodes[turning.rings + 1].transform.rotation = aboutAxis({1, 0, 0}, 0.08 * time_s + 0.17);
        nodes[turning.rings + 2].transform.rotation =
            aboutAxis({0, 0, 1}, 0.11 * time_s + 0.21) * aboutAxis({1, 0, 0}, 0.25);
        nodes[turning.gear_lamp].transform.rotation = turning.gear_rest * aboutAxis({0, 0, 1}, 0.02 * time_s);
    };
    scene.procedural(0.0, scene.nodes);
    finishScene(scene);
    return scene;
}

} // namespace gnomon::worlds
