// SPDX-License-Identifier: Apache-2.0
#include "../mesh_maker.h"
#include "../rng.h"
#include "furniture.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <vector>

namespace gnomon::worlds {

namespace {

/// A leaf in two cards: it rises from `foot` towards `out` and hangs down at its tip.
void frond(Part& leaves, const glm::vec3& foot, const glm::vec3& out, float length, float rise)
{
    const glm::vec3 side(out.z * 0.34F * length, 0, -out.x * 0.34F * length);
    const glm::vec3 knee = foot + out * (0.55F * length) + glm::vec3(0, rise, 0);
    const glm::vec3 tip = foot + out * length + glm::vec3(0, rise - 0.42F * length, 0);
    const glm::vec3 normal = glm::normalize(out * 0.5F + glm::vec3(0, 1, 0));
    // The image's stem is at its top: each card is one whole bough, the second smaller.
    leaves.card(tip - side, tip + side, knee + side, knee - side, normal);
    leaves.card(knee - side, knee + side, foot + side * 0.6F, foot - side * 0.6F, normal);
}

} // namespace

Mesh makePlanter(const RingPalette& palette, std::uint32_t srgb)
{
    MeshMaker maker;
    Part& gloss = maker.with(palette.gloss);
    gloss.colour = rgb(srgb);
    gloss.lathe({{0.26F, -0.05F},
                 {0.30F, 0.02F},
                 {0.42F, 0.34F},
                 {0.46F, 0.50F},
                 {0.47F, 0.56F},
                 {0.42F, 0.57F},
                 {0.40F, 0.50F}},
                20, true);
    gloss.colour = rgb(0x4A3526);
    gloss.lathe({{0.41F, 0.50F}, {0.0F, 0.53F}}, 16);
    return maker.take("planter");
}

Mesh makePalm(const RingPalette& palette, std::uint32_t variant)
{
    Rng rng(601, variant);
    MeshMaker maker;
    const float height = 1.7F + 0.5F * static_cast<float>(variant);
    Part& wood = maker.with(palette.common.wood);
    wood.colour = rgb(0x8A6A48);
    std::vector<glm::vec3> path;
    std::vector<float> radii;
    const float lean = rng.range(-0.18F, 0.18F);
    for (int i = 0; i <= 8; ++i) {
        const float s = static_cast<float>(i) / 8.0F;
        path.emplace_back(lean * s * s, 0.4F + height * s, 0.5F * lean * s);
        radii.push_back(0.075F - 0.03F * s + ((i & 1) != 0 ? 0.012F : 0.0F));
    }
    wood.tube(path, radii, 8);
    Part& leaves = maker.with(palette.common.needles);
    const glm::vec3 crown = path.back();
    for (int i = 0; i < 15; ++i) {
        const float a = 2.3999632F * static_cast<float>(i) + rng.range(-0.2F, 0.2F);
        const float share = static_cast<float>(i) / 14.0F;
        leaves.colour = glm::mix(rgb(0x4E8A45), rgb(0x9CC466), share * rng.range(0.7F, 1.0F));
        frond(leaves, crown - glm::vec3(0, 0.05F, 0), {std::sin(a), 0, std::cos(a)}, rng.range(0.9F, 1.25F),
              0.05F + 0.55F * share);
    }
    return maker.take("palm " + std::to_string(variant));
}

Mesh makeFern(const RingPalette& palette)
{
    Rng rng(602, 1);
    MeshMaker maker;
    Part& leaves = maker.with(palette.common.needles);
    for (int i = 0; i < 13; ++i) {
        const float a = 2.3999632F * static_cast<float>(i) + rng.range(-0.2F, 0.2F);
        const float share = static_cast<float>(i) / 12.0F;
        leaves.colour = glm::mix(rgb(0x3F7A44), rgb(0x86BF5C), share);
        frond(leaves, {0, 0.45F, 0}, {std::sin(a), 0, std::cos(a)}, rng.range(0.6F, 0.85F), 0.25F + 0.35F * share);
    }
    return maker.take("fern");
}

} // namespace gnomon::worlds
