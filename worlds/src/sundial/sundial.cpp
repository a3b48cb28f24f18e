// SPDX-License-Identifier: Apache-2.0
// The setting of P. Fortier, "Shadow maps for moving light sources", 2010: open ground under a sun that crosses the sky
// while one looks, a minute in a second.
#include "worlds/sundial.h"

#include "../mesh_maker.h"
#include "../rng.h"
#include "../rts/buildings.h"
#include "../rts/plants.h"
#include "../scene_maker.h"
#include "course.h"
#include "meadow.h"
#include "things.h"
#include "walker.h"

#include "scene/state.h"

#include <glm/geometric.hpp>

#include <array>
#include <memory>
#include <string>
#include <utility>

namespace gnomon::worlds {

namespace {

/// Where a tree stands, and how big.
struct Stand {
    glm::vec2 at;
    float size;
};
/// The trees one looks at: placed, not scattered.
constexpr std::array<Stand, 15> kOaks{{{{18.5F, 13.0F}, 1.10F},
                                       {{-13.0F, -33.0F}, 1.15F},
                                       {{-5.0F, -39.0F}, 0.95F},
                                       {{13.0F, -37.0F}, 1.05F},
                                       {{34.0F, -21.0F}, 1.20F},
                                       {{-43.0F, -31.0F}, 1.10F},
                                       {{-33.0F, 24.0F}, 1.05F},
                                       {{-26.0F, 35.0F}, 0.90F},
                                       {{29.0F, 38.0F}, 1.15F},
                                       {{-54.0F, -2.0F}, 1.05F},
                                       {{54.0F, -43.0F}, 1.10F},
                                       {{57.0F, 8.0F}, 0.95F},
                                       {{-14.0F, 69.0F}, 1.0F},
                                       {{20.0F, -62.0F}, 1.0F},
                                       {{-38.0F, -13.0F}, 0.85F}}};

constexpr std::array<Stand, 16> kRocks{{{{-8.6F, 6.4F}, 0.55F},
                                        {{-9.7F, 5.6F}, 0.32F},
                                        {{12.5F, 3.4F}, 0.70F},
                                        {{13.6F, 4.5F}, 0.38F},
                                        {{12.0F, -9.0F}, 0.50F},
                                        {{-6.5F, 24.0F}, 0.80F},
                                        {{-7.9F, 25.1F}, 0.40F},
                                        {{18.0F, 31.0F}, 0.75F},
                                        {{-4.5F, 47.0F}, 0.60F},
                                        {{16.0F, 52.0F}, 0.95F},
                                        {{17.6F, 53.0F}, 0.50F},
                                        {{-27.0F, 14.0F}, 0.65F},
                                        {{36.0F, 3.0F}, 0.80F},
                                        {{3.0F, -31.0F}, 0.70F},
                                        {{40.0F, -30.0F}, 0.90F},
                                        {{-50.0F, 20.0F}, 0.85F}}};

class Gardener {
public:
    Gardener(Scene& scene, const Meadow& meadow, std::uint64_t seed) : scene_(scene), meadow_(meadow), rng_(seed, 710)
    {
    }

    [[nodiscard]] glm::mat4 upright(glm::vec2 xz, float size)
    {
        return at(meadow_.ground(xz)) * turnedY(rng_.range(0.0F, kTau)) *
               scaled({size, size * rng_.range(0.95F, 1.1F), size});
    }
    /// Stands square on the slope, as grass and stones do.
    [[nodiscard]] glm::mat4 leaning(glm::vec2 xz, float size)
    {
        const glm::vec3 up = meadow_.normal(xz);
        const glm::vec3 right = glm::normalize(glm::cross(up, glm::vec3(0, 0, 1)));
        const glm::vec3 ahead = glm::cross(right, up);
        return glm::mat4(glm::vec4(right, 0), glm::vec4(up, 0), glm::vec4(ahead, 0), glm::vec4(meadow_.ground(xz), 1)) *
               turnedY(rng_.range(0.0F, kTau)) * scaled(glm::vec3(size));
    }
    /// Off the path, the court, the house and its garden's beds.
    [[nodiscard]] bool free(glm::vec2 xz, float clearance_m) const
    {
        return meadow_.pathDistance(xz) > 1.0F + clearance_m && glm::length(xz) > kCourtRadius_m + 0.4F + clearance_m &&
               glm::distance(xz, kHouseAt) > 9.0F + clearance_m;
    }
    [[nodiscard]] glm::vec2 within(glm::vec2 centre, float from_m, float to_m)
    {
        const float a = rng_.range(0.0F, kTau);
        const float r = std::sqrt(rng_.range(from_m * from_m, to_m * to_m));
        return centre + r * glm::vec2(std::cos(a), std::sin(a));
    }
    [[nodiscard]] Rng& rng() { return rng_; }

