// SPDX-License-Identifier: Apache-2.0
// Foliage with coverage in alpha, and cookies. A texel no leaf covers has the leaves' mean colour, so that filtering
// draws no fringe.
#include "rng.h"
#include "textures.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <array>
#include <vector>

namespace gnomon::worlds {

namespace {

struct Leaf {
    glm::vec2 base;
    glm::vec2 along; // unit
    float length;
    float width;
    float tone;
};

/// Draws leaves back to front over `uv`; pointed at both ends, with a lighter midrib.
glm::vec4 overlay(const std::vector<Leaf>& leaves, glm::vec2 uv, const glm::vec3& ground)
{
    glm::vec4 colour(ground, 0.0F);
    for (const Leaf& leaf : leaves) {
        const glm::vec2 d = uv - leaf.base;
        if (d.x * d.x + d.y * d.y > leaf.length * leaf.length) {
            continue;
        }
        const float along = glm::dot(d, leaf.along) / leaf.length;
        if (along < 0.0F || along > 1.0F) {
            continue;
        }
        const float across = std::abs(d.x * leaf.along.y - d.y * leaf.along.x);
        const float half = leaf.width * 4.0F * along * (1.0F - along) * (1.25F - 0.5F * along);
        if (across < half) {
            const float rib = smoothstep(0.0F, 0.18F, across / std::max(half, 1e-4F));
            const float shade = leaf.tone * (0.80F + 0.20F * along) * (1.12F - 0.12F * rib);
            colour = glm::vec4(ground * 1.25F * shade, 1.0F);
        }
    }
    return colour;
}

std::vector<Leaf> clusterLeaves()
{
    std::vector<Leaf> leaves;
    Rng rng(2011, 1);
    for (int i = 0; i < 62; ++i) {
        const float a = rng.range(0.0F, kTau);
        const float r = 0.30F * std::sqrt(rng.unit()) * (1.0F - 0.25F * static_cast<float>(i) / 62.0F);
        const float turn = a + rng.range(-0.7F, 0.7F);
        leaves.push_back({{0.5F + r * std::cos(a), 0.5F + r * std::sin(a)},
                          {std::cos(turn), std::sin(turn)},
                          rng.range(0.13F, 0.20F),
                          rng.range(0.030F, 0.046F),
                          0.62F + 0.38F * static_cast<float>(i) / 62.0F * rng.range(0.8F, 1.1F)});
    }
    return leaves;
}

std::vector<Leaf> boughNeedles()
{
    std::vector<Leaf> needles;
    Rng rng(2011, 2);
    for (int twig = 0; twig < 13; ++twig) {
        const float down = 0.06F + 0.86F * static_cast<float>(twig) / 12.0F;
        for (const float side : {-1.0F, 1.0F}) {
            const float reach = (0.12F + 0.36F * down) * rng.range(0.85F, 1.0F);
            const int count = 5 + static_cast<int>(reach * 22.0F);
            for (int i = 0; i < count; ++i) {
                const float along = static_cast<float>(i) / static_cast<float>(count);
                const glm::vec2 base(0.5F + side * reach * along, down - 0.12F + 0.16F * along * along);
                const float turn = 0.5F * kPi - side * rng.range(0.25F, 0.95F);
                needles.push_back(
                    {base, {std::cos(turn), std::sin(turn)}, rng.range(0.08F, 0.14F), 0.009F, rng.range(0.65F, 1.05F)});
            }
        }
    }
    return needles;
}

float ring(float r, float radius, float half_width)
{
    return 1.0F - smoothstep(half_width - 0.006F, half_width + 0.006F, std::abs(r - radius));
}

glm::vec4 light(float v, const glm::vec3& tint = glm::vec3(1.0F))
{
    return {tint * v, 1.0F};
}

/// Cookies end in black before their border, so that what lies outside the cone is dark whatever the filter.
float vignette(float r)
{
    return 1.0F - smoothstep(0.455F, 0.495F, r);
}

} // namespace

Image leafCluster()
{
    const std::vector<Leaf> leaves = clusterLeaves();
    return paint("leaf cluster", 256,
                 [&](glm::vec2 uv) { return overlay(leaves, uv, glm::vec3(0.80F, 0.80F, 0.72F)); });
}

Image needleBranch()
{
    const std::vector<Leaf> needles = boughNeedles();
    return paint("needle branch", 256, [&](glm::vec2 uv) {
        const glm::vec4 c = overlay(needles, uv, glm::vec3(0.76F, 0.78F, 0.74F));
        const bool stem = std::abs(uv.x - 0.5F) < 0.016F * (1.1F - uv.y) && uv.y < 0.92F;
        return stem ? glm::vec4(0.50F, 0.42F, 0.34F, 1.0F) : c;
    });
}

Image grassTuft()
{
    std::vector<Leaf> blades;
    Rng rng(2011, 3);
    for (int i = 0; i < 26; ++i) {
        const float x = 0.5F + rng.range(-0.28F, 0.28F);
        const float turn = -0.5F * kPi + (x - 0.5F) * 1.9F + rng.range(-0.25F, 0.25F);
        const float length = rng.range(0.5F, 1.0F);
        // A blade is half a leaf: the base lies below the image's edge.
        blades.push_back({{x, 1.0F + length * 0.45F},
                          {std::cos(turn), std::sin(turn)},
                          length * 1.35F,
                          0.030F,
                          rng.range(0.65F, 1.05F)});
    }
    return paint("grass tuft", 128, [&](glm::vec2 uv) {
        glm::vec4 c = overlay(blades, uv, glm::vec3(0.80F, 0.80F, 0.70F));
        return glm::vec4(glm::vec3(c) * (1.05F - 0.35F * uv.y), c.w);
    });
}

Image windowCookie()
{
    return paint("window cookie", 512, [](glm::vec2 uv) {
        const glm::vec2 p = uv - 0.5F;
        // Three lights with pointed arches, crossed by bars.
        float open = 0.0F;
        for (const float centre : {-0.20F, 0.0F, 0.20F}) {
            const float half = 0.082F;
            const float top = centre == 0.0F ? -0.22F : -0.14F;
            const float x = std::abs(p.x - centre);
            float inside = 1.0F - smoothstep(half - 0.005F, half, x);
            // The pointed arch: two circles of twice the half width, centred on the opposite jambs.
            const float above = std::max(top - p.y, 0.0F);
            const float arch = std::sqrt((x + half) * (x + half) + above * above);
            inside *= 1.0F - smoothstep(2.0F * half - 0.005F, 2.0F * half, arch);
            inside *= 1.0F - smoothstep(0.335F, 0.34F, p.y);
            const float bar = std::abs(std::fmod(p.y + 1.0F, 0.115F) - 0.0575F);
            inside *= smoothstep(0.005F, 0.010F, bar) * smoothstep(0.004F, 0.008F, x);
            open = std::max(open, inside);
        }
        const float glass = 0.88F + 0.12F * noise(uv * 40.0F, 7, 40);
        return light((0.02F + 0.98F * open * glass) * vignette(glm::length(p)));
    });
}

Image foliageCookie()
{
    std::vector<Leaf> leaves;
    Rng rng(2005, 4);
    // Dense at the rim, as if one looked out of a bower.
    while (leaves.size() < 130) {
        const glm::vec2 base(rng.unit(), rng.unit());
        const float turn = rng.range(0.0F, kTau);
        if (glm::distance(base, glm::vec2(0.5F)) > 0.10F + 0.42F * rng.unit()) {
            leaves.push_back(
                {base, {std::cos(turn), std::sin(turn)}, rng.range(0.06F, 0.11F), rng.range(0.013F, 0.021F), 1.0F});
        }
    }
    return paint("foliage cookie", 384, [&](glm::vec2 uv) {
        float covered = 0.0F; // four taps, because a leaf's edge here is a light's edge
        for (const glm::vec2 tap : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(-1, 1), glm::vec2(1, 1)}) {
            covered += 0.25F * overlay(leaves, uv + tap * (0.25F / 384.0F), glm::vec3(1.0F)).w;
        }
        const float open = 1.0F - covered;
        const glm::vec3 tint = glm::mix(glm::vec3(0.55F, 0.95F, 0.35F), glm::vec3(1.0F), open);
        return light((0.10F + 0.90F * open) * vignette(glm::length(uv - 0.5F)), tint);
    });
}

