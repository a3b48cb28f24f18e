// SPDX-License-Identifier: Apache-2.0
#include "lamps.h"

#include "../mesh_maker.h"
#include "../rng.h"
#include "../scene_maker.h"

#include <cmath>

namespace gnomon::worlds {

namespace {

struct LampFacts {
    const char* name;
    float bulb_m;
    float foot_m;
};
constexpr std::array<LampFacts, kLamps> kFacts{{
    {"pendant", 0.07F, 0.0F},
    {"pierced", 0.018F, 0.0F},
    {"lantern", 0.045F, 0.0F},
    {"caged", 0.020F, 0.0F},
    {"sconce", 0.06F, 0.0F},
    {"table lamp", 0.045F, 0.40F},
    {"drum", 0.030F, 1.45F},
    {"bollard", 0.025F, 0.62F},
    {"reactor", 0.10F, 1.75F},
}};

const LampFacts& factsOf(Lamp lamp)
{
    return kFacts[static_cast<std::size_t>(lamp)];
}

/// A wall of revolution with two sides, `thick` apart.
void skin(Part& part, std::initializer_list<glm::vec2> profile, float thick, int sides)
{
    std::vector<glm::vec2> around(profile);
    for (auto p = std::rbegin(profile); p != std::rend(profile); ++p) {
        around.emplace_back(p->x - thick, p->y);
    }
    around.push_back(around.front());
    part.lathe(around, sides);
}

/// A pipe around the y axis.
void ringAt(Part& part, float radius, float y, float thick, int pieces)
{
    std::vector<glm::vec3> path;
    for (int i = 0; i < pieces; ++i) {
        const float a = kTau * static_cast<float>(i) / static_cast<float>(pieces);
        path.emplace_back(radius * std::sin(a), y, radius * std::cos(a));
    }
    const std::vector<float> radii(path.size(), thick);
    part.tube(path, radii, 6, true);
}

void rod(Part& part, const glm::vec3& from, const glm::vec3& to, float thick)
{
    part.beam(from, to, thick, true);
}

void addPendant(MeshMaker& maker, const RingPalette& palette)
{
    Part& metal = maker.with(palette.metal);
    metal.colour = rgb(0x3E6B66);
    skin(metal, {{0.30F, -0.11F}, {0.27F, 0.0F}, {0.17F, 0.12F}, {0.06F, 0.20F}, {0.05F, 0.27F}}, 0.014F, 22);
    metal.colour = rgb(0x2B2E34);
    rod(metal, {0, 0.26F, 0}, {0, kCord_m, 0}, 0.014F);
    metal.lathe({{0.05F, 0.27F}, {0.0F, 0.28F}}, 10);
}

/// A ball of hoops along its meridians and parallels.
void addPierced(MeshMaker& maker, const RingPalette& palette)
{
    constexpr float kRadius = 0.26F;
    Part& metal = maker.with(palette.metal);
    metal.colour = rgb(0xC9963E);
    for (int i = 0; i < 5; ++i) {
        const float a = kPi * static_cast<float>(i) / 5.0F;
        metal.frame = turnedY(a) * turnedX(kPi * 0.5F);
        ringAt(metal, kRadius, 0.0F, 0.013F, 20);
    }
    metal.frame = glm::mat4(1.0F);
    for (const float y : {-0.75F, -0.4F, 0.0F, 0.4F, 0.75F}) {
        ringAt(metal, kRadius * std::sqrt(1.0F - y * y), kRadius * y, 0.014F, 18);
    }
    metal.lathe({{0.07F, -0.265F}, {0.06F, -0.25F}, {0.0F, -0.25F}}, 10);
    metal.lathe({{0.0F, -0.29F}, {0.07F, -0.265F}}, 10);
    metal.lathe({{0.09F, 0.235F}, {0.07F, 0.27F}, {0.02F, 0.30F}, {0.0F, 0.30F}}, 12);
    rod(metal, {0, 0.29F, 0}, {0, kCord_m, 0}, 0.012F);
}

void addLantern(MeshMaker& maker, const RingPalette& palette)
{
    Part& metal = maker.with(palette.metal);
    metal.colour = rgb(0x353A44);
    constexpr int kPosts = 6;
    for (int i = 0; i < kPosts; ++i) {
        const float a = kTau * static_cast<float>(i) / kPosts;
        const glm::vec3 low(0.22F * std::sin(a), -0.36F, 0.22F * std::cos(a));
        const glm::vec3 high(0.30F * std::sin(a), 0.30F, 0.30F * std::cos(a));
        rod(metal, low, high, 0.035F);
        const float b = a + kPi / kPosts;
        rod(metal, {0.215F * std::sin(b), -0.34F, 0.215F * std::cos(b)},
            {0.275F * std::sin(b), 0.28F, 0.275F * std::cos(b)}, 0.014F);
    }
    ringAt(metal, 0.23F, -0.36F, 0.03F, 18);
    ringAt(metal, 0.26F, -0.02F, 0.014F, 18);
    metal.lathe({{0.38F, 0.28F}, {0.36F, 0.33F}, {0.16F, 0.46F}, {0.14F, 0.53F}, {0.06F, 0.58F}, {0.0F, 0.60F}}, 12,
                false, true);
    metal.lathe({{0.0F, 0.34F}, {0.38F, 0.28F}}, 12, false, true);
    rod(metal, {0, 0.58F, 0}, {0, kCord_m, 0}, 0.03F);
}

/// A bulb on a wall behind bars.
void addCaged(MeshMaker& maker, const RingPalette& palette)
{
    Part& metal = maker.with(palette.metal);
    metal.colour = rgb(0xB58A3A);
    metal.frame = at({0, 0, -kOffWall_m}) * turnedX(kPi * 0.5F);
    metal.lathe({{0.20F, -0.03F}, {0.20F, 0.03F}, {0.16F, 0.06F}, {0.06F, 0.07F}, {0.05F, 0.09F}, {0.0F, 0.09F}}, 16);
    metal.colour = rgb(0x3A3F48);
    ringAt(metal, 0.155F, 0.12F, 0.011F, 16);
    ringAt(metal, 0.125F, 0.24F, 0.011F, 16);
    for (int i = 0; i < 6; ++i) {
        const float a = kTau * static_cast<float>(i) / 6.0F;
        const glm::vec3 out(std::sin(a), 0, std::cos(a));
        const std::array<glm::vec3, 4> bar{out * 0.16F + glm::vec3(0, 0.04F, 0), out * 0.157F + glm::vec3(0, 0.15F, 0),
                                           out * 0.115F + glm::vec3(0, 0.26F, 0), glm::vec3(0, 0.30F, 0)};
        constexpr std::array<float, 4> kRadii{0.011F, 0.011F, 0.011F, 0.011F};
        metal.tube(bar, kRadii, 5);
    }
}

/// A box before a wall, open above and below.
void addSconce(MeshMaker& maker, const RingPalette& palette)
{
    Part& metal = maker.with(palette.metal);
    metal.colour = rgb(0x8A6A3E);
    metal.box({-0.15F, -0.18F, -kOffWall_m - 0.02F}, {0.15F, 0.18F, -0.12F}, 1.0F, true);
    metal.box({-0.17F, -0.14F, 0.11F}, {0.17F, 0.14F, 0.135F}, 1.0F, true);
    for (const float x : {-0.16F, 0.16F}) {
        metal.box({x - 0.012F, -0.14F, -0.13F}, {x + 0.012F, 0.14F, 0.115F}, 1.0F, true);
    }
    rod(metal, {0, -0.12F, -0.12F}, {0, -0.09F, 0.0F}, 0.03F);
}

void addTableLamp(MeshMaker& maker, const RingPalette& palette)
{
    Part& shade = maker.with(palette.shade);
    shade.colour = rgb(0xE8CFA0);
    shade.lathe({{0.19F, -0.10F}, {0.11F, 0.13F}}, 22);
    Part& gloss = maker.with(palette.gloss);
    gloss.colour = rgb(0x2F6F78);
    gloss.lathe({{0.11F, -0.40F},
                 {0.11F, -0.38F},
                 {0.04F, -0.36F},
                 {0.085F, -0.28F},
                 {0.08F, -0.20F},
                 {0.025F, -0.12F},
                 {0.02F, -0.06F},
                 {0.0F, -0.06F}},
                16, true);
}

/// Slats around a bulb on a pole.
void addDrum(MeshMaker& maker, const RingPalette& palette)
{
    const float foot = footOf(Lamp::drum);
    Part& wood = maker.with(palette.common.wood);
    wood.colour = rgb(0xA2703F);
    constexpr int kSlats = 14;
    for (int i = 0; i < kSlats; ++i) {
        const float a = kTau * static_cast<float>(i) / kSlats;
        wood.frame = turnedY(a) * at({0, -0.30F, 0.23F}) * turnedY(0.5F);
        wood.box({-0.033F, 0.0F, -0.007F}, {0.033F, 0.60F, 0.007F}, 1.0F, true);
    }
    wood.frame = glm::mat4(1.0F);
    Part& metal = maker.with(palette.metal);
    metal.colour = rgb(0x34383F);
    skin(metal, {{0.26F, -0.32F}, {0.26F, -0.29F}}, 0.05F, 20);
    skin(metal, {{0.26F, 0.29F}, {0.26F, 0.32F}}, 0.05F, 20);
    for (const float a : {0.0F, kTau / 3.0F, 2.0F * kTau / 3.0F}) {
        rod(metal, {0, -0.30F, 0}, {0.24F * std::sin(a), -0.305F, 0.24F * std::cos(a)}, 0.014F);
    }
    metal.lathe({{0.20F, -foot - 0.04F},
                 {0.20F, 0.02F - foot},
                 {0.03F, 0.05F - foot},
                 {0.022F, -0.12F},
                 {0.03F, -0.10F},
                 {0.0F, -0.09F}},
                14);
}

void addBollard(MeshMaker& maker, const RingPalette& palette)
{
    const float foot = footOf(Lamp::bollard);
    Part& metal = maker.with(palette.metal);
    metal.colour = rgb(0x5C6675);
    metal.lathe({{0.17F, -foot - 0.05F},
                 {0.17F, 0.06F - foot},
                 {0.12F, 0.10F - foot},
                 {0.12F, -0.14F},
                 {0.15F, -0.11F},
                 {0.0F, -0.10F}},
                14);
    metal.lathe({{0.17F, 0.10F}, {0.16F, 0.14F}, {0.10F, 0.20F}, {0.0F, 0.22F}}, 14);
    metal.lathe({{0.0F, 0.11F}, {0.17F, 0.10F}}, 14);
    for (int i = 0; i < 6; ++i) {
        const float a = kTau * static_cast<float>(i) / 6.0F;
        rod(metal, {0.135F * std::sin(a), -0.12F, 0.135F * std::cos(a)},
            {0.145F * std::sin(a), 0.12F, 0.145F * std::cos(a)}, 0.022F);
    }
}

/// A stand with three claws; the rings around it are nodes of their own, because they turn.
void addReactor(MeshMaker& maker, const RingPalette& palette)
{
    const float foot = footOf(Lamp::reactor);
    Part& metal = maker.with(palette.metal);
    metal.colour = rgb(0x6E7683);
    metal.lathe({{1.15F, -foot - 0.06F},
                 {1.15F, 0.10F - foot},
                 {1.05F, 0.18F - foot},
                 {0.55F, 0.30F - foot},
                 {0.42F, 0.55F - foot},
                 {0.34F, 0.62F - foot},
                 {0.30F, -0.86F},
                 {0.22F, -0.80F},
                 {0.0F, -0.78F}},
                26);
    metal.colour = rgb(0xC0883A);
    for (const float y : {0.12F, 0.60F}) {
        ringAt(metal, y < 0.3F ? 1.13F : 0.37F, y - foot, 0.05F, 28);
    }
    metal.colour = rgb(0x4E5560);
    for (int i = 0; i < 3; ++i) {
        const float a = kTau * static_cast<float>(i) / 3.0F;
        const glm::vec3 out(std::sin(a), 0, std::cos(a));
        const std::array<glm::vec3, 5> claw{out * 0.35F + glm::vec3(0, 0.5F - foot, 0),
                                            out * 0.95F + glm::vec3(0, -0.95F, 0), out * 1.22F + glm::vec3(0, -0.3F, 0),
                                            out * 1.15F + glm::vec3(0, 0.45F, 0), out * 0.80F + glm::vec3(0, 0.95F, 0)};
        constexpr std::array<float, 5> kRadii{0.10F, 0.09F, 0.075F, 0.06F, 0.03F};
        metal.tube(claw, kRadii, 8);
    }
}

Mesh makeLamp(const RingPalette& palette, Lamp lamp)
{
    using Make = void (*)(MeshMaker&, const RingPalette&);
    constexpr std::array<Make, kLamps> kMakers{addPendant,   addPierced, addLantern, addCaged,  addSconce,
                                               addTableLamp, addDrum,    addBollard, addReactor};
    MeshMaker maker;
    kMakers[static_cast<std::size_t>(lamp)](maker, palette);
    return maker.take(factsOf(lamp).name);
}

Light pointLight(const std::string& name, const Shine& shine)
{
    Light light;
    light.name = name;
    light.type = LightType::point;
    light.colour = colourOf(shine.hue);
    light.intensity = shine.strength * shine.range_m * shine.range_m / 4.0F;
    light.range_m = shine.range_m;
    return light;
}

} // namespace

float footOf(Lamp lamp)
{
    return factsOf(lamp).foot_m;
}

float bulbOf(Lamp lamp)
{
    return factsOf(lamp).bulb_m;
}

LampMaker::LampMaker(Scene& scene, const RingPalette& palette) : scene_(scene), palette_(palette)
{
    for (std::size_t i = 0; i < kLamps; ++i) {
        meshes_[i] = addMesh(scene, makeLamp(palette, static_cast<Lamp>(i)));
    }
    for (std::size_t i = 0; i < kHues; ++i) {
        MeshMaker maker;
        maker.with(palette.glow[i]).ball(1.0F, 2);
        bulbs_[i] = addMesh(scene, maker.take("bulb"));
    }
}

void LampMaker::add(Lamp lamp, const Transform& transform, const Shine& shine)
{
    const std::string name = std::string(factsOf(lamp).name) + " " + std::to_string(count_++);
    const std::uint32_t fixture = addNode(scene_, "lamp/" + name, meshes_[static_cast<std::size_t>(lamp)], transform);
    Transform round;
    round.scale = glm::vec3(1.03F * bulbOf(lamp)); // its flat faces are outside of the light, too
    const std::uint32_t bulb =
        addNode(scene_, "lamp/" + name + "/bulb", bulbs_[static_cast<std::size_t>(shine.hue)], round, fixture);
    scene_.nodes[bulb].casts = false;    // the light is inside
    scene_.nodes[bulb].receives = false; // or it would be drawn into filterable maps, and hide the world from its light
    Light light = pointLight(name, shine);
    light.radius_m = bulbOf(lamp);
    scene_.lights.push_back(light);
    const std::uint32_t node = addNode(scene_, "lamp/" + name + "/light", kNone, {}, fixture);
    scene_.nodes[node].light = static_cast<std::uint32_t>(scene_.lights.size() - 1);
    if (lamp == Lamp::reactor) {
        addRings(fixture);
    }
}

void LampMaker::addRings(std::uint32_t parent)
{
    constexpr std::array<float, 3> kRadii{0.80F, 0.62F, 0.46F};
    for (std::size_t i = 0; i < kRadii.size(); ++i) {
        MeshMaker maker;
        Part& metal = maker.with(palette_.metal);
        metal.colour = rgb(0xD9B25C);
        skin(metal, {{kRadii[i], -0.045F}, {kRadii[i], 0.045F}}, 0.035F, 36);
        const std::uint32_t node = addNode(scene_, "reactor ring/" + std::to_string(i),
                                           addMesh(scene_, maker.take("reactor ring")), {}, parent);
        scene_.nodes[node].dynamic = true;
        rings_ = i == 0 ? node : rings_;
        parent = node;
    }
}

void LampMaker::addMood(const glm::vec3& position, const Shine& shine)
{
    Light light = pointLight("mood " + std::to_string(moods_++), shine);
    light.radius_m = 0.1F;
    light.casts_shadow = false;
    addLight(scene_, light, position, {0.0F, -1.0F, 0.0F});
}

} // namespace gnomon::worlds
