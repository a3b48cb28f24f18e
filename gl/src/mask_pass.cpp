// SPDX-License-Identifier: Apache-2.0
#include "mask_pass.h"

#include <gnomon/pack/page_table.h>
#include <gnomon/plan_views.h>

#include <gnomon/shared/discs.h>
#include <gnomon/shared/gpu_structs.h>

#include <algorithm>
#include <string>

namespace gnomon::gl {
namespace {

// Bindings of mask.frag and mask.vert.
enum Unit : GLuint { kMaps = 1, kDepth = 5, kNormal, kObjectId, kBlocks = 9, kSmooth, kTints };
enum Storage : GLuint { kLights = 2, kViews, kLayers, kPages = 12 };
enum Uniform : GLuint { kConstants = 0, kFewViews = 8 };

GLenum formatOf(const Context& context, GLuint texture)
{
    GLint format = 0;
    context.gl.GetTextureLevelParameteriv(texture, 0, GL_TEXTURE_INTERNAL_FORMAT, &format);
    return static_cast<GLenum>(format);
}

/// Half a step of a depth buffer.
float depthRoundingOf(GLenum format, bool reversed_z)
{
    switch (format) {
    case GL_DEPTH_COMPONENT16:
        return 0x1p-17F;
    case GL_DEPTH_COMPONENT24:
    case GL_DEPTH24_STENCIL8:
        return 0x1p-25F;
    default:
        return reversed_z ? 0.0F : 0x1p-25F;
    }
}

/// By how much a number of [-1, 1] is off at most that a texture of this format holds.
float roundingOf(GLenum format)
{
    switch (format) {
    case GL_RG32F:
        return 0.0F;
    case GL_RG16_SNORM:
        return 0x1p-16F;
    case GL_RG16F:
        return 0x1p-11F;
    default:
        return 0x1p-8F;
    }
}

pack::DrawPrecision precisionOf(const Context& context, const MaskInputs& inputs, const Camera& camera)
{
    pack::DrawPrecision precision;
    precision.depth_rounding = depthRoundingOf(formatOf(context, inputs.depth), camera.reversed_z);
    precision.sub_pixel_bits = context.sub_pixel_bits;
    precision.normal_error_rad = inputs.normal != 0 ? pack::normalError(roundingOf(formatOf(context, inputs.normal)))
                                                    : pack::normalErrorFromDepth(precision.sub_pixel_bits);
    return precision;
}

VertexArray makeVertexArray(const Context& context)
{
    GLuint name = 0;
    context.gl.CreateVertexArrays(1, &name);
    return {context, name};
}

GLenum maskFormat(const Plan& plan)
{
    return maskChannelCount(plan) == 1 ? GL_R8 : GL_RGBA8;
}

} // namespace

MaskPass::MaskPass(const Context& context, Programs& programs)
    : context_(context), programs_(programs), target_(context), nearest_(makeSampler(context, false)),
      linear_(makeSampler(context, true)), no_vertices_(makeVertexArray(context)),
      no_number_(context, {GL_R32UI, {1, 1}, 0}), no_numbers_(context, {GL_R32UI, {1, 1}, 1}),
      constants_(makeBuffer(context)), lights_(makeBuffer(context)), views_(makeBuffer(context)),
      pages_(makeBuffer(context)), points_(makeBuffer(context)),
      stride_((sizeof(shared::GpuConstants) + context.uniform_alignment - 1) / context.uniform_alignment *
              context.uniform_alignment)
{
    std::array<glm::vec4, shared::kDiscPoints / 2> points;
    for (std::size_t i = 0; i < points.size(); ++i) {
        points[i] = {shared::kPoissonPoints[2 * i], shared::kPoissonPoints[2 * i + 1]};
    }
    upload(context, points_, std::span<const glm::vec4>(points));
}

bool MaskPass::holds(const Plan& plan) const
{
    return mask_ && mask_.info().format == maskFormat(plan) && mask_.info().layers >= plan.mask_layers;
}

bool MaskPass::prepare(const Plan& plan, glm::uvec2 size_px)
{
    const bool fits = holds(plan) && mask_.info().size == size_px;
    if (!fits) {
        mask_ = Image(context_, {maskFormat(plan), size_px, std::max(plan.mask_layers, 1U)});
        blurred_ = {};
    }
    glm::uvec2 blurred(0);
    for (const ResolvedOptions& options : *plan.options) {
        if (options.technique().soften == Soften::blur) {
            const std::uint32_t scale = pixelsPerTexel(options.screen_blur().size);
            blurred = {std::max(blurred.x, (size_px.x + scale - 1) / scale),
                       std::max(blurred.y, (size_px.y + scale - 1) / scale)};
        }
    }
    for (Image& image : blurred_) {
        if (blurred.x > 0 && !image.covers(blurred, 1)) {
            image = Image(context_, {mask_.info().format, blurred, 1});
        }
    }
    return !fits;
}

void MaskPass::fill(const Plan& plan, const MaskInputs& inputs, const MapClasses& maps)
{
    const std::size_t options = plan.options->size();
    const pack::DrawPrecision precision = precisionOf(context_, inputs, plan.made_for.camera);
    pack::listMaskDraws(plan, inputs.size_px, draws_);
    pack::fillPageTable(plan, page_table_);
    map_images_.assign(options, {});
    constant_bytes_.resize(options * stride_);
    for (std::uint32_t i = 0; i < options; ++i) {
        if (maps[i]) {
            map_images_[i] = {maps[i]->maps().info().size, maps[i]->maps().info().levels};
        }
        auto& constants = *reinterpret_cast<shared::GpuConstants*>(constant_bytes_.data() + i * stride_);
        pack::fillConstants(plan, i, inputs.size_px, map_images_[i], precision, constants);
    }
    light_list_.resize(std::max(pack::maskLightCount(plan), 1U));
    pack::fillMaskLights(plan, draws_, light_list_);
    view_list_.resize(std::max<std::size_t>(plan.views.size(), shared::kFewViews));
    pack::fillViews(plan, map_images_, view_list_);
    upload(context_, constants_, std::span<const std::byte>(constant_bytes_));
    upload(context_, lights_, std::span<const shared::GpuLight>(light_list_));
    upload(context_, views_, std::span<const shared::GpuView>(view_list_));
    upload(context_, pages_, std::span<const glm::uvec2>(page_table_));
}

void MaskPass::bindInputs(const MaskInputs& inputs)
{
    const Functions& gl = context_.gl;
    const auto orDepth = [&](GLuint texture) {
        return texture != 0 ? texture : inputs.depth; // shaders name them whether they read them or not
    };
    gl.BindTextureUnit(kDepth, inputs.depth);
    gl.BindTextureUnit(kNormal, orDepth(inputs.normal));
    gl.BindTextureUnit(kSmooth, orDepth(inputs.smooth));
    gl.BindTextureUnit(kObjectId, inputs.object_id != 0 ? inputs.object_id : no_number_.name());
    for (const GLuint unit : {kDepth, kNormal, kSmooth, kObjectId, kBlocks, kTints}) {
        gl.BindSampler(unit, nearest_.name());
    }
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, kLights, lights_.name());
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, kViews, views_.name());
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, kPages, page_table_.empty() ? lights_.name() : pages_.name());
    gl.BindBufferRange(GL_UNIFORM_BUFFER, kFewViews, views_.name(), 0,
                       static_cast<GLsizeiptr>(shared::kFewViews * sizeof(shared::GpuView)));
}

