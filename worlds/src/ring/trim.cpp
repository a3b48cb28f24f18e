// SPDX-License-Identifier: Apache-2.0
// Portholes, signs, lines in the deck and pots along the promenade.
#include "../mesh_maker.h"
#include "../rng.h"
#include "../scene_maker.h"
#include "bent.h"
#include "deck.h"

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace gnomon::worlds {

namespace {

using World = RingWorld;

/// Faces +z.
std::uint32_t addPortholeMesh(Scene& scene, const RingPalette& palette, std::uint32_t pane)
{
    MeshMaker maker;
    Part& metal = maker.with(palette.metal);
    metal.colour = rgb(0x7E8794);
    metal.frame = turnedX(kPi * 0.5F);
    metal.lathe({{0.50F, -0.05F}, {0.50F, 0.05F}, {0.44F, 0.09F}, {0.36F, 0.07F}, {0.36F, 0.02F}}, 22);
    Part& glass = maker.with(pane);
    glass.frame = turnedX(kPi * 0.5F);
    glass.lathe({{0.37F, 0.025F}, {0.0F, 0.04F}}, 22);
    return addMesh(scene, maker.take("porthole"));
}

void addPortholes(Scene& scene, const RingPalette& palette)
{
    const std::array<std::uint32_t, 2> meshes{addPortholeMesh(scene, palette, palette.pane_warm),
                                              addPortholeMesh(scene, palette, palette.pane_cold)};
    for (int i = 0; i < World::tiles_around / 2; ++i) {
        for (const int side : {-1, 1}) {
            const double t = 2.0 * i + 1.0;
            const float facing = side > 0 ? kPi : 0.0F;
            const std::uint32_t which = hash(static_cast<std::uint32_t>(4 * i + side + 1)) % 3U == 0U ? 0U : 1U;
            const std::string name = std::string("porthole/") + (side < 0 ? "-" : "+") + std::to_string(i);
            addNode(scene, name, meshes[which], onRing(t, side * World::half_width_m, facing, 3.5));
        }
    }
}

/// A round sign on a bracket that reaches from a wall behind it (-z); it is read along the ring.
Mesh makeSign(const RingPalette& palette, Hue hue)
{
    constexpr int kCorners = 20;
    MeshMaker maker;
    Part& metal = maker.with(palette.metal);
    metal.colour = rgb(0x30343C);
    metal.box({-0.03F, 0.30F, -0.58F}, {0.03F, 0.35F, 0.30F}, 1.0F, true);
    metal.frame = turnedZ(kPi * 0.5F);
    metal.lathe({{0.0F, -0.05F}, {0.27F, -0.05F}, {0.27F, 0.05F}, {0.0F, 0.05F}}, kCorners);
    Part& glow = maker.with(palette.neonOf(hue));
    for (const float x : {-0.06F, 0.06F}) {
        std::vector<glm::vec3> path;
        for (int i = 0; i < kCorners; ++i) {
            const float a = kTau * static_cast<float>(i) / kCorners;
            path.emplace_back(x, 0.24F * std::sin(a), 0.24F * std::cos(a));
        }
        const std::vector<float> radii(path.size(), 0.018F);
        glow.tube(path, radii, 6, true);
        glow.frame = at({x, 0, 0}) * turnedZ(kPi * 0.5F);
        glow.lathe({{0.11F, -0.02F}, {0.11F, 0.02F}, {0.0F, 0.02F}}, 16);
        glow.lathe({{0.0F, -0.02F}, {0.11F, -0.02F}}, 16);
        glow.frame = glm::mat4(1.0F);
    }
    return maker.take("sign");
}

Hue hueOf(Room room)
{
    switch (room) {
    case Room::bar:
        return Hue::rose;
    case Room::lounge:
        return Hue::violet;
    case Room::garden:
    case Room::lab:
        return Hue::lime;
    case Room::berths:
        return Hue::cyan;
    case Room::engine:
        return Hue::red;
    case Room::market:
    case Room::stores:
    case Room::workshop:
        break;
    }
    return Hue::amber;
}

void addSigns(Scene& scene, const RingPalette& palette)
{
    std::array<std::uint32_t, kHues> meshes{};
    for (std::size_t i = 0; i < kHues; ++i) {
        meshes[i] = addMesh(scene, makeSign(palette, static_cast<Hue>(i)));
    }
    for (int sector = 0; sector < World::sectors; ++sector) {
        for (const int side : {-1, 1}) {
            const Room room = roomOf(sector, side);
            if (!isWalled(room)) {
                continue;
            }
            const float facing = side > 0 ? kPi : 0.0F; // hangs over the promenade
            const std::string name = std::string("sign/") + (side < 0 ? "-" : "+") + std::to_string(sector);
            const std::uint32_t node =
                addNode(scene, name, meshes[static_cast<std::size_t>(hueOf(room))],
                        onRing(World::sector_tiles * sector - 1.5, side * (World::promenade_m - 0.65), facing, 2.55));
            if (isFrontCutAway(sector, side)) { // all of it is as high as what has been cut away
                scene.nodes[node].clip_planes[0] = {0.0F, -1.0F, 0.0F, -1.0F};
            }
        }
    }
}

/// Lines of light in the deck along both borders of the promenade, half a sector at a time.
void addLines(Scene& scene, const RingPalette& palette)
{
    constexpr double kAcross_m = 2.62;
    constexpr double kHalf_m = 0.03;
    for (int i = 0; i < World::tiles_around / 4; ++i) {
        for (const int side : {-1, 1}) {
            BentPart part;
            part.box({{4.0 * i + 0.1, 4.0 * i + 3.9},
                      {-0.02, 0.012},
                      {side * kAcross_m - kHalf_m, side * kAcross_m + kHalf_m}},
                     {}, 16);
            const std::string name = std::string("line/") + (side < 0 ? "-" : "+") + std::to_string(i);
            const std::uint32_t node = addNode(scene, name, addMesh(scene, part.take(name, palette.pane_cold)), {});
            scene.nodes[node].casts = false; // it lies flat
        }
    }
}

} // namespace

void addTrim(Scene& scene, const RingPalette& palette)
{
    addPortholes(scene, palette);
    addSigns(scene, palette);
    addLines(scene, palette);
}

} // namespace gnomon::worlds
