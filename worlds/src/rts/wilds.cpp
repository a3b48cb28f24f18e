// SPDX-License-Identifier: Apache-2.0
#include "wilds.h"

#include "../mesh_maker.h"
#include "../rng.h"
#include "../scene_maker.h"
#include "plants.h"

#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <vector>

namespace gnomon::worlds {

namespace {

struct Grove {
    glm::vec2 centre;
    float radius_m;
    std::uint32_t trees;
    bool firs; // mostly
};
constexpr std::array<Grove, 22> kGroves{{
    {{-64, 26}, 13, 16, false},  {{-60, -52}, 16, 20, true},  {{34, -66}, 14, 18, true},   {{66, -38}, 11, 14, false},
    {{66, 42}, 12, 14, false},   {{-40, 62}, 13, 16, false},  {{28, 92}, 15, 18, false},   {{-8, 112}, 16, 20, true},
    {{-76, 130}, 22, 24, true},  {{-180, 20}, 22, 24, false}, {{-170, -60}, 24, 26, true}, {{-110, -120}, 24, 26, true},
    {{-40, -150}, 22, 24, true}, {{40, -140}, 24, 24, true},  {{120, -150}, 24, 22, true}, {{190, -130}, 20, 16, true},
    {{200, 0}, 20, 16, false},   {{180, 70}, 18, 14, false},  {{160, 170}, 24, 16, true},  {{60, 190}, 22, 14, true},
    {{-60, 200}, 22, 10, true},  {{-190, 160}, 22, 8, true},
}};

class Forester {
public:
    Forester(const Terrain& terrain, std::span<const Site> taken, std::uint64_t seed)
        : terrain_(terrain), taken_(taken), rng_(seed, 500)
    {
    }
    [[nodiscard]] Rng& rng() { return rng_; }
    [[nodiscard]] bool free(glm::vec2 xz, float clearance_m, float steepest) const
    {
        const float h = terrain_.height(xz.x, xz.y);
        if (h < kWaterLevel_m + 0.5F || terrain_.slope(xz.x, xz.y) > steepest || terrain_.road(xz.x, xz.y) > 0.02F) {
            return false;
        }
        for (const Site& site : taken_) {
            const glm::vec2 d = xz - site.centre;
            const float reach = site.radius_m + clearance_m;
            if (glm::dot(d, d) < reach * reach) {
                return false;
            }
        }
        return std::abs(xz.x) < 250.0F && std::abs(xz.y) < 250.0F;
    }
    [[nodiscard]] bool inCamp(glm::vec2 xz) const { return glm::length(xz) < kCampRadius_m + 4.0F; }
    [[nodiscard]] glm::mat4 place(glm::vec2 xz, float low, float high)
    {
        const float size = rng_.range(low, high);
        const glm::mat4 stand = at(terrain_.ground(xz)) * turnedY(rng_.range(0.0F, kTau));
        return stand * scaled({size, size * rng_.range(0.92F, 1.12F), size});
    }
    [[nodiscard]] glm::vec2 inDisc(glm::vec2 centre, float radius)
    {
        const float a = rng_.range(0.0F, kTau);
        return centre + radius * std::sqrt(rng_.unit()) * glm::vec2(std::cos(a), std::sin(a));
    }
    [[nodiscard]] glm::vec2 onMap() { return {rng_.range(-245.0F, 245.0F), rng_.range(-245.0F, 245.0F)}; }

private:
    const Terrain& terrain_;
    std::span<const Site> taken_;
    Rng rng_;
};

/// All copies of one mesh are one node, so that they are neighbours in every list.
void addInstances(Scene& scene, const std::string& name, std::uint32_t mesh, std::vector<glm::mat4> places,
                  bool casts = true)
{
    if (!places.empty()) {
        Node& node = scene.nodes[addNode(scene, name, mesh, {})];
        node.instances = std::move(places);
        node.casts = casts;
    }
}

void addTrees(Scene& scene, const Palette& palette, Forester& forester)
{
    std::array<std::vector<glm::mat4>, 2 * kTreeVariants> places; // broad trees, then firs
    std::vector<glm::vec2> stems;
    for (const Grove& grove : kGroves) {
        std::uint32_t planted = 0;
        float radius = grove.radius_m;
        float room_m = 3.2F;
        while (planted < grove.trees) {
            const glm::vec2 xz = forester.inDisc(grove.centre, radius);
            radius += 0.02F; // a grove whose ground is taken spreads, and in the end stands closer
            room_m = std::max(1.5F, room_m - 0.002F);
            bool crowded = forester.inCamp(xz) || !forester.free(xz, 3.0F, 0.6F);
            for (const glm::vec2& stem : stems) {
                crowded = crowded || glm::distance(stem, xz) < room_m;
            }
            if (crowded) {
                continue;
            }
            stems.push_back(xz);
            ++planted;
            const bool fir = (forester.rng().unit() < 0.82F) == grove.firs;
            const std::uint32_t pick = forester.rng().below(10); // few are gold
            const std::uint32_t variant = pick < 5 ? 0 : (pick < 9 || fir ? 1 : 2);
            places[(fir ? kTreeVariants : 0) + variant].push_back(forester.place(xz, 0.75F, 1.25F));
        }
    }
    for (std::uint32_t v = 0; v < kTreeVariants; ++v) {
        addInstances(scene, "grove/broad trees " + std::to_string(v), addMesh(scene, makeBroadTree(palette, v)),
                     places[v]);
        addInstances(scene, "grove/firs " + std::to_string(v), addMesh(scene, makeFir(palette, v)),
                     places[kTreeVariants + v]);
    }
}

std::vector<glm::mat4> scatter(Forester& forester, std::uint32_t count, float low, float high, float steepest,
                               bool in_camp)
{
    std::vector<glm::mat4> places;
    while (places.size() < count) {
        // Half of them near the camp, where people look.
        const glm::vec2 xz = forester.rng().unit() < 0.5F ? forester.inDisc({0, 0}, 105.0F) : forester.onMap();
        if ((in_camp || !forester.inCamp(xz)) && forester.free(xz, 0.8F, steepest)) {
            places.push_back(forester.place(xz, low, high));
        }
    }
    return places;
}

} // namespace

void addWilds(Scene& scene, const Palette& palette, const Terrain& terrain, std::span<const Site> taken,
              std::uint64_t seed)
{
    Forester forester(terrain, taken, seed);
    addTrees(scene, palette, forester);
    for (std::uint32_t v = 0; v < 2; ++v) {
        addInstances(scene, "rocks " + std::to_string(v), addMesh(scene, makeRock(palette, v)),
                     scatter(forester, 90, 0.35F, 1.9F, 1.2F, false));
    }
    addInstances(scene, "bushes", addMesh(scene, makeBush(palette)), scatter(forester, 180, 0.7F, 1.5F, 0.6F, false));
    addInstances(scene, "grass", addMesh(scene, makeGrassTuft(palette)), scatter(forester, 700, 0.6F, 1.3F, 0.5F, true),
                 false);
}

} // namespace gnomon::worlds
