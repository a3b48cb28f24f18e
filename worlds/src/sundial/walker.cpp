// SPDX-License-Identifier: Apache-2.0
#include "walker.h"

#include "../mesh_maker.h"
#include "../rng.h"
#include "../scene_maker.h"

#include "worlds/sundial.h"

#include <glm/geometric.hpp>

#include <array>
#include <cmath>

namespace gnomon::worlds {

namespace {

constexpr double kPace_m_per_s = 1.3; // about
constexpr double kStride_m = 1.45;    // both steps, about
constexpr float kHip_m = 0.84F;
constexpr float kShoulder_m = 1.40F;
constexpr float kLegSwing_rad = 0.45F;
constexpr float kArmSwing_rad = 0.50F;
constexpr glm::vec2 kStartsNear{6.4F, 1.5F};

constexpr std::uint32_t kCoat = 0xB5412F;
constexpr std::uint32_t kSkin = 0xDDB08A;

/// Facing +z; the right is at -x.
Mesh makeBody(const SundialPalette& palette)
{
    MeshMaker maker;
    Part& part = maker.with(palette.common.cloth);
    part.colour = rgb(kCoat);
    part.lathe({{0.30F, 0.60F}, {0.235F, 0.84F}, {0.20F, 1.02F}}, 14, true); // the coat's skirt
    part.lathe({{0.20F, 1.02F}, {0.235F, 1.24F}, {0.225F, 1.36F}, {0.17F, 1.45F}, {0.075F, 1.50F}}, 14, true);
    part.colour = rgb(0x3E2C20);
    part.lathe({{0.208F, 0.99F}, {0.214F, 1.02F}, {0.208F, 1.05F}}, 14);
    part.colour = rgb(kSkin);
    part.lathe({{0.06F, 1.46F}, {0.065F, 1.54F}}, 10, true);
    part.frame = at({0, 1.645F, 0.01F}) * scaled({0.9F, 1.12F, 1.0F});
    part.ball(0.115F, 2);
    part.frame = at({0, 1.68F, -0.025F});
    part.colour = rgb(0x4A3424);
    part.ball(0.118F, 2); // hair
    part.frame = at({0, 1.705F, 0}) * turnedX(-0.08F);
    part.colour = rgb(0xC9A765);
    part.lathe({{0.27F, -0.015F}, {0.25F, 0.0F}, {0.125F, 0.02F}, {0.118F, 0.11F}, {0.075F, 0.145F}, {0.0F, 0.15F}},
               16);
    part.colour = rgb(0x6E3A2A);
    part.lathe({{0.130F, 0.018F}, {0.125F, 0.055F}}, 16);
    part.frame = glm::mat4(1.0F);
    part.colour = rgb(0x7A5A38); // a bag on the back
    part.box({-0.15F, 1.02F, -0.36F}, {0.15F, 1.38F, -0.20F}, 0.9F, true);
    return maker.take("walker's body");
}

/// Hangs from the hip at the origin.
Mesh makeLeg(const SundialPalette& palette)
{
    MeshMaker maker;
    Part& part = maker.with(palette.common.cloth);
    part.colour = rgb(0x3F4657);
    part.lathe({{0.058F, -0.66F}, {0.075F, -0.42F}, {0.092F, 0.0F}}, 9, true);
    part.colour = rgb(0x402C1E);
    part.lathe({{0.066F, -0.80F}, {0.070F, -0.62F}}, 9, true);
    part.box({-0.055F, -kHip_m, -0.075F}, {0.055F, -0.75F, 0.19F}, 0.85F, true);
    return maker.take("walker's leg");
}

/// Hangs from the shoulder at the origin, a little bent.
Mesh makeArm(const SundialPalette& palette)
{
    MeshMaker maker;
    Part& part = maker.with(palette.common.cloth);
    part.colour = rgb(kCoat) * glm::vec4(0.88F, 0.88F, 0.88F, 1.0F);
    const std::array<glm::vec3, 4> sleeve{
        glm::vec3(0, 0.03F, 0), {0, -0.14F, 0}, {0, -0.30F, 0.01F}, {0, -0.52F, 0.10F}};
    constexpr std::array<float, 4> kSleeve{0.055F, 0.062F, 0.054F, 0.045F};
    part.tube(sleeve, kSleeve, 8);
    part.colour = rgb(kSkin);
    part.frame = at({0, -0.56F, 0.125F});
    part.ball(0.048F, 1);
    return maker.take("walker's arm");
}

/// A turn about +x; positive takes what hangs down backwards.
glm::quat aboutX(float angle_rad)
{
    return {std::cos(angle_rad * 0.5F), std::sin(angle_rad * 0.5F), 0.0F, 0.0F};
}

} // namespace

Walker::Walker(Scene& scene, const SundialPalette& palette, const Loop& path)
{
    rounds_per_day_ = std::round(kPace_m_per_s * SundialWorld::day_s / static_cast<double>(path.length_m()));
    strides_per_day_ = std::round(rounds_per_day_ * static_cast<double>(path.length_m()) / kStride_m);
    float nearest_m = 1e9F;
    for (std::size_t i = 0; i < path.samples().size(); ++i) {
        const float d = glm::distance(path.samples()[i].position, kStartsNear);
        if (d < nearest_m) {
            nearest_m = d;
            start_m_ = path.length_m() * static_cast<float>(i) / static_cast<float>(path.samples().size() - 1);
        }
    }
    const std::uint32_t leg = addMesh(scene, makeLeg(palette));
    const std::uint32_t arm = addMesh(scene, makeArm(palette));
    body_ = addNode(scene, "walker/body", addMesh(scene, makeBody(palette)), {});
    addNode(scene, "walker/right leg", leg, standing({-0.10F, kHip_m, 0}), body_);
    addNode(scene, "walker/left leg", leg, standing({0.10F, kHip_m, 0}), body_);
    addNode(scene, "walker/right arm", arm, standing({-0.265F, kShoulder_m, 0}), body_);
    addNode(scene, "walker/left arm", arm, standing({0.265F, kShoulder_m, 0}), body_);
    for (std::uint32_t limb = kBody; limb <= kLeftArm; ++limb) {
        scene.nodes[body_ + limb].dynamic = true;
    }
}

void Walker::pose(double time_s, const Meadow& meadow, const Loop& path, std::vector<Node>& nodes) const
{
    const double days = time_s / SundialWorld::day_s;
    const auto share = [days](double per_day) {
        const double turns = days * per_day;
        return static_cast<float>(turns - std::floor(turns));
    };
    const Loop::Place place = path.at(start_m_ + share(rounds_per_day_) * path.length_m());
    const float step = share(strides_per_day_);
    const float swing = sineOfTurns(step);
    const float spread = kLegSwing_rad * swing;
    Transform& body = nodes[body_].transform;
    body.translation = meadow.ground(place.position);
    body.translation.y -= kHip_m * (1.0F - std::cos(spread)); // so that the feet stay on the ground
    const float yaw = std::atan2(place.direction.x, place.direction.y);
    body.rotation = {std::cos(yaw * 0.5F), 0.0F, std::sin(yaw * 0.5F), 0.0F};
    nodes[body_ + kRightLeg].transform.rotation = aboutX(spread);
    nodes[body_ + kLeftLeg].transform.rotation = aboutX(-spread);
    nodes[body_ + kRightArm].transform.rotation = aboutX(-kArmSwing_rad * swing);
    nodes[body_ + kLeftArm].transform.rotation = aboutX(kArmSwing_rad * swing);
}

} // namespace gnomon::worlds
