// SPDX-License-Identifier: Apache-2.0
#include "cascade_fitter.h"
#include "map_class.h"
#include "mask_pass.h"
#include "reuse_count.h"
#include "timed.h"

#include <gnomon/error.h>
#include <gnomon/pack/frame_passes.h>
#include <gnomon/vulkan/shadow_renderer.h>

#include <algorithm>
#include <cassert>

namespace gnomon::vulkan {
namespace {

static_assert(kPlacementStride == sizeof(shared::GpuFittedView));

ImageRef describe(const Image& image)
{
    return {image.image(),       image.view(),        image.info().format,
            image.info().extent, image.info().layers, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
            image.info().levels};
}

} // namespace

struct ShadowRenderer::Impl {
    Impl(const DeviceView& view, const ShadowRendererOptions& options_in)
        : device(view), options(options_in), fitter(device, options.frames_in_flight, options.pipeline_cache),
          mask(device, options), layered(view.layered), reuse(options.frames_in_flight)
    {
    }

    // Made by warmUp(), without images.
    struct Spare {
        ResolvedOptions options; // that it was made for; it may serve others, too
        std::unique_ptr<MapClass> maps;
    };

    [[nodiscard]] std::unique_ptr<MapClass> makeClass(const ResolvedOptions& wanted);
    [[nodiscard]] std::unique_ptr<MapClass> takeClass(const ResolvedOptions& wanted);
    void matchClasses(const Plan& plan);
    void check(const ResolvedOptions& wanted) const;

