// SPDX-License-Identifier: Apache-2.0
#include "../mesh_maker.h"
#include "../rng.h"
#include "../scene_maker.h"
#include "crowds.h"
#include "turns.h"

#include <glm/geometric.hpp>

#include <array>
#include <cmath>

namespace gnomon::worlds {

namespace {

constexpr float kPace_m_per_s = 1.5F;
constexpr float kStride_m = 1.55F; // both steps
constexpr float kHip_m = 0.78F;
constexpr float kSwing_rad = 0.48F; // a body sinks by kHip_m (1 - cos kSwing_rad) when its legs are spread

struct Livery {
    std::uint32_t coat;
    std::uint32_t trim;
};
constexpr std::array<Livery, 2> kLiveries{{{0x2F5FC4, 0xE9D27A}, {0xC23B32, 0xF0E4CF}}};
enum Role : std::uint32_t { kSword, kSpear, kBow, kRoles };

void addHead(Part& part, const Livery& livery, std::uint32_t role)
{
    part.frame = at({0, 1.72F, 0});
    part.colour = rgb(0xE5B98F);
    part.lathe({{0.17F, -0.22F}, {0.26F, -0.08F}, {0.25F, 0.06F}}, 7, true);
    part.colour = rgb(0x3A2A22);
    for (const float x : {-0.085F, 0.085F}) {
        part.quad({x - 0.035F, -0.12F, 0.262F}, {x + 0.035F, -0.12F, 0.262F}, {x + 0.035F, -0.03F, 0.268F},
                  {x - 0.035F, -0.03F, 0.268F});
    }
    part.colour = role == kBow ? rgb(livery.coat) * glm::vec4(0.6F, 0.6F, 0.6F, 1.0F) : rgb(0xB9BCC2);
    part.lathe({{0.31F, 0.0F}, {0.24F, 0.18F}, {0.0F, role == kSpear ? 0.44F : 0.32F}}, 7);
    if (role != kBow) {
        part.colour = rgb(livery.trim);
        part.quad({0, 0.14F, -0.26F}, {0, 0.20F, 0.16F}, {0, 0.44F, 0.02F}, {0, 0.40F, -0.26F}); // both sides show
    }
    part.frame = glm::mat4(1.0F);
}

void addTrunk(Part& part, const Livery& livery)
{
    part.colour = rgb(livery.coat);
    part.lathe({{0.37F, 0.62F}, {0.27F, 0.90F}}, 7); // the coat's skirt
    part.lathe({{0.27F, 0.99F}, {0.33F, 1.32F}, {0.16F, 1.5F}}, 7);
    part.colour = rgb(0x5A3B22);
    part.lathe({{0.29F, 0.89F}, {0.29F, 1.0F}}, 7);
    part.colour = rgb(livery.trim);
    part.quad({-0.10F, 0.60F, 0.395F}, {0.10F, 0.60F, 0.395F}, {0.09F, 0.92F, 0.305F}, {-0.09F, 0.92F, 0.305F});
    part.quad({-0.09F, 1.0F, 0.30F}, {0.09F, 1.0F, 0.30F}, {0.10F, 1.32F, 0.345F}, {-0.10F, 1.32F, 0.345F});
    part.colour = rgb(0xB9BCC2);
    for (const float x : {-0.38F, 0.38F}) {
        part.frame = at({x, 1.30F, 0}) * turnedZ(x < 0 ? 0.5F : -0.5F);
        part.lathe({{0.19F, 0.0F}, {0.0F, 0.2F}}, 5);
    }
    part.frame = glm::mat4(1.0F);
}

void addArm(Part& part, const Livery& livery, const glm::vec3& shoulder, const glm::vec3& elbow, const glm::vec3& hand)
{
    part.colour = rgb(livery.coat) * glm::vec4(0.8F, 0.8F, 0.8F, 1.0F);
    part.beam(shoulder, elbow, 0.17F, false);
    part.colour = rgb(0xE5B98F);
    part.beam(elbow, hand, 0.13F, false);
}

void addShield(Part& part, const Livery& livery)
{
    part.frame = at({0.52F, 1.02F, 0.24F}) * turnedY(0.9F) * turnedX(kPi * 0.5F);
    part.colour = rgb(livery.trim);
    part.lathe({{0.46F, 0.0F}, {0.36F, 0.05F}}, 8); // one skin: the material shows both sides
    part.colour = rgb(livery.coat);
    part.lathe({{0.36F, 0.05F}, {0.12F, 0.10F}}, 8);
    part.colour = rgb(0xB9BCC2);
    part.lathe({{0.12F, 0.10F}, {0.0F, 0.2F}}, 8);
    part.frame = glm::mat4(1.0F);
}

void addCloak(Part& cloth, const Livery& livery)
{
    cloth.colour = rgb(livery.coat) * glm::vec4(0.62F, 0.62F, 0.62F, 1.0F);
    cloth.quad({0.27F, 1.42F, -0.2F}, {-0.27F, 1.42F, -0.2F}, {-0.36F, 0.9F, -0.42F}, {0.36F, 0.9F, -0.42F});
    cloth.quad({0.36F, 0.9F, -0.42F}, {-0.36F, 0.9F, -0.42F}, {-0.42F, 0.38F, -0.58F}, {0.42F, 0.38F, -0.58F});
}

void addBow(Part& part)
{
    part.colour = rgb(0x7A4E28);
    const std::array<glm::vec3, 5> bow{glm::vec3(0.42F, 0.28F, 0.30F),
                                       {0.42F, 0.62F, 0.52F},
                                       {0.42F, 1.04F, 0.60F},
                                       {0.42F, 1.46F, 0.52F},
                                       {0.42F, 1.80F, 0.30F}};
    for (std::size_t i = 0; i + 1 < bow.size(); ++i) {
        part.beam(bow[i], bow[i + 1], 0.06F, false);
    }
    part.colour = rgb(0xE8E0D0);
    part.beam(bow.front(), bow.back(), 0.02F, false);
    part.colour = rgb(0x5A3B22);
    part.beam({-0.16F, 0.85F, -0.34F}, {0.14F, 1.5F, -0.34F}, 0.17F);
}

void addSword(Part& part, const glm::vec3& hand)
{
    part.colour = rgb(0xD8DCE2);
    part.beam(hand, hand + glm::vec3(0, 0.85F, 0.42F), 0.08F);
    part.colour = rgb(0xC9A13C);
    part.box(hand + glm::vec3(-0.16F, 0.06F, -0.05F), hand + glm::vec3(0.16F, 0.13F, 0.09F));
}

void addSpear(Part& part, const glm::vec3& hand)
{
    const glm::vec3 high = hand + glm::vec3(0, 1.45F, 0.2F);
    part.colour = rgb(0x7A5534);
    part.beam(hand - glm::vec3(0, 0.9F, 0.12F), high, 0.06F, false);
    part.colour = rgb(0xD8DCE2);
    part.frame = at(high) * turnedX(0.14F);
    part.lathe({{0.09F, 0.0F}, {0.0F, 0.38F}}, 4);
    part.frame = glm::mat4(1.0F);
}

/// Body, arms and what they carry, facing +z; the right hand is at -x.
Mesh makeBody(const Palette& palette, std::uint32_t team, std::uint32_t role)
{
    const Livery& livery = kLiveries[team];
    MeshMaker maker;
    Part& part = maker.with(palette.cloth); // one material for one draw; the cloak is seen from both sides
    addTrunk(part, livery);
    addHead(part, livery, role);
    addCloak(part, livery);
    const glm::vec3 right_hand = role == kBow ? glm::vec3(-0.46F, 0.92F, 0.10F) : glm::vec3(-0.46F, 1.02F, 0.42F);
    addArm(part, livery, {-0.40F, 1.36F, 0}, {-0.50F, 1.05F, 0.05F}, right_hand);
    addArm(part, livery, {0.40F, 1.36F, 0}, {0.50F, 1.05F, 0.05F}, {0.42F, 1.04F, 0.40F});
    if (role == kBow) {
        addBow(part);
    } else {
        addShield(part, livery);
        role == kSword ? addSword(part, right_hand) : addSpear(part, right_hand);
    }
    constexpr std::array<const char*, kRoles> kNames{"swordsman", "spearman", "archer"};
    return maker.take(std::string(team == 0 ? "blue " : "red ") + kNames[role]);
}

/// A leg that hangs from the hip at the origin.
Mesh makeLeg(const Palette& palette, std::uint32_t team)
{
    MeshMaker maker;
    Part& part = maker.with(palette.cloth);
    part.colour = rgb(team == 0 ? 0x4A4F5E : 0x574A42);
    part.box({-0.10F, -0.42F, -0.11F}, {0.10F, 0.02F, 0.11F}, 1.1F);
    part.colour = rgb(0x4B3320);
    part.box({-0.11F, -kHip_m, -0.12F}, {0.11F, -0.38F, 0.20F}, 0.85F, true);
    return maker.take(team == 0 ? "blue leg" : "red leg");
}

constexpr std::array<std::uint32_t, kLoopCount> kSquadsOnLoop{6, 5, 5, 5, 4};

} // namespace

Army::Army(Scene& scene, const Palette& palette, std::uint64_t seed)
{
    std::array<std::array<std::uint32_t, kRoles>, 2> bodies{};
    std::array<std::uint32_t, 2> legs{};
    for (std::uint32_t team = 0; team < 2; ++team) {
        for (std::uint32_t role = 0; role < kRoles; ++role) {
            bodies[team][role] = addMesh(scene, makeBody(palette, team, role));
        }
        legs[team] = addMesh(scene, makeLeg(palette, team));
    }
    Rng rng(seed, 300);
    const std::array<Loop, kLoopCount> loops = makeLoops();
    for (std::uint32_t loop = 0; loop < kLoopCount; ++loop) {
        for (std::uint32_t i = 0; i < kSquadsOnLoop[loop]; ++i) {
            const float share = (static_cast<float>(i) + 0.35F) / static_cast<float>(kSquadsOnLoop[loop]);
            squads_.push_back({loop, share * loops[loop].length_m()});
        }
    }
    for (std::uint32_t squad = 0; squad < kSquads; ++squad) {
        const std::uint32_t team = squads_[squad].loop == 3 || squad % 4 == 3 ? 1 : 0;
        for (std::uint32_t i = 0; i < kSquadUnits; ++i) {
            const std::uint32_t row = i / 4;
            const std::uint32_t role = row == 0 ? kSword : (row == 3 ? kBow : (squad % 2 == 0 ? kSpear : kSword));
            const std::string name = "unit/" + std::to_string(squad) + "," + std::to_string(i);
            const std::uint32_t body = addNode(scene, name, bodies[team][role], {});
            scene.nodes[body].dynamic = true;
            for (const float x : {-0.15F, 0.15F}) {
                Transform hip;
                hip.translation = {x, kHip_m, 0.0F};
                const std::uint32_t leg =
                    addNode(scene, name + (x < 0 ? "/right leg" : "/left leg"), legs[team], hip, body);
                scene.nodes[leg].dynamic = true;
            }
            units_.push_back({.body = body,
                              .squad = squad,
                              .ahead_m = 2.4F - 1.6F * static_cast<float>(row) + rng.range(-0.15F, 0.15F),
                              .right_m = 1.35F * (static_cast<float>(i % 4) - 1.5F) + rng.range(-0.12F, 0.12F),
                              .scale = rng.range(0.96F, 1.08F),
                              .step = 0.2F + rng.range(-0.07F, 0.07F)});
        }
    }
}

Loop::Place Army::squadAt(std::uint32_t squad, double time_s, std::span<const Loop> loops) const
{
    const Loop& loop = loops[squads_[squad].loop];
    const double walked = std::fmod(time_s * kPace_m_per_s, static_cast<double>(loop.length_m()));
    return loop.at(squads_[squad].start_m + static_cast<float>(walked));
}

void Army::pose(double time_s, const Terrain& terrain, std::span<const Loop> loops, std::vector<Node>& nodes) const
{
    const double strides = time_s * kPace_m_per_s / kStride_m;
    const auto step = static_cast<float>(strides - std::floor(strides));
    std::array<float, kLoopCount> walked_m{};
    for (std::size_t i = 0; i < kLoopCount; ++i) {
        walked_m[i] = static_cast<float>(std::fmod(time_s * kPace_m_per_s, static_cast<double>(loops[i].length_m())));
    }
    for (const Unit& unit : units_) {
        const Squad& squad = squads_[unit.squad];
        const Loop::Place place = loops[squad.loop].at(squad.start_m + walked_m[squad.loop] + unit.ahead_m);
        const glm::vec2 right(-place.direction.y, place.direction.x);
        const glm::vec2 xz = place.position + right * unit.right_m;
        const float swing = sineOfTurns(step + unit.step);
        const float together = cosineOfTurns(2.0F * (step + unit.step)); // 1 when the legs pass, -1 when spread
        Transform& body = nodes[unit.body].transform;
        body.translation = {xz.x, terrain.height(xz.x, xz.y) - 0.044F * (1.0F - together), xz.y};
        body.rotation = heading(place.direction);
        body.scale = glm::vec3(unit.scale);
        nodes[unit.body + 1].transform.rotation = aboutX(kSwing_rad * swing);
        nodes[unit.body + 2].transform.rotation = aboutX(-kSwing_rad * swing);
    }
}

} // namespace gnomon::worlds
