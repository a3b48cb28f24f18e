// SPDX-License-Identifier: Apache-2.0
#include "worlds/planes.h"

#include "mesh_maker.h"
#include "scene_maker.h"
#include "textures.h"

#include "scene/state.h"

#include <glm/geometric.hpp>

namespace gnomon::worlds {

namespace {

void addGround(Scene& scene, std::uint32_t material)
{
    constexpr float kHalf = PlanesWorld::ground_half_size_m;
    constexpr float kY = PlanesWorld::ground_y;
    MeshMaker maker;
    Part& part = maker.with(material);
    part.uv_per_metre = 0.25F; // the tile image holds 4 by 4 tiles of one metre: a ruler to read shadows off
    part.quad({-kHalf, kY, kHalf}, {kHalf, kY, kHalf}, {kHalf, kY, -kHalf}, {-kHalf, kY, -kHalf});
    addNode(scene, "ground", addMesh(scene, maker.take("ground")), {});
}

void addBox(Scene& scene, std::uint32_t material)
{
    MeshMaker maker;
    Part& part = maker.with(material);
    part.colour = rgb(0xE0743A);
    part.box(PlanesWorld::box_min, PlanesWorld::box_max, 1.0F, true);
    addNode(scene, "box", addMesh(scene, maker.take("box")), {});
}

} // namespace

Scene makePlanes(std::uint64_t /*seed*/)
{
    Scene scene;
    scene.name = "planes";
    const std::uint32_t tiles = addTexture(scene, rulerTiles());
    addGround(scene, addMaterial(scene, "ruler tiles", {.roughness = 0.85F, .texture = tiles}));
    addBox(scene, addMaterial(scene, "orange clay", {.roughness = 0.7F}));

    Light sun;
    sun.name = "sun";
    sun.body = Body::sun;
    sun.colour = {1.0F, 0.95F, 0.86F};
    sun.intensity = 2.8F;
    addLight(scene, sun, {0.0F, 10.0F, 0.0F}, PlanesWorld::sun_direction);

    Light spot;
    spot.name = "spot";
    spot.type = LightType::spot;
    spot.colour = {0.55F, 0.75F, 1.0F};
    spot.intensity = 240.0F;
    spot.range_m = PlanesWorld::spot_range_m;
    spot.inner_cone_rad = PlanesWorld::spot_inner_half_angle_rad;
    spot.outer_cone_rad = PlanesWorld::spot_outer_half_angle_rad;
    spot.radius_m = 0.1F;
    addLight(scene, spot, PlanesWorld::spot_position, PlanesWorld::spot_target - PlanesWorld::spot_position);

    scene.views = {
        // Near the box and its two shadows: a hard one of the sun, a faint one of the spot light behind it.
        {.name = "box", .eye = {4.5F, 6.5F, 8.0F}, .target = {0.5F, 0.7F, -1.4F}, .fov_y_rad = 0.63F},
        // A hair off the vertical, so that "up" is defined; north (-z) is up in the picture.
        {.name = "top", .eye = {1.0F, 16.0F, 0.02F}, .target = {1.0F, 0.0F, 0.0F}, .fov_y_rad = 0.7F},
        {.name = "side", .eye = {6.5F, 5.0F, 9.5F}, .target = {0.6F, 1.0F, 0.0F}, .fov_y_rad = 0.75F},
    };
    finishScene(scene);
    return scene;
}

} // namespace gnomon::worlds
