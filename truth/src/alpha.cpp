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

/// A sample of the values that `read` makes of texels' four bytes; `otherwise`, times 255, where nothing can be read.
template <class Value, class Read>
Value sample(const scene::Image& image, const scene::Texture& sampler, const glm::vec2& uv, Value otherwise,
             Read&& read)
{
    if (!std::isfinite(uv.x) || !std::isfinite(uv.y) || image.width == 0 || image.height == 0) {
        return otherwise * 255.0F;
    }
    const int width = static_cast<int>(image.width);
    const int height = static_cast<int>(image.height);
    const float x = reduce(uv.x, sampler.wrap_u) * static_cast<float>(width);
    const float y = reduce(uv.y, sampler.wrap_v) * static_cast<float>(height);
    const auto texel = [&](int i, int j) {
        const std::size_t column = wrapTexel(i, width, sampler.wrap_u);
        const std::size_t row = wrapTexel(j, height, sampler.wrap_v);
        return read(image.rgba.data() + (row * image.width + column) * 4);
    };
    if (!sampler.magnify_linear) {
        return texel(static_cast<int>(x), static_cast<int>(y));
    }
    const float left = std::floor(x - 0.5F);
    const float top = std::floor(y - 0.5F);
    const float right_share = x - 0.5F - left;
    const float lower_share = y - 0.5F - top;
    const int i = static_cast<int>(left);
    const int j = static_cast<int>(top);
    const Value upper = glm::mix(texel(i, j), texel(i + 1, j), right_share);
    const Value lower = glm::mix(texel(i, j + 1), texel(i + 1, j + 1), right_share);
    return glm::mix(upper, lower, lower_share);
}

/// Alpha is compared with this. Sums of weights and texels are off by their last bits, and alpha that is equal to the
/// cutoff is solid; what rasterisers store of a vertex's colour is a number of 16 bits at best.
float limitOf(float cutoff)
{
    constexpr float kStep = 1.0F / 65536.0F;
    return cutoff - std::min(kStep, 0.5F * cutoff);
}

/// The linear value of an sRGB byte; IEC 61966-2-1, 1999.
float linearOf(std::uint8_t byte)
{
    const float c = static_cast<float>(byte) / 255.0F;
    return c <= 0.04045F ? c / 12.92F : std::pow((c + 0.055F) / 1.055F, 2.4F);
}

/// Linear colour and alpha, [0, 1], sampled like sampleAlpha().
glm::vec4 sampleColour(const scene::Image& image, const scene::Texture& sampler, const glm::vec2& uv)
{
    const auto read = [](const std::uint8_t* texel) {
        return glm::vec4(linearOf(texel[0]), linearOf(texel[1]), linearOf(texel[2]),
                         static_cast<float>(texel[3]) / 255.0F) *
               255.0F;
    };
    return sample(image, sampler, uv, glm::vec4(1.0F), read) / 255.0F;
}

} // namespace

float sampleAlpha(const scene::Image& image, const scene::Texture& sampler, const glm::vec2& uv)
{
    return sample(image, sampler, uv, 1.0F, [](const std::uint8_t* texel) { return static_cast<float>(texel[3]); }) /
           255.0F;
}

AlphaTest::AlphaTest(const scene::Scene& scene, const scene::Primitive& primitive, const scene::Material& material)
    : primitive_(primitive), factor_(material.base_colour), limit_(limitOf(material.alpha_cutoff)),
      stained_(material.stained)
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
    float alpha = factor_.a;
    if (!primitive_.colours.empty()) {
        float of_vertices = 0.0F;
        for (std::size_t k = 0; k < 3; ++k) {
            of_vertices += primitive_.colours[corners[k]].a * weights[k];
        }
        alpha *= of_vertices;
    }
    if (image_ != nullptr) {
        alpha *= sampleAlpha(*image_, sampler_, placeAt(corners, u, v));
    }
    return alpha >= limit_;
}

glm::vec2 AlphaTest::placeAt(const std::uint32_t* corners, float u, float v) const
{
    const std::array<float, 3> weights{1.0F - u - v, u, v};
    glm::vec2 uv(0.0F);
    for (std::size_t k = 0; uvs_ != nullptr && k < 3; ++k) {
        uv += (*uvs_)[corners[k]] * weights[k];
    }
    return {glm::dot(u_axis_, uv) + offset_.x, glm::dot(v_axis_, uv) + offset_.y};
}

glm::vec3 AlphaTest::transmittance(std::uint32_t triangle, float u, float v) const
{
    const std::uint32_t* corners = primitive_.indices.data() + std::size_t{triangle} * 3;
    const std::array<float, 3> weights{1.0F - u - v, u, v};
    glm::vec4 colour = factor_;
    if (!primitive_.colours.empty()) {
        glm::vec4 of_vertices(0.0F);
        for (std::size_t k = 0; k < 3; ++k) {
            of_vertices += primitive_.colours[corners[k]] * weights[k];
        }
        colour *= of_vertices;
    }
    if (image_ != nullptr) {
        colour *= sampleColour(*image_, sampler_, placeAt(corners, u, v));
    }
    colour = glm::clamp(colour, 0.0F, 1.0F);
    return stained_ ? 1.0F - colour.a * (1.0F - glm::vec3(colour)) : glm::vec3(1.0F - colour.a);
}

} // namespace gnomon::truth
