// SPDX-License-Identifier: Apache-2.0
#include "executor.h"
#include "map_storage.h"
#include "state.h"

#include <gnomon/error.h>
#include <gnomon/pack/frame_commands.h>
#include <gnomon/pack/frame_passes.h>

#include <string>

namespace gnomon::gl {
namespace {

glm::uvec2 sizeOf(const Context& context, GLuint texture)
{
    GLint size[2] = {};
    context.gl.GetTextureLevelParameteriv(texture, 0, GL_TEXTURE_WIDTH, &size[0]);
    context.gl.GetTextureLevelParameteriv(texture, 0, GL_TEXTURE_HEIGHT, &size[1]);
    return {size[0], size[1]};
}

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

pack::RecorderInputs inputsOf(const Context& context, const MaskInputs& inputs, const Camera& camera)
{
    pack::RecorderInputs made;
    made.normals = inputs.normal != 0;
    made.smooth = inputs.smooth != 0;
    made.ids = inputs.object_id != 0;
    pack::DrawPrecision& precision = made.precision;
    precision.depth_rounding = depthRoundingOf(formatOf(context, inputs.depth), camera.reversed_z);
    precision.sub_pixel_bits = context.sub_pixel_bits;
    precision.normal_error_rad = made.normals ? pack::normalError(roundingOf(formatOf(context, inputs.normal)))
                                              : pack::normalErrorFromDepth(precision.sub_pixel_bits);
    return made;
}

/// Throws Error where a filterable map's format cannot be filtered.
void requireFiltering(const Context& context, const Plan& plan)
{
    for (std::uint32_t i = 0; i < plan.options->size(); ++i) {
        const ResolvedOptions& options = (*plan.options)[i];
        if (!options.filterable() || !pack::hasLights(plan, i)) {
            continue;
        }
        GLint filters = 0;
        context.gl.GetInternalformativ(GL_TEXTURE_2D_ARRAY, mapStorage(options.format()).colour, GL_FILTER, 1, &filters);
        if (filters == GL_FALSE) {
            throw Error("make shadow maps by OpenGL",
                        "the context cannot filter maps of format " + std::string(nameOf(options.format())),
                        "choose another map format");
        }
    }
}

pack::RecorderTraits traitsOf(const Context& context)
{
    return {context.most_layers, context.uniform_alignment, context.in_software, context.has_one_view};
}

} // namespace

struct ShadowRenderer::Impl {
    explicit Impl(const ShadowRendererOptions& options)
        : context(options), executor(context), recorder(traitsOf(context))
    {
    }

    /// Carries out what was recorded; where that fails, maps are drawn again.
    void run(const Host& host)
    {
        half_done = true;
        const KeptState state(context);
        executor.run(list, host);
        half_done = false;
    }
    /// The last call threw: nobody knows what maps hold.
    void recover()
    {
        if (half_done) {
            recorder.lose();
        }
        list.clear();
    }

    Context context;
    Executor executor;
    pack::FrameRecorder recorder;
    pack::CommandList list;
    glm::uvec2 size_px{0}; // of the mask
    bool half_done = false;
};

ShadowRenderer::ShadowRenderer(const ShadowRendererOptions& options) : impl_(std::make_unique<Impl>(options)) {}

ShadowRenderer::~ShadowRenderer() = default;

bool ShadowRenderer::prepare(const Plan& plan, glm::uvec2 size_px)
{
    Impl& impl = *impl_;
    impl.recover();
    bool changed = false;
    try {
        changed = impl.recorder.prepare(plan, size_px, impl.list);
        requireFiltering(impl.context, plan);
        impl.run({plan});
    } catch (...) { // images that were recorded may not be there
        impl.executor.forget();
        impl.recorder.loseImages();
        throw;
    }
    impl.size_px = size_px;
    return changed;
}

void ShadowRenderer::drawMaps(const Plan& plan, const DrawCasters& draw)
{
    Impl& impl = *impl_;
    impl.recover();
    if (!draw) {
        throw Error("draw shadow maps", "the callback is empty", "hand in one that draws casters");
    }
    impl.recorder.drawMaps(plan, impl.list);
    impl.run({plan, nullptr, &draw});
}

void ShadowRenderer::drawMask(const Plan& plan, const MaskInputs& inputs)
{
    constexpr const char* kTried = "draw the mask";
    Impl& impl = *impl_;
    impl.recover();
    if (inputs.size_px != impl.size_px) {
        throw Error(kTried, "the last prepare() made no mask of this size for this plan", "call prepare() for it");
    }
    if (inputs.depth == 0) {
        throw Error(kTried, "the depth is 0", "hand in the texture of the camera's depth");
    }
    for (const std::uint32_t texture : {inputs.depth, inputs.normal, inputs.smooth, inputs.object_id}) {
        if (texture != 0 && sizeOf(impl.context, texture) != inputs.size_px) {
            throw Error(kTried, "an input is no texture of MaskInputs::size_px", "hand in textures of the mask's size");
        }
    }
    impl.recorder.drawMask(plan, inputsOf(impl.context, inputs, plan.made_for.camera), impl.list);
    impl.run({plan, &inputs});
}

void ShadowRenderer::reset()
{
    impl_->recorder.lose();
}

TextureRef ShadowRenderer::mask() const
{
    const bool has_mask = impl_->size_px.x > 0 && impl_->size_px.y > 0;
    return has_mask ? impl_->executor.image({pack::ImageName::mask}) : TextureRef{};
}

TextureRef ShadowRenderer::maps(std::uint32_t options) const
{
    return impl_->executor.image({pack::ImageName::maps, options});
}

MapReuse ShadowRenderer::reuse() const
{
    const pack::RecordedMaps recorded = impl_->recorder.recorded();
    return {recorded.drawn, recorded.kept_drawn, recorded.restored, recorded.held};
}

} // namespace gnomon::gl
