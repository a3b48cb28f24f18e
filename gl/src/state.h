// SPDX-License-Identifier: Apache-2.0
// The state of the host's that a call changes, restored where this goes out of scope.
#pragma once

#include "context.h"

#include <array>

namespace gnomon::gl {

/// Switches that drawing needs off, except GL_MULTISAMPLE.
inline constexpr std::array<GLenum, 21> kSwitches{
    GL_DEPTH_TEST,      GL_CULL_FACE,          GL_STENCIL_TEST,    GL_DEPTH_CLAMP,     GL_POLYGON_OFFSET_FILL,
    GL_COLOR_LOGIC_OP,  GL_RASTERIZER_DISCARD, GL_SAMPLE_MASK,     GL_SAMPLE_COVERAGE, GL_SAMPLE_ALPHA_TO_COVERAGE,
    GL_MULTISAMPLE,     GL_SAMPLE_SHADING,     GL_DITHER,          GL_CLIP_DISTANCE0,  GL_CLIP_DISTANCE1,
    GL_CLIP_DISTANCE2,  GL_CLIP_DISTANCE3,     GL_CLIP_DISTANCE4,  GL_CLIP_DISTANCE5,  GL_CLIP_DISTANCE6,
    GL_CLIP_DISTANCE7};

class KeptState {
public:
    /// Notes it, and sets what all passes here want: every switch off except GL_MULTISAMPLE, scissor on, no blending,
    /// all written, clip space with y = -1 in row 0 and z of [0, w].
    explicit KeptState(const Context& context);
    ~KeptState();
    KeptState(const KeptState&) = delete;
    KeptState& operator=(const KeptState&) = delete;

private:
    [[nodiscard]] GLint number(GLenum name) const;

    const Context& context_;
    std::array<GLboolean, kSwitches.size()> switches_{};
    GLboolean blends_;
    GLboolean scissors_;
    std::array<GLint, 2> framebuffers_;
    GLint program_;
    GLint vertices_;
    std::array<GLfloat, 4> viewport_{};
    std::array<GLint, 4> scissor_{};
    std::array<GLint, 2> clip_;
    std::array<GLdouble, 2> depth_range_{};
    GLint depth_function_;
    GLint depth_mask_;
    GLint polygon_mode_;
    std::array<GLboolean, 4> colour_mask_{};
    std::array<GLint, 6> blend_{}; // equations and functions of draw buffer 0
};

/// Viewport and scissor over this part.
void setViewport(const Context& context, const Tile& tile);
void setScissor(const Context& context, const Tile& area);
/// On or off.
void setSwitch(const Context& context, GLenum name, bool on);

} // namespace gnomon::gl
