// SPDX-License-Identifier: Apache-2.0
// Where an alpha-masked surface is solid, and how much light a blended one lets through.
#pragma once

#include "scene/model.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>

namespace gnomon::truth {

/// The alpha of one primitive with one masked or blended material. The constructor's arguments must outlive it.
class AlphaTest {
public:
    AlphaTest(const scene::Scene& scene, const scene::Primitive& primitive, const scene::Material& material);

    /// Is the surface solid at the point of triangle `triangle` with weights 1 - u - v, u and v for its three vertices?
    [[nodiscard]] bool isSolid(std::uint32_t triangle, float u, float v) const;
    /// The share of red, green and blue light that passes a blended surface at that point, [0, 1]: 1 - alpha, or with
    /// stained glass 1 - alpha (1 - colour).
    [[nodiscard]] glm::vec3 transmittance(std::uint32_t triangle, float u, float v) const;

private:
    [[nodiscard]] glm::vec2 placeAt(const std::uint32_t* corners, float u, float v) const;

    const scene::Primitive& primitive_;
    const std::vector<glm::vec2>* uvs_ = nullptr; // null: all (0, 0)
    const scene::Image* image_ = nullptr;         // null: alpha 1
    scene::Texture sampler_;
    glm::vec2 u_axis_{1.0F, 0.0F}; // texture u = dot(u_axis, uv) + offset.x
    glm::vec2 v_axis_{0.0F, 1.0F};
    glm::vec2 offset_{0.0F};
    glm::vec4 factor_{1.0F};
    float limit_ = 0.5F;
    bool stained_ = false;
};

/// Alpha of the finest level at `uv`, [0, 1], as GPUs sample: `magnify_linear` blends the four nearest texels. Texel
/// (0, 0) covers uv [0, 1 / size); anything not finite reads 1.
[[nodiscard]] float sampleAlpha(const scene::Image& image, const scene::Texture& sampler, const glm::vec2& uv);

} // namespace gnomon::truth