Image gearCookie()
{
    return paint("gear cookie", 512, [](glm::vec2 uv) {
        const glm::vec2 p = uv - 0.5F;
        const float r = glm::length(p);
        const float turn = std::atan2(p.y, p.x) / kTau + 0.5F;
        const auto wave = [turn](float count) {
            return std::abs(turn * count - std::floor(turn * count) - 0.5F) * 2.0F;
        };
        float open = ring(r, 0.425F, 0.022F);
        const float teeth = 0.355F + 0.028F * smoothstep(0.42F, 0.58F, wave(24.0F));
        open = std::max(open, (1.0F - smoothstep(teeth - 0.006F, teeth, r)) * smoothstep(0.262F, 0.268F, r));
        const float spokes = smoothstep(0.80F, 0.86F, wave(8.0F));
        open = std::max(open, spokes * (1.0F - smoothstep(0.262F, 0.268F, r)));
        const float star = 0.085F + 0.10F * (1.0F - wave(8.0F)) * (1.0F - wave(8.0F));
        open = std::max(open, 1.0F - smoothstep(star - 0.006F, star + 0.004F, r));
        open *= smoothstep(0.030F, 0.036F, r);
        return light((0.03F + 0.97F * open) * vignette(r));
    });
}

} // namespace gnomon::worlds
