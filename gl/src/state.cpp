// SPDX-License-Identifier: Apache-2.0
#include "state.h"

namespace gnomon::gl {
namespace {

constexpr std::array<GLenum, 6> kBlend{GL_BLEND_EQUATION_RGB, GL_BLEND_EQUATION_ALPHA, GL_BLEND_SRC_RGB,
                                       GL_BLEND_DST_RGB,      GL_BLEND_SRC_ALPHA,      GL_BLEND_DST_ALPHA};

} // namespace

GLint KeptState::number(GLenum name) const
{
    GLint value[4] = {}; // some drivers write two of GL_POLYGON_MODE
    context_.gl.GetIntegerv(name, value);
    return value[0];
}

KeptState::KeptState(const Context& context)
    : context_(context), blends_(context.gl.IsEnabledi(GL_BLEND, 0)),
      scissors_(context.gl.IsEnabledi(GL_SCISSOR_TEST, 0)),
      framebuffers_{number(GL_DRAW_FRAMEBUFFER_BINDING), number(GL_READ_FRAMEBUFFER_BINDING)},
      program_(number(GL_CURRENT_PROGRAM)), vertices_(number(GL_VERTEX_ARRAY_BINDING)),
      clip_{number(GL_CLIP_ORIGIN), number(GL_CLIP_DEPTH_MODE)}, depth_function_(number(GL_DEPTH_FUNC)),
      depth_mask_(number(GL_DEPTH_WRITEMASK)), polygon_mode_(number(GL_POLYGON_MODE))
{
    const Functions& gl = context.gl;
    for (std::size_t i = 0; i < kSwitches.size(); ++i) {
        switches_[i] = gl.IsEnabled(kSwitches[i]);
        setSwitch(context, kSwitches[i], kSwitches[i] == GL_MULTISAMPLE);
    }
    gl.GetFloati_v(GL_VIEWPORT, 0, viewport_.data());
    gl.GetIntegeri_v(GL_SCISSOR_BOX, 0, scissor_.data());
    gl.GetDoublev(GL_DEPTH_RANGE, depth_range_.data());
    gl.GetBooleani_v(GL_COLOR_WRITEMASK, 0, colour_mask_.data());
    for (std::size_t i = 0; i < kBlend.size(); ++i) {
        gl.GetIntegeri_v(kBlend[i], 0, &blend_[i]);
    }
    gl.Disablei(GL_BLEND, 0);
    gl.Enablei(GL_SCISSOR_TEST, 0);
    gl.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    gl.DepthRange(0.0, 1.0);
    gl.DepthFunc(GL_LEQUAL);
    gl.DepthMask(GL_TRUE);
    gl.PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    gl.ColorMaski(0, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

KeptState::~KeptState()
{
    const Functions& gl = context_.gl;
    const auto word = [](GLint value) {
        return static_cast<GLenum>(value);
    };
    for (std::size_t i = 0; i < kSwitches.size(); ++i) {
        setSwitch(context_, kSwitches[i], switches_[i] == GL_TRUE);
    }
    (blends_ == GL_TRUE ? gl.Enablei : gl.Disablei)(GL_BLEND, 0);
    (scissors_ == GL_TRUE ? gl.Enablei : gl.Disablei)(GL_SCISSOR_TEST, 0);
    gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, word(framebuffers_[0]));
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, word(framebuffers_[1]));
    gl.UseProgram(word(program_));
    gl.BindVertexArray(word(vertices_));
    gl.ViewportIndexedf(0, viewport_[0], viewport_[1], viewport_[2], viewport_[3]);
    gl.ScissorIndexed(0, scissor_[0], scissor_[1], scissor_[2], scissor_[3]);
    gl.ClipControl(word(clip_[0]), word(clip_[1]));
    gl.DepthRange(depth_range_[0], depth_range_[1]);
    gl.DepthFunc(word(depth_function_));
    gl.DepthMask(depth_mask_ != 0 ? GL_TRUE : GL_FALSE);
    gl.PolygonMode(GL_FRONT_AND_BACK, word(polygon_mode_));
    gl.ColorMaski(0, colour_mask_[0], colour_mask_[1], colour_mask_[2], colour_mask_[3]);
    gl.BlendEquationSeparatei(0, word(blend_[0]), word(blend_[1]));
    gl.BlendFuncSeparatei(0, word(blend_[2]), word(blend_[3]), word(blend_[4]), word(blend_[5]));
}

void setViewport(const Context& context, const Tile& tile)
{
    context.gl.ViewportIndexedf(0, static_cast<float>(tile.x), static_cast<float>(tile.y),
                                static_cast<float>(tile.width), static_cast<float>(tile.height));
}

void setScissor(const Context& context, const Tile& area)
{
    context.gl.ScissorIndexed(0, static_cast<GLint>(area.x), static_cast<GLint>(area.y),
                              static_cast<GLsizei>(area.width), static_cast<GLsizei>(area.height));
}

void setSwitch(const Context& context, GLenum name, bool on)
{
    (on ? context.gl.Enable : context.gl.Disable)(name);
}

} // namespace gnomon::gl
