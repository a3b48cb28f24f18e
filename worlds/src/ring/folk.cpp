// SPDX-License-Identifier: Apache-2.0
#include "folk.h"

#include "../mesh_maker.h"
#include "../rng.h"
#include "../scene_maker.h"
#include "bent.h"

#include <glm/gtc/quaternion.hpp>

#include <cmath>
#include <string>

namespace gnomon::worlds {

namespace {

using World = RingWorld;

constexpr std::uint32_t kWalkers = 46;
constexpr double kPace_m_per_s = 1.05; // everybody's pace, so that none runs into another
constexpr float kLegSwing_rad = 0.46F;
constexpr float kArmSwing_rad = 0.50F;
enum Limb : std::uint32_t { kBody, kRightLeg, kLeftLeg, kRightArm, kLeftArm, kLimbs };

void eyes(Part& part, float y, float z, float apart, float radius)
{
    for (const float x : {-apart, apart}) {
        part.colour = rgb(0xF4F4EE);
        part.frame = at({x, y, z});
        part.ball(radius, 1);
        part.colour = rgb(0x17181C);
        part.frame = at({x, y, z + radius * 0.62F});
        part.ball(radius * 0.55F, 1);
    }
    part.frame = glm::mat4(1.0F);
}

/// In overalls, with a cap.
Mesh makeHand(const RingPalette& palette)
{
    MeshMaker maker;
    Part& part = maker.with(palette.common.plain);
    part.colour = rgb(0x2F6FA6);
    part.lathe({{0.19F, 0.74F},
                {0.21F, 0.86F},
                {0.20F, 1.02F},
                {0.24F, 1.24F},
                {0.23F, 1.38F},
                {0.12F, 1.48F},
                {0.07F, 1.50F}},
               14, true);
    part.colour = rgb(0xD9A441);
    part.lathe({{0.208F, 0.96F}, {0.214F, 0.99F}, {0.208F, 1.02F}}, 14);
    part.colour = rgb(0xDDB08A);
    part.lathe({{0.065F, 1.46F}, {0.065F, 1.56F}}, 10);
    part.frame = at({0, 1.66F, 0.01F}) * scaled({0.92F, 1.10F, 1.0F});
    part.ball(0.125F, 2);
    part.frame = glm::mat4(1.0F);
    eyes(part, 1.67F, 0.105F, 0.045F, 0.025F);
    part.colour = rgb(0xC8452F);
    part.frame = at({0, 1.72F, 0});
    part.lathe({{0.135F, -0.02F}, {0.13F, 0.05F}, {0.08F, 0.10F}, {0.0F, 0.115F}}, 14, true);
    part.box({-0.09F, -0.01F, 0.08F}, {0.09F, 0.015F, 0.24F}, 1.0F, true);
    return maker.take("hand");
}

/// Tall and grey, with a large head.
Mesh makeGrey(const RingPalette& palette)
{
    MeshMaker maker;
    Part& part = maker.with(palette.common.plain);
    part.colour = rgb(0x8E4FA6);
    part.lathe({{0.30F, 0.40F}, {0.22F, 0.80F}, {0.16F, 1.10F}, {0.19F, 1.36F}, {0.10F, 1.50F}, {0.05F, 1.54F}}, 14,
               true);
    part.colour = rgb(0xE2C35A);
    part.lathe({{0.305F, 0.40F}, {0.30F, 0.46F}}, 14);
    part.colour = rgb(0xA9BFB4);
    part.lathe({{0.05F, 1.50F}, {0.045F, 1.66F}}, 9);
    part.frame = at({0, 1.80F, 0.0F}) * scaled({1.0F, 1.22F, 1.06F});
    part.ball(0.17F, 2);
    part.colour = rgb(0x14161A);
    for (const float x : {-0.075F, 0.075F}) {
        part.frame = at({x, 1.79F, 0.135F}) * turnedZ(x > 0 ? 0.5F : -0.5F) * scaled({0.7F, 1.1F, 0.6F});
        part.ball(0.055F, 1);
    }
    return maker.take("grey");
}

/// Round and orange, on short legs.
Mesh makeRound(const RingPalette& palette)
{
    MeshMaker maker;
    Part& part = maker.with(palette.common.plain);
    part.colour = rgb(0xE08A3C);
    part.frame = at({0, 0.80F, 0}) * scaled({1.0F, 1.05F, 0.95F});
    part.ball(0.44F, 3);
    part.colour = rgb(0x4F7F3F);
    part.frame = glm::mat4(1.0F);
    part.lathe({{0.30F, 0.44F}, {0.405F, 0.62F}, {0.448F, 0.72F}, {0.42F, 0.73F}}, 18, true);
    part.colour = rgb(0xE08A3C);
    for (const float x : {-0.16F, 0.16F}) {
        part.frame = at({x, 1.22F, 0.05F}) * turnedZ(x > 0 ? -0.25F : 0.25F);
        part.lathe({{0.045F, -0.12F}, {0.035F, 0.16F}}, 8);
    }
    part.frame = glm::mat4(1.0F);
    eyes(part, 1.42F, 0.06F, 0.20F, 0.085F);
    part.colour = rgb(0x7A2F22);
    part.frame = at({0, 0.90F, 0.40F}) * scaled({1.0F, 0.3F, 0.3F});
    part.ball(0.14F, 1);
    return maker.take("round");
}

/// A robot of tin.
Mesh makeTin(const RingPalette& palette)
{
    MeshMaker maker;
    Part& part = maker.with(palette.common.plain);
    part.colour = rgb(0xC9D0D6);
    part.lathe({{0.17F, 0.56F}, {0.24F, 0.62F}, {0.26F, 1.02F}, {0.22F, 1.14F}, {0.07F, 1.18F}, {0.07F, 1.26F}}, 12,
               false, true);
    part.box({-0.17F, 1.26F, -0.14F}, {0.17F, 1.52F, 0.14F}, 0.9F, true);
    part.colour = rgb(0xC8452F);
    part.lathe({{0.268F, 0.84F}, {0.272F, 0.94F}}, 12, false, true);
    part.beam({0, 1.52F, 0}, {0, 1.70F, 0}, 0.02F);
    part.frame = at({0, 1.72F, 0});
    part.ball(0.04F, 1);
    part.frame = glm::mat4(1.0F);
    eyes(part, 1.40F, 0.135F, 0.075F, 0.042F);
    return maker.take("tin");
}

/// Hangs from the origin.
Mesh makeLimb(const RingPalette& palette, const std::string& name, std::uint32_t cloth, std::uint32_t end,
              float length_m, float thick_m, bool foot)
{
    MeshMaker maker;
    Part& part = maker.with(palette.common.plain);
    part.colour = rgb(cloth) * glm::vec4(0.88F, 0.88F, 0.88F, 1.0F);
    const float l = length_m;
    part.lathe({{thick_m * 0.75F, -l + 0.06F},
                {thick_m * 0.85F, -0.5F * l},
                {thick_m, -0.04F},
                {thick_m * 0.6F, 0.05F},
                {0.0F, 0.06F}},
               9, true);
    part.colour = rgb(end);
    if (foot) {
        part.frame = at({0, -l + 0.055F, 0.05F}) * scaled({0.95F, 0.6F, 1.6F});
        part.ball(thick_m * 1.15F, 1);
    } else {
        part.frame = at({0, -l + 0.03F, 0.0F});
        part.ball(thick_m * 1.05F, 1);
    }
    return maker.take(name);
}

/// About +x; positive takes what hangs down backwards.
glm::quat swung(float angle_rad)
{
    const float half = angle_rad * 0.5F;
    return {std::cos(half), std::sin(half), 0.0F, 0.0F};
}

} // namespace

Folk::Folk(Scene& scene, const RingPalette& palette, std::uint64_t seed)
{
    const auto limb = [&](const char* name, std::uint32_t cloth, std::uint32_t end, float length_m, float thick_m,
                          bool foot) {
        return addMesh(scene, makeLimb(palette, name, cloth, end, length_m, thick_m, foot));
    };
    kinds_[0] = {addMesh(scene, makeHand(palette)),
                 limb("hand's leg", 0x2F6FA6, 0x3A2A20, 0.80F, 0.085F, true),
                 limb("hand's arm", 0x2F6FA6, 0xDDB08A, 0.62F, 0.058F, false),
                 0.80F,
                 1.38F,
                 0.10F,
                 0.26F,
                 1.42};
    kinds_[1] = {addMesh(scene, makeGrey(palette)),
                 limb("grey's leg", 0x5F3A72, 0x8FA398, 0.62F, 0.06F, true),
                 limb("grey's arm", 0x8E4FA6, 0xA9BFB4, 0.80F, 0.045F, false),
                 0.62F,
                 1.40F,
                 0.10F,
                 0.20F,
                 1.1};
    kinds_[2] = {addMesh(scene, makeRound(palette)),
                 limb("round's leg", 0xE08A3C, 0x7A4A24, 0.50F, 0.10F, true),
                 limb("round's arm", 0xE08A3C, 0xE9A55C, 0.50F, 0.06F, false),
                 0.50F,
                 0.98F,
                 0.17F,
                 0.44F,
                 0.85};
    kinds_[3] = {addMesh(scene, makeTin(palette)),
                 limb("tin's leg", 0x9AA4AE, 0x5A626C, 0.62F, 0.07F, true),
                 limb("tin's arm", 0x9AA4AE, 0xC8452F, 0.56F, 0.05F, false),
                 0.62F,
                 1.06F,
                 0.11F,
                 0.29F,
                 1.1};
    Rng rng(seed, 700);
    for (std::uint32_t i = 0; i < kWalkers; ++i) {
        Walker walker;
        walker.kind = rng.below(kFolkKinds);
        walker.way = (i & 1) != 0 ? -1.0F : 1.0F;
        walker.start_tiles = World::tiles_around * (i + 0.8 * rng.unit()) / kWalkers - 1.2;
        walker.across_m = walker.way * (1.65 + 0.2 * rng.unit()); // they keep to the right, clear of the middle
        walker.step = rng.unit();
        const std::string name = "walker/" + std::to_string(i);
        walker.body = addBody(scene, name, {}, walker.kind);
        for (std::uint32_t node = walker.body; node < walker.body + kLimbs; ++node) {
            scene.nodes[node].dynamic = true;
        }
        walkers_.push_back(walker);
    }
}

std::uint32_t Folk::addBody(Scene& scene, const std::string& name, const Transform& transform, std::uint32_t kind) const
{
    const Kind& k = kinds_[kind];
    const std::uint32_t body = addNode(scene, name, k.body, transform);
    addNode(scene, name + "/right leg", k.leg, standing({-k.hip_apart_m, k.hip_m, 0}), body);
    addNode(scene, name + "/left leg", k.leg, standing({k.hip_apart_m, k.hip_m, 0}), body);
    addNode(scene, name + "/right arm", k.arm, standing({-k.shoulder_apart_m, k.shoulder_m, 0}), body);
    addNode(scene, name + "/left arm", k.arm, standing({k.shoulder_apart_m, k.shoulder_m, 0}), body);
    return body;
}

void Folk::addStanding(Scene& scene, const Transform& transform, std::uint32_t kind) const
{
    const std::uint32_t body = addBody(scene, "guest/" + std::to_string(scene.nodes.size()), transform, kind);
    scene.nodes[body + kRightArm].transform.rotation = swung(-0.9F); // holds something out
    scene.nodes[body + kLeftArm].transform.rotation = swung(0.12F);
}

void Folk::pose(double time_s, std::vector<Node>& nodes) const
{
    for (const Walker& walker : walkers_) {
        const Kind& kind = kinds_[walker.kind];
        const double walked_m = time_s * kPace_m_per_s;
        const double tiles = walker.start_tiles + walker.way * walked_m / World::tile_m;
        const double strides = walked_m / kind.stride_m;
        const float step = static_cast<float>(strides - std::floor(strides)) + walker.step;
        const float swing = sineOfTurns(step);
        const float spread = kLegSwing_rad * swing;
        const float sunk_m = kind.hip_m * (1.0F - std::cos(spread)); // so that the feet stay on the deck
        nodes[walker.body].transform =
            onRing(tiles, walker.across_m, walker.way * kPi * 0.5F, static_cast<double>(-sunk_m));
        nodes[walker.body + kRightLeg].transform.rotation = swung(spread);
        nodes[walker.body + kLeftLeg].transform.rotation = swung(-spread);
        nodes[walker.body + kRightArm].transform.rotation = swung(-kArmSwing_rad * swing);
        nodes[walker.body + kLeftArm].transform.rotation = swung(kArmSwing_rad * swing);
    }
}

} // namespace gnomon::worlds