void MaskPass::bindMaps(const Plan& plan, std::uint32_t options, const MapRecorder& maps)
{
    const Functions& gl = context_.gl;
    gl.BindBufferRange(GL_UNIFORM_BUFFER, kConstants, constants_.name(), static_cast<GLintptr>(options * stride_),
                       sizeof(shared::GpuConstants));
    gl.BindTextureUnit(kMaps, maps.maps().name());
    gl.BindTextureUnit(kTints, maps.maps().name());
    gl.BindSampler(kMaps, (*plan.options)[options].filterable() ? linear_.name() : nearest_.name());
    gl.BindTextureUnit(kBlocks, maps.blocks() != nullptr ? maps.blocks()->name() : no_numbers_.name());
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, kLayers, maps.depthLayers() != 0 ? maps.depthLayers() : lights_.name());
}

GLuint MaskPass::program(const Plan& plan, const MaskInputs& inputs, const pack::MaskDraw& draw)
{
    const ResolvedOptions& options = (*plan.options)[draw.options];
    pack::MaskConstants constants =
        pack::maskConstants(options, {inputs.normal != 0, inputs.object_id != 0, inputs.smooth != 0});
    const Filter filter = pack::filterModule(options);
    std::string module = "mask_" + std::string(nameOf(filter));
    // A module for one view serves two as well where its filter compares depths (mask.frag).
    const bool pairs = filter == Filter::hard || filter == Filter::pcf;
    const bool alone = draw.told_apart == pack::ToldApart::alone && context_.has_one_view && (pairs || !draw.paired) &&
                       Programs::has(module + "_one.frag");
    constants.in_software = context_.in_software ? 1 : 0;
    constants.coloured = draw.coloured ? 1 : 0;
    constants.technique.few_views = draw.few_views;
    constants.slices_alone = draw.told_apart == pack::ToldApart::slices ? 1 : 0;
    constants.paired = alone && draw.paired ? 1 : 0;
    constants.orthographic = !alone && draw.orthographic ? 1 : 0;
    module += alone ? "_one.frag" : ".frag";
    return programs_.draw(alone ? "mask_numbers_one.vert" : "mask_numbers.vert", module, wordsOf(constants));
}

