// SPDX-License-Identifier: Apache-2.0
// One figure with a skin over joints, as the paper's units had ("a complex animation system"): what a shadow map is
// drawn from is then made anew in each frame, vertex by vertex.
#include "../mesh_maker.h"
#include "../rng.h"
#include "../scene_maker.h"
#include "crowds.h"
#include "turns.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace gnomon::worlds {

namespace {

constexpr float kPace_m_per_s = 1.5F; // as the squads
constexpr float kStride_m = 3.0F;     // both steps
constexpr float kHip_m = 1.50F;
constexpr float kThighSwing_rad = 0.42F;
constexpr float kKneeBend_rad = 0.55F;
constexpr float kArmSwing_rad = 0.38F;
constexpr float kElbowBend_rad = 0.35F;
constexpr float kLean_rad = 0.08F;
/// How far a vertex takes part in bones that are farther from it than its nearest one.
constexpr float kBlend_m = 0.16F;

enum Joint : std::uint32_t {
    kHips,
    kChest,
    kHead,
    kRightArm,
    kRightForearm,
    kLeftArm,
    kLeftForearm,
    kRightThigh,
    kRightShin,
    kLeftThigh,
    kLeftShin,
    kJoints
};

/// At rest: where a joint is and where its bone ends, in metres over the ground; facing +z, the right is at -x.
struct Bone {
    const char* name;
    std::uint32_t parent;
    glm::vec3 joint;
    glm::vec3 end;
};
const std::array<Bone, kJoints>& bones()
{
    static const std::array<Bone, kJoints> kBones{{
        {"hips", kNone, {0, kHip_m + 0.05F, 0}, {0, 1.90F, 0}},
        {"chest", kHips, {0, 1.90F, 0}, {0, 2.55F, 0}},
        {"head", kChest, {0, 2.62F, 0.04F}, {0, 3.05F, 0.10F}},
        {"right arm", kChest, {-0.52F, 2.42F, 0}, {-0.64F, 1.86F, 0}},
        {"right forearm", kRightArm, {-0.64F, 1.86F, 0}, {-0.68F, 1.28F, 0.14F}},
        {"left arm", kChest, {0.52F, 2.42F, 0}, {0.64F, 1.86F, 0}},
        {"left forearm", kLeftArm, {0.64F, 1.86F, 0}, {0.68F, 1.28F, 0.14F}},
        {"right thigh", kHips, {-0.25F, kHip_m, 0}, {-0.27F, 0.80F, 0.04F}},
        {"right shin", kRightThigh, {-0.27F, 0.80F, 0.04F}, {-0.27F, 0.06F, 0}},
        {"left thigh", kHips, {0.25F, kHip_m, 0}, {0.27F, 0.80F, 0.04F}},
        {"left shin", kLeftThigh, {0.27F, 0.80F, 0.04F}, {0.27F, 0.06F, 0}},
    }};
    return kBones;
}

void addTrunkAndHead(Part& part)
{
    part.colour = rgb(0x6E7F5B);
    part.lathe({{0.34F, 1.66F}, {0.42F, 1.86F}, {0.50F, 2.16F}, {0.50F, 2.40F}, {0.36F, 2.58F}, {0.18F, 2.66F}}, 14,
               true);
    part.colour = rgb(0x5A3B22);
    part.lathe({{0.46F, 1.30F}, {0.43F, 1.50F}, {0.40F, 1.72F}}, 14, true); // a kilt
    part.frame = at({0, 2.84F, 0.08F});
    part.colour = rgb(0x7C8E66);
    part.ball(0.27F, 2);
    part.colour = rgb(0xE8E0C8);
    for (const float x : {-0.12F, 0.12F}) { // tusks
        part.frame = at({x, 2.72F, 0.28F});
        part.lathe({{0.04F, 0.0F}, {0.0F, 0.17F}}, 5);
    }
    part.frame = glm::mat4(1.0F);
}

/// Along two bones, with a ring of vertices every few centimetres for the joint between them to bend.
void addLimb(Part& part, const Bone& upper, const Bone& lower, float thick_m, float thin_m)
{
    constexpr int kRings = 7; // rings of each bone
    std::vector<glm::vec3> path;
    std::vector<float> radii;
    for (int i = 0; i <= 2 * kRings; ++i) {
        const Bone& bone = i <= kRings ? upper : lower;
        const float t = static_cast<float>(i <= kRings ? i : i - kRings) / static_cast<float>(kRings);
        path.push_back(bone.joint + (bone.end - bone.joint) * t);
        radii.push_back(thick_m + (thin_m - thick_m) * static_cast<float>(i) / static_cast<float>(2 * kRings));
    }
    part.tube(path, radii, 9);
}

Mesh makeSkin(const Palette& palette)
{
    MeshMaker maker;
    Part& part = maker.with(palette.plain);
    addTrunkAndHead(part);
    const auto& b = bones();
    part.colour = rgb(0x6E7F5B);
    addLimb(part, b[kRightArm], b[kRightForearm], 0.19F, 0.12F);
    addLimb(part, b[kLeftArm], b[kLeftForearm], 0.19F, 0.12F);
    part.colour = rgb(0x4B4F3C);
    addLimb(part, b[kRightThigh], b[kRightShin], 0.24F, 0.14F);
    addLimb(part, b[kLeftThigh], b[kLeftShin], 0.24F, 0.14F);
    part.colour = rgb(0x3E2C20);
    for (const float x : {-0.27F, 0.27F}) {
        part.box({x - 0.16F, 0.0F, -0.18F}, {x + 0.16F, 0.17F, 0.34F}, 0.85F, true);
    }
    part.colour = rgb(0x6B4A2A); // a club
    part.beam({-0.69F, 1.20F, -0.10F}, {-0.71F, 1.36F, 0.62F}, 0.11F);
    part.beam({-0.71F, 1.34F, 0.52F}, {-0.73F, 1.45F, 1.02F}, 0.25F);
    return maker.take("giant");
}

float distanceTo(const Bone& bone, const glm::vec3& p)
{
    const glm::vec3 way = bone.end - bone.joint;
    const float t = std::clamp(glm::dot(p - bone.joint, way) / glm::dot(way, way), 0.0F, 1.0F);
    return glm::distance(p, bone.joint + way * t);
}

/// Each vertex goes with the bones that are about as near as its nearest one, at most four.
void bind(Primitive& primitive)
{
    for (const glm::vec3& p : primitive.positions) {
        std::array<std::pair<float, std::uint16_t>, kJoints> near;
        for (std::uint16_t i = 0; i < kJoints; ++i) {
            near[i] = {distanceTo(bones()[i], p), i};
        }
        std::sort(near.begin(), near.end());
        glm::u16vec4 joints(0);
        glm::vec4 weights(0.0F);
        for (int k = 0; k < 4; ++k) {
            const auto& [distance_m, joint] = near[static_cast<std::size_t>(k)];
            const float share = std::max(1.0F - (distance_m - near[0].first) / kBlend_m, 0.0F);
            joints[k] = joint;
            weights[k] = share * share;
        }
        primitive.joints.push_back(joints);
        primitive.weights.push_back(weights / (weights.x + weights.y + weights.z + weights.w));
    }
}

} // namespace

