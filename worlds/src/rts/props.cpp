// SPDX-License-Identifier: Apache-2.0
#include "../mesh_maker.h"
#include "../rng.h"
#include "buildings.h"

#include <array>
#include <cmath>

namespace gnomon::worlds {

Mesh makeCampfire(const Palette& palette)
{
    MeshMaker maker;
    Part& rock = maker.with(palette.rock);
    for (int i = 0; i < 7; ++i) {
        const float a = kTau * static_cast<float>(i) / 7.0F;
        rock.frame = at({0.8F * std::sin(a), 0.08F, 0.8F * std::cos(a)});
        rock.colour = rgb(0x7D766D);
        rock.ball(0.24F, 0, 0.25F, static_cast<std::uint32_t>(i));
    }
    Part& wood = maker.with(palette.wood);
    wood.colour = rgb(0x4A3322);
    for (int i = 0; i < 3; ++i) {
        const float a = kTau * static_cast<float>(i) / 3.0F;
        wood.beam({0.6F * std::sin(a), 0.05F, 0.6F * std::cos(a)}, {-0.1F * std::sin(a), 0.5F, -0.1F * std::cos(a)},
                  0.15F);
    }
    Part& fire = maker.with(palette.fire);
    fire.frame = at({0, 0.15F, 0});
    fire.lathe({{0.34F, 0.0F}, {0.24F, 0.45F}, {0.0F, 1.15F}}, 6, false, true);
    return maker.take("campfire");
}

Mesh makeCrates(const Palette& palette)
{
    MeshMaker maker;
    Part& wood = maker.with(palette.wood);
    wood.uv_per_metre = 0.9F;
    const std::array<glm::vec4, 3> places{glm::vec4(0, 0, 0, 0.1F), {1.25F, 0, 0.2F, -0.2F}, {0.55F, 1.1F, 0.1F, 0.4F}};
    for (const glm::vec4& p : places) {
        wood.frame = at(glm::vec3(p)) * turnedY(p.w);
        wood.colour = rgb(0xB08A57);
        wood.box({-0.55F, 0.0F, -0.55F}, {0.55F, 1.1F, 0.55F});
        wood.colour = rgb(0x75542F);
        for (const float y : {0.0F, 0.94F}) {
            wood.box({-0.6F, y, -0.6F}, {0.6F, y + 0.16F, 0.6F});
        }
    }
    return maker.take("crates");
}

Mesh makeBarrels(const Palette& palette)
{
    MeshMaker maker;
    Part& wood = maker.with(palette.wood);
    wood.uv_per_metre = 0.9F;
    for (const glm::vec2 p : {glm::vec2(0, 0), glm::vec2(0.95F, 0.2F), glm::vec2(0.4F, 0.9F)}) {
        wood.frame = at({p.x, 0, p.y});
        wood.colour = rgb(0x94693C);
        wood.lathe({{0.36F, 0.0F}, {0.46F, 0.5F}, {0.36F, 1.0F}, {0.32F, 0.95F}, {0.0F, 0.95F}}, 8);
    }
    return maker.take("barrels");
}

Mesh makeHay(const Palette& palette)
{
    MeshMaker maker;
    Part& straw = maker.with(palette.thatch);
    straw.uv_per_metre = 0.6F;
    straw.colour = rgb(0xD8B75F);
    straw.lathe({{1.25F, -0.3F}, {1.45F, 0.7F}, {1.0F, 1.7F}, {0.0F, 2.4F}}, 9, true);
    return maker.take("hay");
}

Mesh makeFence(const Palette& palette)
{
    MeshMaker maker;
    Part& wood = maker.with(palette.wood);
    wood.colour = rgb(0x8B6B48);
    for (const float x : {-1.5F, 0.0F, 1.5F}) {
        wood.beam({x, -0.5F, 0}, {x, 1.15F, 0}, 0.16F);
    }
    wood.beam({-1.6F, 0.45F, 0.1F}, {1.6F, 0.5F, 0.1F}, 0.11F);
    wood.beam({-1.6F, 0.95F, 0.1F}, {1.6F, 0.9F, 0.1F}, 0.11F);
    return maker.take("fence");
}

Mesh makeCart(const Palette& palette)
{
    MeshMaker maker;
    Part& wood = maker.with(palette.wood);
    wood.uv_per_metre = 0.8F;
    wood.colour = rgb(0x96703F);
    wood.box({-0.8F, 0.75F, -1.4F}, {0.8F, 0.9F, 1.4F}, 1.0F, true);
    for (const float s : {-1.0F, 1.0F}) {
        wood.box({s * 0.78F - 0.05F, 0.9F, -1.4F}, {s * 0.78F + 0.05F, 1.35F, 1.4F});
        wood.beam({s * 0.5F, 0.8F, 1.4F}, {s * 0.4F, 0.55F, 3.2F}, 0.12F);
    }
    wood.box({-0.8F, 0.9F, -1.4F}, {0.8F, 1.35F, -1.3F});
    wood.colour = rgb(0x5F432B);
    for (const float s : {-1.0F, 1.0F}) {
        wood.frame = at({s * 0.95F, 0.7F, -0.2F}) * turnedZ(-s * kPi * 0.5F);
        wood.lathe({{0.7F, -0.07F}, {0.7F, 0.07F}, {0.12F, 0.05F}, {0.0F, 0.18F}}, 10);
        wood.lathe({{0.0F, -0.07F}, {0.7F, -0.07F}}, 10);
    }
    Part& straw = maker.with(palette.thatch);
    straw.colour = rgb(0xD8B75F);
    straw.frame = at({0, 0.9F, -0.1F}) * scaled({0.62F, 0.55F, 1.1F});
    straw.ball(1.15F, 1, 0.08F, 5);
    return maker.take("cart");
}

Mesh makeWell(const Palette& palette)
{
    MeshMaker maker;
    Part& stone = maker.with(palette.stone);
    stone.uv_per_metre = 0.5F;
    stone.colour = rgb(0xA59C8D);
    stone.lathe({{1.2F, -0.5F}, {1.2F, 0.95F}, {0.85F, 0.95F}, {0.85F, 0.2F}}, 10);
    Part& wood = maker.with(palette.wood);
    wood.colour = rgb(0x6B4A2E);
    for (const float x : {-1.05F, 1.05F}) {
        wood.beam({x, 0.5F, 0}, {x, 2.5F, 0}, 0.18F);
    }
    wood.beam({-1.05F, 2.0F, 0}, {1.05F, 2.0F, 0}, 0.14F);
    Part& water = maker.with(palette.plain);
    water.colour = rgb(0x2B5560);
    water.lathe({{0.86F, 0.45F}, {0.0F, 0.45F}}, 10);
    Part& roof = maker.with(palette.shingle);
    roof.colour = rgb(0xA4523A);
    roof.uv_per_metre = 0.42F;
    roof.frame = at({0, 2.4F, 0}) * turnedY(kPi * 0.5F);
    roof.gable(2.2F, 1.0F, 2.9F);
    return maker.take("well");
}

} // namespace gnomon::worlds