void MaskPass::drawPart(const Plan& plan, const MaskInputs& inputs, const pack::MaskDraw& draw)
{
    const pack::ScreenBounds& pixels = draw.pixels;
    setScissor(context_, {0, pixels.x0, pixels.y0, pixels.x1 - pixels.x0, pixels.y1 - pixels.y0});
    context_.gl.UseProgram(program(plan, inputs, draw));
    programs_.push(std::array<std::uint32_t, 4>{draw.first_light, draw.channels, 0, 0});
    if (draw.shares) { // a draw writes 1 to channels that are not its own
        context_.gl.Enablei(GL_BLEND, 0);
    } else {
        context_.gl.Disablei(GL_BLEND, 0);
    }
    context_.gl.DrawArrays(GL_TRIANGLES, 0, 3);
}

void MaskPass::draw(const Plan& plan, const MaskInputs& inputs, const MapClasses& maps)
{
    const Functions& gl = context_.gl;
    fill(plan, inputs, maps);
    bindInputs(inputs);
    gl.BindVertexArray(no_vertices_.name());
    gl.BlendEquationSeparatei(0, GL_MIN, GL_MIN);
    const Tile whole{0, 0, 0, inputs.size_px.x, inputs.size_px.y};
    setViewport(context_, whole);
    for (std::uint32_t layer = 0; layer < mask_.info().layers; ++layer) {
        target_.bind(&mask_, layer, nullptr, 0);
        setScissor(context_, whole);
        target_.clearColour(1.0F); // undrawn pixels are lit
        for (const pack::MaskDraw& draw : draws_) {
            if (draw.layer == layer) {
                bindMaps(plan, draw.options, *maps[draw.options]);
                drawPart(plan, inputs, draw);
            }
        }
    }
    gl.Disablei(GL_BLEND, 0);
    pack::listSoftenDraws(plan, soften_draws_);
    for (const pack::SoftenDraw& draw : soften_draws_) {
        soften(inputs, draw);
    }
}

} // namespace gnomon::gl
