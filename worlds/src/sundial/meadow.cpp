// SPDX-License-Identifier: Apache-2.0
#include "meadow.h"

#include "../mesh_maker.h"
#include "../rng.h"
#include "../scene_maker.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace gnomon::worlds {

namespace {

constexpr float kPathHalfWidth_m = 0.75F;

} // namespace

glm::vec2 fromHouse(glm::vec2 own)
{
    const float c = std::cos(kHouseYaw_rad);
    const float s = std::sin(kHouseYaw_rad);
    return kHouseAt + glm::vec2(c * own.x + s * own.y, -s * own.x + c * own.y);
}

Loop makePath()
{
    constexpr std::array<glm::vec2, 18> kCorners{{{-15.5F, -7.5F},
                                                  {-9.0F, -6.6F},
                                                  {-2.5F, -6.6F},
                                                  {3.4F, -5.8F},
                                                  {6.5F, -1.4F},
                                                  {5.8F, 4.0F},
                                                  {2.4F, 9.5F},
                                                  {0.5F, 18.0F},
                                                  {1.5F, 28.0F},
                                                  {4.5F, 40.0F},
                                                  {4.0F, 53.0F},
                                                  {-4.0F, 60.5F},
                                                  {-18.0F, 57.0F},
                                                  {-33.0F, 45.0F},
                                                  {-43.0F, 28.0F},
                                                  {-44.0F, 12.0F},
                                                  {-36.0F, 1.0F},
                                                  {-24.0F, -4.0F}}};
    return Loop(kCorners);
}

Meadow::Meadow(std::uint64_t seed, const Loop& path)
    : noise_seed_(Rng(seed, 700).next()), grid_(kCells, kMeadowSize_m), path_m_(grid_.heights.size(), 1e3F)
{
    for (std::int32_t iz = 0; iz <= kCells; ++iz) {
        for (std::int32_t ix = 0; ix <= kCells; ++ix) {
            const std::size_t cell = grid_.index(ix, iz);
            const glm::vec2 p = grid_.point(ix, iz);
            for (const Loop::Place& place : path.samples()) {
                path_m_[cell] = std::min(path_m_[cell], glm::distance(place.position, p));
            }
            // Feet have worn it down.
            grid_.heights[cell] = naturalHeight(p) - 0.07F * (1.0F - smoothstep(0.4F, 1.8F, path_m_[cell]));
        }
    }
}

float Meadow::naturalHeight(glm::vec2 p) const
{
    const std::uint32_t s = noise_seed_;
    const auto rolling = [&](glm::vec2 q) {
        const float r = glm::length(q);
        return (3.4F * fractal(q / 58.0F, 2, s) + 0.9F * noise(q / 19.0F, s + 5)) * smoothstep(7.0F, 34.0F, r) +
               0.00045F * r * r; // a bowl, so that the far ground is seen
    };
    float h = rolling(p);
    const float beyond = std::max(glm::length(p), 0.94F * std::max(std::abs(p.x), std::abs(p.y)) + 4.0F);
    h += (6.5F + 3.5F * noise(p / 30.0F, s + 9)) *
         smoothstep(kOpenRadius_m - 2.0F, 104.0F, beyond + 5.0F * noise(p / 24.0F, s + 11));
    h = glm::mix(rolling(kHouseAt), h,
                 smoothstep(kGardenRadius_m - 3.0F, kGardenRadius_m + 9.0F, glm::distance(p, kHouseAt)));
    return glm::mix(0.0F, h, smoothstep(kCourtRadius_m + 0.5F, kCourtRadius_m + 6.0F, glm::length(p)));
}

glm::vec3 Meadow::normal(glm::vec2 xz) const
{
    const float dx = height(xz.x + 1.0F, xz.y) - height(xz.x - 1.0F, xz.y);
    const float dz = height(xz.x, xz.y + 1.0F) - height(xz.x, xz.y - 1.0F);
    return glm::normalize(glm::vec3(-0.5F * dx, 1.0F, -0.5F * dz));
}

float Meadow::pathDistance(glm::vec2 xz) const
{
    const auto nearest = [&](float v) {
        const float cell = (v + kMeadowSize_m * 0.5F) * grid_.cellsPerM() + 0.5F;
        return std::clamp(static_cast<std::int32_t>(cell), 0, kCells);
    };
    return path_m_[grid_.index(nearest(xz.x), nearest(xz.y))];
}

glm::vec4 Meadow::colour(std::int32_t ix, std::int32_t iz) const
{
    const glm::vec2 p = grid_.point(ix, iz);
    const std::uint32_t s = noise_seed_ + 200;
    const float broad = fractal(p / 34.0F, 3, s);
    const float fine = noise(p / 4.0F, s + 7);
    glm::vec4 c = glm::mix(rgb(0x6E8446), rgb(0x97995A), smoothstep(-0.35F, 0.45F, broad + 0.18F * fine));
    c = glm::mix(c, rgb(0x566E3E), 0.65F * smoothstep(0.0F, 0.5F, fractal(p / 21.0F, 3, s + 11)));
    c = glm::mix(c, rgb(0xB2A66C), 0.55F * smoothstep(0.1F, 0.55F, fractal(p / 15.0F, 2, s + 21)));
    c = glm::mix(c, rgb(0x4B633A), 0.6F * smoothstep(kOpenRadius_m - 8.0F, kOpenRadius_m + 12.0F, glm::length(p)));
    const float d = path_m_[grid_.index(ix, iz)] + 0.25F * fine;
    const float court = glm::length(p) + 0.4F * fine;
    const float bare = std::max(1.0F - smoothstep(kPathHalfWidth_m, kPathHalfWidth_m + 0.9F, d),
                                0.9F * (1.0F - smoothstep(kCourtRadius_m - 0.6F, kCourtRadius_m + 0.7F, court)));
    return glm::mix(c, glm::mix(rgb(0xB79B70), rgb(0xA0845C), 0.5F + 0.5F * fine), bare);
}

void Meadow::addTo(Scene& scene, std::uint32_t material) const
{
    constexpr std::int32_t kChunks = kCells / HeightGrid::kChunkCells;
    constexpr float kImage_m = 4.0F;
    const auto colour_at = [&](std::int32_t ix, std::int32_t iz) {
        return colour(ix, iz);
    };
    for (std::int32_t cz = 0; cz < kChunks; ++cz) {
        for (std::int32_t cx = 0; cx < kChunks; ++cx) {
            Mesh mesh;
            mesh.name = "ground/" + std::to_string(cx) + "," + std::to_string(cz);
            mesh.primitives.push_back(grid_.chunk(cx, cz, kImage_m, colour_at));
            mesh.primitives.back().material = material;
            const std::string name = mesh.name;
            addNode(scene, name, addMesh(scene, std::move(mesh)), {});
        }
    }
}

} // namespace gnomon::worlds
