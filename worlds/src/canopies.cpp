// SPDX-License-Identifier: Apache-2.0
// Roofs over each other, the setting in which A. Lauritzen and M. McCool, "Layered Variance Shadow Maps", 2008, show
// light bleeding.
#include "worlds/canopies.h"

#include "mesh_maker.h"
#include "scene_maker.h"
#include "textures.h"

#include "scene/state.h"

#include <glm/geometric.hpp>

#include <string>

namespace gnomon::worlds {

namespace {

using Box = CanopiesWorld::Box;

struct Palette {
    std::uint32_t paving = kNone;
    std::uint32_t timber = kNone;
    std::uint32_t canvas = kNone;
    std::uint32_t clay = kNone;
};

void addGround(Scene& scene, const Palette& palette)
{
    constexpr float kHalf = CanopiesWorld::ground_half_size_m;
    MeshMaker maker;
    Part& part = maker.with(palette.paving);
    part.uv_per_metre = 0.25F; // tiles of one metre
    part.quad({-kHalf, 0, kHalf}, {kHalf, 0, kHalf}, {kHalf, 0, -kHalf}, {-kHalf, 0, -kHalf});
    addNode(scene, "ground", addMesh(scene, maker.take("ground")), {});
}

void addRoof(Scene& scene, const std::string& name, std::uint32_t material, const glm::vec4& colour, const Box& box)
{
    MeshMaker maker;
    Part& part = maker.with(material);
    part.uv_per_metre = 0.4F;
    part.colour = colour;
    part.box(box.min, box.max, 1.0F, true);
    addNode(scene, name, addMesh(scene, maker.take(name)), {});
}

/// From the ground to the underside of a roof, at a place where the roof hides all of it from the sun.
void addPost(Scene& scene, const Palette& palette, const std::string& name, const glm::vec2& place, float height)
{
    constexpr float kHalf = 0.12F;
    MeshMaker maker;
    Part& part = maker.with(palette.timber);
    part.colour = rgb(0x9A7B58);
    part.box({place.x - kHalf, 0.0F, place.y - kHalf}, {place.x + kHalf, height, place.y + kHalf});
    addNode(scene, name, addMesh(scene, maker.take(name)), {});
}

void addRoofs(Scene& scene, const Palette& palette)
{
    for (int i = 0; i < CanopiesWorld::slats; ++i) {
        addRoof(scene, "slat/" + std::to_string(i), palette.timber, rgb(0xC9A876), CanopiesWorld::slat(i));
    }
    addRoof(scene, "sail", palette.canvas, rgb(0xF1E9DA), CanopiesWorld::sail);
    addRoof(scene, "awning", palette.clay, rgb(0xC8553D), CanopiesWorld::awning);
    const float high = CanopiesWorld::slat(0).min.y;
    for (const int slat : {0, CanopiesWorld::slats - 1}) {
        const Box box = CanopiesWorld::slat(slat);
        const float x = 0.5F * (box.min.x + box.max.x) + 0.5F * CanopiesWorld::sun_direction.x * high;
        addPost(scene, palette, "pergola post/" + std::to_string(slat), {x, 4.2F}, high);
    }
    for (const float x : {-4.0F, -3.0F}) {
        addPost(scene, palette, x < -3.5F ? "sail post/0" : "sail post/1", {x, -2.6F}, CanopiesWorld::sail.min.y);
    }
    for (const float x : {0.9F, 2.9F}) {
        addPost(scene, palette, x < 2.0F ? "awning post/0" : "awning post/1", {x, 1.2F}, CanopiesWorld::awning.min.y);
    }
}

void addLights(Scene& scene)
{
    Light sun;
    sun.name = "sun";
    sun.body = Body::sun;
    sun.colour = {1.0F, 0.95F, 0.86F};
    sun.intensity = 2.8F;
    addLight(scene, sun, {0.0F, 30.0F, 0.0F}, CanopiesWorld::sun_direction);

    Light spot;
    spot.name = "spot";
    spot.type = LightType::spot;
    spot.colour = {0.55F, 0.75F, 1.0F};
    spot.intensity = 420.0F;
    spot.range_m = 60.0F;
    spot.inner_cone_rad = 0.30F;
    spot.outer_cone_rad = 0.38F;
    spot.radius_m = 0.1F;
    addLight(scene, spot, CanopiesWorld::spot_position, CanopiesWorld::spot_target - CanopiesWorld::spot_position);
}

} // namespace

Scene makeCanopies(std::uint64_t /*seed*/)
{
    Scene scene;
    scene.name = "canopies";
    Palette palette;
    palette.paving = addMaterial(scene, "paving", {.roughness = 0.85F, .texture = addTexture(scene, rulerTiles())});
    palette.timber = addMaterial(scene, "timber", {.roughness = 0.8F, .texture = addTexture(scene, planks())});
    palette.canvas = addMaterial(scene, "canvas", {.roughness = 0.95F, .texture = addTexture(scene, plaster())});
    palette.clay = addMaterial(scene, "clay", {.roughness = 0.75F});
    addGround(scene, palette);
    addRoofs(scene, palette);
    addLights(scene);
    scene.views = {
        // All three roofs and what they leave of the light on the ground: stripes beside the lower roofs, none below.
        {.name = "roofs", .eye = {15.0F, 22.0F, 37.0F}, .target = {-0.3F, 7.7F, 0.5F}, .fov_y_rad = 0.62F},
        {.name = "side", .eye = {8.5F, 5.6F, 19.0F}, .target = {-0.3F, 5.4F, 0.0F}, .fov_y_rad = 0.86F},
        {.name = "top", .eye = {3.5F, 27.0F, 27.0F}, .target = {0.0F, 3.6F, 1.4F}, .fov_y_rad = 0.60F},
    };
    finishScene(scene);
    return scene;
}

} // namespace gnomon::worlds
