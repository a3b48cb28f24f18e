// SPDX-License-Identifier: Apache-2.0
#include "palette.h"

#include "../scene_maker.h"
#include "../textures.h"

#include <future>

namespace gnomon::worlds {
namespace {

/// Makes an image on another thread, or on the calling one where no thread can be had.
std::future<Image> begun(Image (*make)())
{
    return std::async(std::launch::async | std::launch::deferred, make);
}

} // namespace

Palette addPalette(Scene& scene)
{
    const auto surface = [&](const char* name, std::uint32_t texture, float roughness) {
        return addMaterial(scene, name, {.roughness = roughness, .texture = texture});
    };
    const auto foliage = [&](const char* name, Image image, bool double_sided) {
        return addMaterial(scene, name,
                           {.roughness = 0.85F,
                            .texture = addTexture(scene, std::move(image), Wrap::clamp_to_edge),
                            .alpha_mode = AlphaMode::mask,
                            .double_sided = double_sided});
    };
    // Nothing of one image is in another. These four take most of the time.
    std::future<Image> ground = begun(groundDetail);
    std::future<Image> stone = begun(stoneBlocks);
    std::future<Image> shingle = begun(shingles);
    std::future<Image> thatch = begun(straw);
    Palette palette;
    const std::uint32_t detail = addTexture(scene, ground.get());
    palette.ground = surface("ground", detail, 0.95F);
    palette.water = addMaterial(scene, "water", {.roughness = 0.16F});
    palette.stone = surface("stone", addTexture(scene, stone.get()), 0.9F);
    palette.wood = surface("wood", addTexture(scene, planks()), 0.85F);
    palette.shingle = surface("shingle", addTexture(scene, shingle.get()), 0.8F);
    palette.thatch = surface("thatch", addTexture(scene, thatch.get()), 0.95F);
    palette.plain = addMaterial(scene, "plain", {.roughness = 0.75F, .lit_by_night = 1.0F});
    palette.cloth = addMaterial(scene, "cloth", {.roughness = 0.9F, .double_sided = true});
    palette.rock = surface("rock", detail, 0.9F);
    palette.fire =
        addMaterial(scene, "fire", {.base_colour = {1.0F, 0.5F, 0.12F, 1.0F}, .emissive = {5.0F, 1.6F, 0.25F}});
    palette.crystal = addMaterial(scene, "crystal", {.roughness = 0.22F, .emissive = {0.02F, 0.16F, 0.20F}});
    palette.leaves = foliage("leaves", leafCluster(), true);
    palette.needles = foliage("needles", needleBranch(), true);
    palette.grass = foliage("grass", grassTuft(), false);
    return palette;
}

} // namespace gnomon::worlds
