// SPDX-License-Identifier: Apache-2.0
#include "settlements.h"

#include "../mesh_maker.h"
#include "../rng.h"
#include "../scene_maker.h"
#include "buildings.h"

#include <array>
#include <cmath>

namespace gnomon::worlds {

namespace {

constexpr std::uint32_t kBlue = 0x2F5FC4;
constexpr std::uint32_t kRed = 0xC23B32;
constexpr std::uint32_t kGold = 0xD39B2E;

struct Kit {
    std::uint32_t keep, gatehouse, watchtower, barracks, shingled, thatched, roundhouse;
    std::array<std::uint32_t, 3> pavilions;
    std::uint32_t windmill, sails, palisade, flag, red_flag, flagpole;
    std::uint32_t campfire, crates, barrels, hay, fence, cart, well;
};

constexpr int kPalisadeSlots = 28;
constexpr float kPalisadeLength_m = 11.75F;

Kit makeKit(Scene& scene, const Palette& p)
{
    Kit kit{};
    kit.keep = addMesh(scene, makeKeep(p));
    kit.gatehouse = addMesh(scene, makeGatehouse(p));
    kit.watchtower = addMesh(scene, makeWatchtower(p));
    kit.barracks = addMesh(scene, makeBarracks(p));
    kit.shingled = addMesh(scene, makeCottage(p, 0));
    kit.thatched = addMesh(scene, makeCottage(p, 1));
    kit.roundhouse = addMesh(scene, makeRoundhouse(p));
    kit.pavilions = {addMesh(scene, makePavilion(p, kBlue)), addMesh(scene, makePavilion(p, kRed)),
                     addMesh(scene, makePavilion(p, kGold))};
    kit.windmill = addMesh(scene, makeWindmill(p));
    kit.sails = addMesh(scene, makeSails(p));
    kit.palisade = addMesh(scene, makePalisade(p, kPalisadeLength_m));
    kit.flag = addMesh(scene, makeFlag(p, kBlue));
    kit.red_flag = addMesh(scene, makeFlag(p, kRed));
    kit.flagpole = addMesh(scene, makeFlagpole(p, 6.0F));
    kit.campfire = addMesh(scene, makeCampfire(p));
    kit.crates = addMesh(scene, makeCrates(p));
    kit.barrels = addMesh(scene, makeBarrels(p));
    kit.hay = addMesh(scene, makeHay(p));
    kit.fence = addMesh(scene, makeFence(p));
    kit.cart = addMesh(scene, makeCart(p));
    kit.well = addMesh(scene, makeWell(p));
    return kit;
}

class Settler {
public:
    Settler(Scene& scene, const Terrain& terrain, Turners& turners, const Kit& kit)
        : scene_(scene), terrain_(terrain), turners_(turners), kit_(kit)
    {
    }
    /// Doors look along `facing` (x, z).
    std::uint32_t build(const char* what, std::uint32_t mesh, glm::vec2 xz, glm::vec2 facing, float radius_m)
    {
        const std::string name = "building/" + std::to_string(buildings_++) + " " + what;
        taken_.push_back({xz, radius_m});
        return place(name, mesh, xz, std::atan2(facing.x, facing.y));
    }
    std::uint32_t place(const std::string& name, std::uint32_t mesh, glm::vec2 xz, float yaw_rad, float scale = 1.0F)
    {
        return addNode(scene_, name, mesh, standing(terrain_.ground(xz), yaw_rad, scale));
    }
    void prop(const char* what, std::uint32_t mesh, glm::vec2 xz, float yaw_rad)
    {
        taken_.push_back({xz, 1.5F});
        place(std::string("prop/") + what, mesh, xz, yaw_rad);
    }
    void flag(const glm::vec3& top, std::uint32_t mesh)
    {
        Transform transform;
        transform.translation = top;
        const std::uint32_t node = addNode(scene_, "flag/" + std::to_string(flags_), mesh, transform);
        scene_.nodes[node].dynamic = true;
        turners_.addFlag(node, 0.37F * static_cast<float>(flags_++));
    }
    void flagpole(glm::vec2 xz, std::uint32_t mesh)
    {
        place("prop/flagpole", kit_.flagpole, xz, 0.0F);
        flag(terrain_.ground(xz) + glm::vec3(0, 5.3F, 0), mesh);
    }
    void windmill(glm::vec2 xz, glm::vec2 facing)
    {
        const std::uint32_t mill = build("windmill", kit_.windmill, xz, facing, 6.0F);
        Transform hub;
        hub.translation = kSailHub;
        const std::uint32_t sails = addNode(scene_, "sails/" + std::to_string(mills_), kit_.sails, hub, mill);
        scene_.nodes[sails].dynamic = true;
        turners_.addSails(sails, 0.09F, 0.11F * static_cast<float>(mills_++) + 0.05F);
    }
    void fenceRow(glm::vec2 from, glm::vec2 to)
    {
        const glm::vec2 along = to - from;
        const float length = std::sqrt(along.x * along.x + along.y * along.y);
        const int count = static_cast<int>(length / 3.2F);
        for (int i = 0; i < count; ++i) {
            const glm::vec2 xz = from + along * ((static_cast<float>(i) + 0.5F) / static_cast<float>(count));
            prop("fence", kit_.fence, xz, std::atan2(-along.y, along.x));
        }
    }
    [[nodiscard]] const Kit& kit() const { return kit_; }
    [[nodiscard]] std::vector<Site> taken() const { return taken_; }

private:
    Scene& scene_;
    const Terrain& terrain_;
    Turners& turners_;
    const Kit& kit_;
    std::vector<Site> taken_;
    std::uint32_t buildings_ = 0;
    std::uint32_t flags_ = 0;
    std::uint32_t mills_ = 0;
};

glm::vec2 onCircle(float degrees, float radius) // clockwise from north, as on a map
{
    const float a = degrees * kPi / 180.0F;
    return {radius * std::sin(a), -radius * std::cos(a)};
}

/// Gates look south, west and east.
constexpr std::array<float, 3> kGates{180.0F, 270.0F, 90.0F};

void addWalls(Settler& settler)
{
    const Kit& kit = settler.kit();
    for (int i = 0; i < kPalisadeSlots; ++i) {
        const float degrees = 360.0F * static_cast<float>(i) / kPalisadeSlots;
        bool gate = false;
        for (const float g : kGates) {
            gate = gate || std::abs(degrees - g) < 4.0F;
        }
        const glm::vec2 xz = onCircle(degrees, kCampRadius_m);
        if (gate) {
            settler.build("gatehouse", kit.gatehouse, xz, xz, 7.0F);
        } else {
            settler.place("wall/" + std::to_string(i), kit.palisade, xz, std::atan2(xz.x, xz.y));
        }
    }
    for (const float degrees : {25.7F, 77.1F - 12.9F, 128.6F, 141.4F + 10.3F, 218.6F, 231.4F + 70.0F}) {
        const glm::vec2 xz = onCircle(degrees, kCampRadius_m - 3.6F);
        settler.build("watchtower", kit.watchtower, xz, xz, 3.0F);
    }
}

void addCamp(Settler& settler)
{
    const Kit& kit = settler.kit();
    settler.build("keep", kit.keep, {0.0F, -8.0F}, {0.0F, 1.0F}, 10.0F);
    settler.flag({0.1F, kCampHeight_m + kKeepFlag_m + 1.0F, -8.0F}, kit.flag);
    const auto around = [&](const char* what, std::uint32_t mesh, float degrees, float radius, float taken) {
        const glm::vec2 xz = onCircle(degrees, radius);
        settler.build(what, mesh, xz, -xz, taken);
    };
    for (const float degrees : {0.0F, 38.0F, 118.0F, 242.0F, 322.0F}) {
        around("barracks", kit.barracks, degrees, 40.0F, 7.0F);
    }
    for (const float degrees : {19.0F, 60.0F, 300.0F, 222.0F}) {
        around("cottage", kit.shingled, degrees, 39.5F, 5.0F);
    }
    for (const float degrees : {74.0F, 137.0F, 286.0F, 341.0F}) {
        around("cottage", kit.thatched, degrees, 39.5F, 5.0F);
    }
    int tent = 0;
    for (const float degrees : {105.0F, 152.0F, 163.0F, 197.0F, 208.0F, 256.0F}) {
        around("pavilion", kit.pavilions[static_cast<std::size_t>(tent++ % 3)], degrees, 38.5F, 3.5F);
    }
    for (const glm::vec2 xz : {glm::vec2(-14.5F, 8.5F), {14.5F, 9.5F}}) {
        settler.build("pavilion", kit.pavilions[xz.x < 0.0F ? 0 : 2], xz, -xz, 3.5F);
    }
    settler.prop("campfire", kit.campfire, {-5.5F, 13.0F}, 0.0F);
    settler.prop("well", kit.well, {7.0F, 14.5F}, 0.4F);
    settler.prop("cart", kit.cart, {13.5F, 2.5F}, 2.3F);
    settler.prop("cart", kit.cart, {-33.0F, 19.0F}, 0.9F);
    for (const glm::vec2 xz :
         {glm::vec2(-12.5F, 1.5F), {11.5F, 14.6F}, {33.6F, 14.5F}, {-19.0F, 32.5F}, {24.0F, 37.0F}}) {
        settler.prop("crates", kit.crates, xz, xz.x * 0.31F);
        settler.prop("barrels", kit.barrels, xz + glm::vec2(1.4F, 1.5F), xz.y * 0.7F);
    }
    for (const glm::vec2 xz : {glm::vec2(-9.0F, 16.5F), {-34.5F, 9.0F}, {36.5F, -6.5F}, {-11.0F, 44.0F}}) {
        settler.prop("hay", kit.hay, xz, xz.x);
    }
    for (const float degrees : {172.0F, 188.0F, 262.5F, 277.5F, 82.5F, 97.5F}) {
        settler.flagpole(onCircle(degrees, 46.0F), kit.flag);
    }
    settler.flagpole({-3.6F, 3.2F}, kit.flag);
    settler.flagpole({3.6F, 3.2F}, kit.red_flag);
}

void addVillage(Settler& settler, const Site& site, float turn_degrees)
{
    const Kit& kit = settler.kit();
    const auto spot = [&](float degrees, float share) {
        return site.centre + onCircle(degrees + turn_degrees, site.radius_m * share);
    };
    const std::array<std::uint32_t, 3> kinds{kit.thatched, kit.roundhouse, kit.shingled};
    for (int i = 0; i < 9; ++i) {
        const bool inner = i >= 6;
        const glm::vec2 xz =
            spot(static_cast<float>(i) * (inner ? 120.0F : 60.0F) + (inner ? 30.0F : 0.0F), inner ? 0.36F : 0.84F);
        settler.build(i % 3 == 1 ? "roundhouse" : "cottage", kinds[static_cast<std::size_t>(i % 3)], xz,
                      site.centre - xz, 5.0F);
    }
    settler.prop("well", kit.well, site.centre, 0.3F);
    settler.prop("cart", kit.cart, spot(100.0F, 0.5F), 1.2F);
    for (const float degrees : {30.0F, 150.0F, 270.0F}) {
        settler.prop("hay", kit.hay, spot(degrees, 0.62F), degrees);
        settler.prop("hay", kit.hay, spot(degrees + 8.0F, 0.55F), degrees);
        settler.fenceRow(spot(degrees - 22.0F, 1.05F), spot(degrees + 22.0F, 1.05F));
    }
}

void addOutposts(Settler& settler)
{
    const Kit& kit = settler.kit();
    const glm::vec2 field = villageSites()[2].centre;
    int tent = 0;
    for (const glm::vec2 offset : {glm::vec2(-9, 3), {-3, -4}, {4, 4}, {10, -3}}) {
        settler.build("pavilion", kit.pavilions[static_cast<std::size_t>(tent++ % 3)], field + offset, {0, 1}, 3.5F);
    }
    settler.prop("campfire", kit.campfire, field, 0.0F);
    settler.windmill(villageSites()[3].centre, {0.55F, 1.0F});
    settler.windmill(villageSites()[4].centre, {-0.35F, 1.0F});
    settler.windmill({-162.0F, 62.0F}, {1.0F, 0.5F});
    for (const glm::vec2 xz : {glm::vec2(-44.0F, -92.0F), {64.0F, 16.0F}, {-96.0F, 96.0F}, {134.0F, -14.0F}}) {
        settler.build("watchtower", kit.watchtower, xz, {0, 1}, 3.5F);
    }
    settler.fenceRow({-62.0F, -20.0F}, {-96.0F, -18.0F});
    settler.fenceRow({46.0F, 78.0F}, {50.0F, 104.0F});
}

} // namespace

std::vector<Site> addSettlements(Scene& scene, const Palette& palette, const Terrain& terrain, Turners& turners)
{
    const Kit kit = makeKit(scene, palette);
    Settler settler(scene, terrain, turners, kit);
    addCamp(settler);
    addWalls(settler);
    addVillage(settler, villageSites()[0], 20.0F);
    addVillage(settler, villageSites()[1], 50.0F);
    addOutposts(settler);
    return settler.taken();
}

} // namespace gnomon::worlds