    Device device;
    ShadowRendererOptions options;
    MapClasses classes; // by options of the last plan; null where no light has named them
    std::vector<Spare> spares;
    CascadeFitter fitter;
    MaskPassRecorder mask;
    bool layered;                        // the device can
    std::vector<pack::FramePass> passes; // of the plan that was prepared last
    std::vector<MapReuse> reuse;         // by slot
    MapNotes notes;
};

ShadowRenderer::ShadowRenderer(const DeviceView& device, const ShadowRendererOptions& options)
{
    assert(options.frames_in_flight > 0);
    impl_ = std::make_unique<Impl>(device, options);
}

ShadowRenderer::~ShadowRenderer() = default;

void ShadowRenderer::Impl::check(const ResolvedOptions& wanted) const
{
    if (wanted.cascades().pass == CascadePass::layered && !layered) {
        throw Error("draw cascades in one pass", "the device was made without shaderOutputLayer",
                    "draw each in a pass of its own");
    }
}

std::unique_ptr<MapClass> ShadowRenderer::Impl::makeClass(const ResolvedOptions& wanted)
{
    check(wanted);
    return std::make_unique<MapClass>(device, wanted, options.frames_in_flight, options.pipeline_cache);
}

std::unique_ptr<MapClass> ShadowRenderer::Impl::takeClass(const ResolvedOptions& wanted)
{
    check(wanted);
    const auto found = std::ranges::find_if(spares, [&](const Spare& spare) { return spare.maps->serves(wanted); });
    if (found == spares.end()) {
        return makeClass(wanted);
    }
    std::unique_ptr<MapClass> taken = std::move(found->maps);
    spares.erase(found);
    return taken;
}

/// Options that are others than those of the last plan lose their maps, unless these are made in the same way.
void ShadowRenderer::Impl::matchClasses(const Plan& plan)
{
    for (std::uint32_t i = 0; i < classes.size(); ++i) {
        const bool goes_on = i < plan.options->size() && classes[i] && classes[i]->serves((*plan.options)[i]);
        if (classes[i] && !goes_on) {
            device.retire(std::move(classes[i]));
            notes.lose(i);
        }
    }
    classes.resize(std::max(classes.size(), plan.options->size()));
    for (const pack::FramePass& pass : passes) {
        if (pass.kind == pack::FramePassKind::maps && !classes[pass.options]) {
            classes[pass.options] = takeClass((*plan.options)[pass.options]);
        }
    }
}

void ShadowRenderer::warmUp(const ResolvedOptions& options, const WarmUp& what)
{
    // Two options may have maps of one kind and be in one plan: each gets its own.
    if (std::ranges::find(impl_->spares, options, &Impl::Spare::options) == impl_->spares.end()) {
        impl_->spares.push_back({options, impl_->makeClass(options)});
        impl_->spares.back().maps->recorder->warmUp(options);
    }
    if (options.technique().partition == Partition::sdsm) {
        impl_->fitter.warmUp();
    }
    impl_->mask.warmUp(options, what);
}

bool ShadowRenderer::prepare(const Plan& plan, VkExtent2D screen)
{
    assert(plan.options != nullptr && !plan.options->empty() && plan.pages.size() >= plan.options->size());
    pack::listFramePasses(plan, impl_->passes);
    impl_->matchClasses(plan);
    impl_->notes.reserve(plan);
    bool changed = false;
    for (const pack::FramePass& pass : impl_->passes) {
        if (pass.kind == pack::FramePassKind::maps) {
            impl_->check((*plan.options)[pass.options]);
            const MapRecorder::Prepared maps = impl_->classes[pass.options]->recorder->prepare(plan, pass.options);
            changed = changed || maps.changed;
            if (maps.lost) {
                impl_->notes.lose(pass.options);
            }
        }
    }
    impl_->fitter.prepare(plan);
    const bool wants_mask = screen.width > 0 && screen.height > 0;
    const bool mask_changed = wants_mask && impl_->mask.prepare(plan, screen);
    return changed || mask_changed;
}

void ShadowRenderer::recordBounds(VkCommandBuffer commands, std::uint32_t slot, const Frame& frame, const Plan& plan,
                                  const MaskInputs& inputs, Profiler* profiler)
{
    impl_->device.enter(slot, Retirement::Work::bounds);
    if (pack::has(impl_->passes, pack::FramePassKind::bounds)) {
        const Timed timed(profiler, commands, "shadow bounds");
        impl_->fitter.record(commands, slot, frame, plan, inputs);
    }
}

void ShadowRenderer::recordMaps(VkCommandBuffer commands, std::uint32_t slot, [[maybe_unused]] const Frame& frame,
                                const Plan& plan, const DrawCasters& draw, Profiler* profiler)
{
    impl_->device.enter(slot, Retirement::Work::maps);
    const std::span<const ViewWork> work = impl_->notes.workFor(plan);
    impl_->reuse[slot] = countReuse(plan, work);
    assert(impl_->fitter.isFitted(plan));
    const DrawCasters placed = [&](const MapPass& pass) {
        MapPass with = pass;
        if (pass.view->gpu_cascade != kNoIndex) {
            with.placement = impl_->fitter.views();
            with.placement_offset = pass.view_index * kPlacementStride;
        }
        draw(with);
    };
    for (const pack::FramePass& pass : impl_->passes) {
        if (pass.kind == pack::FramePassKind::maps) {
            impl_->classes[pass.options]->recorder->record(
                {commands, slot, plan, pass.options, work, placed, profiler});
        }
    }
    impl_->notes.done(plan);
}

void ShadowRenderer::recordMask(VkCommandBuffer commands, std::uint32_t slot, const Frame& frame, const Plan& plan,
                                const MaskInputs& inputs, Profiler* profiler)
{
    impl_->device.enter(slot, Retirement::Work::mask);
    const Timed timed(profiler, commands, "mask");
    for (const std::unique_ptr<MapClass>& maps : impl_->classes) {
        if (maps) {
            maps->recorder->makeReadable(commands);
        }
    }
    impl_->mask.record(commands, slot, frame, plan, inputs, impl_->classes, impl_->fitter);
}

void ShadowRenderer::recordViews(VkCommandBuffer commands, std::uint32_t slot, const Plan& plan, VkBuffer views,
                                 VkDeviceSize offset)
{
    if (pack::has(impl_->passes, pack::FramePassKind::bounds)) {
        impl_->fitter.recordViews(commands, slot, CascadeFitter::Reader::host,
                                  {views, offset, static_cast<std::uint32_t>(plan.views.size())});
    }
}

ImageRef ShadowRenderer::mask() const
{
    return describe(impl_->mask.mask());
}

ImageRef ShadowRenderer::maps(std::uint32_t options) const
{
    const bool made = options < impl_->classes.size() && impl_->classes[options];
    return made ? describe(impl_->classes[options]->recorder->maps()) : ImageRef{};
}

BufferRef ShadowRenderer::depthLayersBuffer(std::uint32_t options) const
{
    const bool made = options < impl_->classes.size() && impl_->classes[options];
    return made ? BufferRef{impl_->classes[options]->placer.buffer(), impl_->classes[options]->placer.bytes()}
                : BufferRef{};
}

FilterCost ShadowRenderer::filterCost(std::uint32_t slot) const
{
    FilterCost sum;
    for (const std::unique_ptr<MapClass>& maps : impl_->classes) {
        if (maps && maps->filterable()) {
            const FilterCost one = maps->recorder->cost(slot);
            sum = {sum.texels + one.texels, sum.taps + one.taps, sum.bytes_moved + one.bytes_moved,
                   sum.bytes_minimum + one.bytes_minimum, one.path};
        }
    }
    return sum;
}

MapReuse ShadowRenderer::reuse(std::uint32_t slot) const
{
    return impl_->reuse[slot];
}

std::vector<pack::DepthLayer> ShadowRenderer::depthLayers(const Plan& plan, std::uint32_t view) const
{
    const std::uint32_t options = optionsIndexOf(plan, plan.views[view]);
    const bool made = options < impl_->classes.size() && impl_->classes[options];
    return made ? impl_->classes[options]->placer.read(pack::depthLayersSlot(plan, view))
                : std::vector<pack::DepthLayer>{};
}

std::vector<FittedView> ShadowRenderer::fittedViews(std::uint32_t slot) const
{
    return impl_->fitter.read(slot);
}

std::span<const MemoryUse> ShadowRenderer::memory() const
{
    return impl_->device.account().uses();
}

} // namespace gnomon::vulkan
