// SPDX-License-Identifier: Apache-2.0
// The map of the game that the paper describes: A. Marinescu, "Achieving real-time soft shadows using LVSM in an RTS
// game", 2011. Many units and buildings on a height field, debris floating above, one sun.

#include "../mesh_maker.h"
#include "../rng.h"
#include "../scene_maker.h"
#include "crowds.h"
#include "palette.h"
#include "settlements.h"
#include "terrain.h"
#include "wilds.h"

#include "scene/state.h"

#include <glm/geometric.hpp>

#include <array>
#include <memory>
#include <utility>

namespace gnomon::worlds {

namespace {

/// The animator's data, which live as long as the scene.
struct Actors {
    std::array<Loop, kLoopCount> loops;
    Terrain terrain;
    Army army;
    Debris debris;
    Turners turners;
    Giant giant;
};

/// The giant's loop, the far round, and where on it he is at first: out of sight of `camp` and `unit`.
constexpr std::size_t kGiantsLoop = 3;
constexpr float kGiantStarts = 0.25F; // share of the loop

void addSun(Scene& scene)
{
    Light sun;
    sun.name = "sun";
    sun.body = Body::sun;
    sun.colour = {1.0F, 0.86F, 0.66F};
    sun.intensity = 3.6F;
    addLight(scene, sun, {0.0F, 120.0F, 0.0F}, {0.74F, -0.60F, -0.30F});
    scene.environment.sky_zenith = {0.20F, 0.38F, 0.68F};
    scene.environment.sky_horizon = {0.80F, 0.78F, 0.72F};
    scene.environment.ground = {0.31F, 0.29F, 0.25F};
    scene.environment.ambient = 0.24F;
    scene.environment.exposure = 1.0F;
}

void addViews(Scene& scene, const Actors& actors)
{
    const Loop::Place squad = actors.army.squadAt(0, 0.0, actors.loops);
    const glm::vec3 middle = actors.terrain.ground(squad.position);
    const glm::vec2 right(-squad.direction.y, squad.direction.x);
    const glm::vec2 stand = squad.position + squad.direction * 8.2F - right * 4.2F;
    glm::vec3 eye = actors.terrain.ground(stand);
    eye.y += 2.1F;
    const Loop::Place giant = actors.giant.place(0.0, actors.loops[kGiantsLoop]);
    const glm::vec2 beside(-giant.direction.y, giant.direction.x);
    glm::vec3 giants_eye = actors.terrain.ground(giant.position + giant.direction * 6.5F - beside * 5.0F);
    giants_eye.y += 2.6F;
    scene.views = {
        {.name = "camp", .eye = {14.0F, 54.0F, 76.0F}, .target = {-1.0F, 7.0F, -1.0F}, .fov_y_rad = 0.72F},
        {.name = "unit", .eye = eye, .target = middle + glm::vec3(0.0F, 1.25F, 0.0F), .fov_y_rad = 0.8F},
        {.name = "map", .eye = {45.0F, 400.0F, 510.0F}, .target = {0.0F, -30.0F, 22.0F}, .fov_y_rad = 0.70F},
        {.name = "giant",
         .eye = giants_eye,
         .target = actors.terrain.ground(giant.position) + glm::vec3(0.0F, 1.3F, 0.0F),
         .fov_y_rad = 0.8F},
    };
}

} // namespace

Scene makeRts(std::uint64_t seed)
{
    Scene scene;
    scene.name = "rts";
    const Palette palette = addPalette(scene);
    std::array<Loop, kLoopCount> loops = makeLoops();
    Terrain terrain(seed, loops);
    terrain.addTo(scene, palette.ground, palette.water);
    Turners turners;
    const std::vector<Site> built = addSettlements(scene, palette, terrain, turners);
    addWilds(scene, palette, terrain, built, seed);
    Army army(scene, palette, seed);
    Debris debris(scene, palette, seed);
    Giant giant(scene, palette, kGiantStarts * loops[kGiantsLoop].length_m());
    addSun(scene);
    const auto actors = std::make_shared<const Actors>(
        Actors{std::move(loops), std::move(terrain), std::move(army), std::move(debris), std::move(turners), giant});
    addViews(scene, *actors);
    scene.procedural = [actors](double time_s, std::vector<Node>& nodes) {
        actors->army.pose(time_s, actors->terrain, actors->loops, nodes);
        actors->debris.pose(time_s, nodes);
        actors->turners.pose(time_s, nodes);
        actors->giant.pose(time_s, actors->terrain, actors->loops[kGiantsLoop], nodes);
    };
    scene.procedural(0.0, scene.nodes);
    finishScene(scene);
    return scene;
}

} // namespace gnomon::worlds