Giant::Giant(Scene& scene, const Palette& palette, float start_m) : start_m_(start_m)
{
    Mesh mesh = makeSkin(palette);
    for (Primitive& primitive : mesh.primitives) {
        bind(primitive);
    }
    root_ = addNode(scene, "giant", kNone, {});
    scene.nodes[root_].dynamic = true;
    Skin skin;
    skin.name = "giant";
    for (const Bone& bone : bones()) {
        const bool hangs = bone.parent != kNone;
        const glm::vec3 from = hangs ? bones()[bone.parent].joint : glm::vec3(0.0F);
        const std::uint32_t parent = hangs ? skin.joints[bone.parent] : root_;
        Transform rest;
        rest.translation = bone.joint - from;
        const std::uint32_t node = addNode(scene, std::string("giant/") + bone.name, kNone, rest, parent);
        scene.nodes[node].dynamic = true;
        skin.joints.push_back(node);
        skin.inverse_bind.push_back(glm::translate(glm::mat4(1.0F), -bone.joint));
    }
    const std::uint32_t body = addNode(scene, "giant/skin", addMesh(scene, std::move(mesh)), {});
    scene.nodes[body].skin = static_cast<std::uint32_t>(scene.skins.size());
    scene.nodes[body].dynamic = true;
    scene.skins.push_back(std::move(skin));
}

Loop::Place Giant::place(double time_s, const Loop& loop) const
{
    const double walked = std::fmod(time_s * kPace_m_per_s, static_cast<double>(loop.length_m()));
    return loop.at(start_m_ + static_cast<float>(walked));
}

void Giant::pose(double time_s, const Terrain& terrain, const Loop& loop, std::vector<Node>& nodes) const
{
    const Loop::Place at = place(time_s, loop);
    const double strides = time_s * kPace_m_per_s / kStride_m;
    const float step = static_cast<float>(strides - std::floor(strides)) + 0.12F;
    const float swing = sineOfTurns(step);
    const float together = cosineOfTurns(2.0F * step); // 1 when the legs pass, -1 when spread
    Transform& root = nodes[root_].transform;
    root.translation = terrain.ground(at.position);
    root.translation.y -= 0.066F * (1.0F - together); // so that the feet stay on the ground
    root.rotation = heading(at.direction);
    const auto turn = [&](std::uint32_t joint, float angle_rad) {
        nodes[root_ + 1 + joint].transform.rotation = aboutX(angle_rad);
    };
    // The knee of the leg that swings forward bends. A positive turn takes what hangs down backwards.
    const float bend = cosineOfTurns(step);
    turn(kHips, 0.0F);
    turn(kChest, kLean_rad);
    turn(kHead, -kLean_rad);
    turn(kRightThigh, kThighSwing_rad * swing);
    turn(kLeftThigh, -kThighSwing_rad * swing);
    turn(kRightShin, kKneeBend_rad * std::max(-bend, 0.0F));
    turn(kLeftShin, kKneeBend_rad * std::max(bend, 0.0F));
    turn(kRightArm, -kArmSwing_rad * swing);
    turn(kLeftArm, kArmSwing_rad * swing);
    turn(kRightForearm, -kElbowBend_rad);
    turn(kLeftForearm, -kElbowBend_rad);
}

} // namespace gnomon::worlds
