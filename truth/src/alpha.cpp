// SPDX-License-Identifier: Apache-2.0
// Based on: Khronos Group, "KHR_texture_transform"; "Vulkan 1.3 specification", 16.7 to 16.9 (wrapping and filtering of
// texel coordinates).
#include "alpha.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::truth {
namespace {

/// Brings a coordinate near the image before it becomes an integer, which a large one would overflow.
float reduce(float x, scene::Wrap wrap)
{
    switch (wrap) {
    case scene::Wrap::repeat:
        return x - std::floor(x);
    case scene::Wrap::mirrored_repeat:
        return x - 2.0F * std::floor(x * 0.5F);
    case scene::Wrap::clamp_to_edge:
        break;
    }
    return std::clamp(x, 0.0F, 1.0F);
}

/// `i` is at most one texel outside [0, size), or [0, 2 size) where the image is mirrored.
std::uint32_t wrapTexel(int i, int size, scene::Wrap wrap)
{
    switch (wrap) {
    case scene::Wrap::repeat:
        i = (i + size) % size;
        break;
    case scene::Wrap::mirrored_repeat:
        i = (i + 2 * size) % (2 * size);
        i = i < size ? i : 2 * size - 1 - i;
        break;
    case scene::Wrap::clamp_to_edge:
        i = std::clamp(i, 0, size - 1);
        break;
    }
    return static_cast<std::uint32_t>(i);
}

} // namespace

float sampleAlpha(const scene::Image& image, const scene::Texture& sampler, const glm::vec2& uv)
{
    if (!std::isfinite(uv.x) || !std::isfinite(uv.y) || image.width == 0 || image.height == 0) {
        return 1.0F;
    }
    const int width = static_cast<int>(image.width);
    const int height = static_cast<int>(image.height);
    const float x = reduce(uv.x, sampler.wrap_u) * static_cast<float>(width);
    const float y = reduce(uv.y, sampler.wrap_v) * static_cast<float>(height);
    const auto texel = [&](int i, int j) {
        const std::size_t column = wrapTexel(i, width, sampler.wrap_u);
        const std::size_t row = wrapTexel(j, height, sampler.wrap_v);
        return static_cast<float>(image.rgba[(row * image.width + column) * 4 + 3]);
    };
    if (!sampler.magnify_linear) {
        return texel(static_cast<int>(x), static_cast<int>(y)) / 255.0F;
    }
    const float left = std::floor(x - 0.5F);
    const float top = std::floor(y - 0.5F);
    const float right_share = x - 0.5F - left;
    const float lower_share = y - 0.5F - top;
    const int i = static_cast<int>(left);
    const int j = static_cast<int>(top);
    const float upper = glm::mix(texel(i, j), texel(i + 1, j), right_share);
    const float lower = glm::mix(texel(i, j + 1), texel(i + 1, j + 1), right_share);
    return glm::mix(upper, lower, lower_share) / 255.0F;
}

AlphaTest::AlphaTest(const scene::Scene& scene, const scene::Primitive& primitive, const scene::Material& material)
    : primitive_(primitive), factor_(material.base_colour.a), cutoff_(material.alpha_cutoff)
{
    const scene::TextureUse& use = material.base_colour_texture;
    if (use.texture == scene::kNone || use.texture >= scene.textures.size()) {
        return;
    }
    sampler_ = scene.textures[use.texture];
    if (sampler_.image == scene::kNone || sampler_.image >= scene.images.size()) {
        return;
    }
    image_ = &scene.images[sampler_.image];
    const std::vector<glm::vec2>& uvs = use.uv_set == 1 ? primitive.uv1 : primitive.uv0;
    uvs_ = uvs.empty() ? nullptr : &uvs;
    // Scaled, then turned counter-clockwise as seen with v down, then moved.
    const float c = std::cos(use.rotation_rad);
    const float s = std::sin(use.rotation_rad);
    u_axis_ = {c * use.scale.x, s * use.scale.y};
    v_axis_ = {-s * use.scale.x, c * use.scale.y};
    offset_ = use.offset;
}

bool AlphaTest::isSolid(std::uint32_t triangle, float u, float v) const
{
    const std::uint32_t* corners = primitive_.indices.data() + std::size_t{triangle} * 3;
    const std::array<float, 3> weights{1.0F - u - v, u, v};
    float alpha = factor_;
    if (!primitive_.colours.empty()) {
        float of_vertices = 0.0F;
        for (std::size_t k = 0; k < 3; ++k) {
            of_vertices += primitive_.colours[corners[k]].a * weights[k];
        }
        alpha *= of_vertices;
    }
    if (image_ != nullptr) {
        glm::vec2 uv(0.0F);
        for (std::size_t k = 0; uvs_ != nullptr && k < 3; ++k) {
            uv += (*uvs_)[corners[k]] * weights[k];
        }
        alpha *= sampleAlpha(*image_, sampler_, {glm::dot(u_axis_, uv) + offset_.x, glm::dot(v_axis_, uv) + offset_.y});
    }
    return alpha >= cutoff_;
}

} // namespace gnomon::truth
