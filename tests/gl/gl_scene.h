// SPDX-License-Identifier: Apache-2.0
// The scene of boxes (tests/vulkan/scene.h) drawn by OpenGL, and what its camera sees as textures.
#pragma once

#include "egl_context.h"
#include "scene.h"

#include <gnomon/gl/shadow_renderer.h>

#include <cstddef>
#include <vector>

namespace gnomon::test {

class GlScene {
public:
    explicit GlScene(Scene scene);

    /// Depth and normals, from the same numbers that the Vulkan side has.
    [[nodiscard]] gl::MaskInputs upload(const Picture& picture);
    [[nodiscard]] gl::DrawCasters callback();
    /// All layers of the mask, one after the other.
    [[nodiscard]] static std::vector<std::byte> read(const gl::TextureRef& mask, std::uint32_t layers);
    Scene scene;

private:
    void draw(const gl::MapPass& pass);

    GLuint programs_[3] = {}; // the rasteriser's depth; the metric as depth; as colour
    GLuint vertices_ = 0;
    GLuint depth_ = 0;
    GLuint normal_ = 0;
};

} // namespace gnomon::test
