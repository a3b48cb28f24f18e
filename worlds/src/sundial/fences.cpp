// SPDX-License-Identifier: Apache-2.0
#include "things.h"

#include "../mesh_maker.h"
#include "../rng.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <vector>

namespace gnomon::worlds {

namespace {

/// Points at even distances, at most `spacing_m`, along each stretch, corners included.
std::vector<glm::vec2> postsAlong(std::span<const glm::vec2> corners, float spacing_m)
{
    std::vector<glm::vec2> posts;
    for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
        const auto pieces = static_cast<int>(std::ceil(glm::distance(corners[i], corners[i + 1]) / spacing_m));
        for (int k = 0; k < pieces; ++k) {
            posts.push_back(glm::mix(corners[i], corners[i + 1], static_cast<float>(k) / static_cast<float>(pieces)));
        }
    }
    posts.push_back(corners.back());
    return posts;
}

/// An upright board that faces across `along`, from y = low to high over `ground`, pointed at the top.
void addPicket(Part& wood, const glm::vec3& ground, glm::vec2 along, float low, float high)
{
    constexpr float kHalfWidth = 0.045F;
    constexpr float kHalfThickness = 0.012F;
    wood.frame = at(ground) * turnedY(std::atan2(-along.y, along.x)); // +x turns to `along`
    wood.box({-kHalfWidth, low, -kHalfThickness}, {kHalfWidth, high, kHalfThickness});
    const float tip = high + 0.06F;
    wood.triangle({-kHalfWidth, high, kHalfThickness}, {kHalfWidth, high, kHalfThickness}, {0, tip, kHalfThickness});
    wood.triangle({kHalfWidth, high, -kHalfThickness}, {-kHalfWidth, high, -kHalfThickness}, {0, tip, -kHalfThickness});
    wood.quad({kHalfWidth, high, kHalfThickness}, {kHalfWidth, high, -kHalfThickness}, {0, tip, -kHalfThickness},
              {0, tip, kHalfThickness});
    wood.quad({-kHalfWidth, high, -kHalfThickness}, {-kHalfWidth, high, kHalfThickness}, {0, tip, kHalfThickness},
              {0, tip, -kHalfThickness});
    wood.frame = glm::mat4(1.0F);
}

} // namespace

Mesh makePickets(const SundialPalette& palette, const Meadow& meadow, std::span<const glm::vec2> corners)
{
    constexpr float kGap_m = 0.17F; // between the middles of boards
    constexpr float kBehind_m = 0.04F;
    MeshMaker maker;
    Part& wood = maker.with(palette.common.wood);
    wood.uv_per_metre = 0.9F;
    Rng rng(93, corners.size());
    const std::vector<glm::vec2> posts = postsAlong(corners, 2.2F);
    const glm::vec3 up(0, 1, 0);
    for (std::size_t i = 0; i < posts.size(); ++i) {
        wood.colour = rgb(0xE4DFD2);
        const glm::vec3 foot = meadow.ground(posts[i]);
        wood.beam(foot - up * 0.4F, foot + up * 1.12F, 0.10F);
        if (i + 1 == posts.size()) {
            break;
        }
        const glm::vec2 along = glm::normalize(posts[i + 1] - posts[i]);
        const glm::vec3 next = meadow.ground(posts[i + 1]);
        for (const float height : {0.28F, 0.78F}) {
            wood.beam(foot + up * height, next + up * height, 0.05F, false);
        }
        const float length = glm::distance(posts[i], posts[i + 1]);
        const auto boards = static_cast<int>(length / kGap_m);
        const glm::vec2 outward(-along.y, along.x);
        for (int k = 1; k < boards; ++k) {
            const float t = static_cast<float>(k) / static_cast<float>(boards);
            const glm::vec2 xz = glm::mix(posts[i], posts[i + 1], t) + outward * kBehind_m;
            const float tone = rng.range(0.90F, 1.04F);
            wood.colour = rgb(0xE9E4D8) * glm::vec4(tone, tone, tone, 1.0F);
            addPicket(wood, {xz.x, glm::mix(foot.y, next.y, t), xz.y}, along, 0.07F, 0.92F);
        }
    }
    return maker.take("pickets");
}

Mesh makeRails(const SundialPalette& palette, const Meadow& meadow, std::span<const glm::vec2> corners)
{
    MeshMaker maker;
    Part& wood = maker.with(palette.common.wood);
    wood.uv_per_metre = 0.8F;
    Rng rng(94, corners.size());
    const std::vector<glm::vec2> posts = postsAlong(corners, 2.6F);
    const glm::vec3 up(0, 1, 0);
    for (std::size_t i = 0; i < posts.size(); ++i) {
        wood.colour = rgb(0x86705A);
        const glm::vec3 foot = meadow.ground(posts[i]);
        const glm::vec3 lean(rng.range(-0.03F, 0.03F), 1.22F, rng.range(-0.03F, 0.03F));
        wood.beam(foot - up * 0.4F, foot + lean, 0.13F);
        if (i + 1 == posts.size()) {
            break;
        }
        const glm::vec3 next = meadow.ground(posts[i + 1]);
        const glm::vec2 along = glm::normalize(posts[i + 1] - posts[i]);
        const glm::vec3 side = glm::vec3(-along.y, 0, along.x) * 0.075F;
        for (const float height : {0.36F, 0.70F, 1.04F}) {
            const float tone = rng.range(0.85F, 1.1F);
            wood.colour = rgb(0x9A8268) * glm::vec4(tone, tone, tone, 1.0F);
            wood.beam(foot + side + up * (height + rng.range(-0.03F, 0.03F)),
                      next + side + up * (height + rng.range(-0.03F, 0.03F)), 0.065F);
        }
    }
    return maker.take("rails");
}

} // namespace gnomon::worlds
