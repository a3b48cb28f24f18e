// SPDX-License-Identifier: Apache-2.0
// The blur of a layer of the mask, to images of its own and back.
#include "mask_pass.h"

#include <gnomon/shared/gpu_structs.h>
#include <gnomon/shared/screen_blur.h>

namespace gnomon::gl {
namespace {

// Texture units and buffers of soften.frag.
enum Unit : GLuint { kDepth = 1, kNormal, kSource };
enum Uniform : GLuint { kConstants = 0, kPoints = 4 };

// Specialisation constants of soften.frag and soften_spread.frag.
struct Constants {
    std::int32_t scale;
    std::uint32_t edge_aware;
    std::uint32_t has_normals;
    std::int32_t kernel;
    std::uint32_t in_software;
};

// Their push constants.
struct Push {
    glm::ivec4 sizes;
    glm::ivec4 how;
    glm::vec4 along;
};

bool passesTwice(const ScreenBlurOptions& blur)
{
    return blur.kernel != ScreenKernel::poisson && blur.passes == 2;
}

std::int32_t kernelNumber(const ScreenBlurOptions& blur)
{
    const bool published = blur.kernel == ScreenKernel::gaussian && blur.taps == ScreenTaps::published;
    return published ? shared::kScreenPublished : static_cast<std::int32_t>(blur.kernel);
}

} // namespace

void MaskPass::soften(const MaskInputs& inputs, const pack::SoftenDraw& draw)
{
    const Functions& gl = context_.gl;
    const auto scale = static_cast<std::uint32_t>(pixelsPerTexel(draw.blur.size));
    const glm::uvec2 full = inputs.size_px;
    const glm::uvec2 small((full.x + scale - 1) / scale, (full.y + scale - 1) / scale);
    const Constants constants{static_cast<std::int32_t>(scale), draw.blur.edges == ScreenEdges::aware ? 1U : 0U,
                              inputs.normal != 0 ? 1U : 0U, kernelNumber(draw.blur), context_.in_software ? 1U : 0U};
    gl.BindTextureUnit(kDepth, inputs.depth);
    gl.BindTextureUnit(kNormal, inputs.normal != 0 ? inputs.normal : inputs.depth);
    gl.BindSampler(kDepth, nearest_.name());
    gl.BindSampler(kNormal, nearest_.name());
    gl.BindSampler(kSource, linear_.name());
    gl.BindBufferRange(GL_UNIFORM_BUFFER, kConstants, constants_.name(), 0, sizeof(shared::GpuConstants));
    gl.BindBufferBase(GL_UNIFORM_BUFFER, kPoints, points_.name());
    const auto pass = [&](const Image& to, const Image& from, const glm::vec2& direction, bool spreads) {
        const bool of_mask = &from == &mask_;
        const bool to_mask = &to == &mask_;
        const glm::uvec2 read = of_mask ? full : small;
        const glm::uvec2 drawn = to_mask ? full : small;
        Push push{};
        push.sizes = {read.x, read.y, full.x, full.y};
        push.how = {of_mask ? 1U : scale, of_mask ? draw.layer : 0U, draw.blur.points, 0};
        push.along = {direction.x, direction.y, draw.blur.strength_px, 0.0F};
        target_.bind(&to, to_mask ? draw.layer : 0, nullptr, 0);
        setViewport(context_, {0, 0, 0, drawn.x, drawn.y});
        setScissor(context_, {0, 0, 0, drawn.x, drawn.y});
        const auto writes = [&](unsigned channel) {
            const bool chosen = !to_mask || draw.whole || (draw.channels >> channel & 1U) != 0;
            return static_cast<GLboolean>(chosen ? GL_TRUE : GL_FALSE);
        };
        gl.ColorMaski(0, writes(0), writes(1), writes(2), writes(3));
        gl.BindTextureUnit(kSource, from.name());
        gl.UseProgram(
            programs_.draw("mask.vert", spreads ? "soften_spread.frag" : "soften.frag", wordsOf(constants)));
        programs_.push(push);
        gl.DrawArrays(GL_TRIANGLES, 0, 3);
        gl.ColorMaski(0, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    };
    constexpr glm::vec2 kAcross(1.0F, 0.0F);
    constexpr glm::vec2 kDown(0.0F, 1.0F);
    const bool twice = passesTwice(draw.blur);
    pass(blurred_[0], mask_, kAcross, false);
    if (twice && draw.blur.size == ScreenSize::full) {
        pass(mask_, blurred_[0], kDown, false);
        return;
    }
    if (twice) {
        pass(blurred_[1], blurred_[0], kDown, false);
    }
    pass(mask_, twice ? blurred_[1] : blurred_[0], kAcross, true);
}

} // namespace gnomon::gl