    /// All copies of one mesh are one node, so that they are neighbours in every list.
    void addInstances(const std::string& name, Mesh mesh, std::vector<glm::mat4> places, bool casts = true)
    {
        Node& node = scene_.nodes[addNode(scene_, name, addMesh(scene_, std::move(mesh)), {})];
        node.instances = std::move(places);
        node.casts = casts;
    }

private:
    Scene& scene_;
    const Meadow& meadow_;
    Rng rng_;
};

void addTrees(Gardener& gardener, const SundialPalette& palette)
{
    std::array<std::vector<glm::mat4>, kOakVariants> oaks;
    for (std::size_t i = 0; i < kOaks.size(); ++i) {
        oaks[i % kOakVariants].push_back(gardener.upright(kOaks[i].at, kOaks[i].size));
    }
    // The woods on the hills: nobody comes near them.
    std::array<std::vector<glm::mat4>, 2> broad;
    std::array<std::vector<glm::mat4>, 2> firs;
    std::vector<glm::vec2> stems;
    while (stems.size() < 150) {
        const glm::vec2 xz = gardener.within({0, 0}, kOpenRadius_m + 2.0F, 126.0F);
        bool crowded = std::max(std::abs(xz.x), std::abs(xz.y)) > 97.0F;
        for (const glm::vec2& stem : stems) {
            crowded = crowded || glm::distance(stem, xz) < 4.0F;
        }
        if (crowded) {
            continue;
        }
        stems.push_back(xz);
        const std::uint32_t variant = gardener.rng().below(2);
        const bool fir = fractal(xz / 40.0F, 2, 77) > -0.08F;
        (fir ? firs : broad)[variant].push_back(gardener.upright(xz, gardener.rng().range(0.85F, 1.35F)));
    }
    for (std::uint32_t v = 0; v < 2; ++v) {
        const std::string number = " " + std::to_string(v);
        gardener.addInstances("tree/oaks" + number, makeOak(palette, v, true), std::move(oaks[v]));
        gardener.addInstances("tree/woods" + number, makeOak(palette, v, false), std::move(broad[v]));
        gardener.addInstances("tree/firs" + number, makeFir(palette.common, v), std::move(firs[v]));
    }
}

void addUndergrowth(Gardener& gardener, const SundialPalette& palette)
{
    const auto scatter = [&](std::size_t count, float reach_m, float clearance_m, float low, float high) {
        std::vector<glm::mat4> places;
        while (places.size() < count) {
            // Half of them where people look: about the sundial, and where the long view begins.
            const float pick = gardener.rng().unit();
            const glm::vec2 xz = pick < 0.20F   ? gardener.within({0, 0}, 0.0F, 0.4F * reach_m)
                                 : pick < 0.36F ? gardener.within({1.0F, 12.0F}, 0.0F, 6.5F)
                                 : pick < 0.50F ? gardener.within({3.0F, 58.0F}, 0.0F, 13.0F)
                                                : gardener.within({0, 0}, 0.0F, reach_m);
            if (gardener.free(xz, clearance_m)) {
                places.push_back(gardener.leaning(xz, gardener.rng().range(low, high)));
            }
        }
        return places;
    };
    gardener.addInstances("grass", makeGrassPatch(palette), scatter(290, 74.0F, 0.9F, 0.8F, 1.3F), false);
    gardener.addInstances("flowers", makeFlowerPatch(palette), scatter(64, 60.0F, 0.9F, 0.8F, 1.2F), false);
    std::array<std::vector<glm::mat4>, 2> rocks;
    for (std::size_t i = 0; i < kRocks.size(); ++i) {
        rocks[i % 2].push_back(gardener.leaning(kRocks[i].at, kRocks[i].size));
    }
    for (std::uint32_t v = 0; v < 2; ++v) {
        gardener.addInstances("rocks " + std::to_string(v), makeRock(palette.common, v), std::move(rocks[v]));
    }
    std::vector<glm::mat4> bushes;
    for (const glm::vec2 own : {glm::vec2(-7.2F, 1.5F),
                                {-7.4F, -1.2F},
                                {7.3F, 0.4F},
                                {7.2F, -2.2F},
                                {-3.0F, -4.6F},
                                {1.4F, -4.7F},
                                {5.0F, -4.4F}}) {
        bushes.push_back(gardener.upright(fromHouse(own), gardener.rng().range(0.8F, 1.2F)));
    }
    for (const glm::vec2 xz :
         {glm::vec2(24.0F, 15.5F), {17.0F, -33.0F}, {-30.0F, 27.0F}, {38.0F, -17.0F}, {-47.0F, -4.0F}}) {
        bushes.push_back(gardener.upright(xz, gardener.rng().range(0.9F, 1.5F)));
    }
    gardener.addInstances("bushes", makeBush(palette.common), std::move(bushes));
}

void addBuilt(Scene& scene, const SundialPalette& palette, const Meadow& meadow)
{
    const auto put = [&](const char* name, Mesh mesh, glm::vec2 xz, float yaw_rad) {
        addNode(scene, name, addMesh(scene, std::move(mesh)), standing(meadow.ground(xz), yaw_rad));
    };
    put("sundial", makeDial(palette), {0, 0}, 0.0F);
    put("house", makeHouse(palette), kHouseAt, kHouseYaw_rad);
    const std::uint32_t bench = addMesh(scene, makeBench(palette));
    for (const float side : {-1.0F, 1.0F}) {
        const float turn = side * 0.85F;
        const glm::vec2 xz(4.75F * std::sin(turn),
                           4.75F * std::cos(turn)); // on the court's southern half, facing the dial
        addNode(scene, side < 0.0F ? "bench/west" : "bench/east", bench, standing(meadow.ground(xz), turn));
    }
    put("well", makeWell(palette.common), fromHouse({-9.2F, 8.2F}), kHouseYaw_rad + 0.3F);
    put("barrels", makeBarrels(palette.common), fromHouse({-5.4F, 3.8F}), 0.6F);
    put("cart", makeCart(palette.common), {17.0F, -15.5F}, 2.2F);
    put("hay/0", makeHay(palette.common), {24.0F, -10.0F}, 0.0F);
    put("hay/1", makeHay(palette.common), {20.5F, -6.0F}, 0.9F);

    const auto fence = [&](const char* name, Mesh mesh) {
        addNode(scene, name, addMesh(scene, std::move(mesh)), {});
    };
    // The garden's fence leaves a gate before the door.
    const std::array<glm::vec2, 4> right{fromHouse({1.3F, 10.6F}), fromHouse({10.2F, 10.6F}), fromHouse({10.2F, 0.0F}),
                                         fromHouse({10.2F, -5.5F})};
    const std::array<glm::vec2, 4> left{fromHouse({-11.4F, -5.5F}), fromHouse({-11.4F, 0.0F}),
                                        fromHouse({-11.4F, 10.6F}), fromHouse({-1.3F, 10.6F})};
    fence("fence/garden right", makePickets(palette, meadow, right));
    fence("fence/garden left", makePickets(palette, meadow, left));
    constexpr std::array<glm::vec2, 5> kNorth{
        {{-7.0F, -20.5F}, {3.0F, -21.5F}, {14.0F, -20.0F}, {26.0F, -15.0F}, {37.0F, -7.0F}}};
    constexpr std::array<glm::vec2, 4> kEast{{{40.0F, -3.5F}, {45.0F, 8.0F}, {46.0F, 22.0F}, {42.0F, 36.0F}}};
    constexpr std::array<glm::vec2, 4> kSouth{{{8.5F, 62.0F}, {9.0F, 50.0F}, {7.0F, 36.0F}, {6.5F, 25.0F}}};
    fence("fence/north", makeRails(palette, meadow, kNorth));
    fence("fence/east", makeRails(palette, meadow, kEast));
    fence("fence/south", makeRails(palette, meadow, kSouth));
}

/// Flat stones from the gate to the arcade.
void addSteppingStones(Scene& scene, const SundialPalette& palette, const Meadow& meadow)
{
    MeshMaker maker;
    Part& stone = maker.with(palette.pale_stone);
    stone.uv_per_metre = 0.5F;
    Rng rng(95, 0);
    for (int i = 0; i < 7; ++i) {
        const glm::vec2 xz = fromHouse({rng.range(-0.14F, 0.14F), 6.75F + 0.72F * static_cast<float>(i)});
        const float tone = rng.range(0.9F, 1.05F);
        stone.colour = rgb(0xB9AF9C) * glm::vec4(tone, tone, tone, 1.0F);
        stone.frame = at(meadow.ground(xz)) * turnedY(rng.range(0.0F, kTau));
        const float r = rng.range(0.28F, 0.34F);
        stone.lathe({{r, -0.15F}, {r, 0.035F}, {r - 0.03F, 0.05F}, {0.0F, 0.05F}}, 7, false, true);
    }
    addNode(scene, "stepping stones", addMesh(scene, maker.take("stepping stones")), {});
}

struct Lamps {
    std::uint32_t sun = 0; // nodes
    std::uint32_t moon = 0;
};

Lamps addSunAndMoon(Scene& scene)
{
    Light sun;
    sun.name = "sun";
    sun.body = Body::sun;
    sun.colour = {1.0F, 0.95F, 0.87F};
    sun.intensity = 3.6F;
    sun.angular_diameter_rad = SundialWorld::sun_angular_diameter_rad;
    Light moon;
    moon.name = "moon";
    moon.body = Body::moon;
    moon.colour = {0.55F, 0.72F, 1.0F};
    moon.intensity = 0.95F; // a real one gives a 400,000th of the sun's light; eyes get used to that
    moon.angular_diameter_rad = SundialWorld::moon_angular_diameter_rad;
    const glm::vec3 above(0.0F, 60.0F, 0.0F);
    Lamps lamps;
    lamps.sun = addLight(scene, sun, above, SundialWorld::sunDirection(0.0));
    lamps.moon = addLight(scene, moon, above, SundialWorld::moonDirection(0.0));
    for (const std::uint32_t node : {lamps.sun, lamps.moon}) {
        scene.nodes[node].dynamic = true;
    }
    scene.environment = skyAt(0.0);
    scene.daylight = [](double time_s, std::span<glm::vec3> strengths, Environment& environment) {
        strengths[0] = sunlightAt(time_s);
        strengths[1] = glm::vec3(static_cast<float>(SundialWorld::moonStrength(time_s)));
        environment = skyAt(time_s);
    };
    return lamps;
}

void addViews(Scene& scene, const Meadow& meadow)
{
    const auto eye = [&](glm::vec2 xz, float height_m) {
        return meadow.ground(xz) + glm::vec3(0, height_m, 0);
    };
    const glm::vec2 gate = fromHouse({1.5F, 6.0F});
    scene.views = {
        {.name = "meadow", .eye = eye({7.0F, 15.8F}, 2.3F), .target = {-3.0F, 1.5F, -4.5F}, .fov_y_rad = 0.72F},
        {.name = "long", .eye = eye({3.0F, 72.0F}, 1.7F), .target = {-1.0F, 1.6F, 0.0F}, .fov_y_rad = 0.75F},
        {.name = "porch", .eye = eye(fromHouse({8.8F, 16.0F}), 1.7F), .target = eye(gate, 2.2F), .fov_y_rad = 0.80F},
        {.name = "overhead", .eye = {6.0F, 78.0F, 44.0F}, .target = {-3.0F, 0.0F, -1.0F}, .fov_y_rad = 0.72F},
        {.name = "face", .eye = {3.05F, 2.75F, -1.05F}, .target = {-1.0F, 1.62F, 0.18F}, .fov_y_rad = 0.86F},
    };
}

/// The animator's data, which live as long as the scene.
struct Stage {
    Loop path;
    Meadow meadow;
    Walker walker;
    Lamps lamps;
};

} // namespace

Scene makeSundial(std::uint64_t seed)
{
    Scene scene;
    scene.name = "sundial";
    const SundialPalette palette = addSundialPalette(scene);
    Loop path = makePath();
    Meadow meadow(seed, path);
    meadow.addTo(scene, palette.common.ground);
    addBuilt(scene, palette, meadow);
    addSteppingStones(scene, palette, meadow);
    Gardener gardener(scene, meadow, seed);
    addTrees(gardener, palette);
    addUndergrowth(gardener, palette);
    Walker walker(scene, palette, path);
    const Lamps lamps = addSunAndMoon(scene);
    addViews(scene, meadow);
    const auto stage = std::make_shared<const Stage>(Stage{std::move(path), std::move(meadow), walker, lamps});
    scene.procedural = [stage](double time_s, std::vector<Node>& nodes) {
        stage->walker.pose(time_s, stage->meadow, stage->path, nodes);
        nodes[stage->lamps.sun].transform.rotation = lookAlong(SundialWorld::sunDirection(time_s));
        nodes[stage->lamps.moon].transform.rotation = lookAlong(SundialWorld::moonDirection(time_s));
    };
    scene.procedural(0.0, scene.nodes);
    finishScene(scene);
    return scene;
}

} // namespace gnomon::worlds
