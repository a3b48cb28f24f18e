// SPDX-License-Identifier: Apache-2.0
#include "depth_maps.h"
#include "mask_pass.h"
#include "moment_maps.h"
#include "supported.h"

#include <gnomon/error.h>
#include <gnomon/pack/frame_passes.h>
#include <gnomon/plan_views.h>

#include <algorithm>

namespace gnomon::gl {
namespace {

/// Can maps with the one options go on with the other? Only what they are made by counts.
bool areAlike(const ResolvedOptions& a, const ResolvedOptions& b)
{
    return a.filter() == b.filter() && a.format() == b.format() && (!a.filterable() || a.moments() == b.moments());
}

glm::uvec2 sizeOf(const Context& context, GLuint texture)
{
    GLint size[2] = {};
    context.gl.GetTextureLevelParameteriv(texture, 0, GL_TEXTURE_WIDTH, &size[0]);
    context.gl.GetTextureLevelParameteriv(texture, 0, GL_TEXTURE_HEIGHT, &size[1]);
    return {size[0], size[1]};
}

} // namespace

struct ShadowRenderer::Impl {
    explicit Impl(const ShadowRendererOptions& options) : context(options), programs(context), mask(context, programs)
    {
    }

    /// Forgets what maps hold.
    void lose()
    {
        for (std::uint32_t i = 0; i < classes.size(); ++i) {
            notes.lose(i);
        }
    }
    void matchClasses(const Plan& plan);
    void check(const char* tried, const Plan& plan) const;

    Context context;
    Programs programs;
    MaskPass mask;
    MapClasses classes;                     // by options
    std::vector<ResolvedOptions> class_for; // the options that they were made for, by options
    pack::MapNotes notes;
    std::vector<pack::FramePass> passes;
    std::uint64_t planner = 0;
    bool has_mask = false;
    bool half_done = false; // a call threw
    MapReuse reuse;
};

/// Options that are others than those of the last plan lose their maps, unless these are made in the same way.
void ShadowRenderer::Impl::matchClasses(const Plan& plan)
{
    for (std::uint32_t i = 0; i < classes.size(); ++i) {
        const bool goes_on = i < plan.options->size() && areAlike(class_for[i], (*plan.options)[i]);
        if (classes[i] && !goes_on) {
            classes[i].reset();
            notes.lose(i);
        }
    }
    classes.resize(std::max(classes.size(), plan.options->size()));
    class_for.resize(classes.size(), plan.options->front());
    std::copy(plan.options->begin(), plan.options->end(), class_for.begin());
    for (std::uint32_t i = 0; i < plan.options->size(); ++i) {
        const ResolvedOptions& options = (*plan.options)[i];
        if (!classes[i] && pack::hasLights(plan, i)) {
            if (options.filterable()) {
                classes[i] = std::make_unique<MomentMaps>(context, programs, options);
            } else {
                classes[i] = std::make_unique<DepthMaps>(context, programs, options);
            }
        }
    }
}

void ShadowRenderer::Impl::check(const char* tried, const Plan& plan) const
{
    pack::checkPlan(tried, plan);
    checkSupported(tried, plan);
    for (const View& view : plan.views) {
        const std::uint32_t options = optionsIndexOf(plan, view);
        const bool there = options < classes.size() && classes[options] &&
                           areAlike(class_for[options], (*plan.options)[options]) &&
                           classes[options]->covers(plan, view);
        if (!there) {
            throw Error(tried, "the plan needs other textures than the last prepare() made", "call prepare() for it");
        }
    }
}

ShadowRenderer::ShadowRenderer(const ShadowRendererOptions& options) : impl_(std::make_unique<Impl>(options)) {}

ShadowRenderer::~ShadowRenderer() = default;

bool ShadowRenderer::prepare(const Plan& plan, glm::uvec2 size_px)
{
    constexpr const char* kTried = "prepare for a plan";
    pack::checkPlan(kTried, plan);
    checkSupported(kTried, plan);
    Impl& impl = *impl_;
    if (impl.half_done || impl.planner != plan.planner) { // another planner may give out the same names
        impl.lose();
    }
    impl.planner = plan.planner;
    impl.half_done = true;
    impl.matchClasses(plan);
    impl.notes.reserve(plan);
    bool changed = false;
    for (std::uint32_t i = 0; i < plan.options->size(); ++i) {
        if (impl.classes[i]) {
            const MapRecorder::Prepared prepared = impl.classes[i]->prepare(plan, i);
            changed = changed || prepared.changed;
            if (prepared.lost) {
                impl.notes.lose(i);
            }
        }
    }
    impl.has_mask = size_px.x > 0 && size_px.y > 0;
    const bool mask_changed = impl.has_mask && impl.mask.prepare(plan, size_px);
    impl.half_done = false;
    return changed || mask_changed;
}

void ShadowRenderer::drawMaps(const Plan& plan, const DrawCasters& draw)
{
    constexpr const char* kTried = "draw shadow maps";
    Impl& impl = *impl_;
    impl.check(kTried, plan);
    if (!draw) {
        throw Error(kTried, "the callback is empty", "hand in one that draws casters");
    }
    if (impl.half_done) {
        impl.lose();
    }
    const KeptState state(impl.context);
    const std::span<const pack::ViewWork> work = impl.notes.workFor(plan);
    impl.half_done = true;
    for (std::uint32_t i = 0; i < plan.options->size(); ++i) {
        if (impl.classes[i]) {
            impl.classes[i]->draw({plan, i, work, draw});
        }
    }
    impl.notes.done(plan);
    impl.half_done = false;
    impl.reuse = {};
    for (std::size_t i = 0; i < work.size(); ++i) {
        const bool keeps = plan.views[i].contents.kept_layer != kNoIndex;
        impl.reuse.held += work[i].draw ? 0 : 1;
        impl.reuse.drawn += work[i].draw && !keeps ? 1 : 0;
        impl.reuse.restored += work[i].draw && keeps ? 1 : 0;
        impl.reuse.kept_drawn += work[i].draw_kept ? 1 : 0;
    }
}

void ShadowRenderer::drawMask(const Plan& plan, const MaskInputs& inputs)
{
    constexpr const char* kTried = "draw the mask";
    Impl& impl = *impl_;
    impl.check(kTried, plan);
    if (!impl.has_mask || !impl.mask.holds(plan) || impl.mask.mask().info().size != inputs.size_px) {
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
    if (plan.made_for.lights.size() != plan.lights.size()) {
        throw Error(kTried, "the frame that the plan was made for has other lights", "hand in the planner's own plan");
    }
    const KeptState state(impl.context);
    impl.mask.draw(plan, inputs, impl.classes);
}

void ShadowRenderer::reset()
{
    impl_->lose();
}

TextureRef ShadowRenderer::mask() const
{
    return impl_->has_mask ? impl_->mask.mask().ref() : TextureRef{};
}

TextureRef ShadowRenderer::maps(std::uint32_t options) const
{
    const MapClasses& classes = impl_->classes;
    return options < classes.size() && classes[options] ? classes[options]->maps().ref() : TextureRef{};
}

MapReuse ShadowRenderer::reuse() const
{
    return impl_->reuse;
}

} // namespace gnomon::gl
