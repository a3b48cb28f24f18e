// SPDX-License-Identifier: Apache-2.0
#include "terrain.h"

#include "../mesh_maker.h"
#include "../rng.h"
#include "../scene_maker.h"

#include "worlds/rts.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>

namespace gnomon::worlds {

namespace {

constexpr std::array<Site, 5> kSites{{{{-138.0F, 78.0F}, 30.0F},
                                      {{160.0F, -66.0F}, 30.0F},
                                      {{-4.0F, -84.0F}, 44.0F},
                                      {{-86.0F, -36.0F}, 9.0F},
                                      {{62.0F, 92.0F}, 9.0F}}};

float riverDistance(glm::vec2 p)
{
    const float x = 90.0F + 22.0F * std::sin(p.y / 52.0F) + 8.0F * std::sin(p.y / 21.0F + 1.0F);
    return std::abs(p.x - x);
}

/// Rise over run of a chunk's steepest triangle.
float steepestOf(const Primitive& chunk, float cells_per_m)
{
    const auto rise = [&](std::uint32_t a, std::uint32_t b) {
        return (chunk.positions[b].y - chunk.positions[a].y) * cells_per_m;
    };
    float steepest = 0.0F;
    for (std::size_t i = 0; i < chunk.indices.size(); i += 6) { // a cell's two triangles: a c b, b c d
        const std::uint32_t* const cell = &chunk.indices[i];
        const auto [a, b, c, d] = std::array{cell[0], cell[2], cell[1], cell[5]};
        steepest = std::max({steepest, std::hypot(rise(a, b), rise(a, c)), std::hypot(rise(c, d), rise(b, d))});
    }
    return steepest;
}

} // namespace

std::span<const Site> villageSites()
{
    return kSites;
}

Terrain::Terrain(std::uint64_t seed, std::span<const Loop> roads)
    : noise_seed_(Rng(seed, 100).next()), grid_(kCells, kMapSize_m), roads_(grid_.heights.size(), 0.0F)
{
    for (std::int32_t iz = 0; iz <= kCells; ++iz) {
        for (std::int32_t ix = 0; ix <= kCells; ++ix) {
            grid_.heights[grid_.index(ix, iz)] = naturalHeight(grid_.point(ix, iz));
        }
    }
    treadRoads(roads);
}

float Terrain::naturalHeight(glm::vec2 p) const
{
    const std::uint32_t s = noise_seed_;
    const float r = glm::length(p);
    const float wild = smoothstep(kCampRadius_m + 4.0F, 115.0F, r);
    float h = kCampHeight_m + wild * (6.0F * fractal(p / 46.0F, 4, s) + 9.0F * fractal(p / 130.0F, 3, s + 20));
    const float border = std::max(std::abs(p.x), std::abs(p.y)) + 14.0F * noise(p / 40.0F, s + 31);
    h += smoothstep(195.0F, 262.0F, border) * (13.0F + 9.0F * noise(p / 60.0F, s + 33));
    // Mesas in the north and west: noise cut into terraces.
    const float lie = 0.34F * smoothstep(60.0F, 150.0F, -p.y) + 0.12F * smoothstep(60.0F, 190.0F, -p.x) - 0.22F;
    const float mesa = (fractal(p / 62.0F, 4, s + 40) + lie) * smoothstep(78.0F, 104.0F, r);
    h += 13.0F * smoothstep(0.10F, 0.17F, mesa) + 11.0F * smoothstep(0.28F, 0.34F, mesa);
    for (const Site& site : kSites) {
        const float d = glm::distance(p, site.centre);
        h = glm::mix(kCampHeight_m + 1.5F, h, smoothstep(site.radius_m, site.radius_m + 26.0F, d));
    }
    const float bank = riverDistance(p) + 3.0F * noise(p / 9.0F, s + 60);
    const float lake = glm::distance(p, {96.0F, 138.0F}) + 10.0F * fractal(p / 26.0F, 3, s + 61) - 34.0F;
    const float wet = std::min(bank, lake);
    h = glm::mix(kWaterLevel_m - 2.2F, h, smoothstep(4.0F, 19.0F, wet));
    return h + 0.10F * wild * noise(p / 5.0F, s + 70);
}

void Terrain::treadRoad(const Loop& road, std::vector<float>& nearest_m, std::vector<float>& road_heights) const
{
    const std::span<const Loop::Place> places = road.samples();
    const std::size_t n = places.size() - 1;
    std::vector<float> along(n);
    for (std::size_t i = 0; i < n; ++i) {
        along[i] = std::max(height(places[i].position.x, places[i].position.y), kWaterLevel_m + 0.35F); // fords
    }
    constexpr std::size_t kHalfWindow = 24; // samples; evens out what feet would not put up with
    for (std::size_t i = 0; i < n; ++i) {
        float sum = 0.0F;
        for (std::size_t k = 0; k <= 2 * kHalfWindow; ++k) {
            sum += along[(i + n + k - kHalfWindow) % n];
        }
        const float even = sum / static_cast<float>(2 * kHalfWindow + 1);
        const glm::vec2 grid = (places[i].position + kMapSize_m * 0.5F) * grid_.cellsPerM();
        constexpr std::int32_t kReach = 4; // cells
        for (std::int32_t dz = -kReach; dz <= kReach; ++dz) {
            for (std::int32_t dx = -kReach; dx <= kReach; ++dx) {
                const std::int32_t ix = std::clamp(static_cast<std::int32_t>(grid.x) + dx, 0, kCells);
                const std::int32_t iz = std::clamp(static_cast<std::int32_t>(grid.y) + dz, 0, kCells);
                const std::size_t cell = grid_.index(ix, iz);
                const float d = glm::distance(grid_.point(ix, iz), places[i].position);
                if (d < nearest_m[cell]) {
                    nearest_m[cell] = d;
                    road_heights[cell] = even;
                }
            }
        }
    }
}

void Terrain::treadRoads(std::span<const Loop> roads)
{
    std::vector<float> nearest_m(grid_.heights.size(), 1e9F);
    std::vector<float> road_heights(grid_.heights.size(), 0.0F);
    for (const Loop& road : roads) {
        treadRoad(road, nearest_m, road_heights);
    }
    for (std::size_t i = 0; i < grid_.heights.size(); ++i) {
        grid_.heights[i] = glm::mix(road_heights[i], grid_.heights[i], smoothstep(3.0F, 8.0F, nearest_m[i]));
        roads_[i] = 1.0F - smoothstep(1.8F, 4.4F, nearest_m[i]);
    }
}

float Terrain::road(float x, float z) const
{
    const auto nearest = [&](float v) {
        const float cell = grid_.toCells(v) + 0.5F;
        return static_cast<std::int32_t>(cell); // towards 0: the border's half cell is in the grid
    };
    return roads_[grid_.index(nearest(x), nearest(z))];
}

float Terrain::slope(float x, float z) const
{
    const float dx = height(x + 1.0F, z) - height(x - 1.0F, z);
    const float dz = height(x, z + 1.0F) - height(x, z - 1.0F);
    return 0.5F * std::sqrt(dx * dx + dz * dz);
}

glm::vec4 Terrain::colour(std::int32_t ix, std::int32_t iz) const
{
    const glm::vec2 p = grid_.point(ix, iz);
    const std::uint32_t s = noise_seed_ + 200;
    const float h = grid_.at(ix, iz);
    const glm::vec3 n = grid_.normal(ix, iz);
    const float steep = std::sqrt(1.0F - n.y * n.y) / n.y;
    const float broad = fractal(p / 38.0F, 4, s);
    const float fine = noise(p / 5.5F, s + 7);
    glm::vec4 c = glm::mix(rgb(0x6E8F3C), rgb(0xA3A856), smoothstep(-0.25F, 0.45F, broad + 0.12F * fine));
    c = glm::mix(c, rgb(0x4F7A38), 0.7F * smoothstep(0.05F, 0.5F, fractal(p / 24.0F, 3, s + 11)));
    c = glm::mix(c, rgb(0xC2B573), 0.6F * smoothstep(24.0F, 36.0F, h + 3.0F * fine));
    const float camp = 1.0F - smoothstep(34.0F, 54.0F, glm::length(p) + 9.0F * broad + 4.0F * fine);
    float bare = 0.85F * camp;
    for (const Site& site : kSites) {
        const float d = glm::distance(p, site.centre) + 7.0F * broad + 4.0F * fine;
        bare = std::max(bare, 0.75F * (1.0F - smoothstep(site.radius_m * 0.4F, site.radius_m * 0.95F, d)));
    }
    c = glm::mix(c, glm::mix(rgb(0xA88A5C), rgb(0x8F7650), 0.5F + 0.5F * fine), bare);
    c = glm::mix(c, rgb(0xC9A876), 0.92F * roads_[grid_.index(ix, iz)] * (0.9F + 0.1F * fine));
    const float rock = smoothstep(0.50F, 0.85F, steep + 0.12F * fine);
    const float stratum = 0.5F + 0.5F * std::sin(h * 1.9F + 1.5F * broad);
    c = glm::mix(c, glm::mix(rgb(0x8A7B6C), rgb(0xB39B7E), stratum), rock);
    const float shore = 1.0F - smoothstep(0.2F, 1.8F, h - kWaterLevel_m + 0.5F * fine);
    c = glm::mix(c, rgb(0xD3C08F), shore * (1.0F - rock));
    return glm::mix(c, rgb(0x5D6650), 1.0F - smoothstep(-1.6F, -0.1F, h - kWaterLevel_m));
}

Primitive Terrain::water(std::int32_t cx, std::int32_t cz) const
{
    Primitive primitive;
    for (std::int32_t j = 0; j < kChunkCells; ++j) {
        for (std::int32_t i = 0; i < kChunkCells; ++i) {
            const std::int32_t ix = cx * kChunkCells + i;
            const std::int32_t iz = cz * kChunkCells + j;
            const float lowest = std::min(std::min(grid_.at(ix, iz), grid_.at(ix + 1, iz)),
                                          std::min(grid_.at(ix, iz + 1), grid_.at(ix + 1, iz + 1)));
            if (lowest >= kWaterLevel_m) {
                continue;
            }
            const auto first = static_cast<std::uint32_t>(primitive.positions.size());
            for (const auto& [dx, dz] : {std::pair{0, 0}, std::pair{0, 1}, std::pair{1, 1}, std::pair{1, 0}}) {
                const glm::vec2 p = grid_.point(ix + dx, iz + dz);
                primitive.positions.emplace_back(p.x, kWaterLevel_m, p.y);
                primitive.normals.emplace_back(0.0F, 1.0F, 0.0F);
                primitive.uv0.emplace_back(p / 12.0F);
                const float deep = smoothstep(0.1F, 1.9F, kWaterLevel_m - grid_.at(ix + dx, iz + dz));
                primitive.colours.push_back(glm::mix(rgb(0x6FA39A), rgb(0x1F5666), deep));
            }
            for (const std::uint32_t corner : {0U, 1U, 2U, 0U, 2U, 3U}) {
                primitive.indices.push_back(first + corner);
            }
        }
    }
    return primitive;
}

Primitive Terrain::border() const
{
    constexpr float kFloor = -14.0F;
    Part part;
    part.uv_per_metre = 0.2F;
    const auto strip = [&](glm::vec2 a, glm::vec2 b) {
        const float ha = height(a.x, a.y);
        const float hb = height(b.x, b.y);
        const float ma = glm::mix(kFloor, ha, 0.72F);
        const float mb = glm::mix(kFloor, hb, 0.72F);
        part.colour = rgb(0x7A6248);
        part.quad({a.x, ma, a.y}, {b.x, mb, b.y}, {b.x, hb, b.y}, {a.x, ha, a.y});
        part.colour = rgb(0x5E5045);
        part.quad({a.x, kFloor, a.y}, {b.x, kFloor, b.y}, {b.x, mb, b.y}, {a.x, ma, a.y});
    };
    constexpr float kHalf = kMapSize_m * 0.5F;
    for (std::int32_t i = 0; i < kCells; ++i) {
        const float from = grid_.point(i, 0).x;
        const float to = grid_.point(i + 1, 0).x;
        strip({from, kHalf}, {to, kHalf});
        strip({to, -kHalf}, {from, -kHalf});
        strip({kHalf, to}, {kHalf, from});
        strip({-kHalf, from}, {-kHalf, to});
    }
    return part.take(kNone);
}

void Terrain::addTo(Scene& scene, std::uint32_t ground_material, std::uint32_t water_material) const
{
    const auto add = [&](const std::string& name, Primitive primitive, std::uint32_t material) {
        primitive.material = material;
        Mesh mesh;
        mesh.name = name;
        mesh.primitives.push_back(std::move(primitive));
        return addNode(scene, name, addMesh(scene, std::move(mesh)), {});
    };
    constexpr std::int32_t kChunks = kCells / kChunkCells;
    constexpr float kImage_m = 5.0F;
    const auto colour_at = [&](std::int32_t ix, std::int32_t iz) {
        return colour(ix, iz);
    };
    for (std::int32_t cz = 0; cz < kChunks; ++cz) {
        for (std::int32_t cx = 0; cx < kChunks; ++cx) {
            const std::string place = std::to_string(cx) + "," + std::to_string(cz);
            Primitive primitive = grid_.chunk(cx, cz, kImage_m, colour_at);
            const float steepest = steepestOf(primitive, grid_.cellsPerM());
            const std::uint32_t node = add("terrain/" + place, std::move(primitive), ground_material);
            scene.nodes[node].casts = steepest > kFlatChunkSlope;
            Primitive wet = water(cx, cz);
            if (!wet.indices.empty()) {
                scene.nodes[add("water/" + place, std::move(wet), water_material)].casts = false;
            }
        }
    }
    add("border", border(), ground_material);
}

} // namespace gnomon::worlds
