// SPDX-License-Identifier: Apache-2.0
#include "cascade_fitter.h"
#include "device.h"
#include "layer_placer.h"
#include "map_pass.h"
#include "mask_constants.h"
#include "mask_pass.h"
#include "moment_maps.h"
#include "moment_rule_of.h"
#include "reuse_count.h"
#include "timed.h"

#include <gnomon/error.h>
#include <gnomon/vulkan/shadow_renderer.h>

#include <cassert>

namespace gnomon::vulkan {
namespace {

static_assert(kPlacementStride == sizeof(shared::GpuFittedView));

constexpr const char* kCreating = "create the shadow renderer";

const MapStorage& storageFor(const Device& device, const FilterOptions& filter)
{
    if (const auto reason = refusal(filter.filter, filter.format, filter.moments)) {
        throw Error(kCreating, *reason);
    }
    const MapStorage* storage = findMapStorage(filter.format);
    if (storage == nullptr) {
        throw Error(kCreating, "no pass writes maps of format " + std::string(nameOf(filter.format)));
    }
    const VkFormatFeatureFlags attachment =
        storage->depthOnly() ? VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT : VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT;
    const VkFormatFeatureFlags needed = attachment | VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT;
    if ((device.features(storage->mapFormat()) & needed) != needed) {
        throw Error(kCreating,
                    "the device cannot draw to and read maps of format " + std::string(nameOf(filter.format)),
                    "choose another map format");
    }
    return *storage;
}

std::unique_ptr<MapRecorder> makeRecorder(Device& device, const ShadowRendererOptions& options,
                                          const MapStorage& storage, LayerPlacer& placer)
{
    if (isFilterable(options.filter.filter)) {
        return std::make_unique<MomentMaps>(device, options, storage, placer);
    }
    return std::make_unique<DepthMaps>(device, options, storage);
}

ImageRef describe(const Image& image)
{
    return {image.image(),       image.view(),        image.info().format,
            image.info().extent, image.info().layers, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
}

} // namespace

struct ShadowRenderer::Impl {
    Impl(const DeviceView& view, const ShadowRendererOptions& options)
        : device(view), storage(storageFor(device, options.filter)),
          placer(device, options.filter, options.pipeline_cache), maps(makeRecorder(device, options, storage, placer)),
          fitter(device, options), mask(device, options, storage.quantum),
          filterable(isFilterable(options.filter.filter)), layered(view.layered), reuse(options.frames_in_flight)
    {
    }

    Device device;
    const MapStorage& storage;
    LayerPlacer placer;
    std::unique_ptr<MapRecorder> maps;
    CascadeFitter fitter;
    MaskPassRecorder mask;
    bool filterable;
    bool layered; // the device can
    CascadePass pass = CascadePass::each;
    std::vector<MapReuse> reuse; // by slot
    MapContents contents;
};

ShadowRenderer::ShadowRenderer(const DeviceView& device, const ShadowRendererOptions& options)
{
    assert(options.frames_in_flight > 0);
    const FilterOptions& filter = options.filter;
    if (filter.disc_taps < 4 || filter.disc_taps > 64) {
        throw Error(kCreating, "a disc of " + std::to_string(filter.disc_taps) + " taps", "choose 4 to 64");
    }
    impl_ = std::make_unique<Impl>(device, options);
}

ShadowRenderer::~ShadowRenderer() = default;

bool ShadowRenderer::prepare(const Plan& plan, VkExtent2D screen)
{
    impl_->contents.reserve(plan);
    const MapRecorder::Prepared maps = impl_->maps->prepare(plan);
    if (maps.lost) {
        impl_->contents.loseMaps();
    }
    impl_->fitter.prepare(plan);
    const bool mask_changed = impl_->mask.prepare(plan, screen);
    return maps.changed || mask_changed;
}

void ShadowRenderer::setCascadePass(CascadePass pass)
{
    if (pass == CascadePass::layered && !canDrawTogether()) {
        throw Error("drawing cascades in one pass",
                    impl_->layered ? "maps that are averaged are made one by one"
                                   : "the device was made without shaderOutputLayer",
                    "draw each in a pass of its own");
    }
    impl_->pass = pass == CascadePass::layered ? pass : CascadePass::each;
    impl_->maps->setPass(impl_->pass);
}

CascadePass ShadowRenderer::cascadePass() const
{
    return impl_->pass;
}

bool ShadowRenderer::canDrawTogether() const
{
    return impl_->layered && impl_->maps->drawsTogether();
}

void ShadowRenderer::recordBounds(VkCommandBuffer commands, std::uint32_t slot, const Frame& frame, const Plan& plan,
                                  const MaskInputs& inputs, Profiler* profiler)
{
    impl_->device.enter(slot, Retirement::Work::bounds);
    if (CascadeFitter::fits(plan)) {
        const Timed timed(profiler, commands, "shadow bounds");
        impl_->fitter.record(commands, slot, frame, plan, inputs);
    }
}

void ShadowRenderer::recordMaps(VkCommandBuffer commands, std::uint32_t slot, [[maybe_unused]] const Frame& frame,
                                const Plan& plan, const DrawCasters& draw, Profiler* profiler)
{
    impl_->device.enter(slot, Retirement::Work::maps);
    const std::span<const ViewWork> work = impl_->contents.workFor(plan);
    impl_->reuse[slot] = countReuse(plan, work, impl_->filterable, impl_->pass);
    assert(impl_->fitter.isFitted(plan));
    const DrawCasters placed = [&](const MapPass& pass) {
        MapPass with = pass;
        if (pass.view->gpu_cascade != kNoIndex) {
            with.placement = impl_->fitter.views();
            with.placement_offset = pass.view_index * kPlacementStride;
        }
        draw(with);
    };
    impl_->maps->record({commands, slot, plan, work, placed, profiler});
    impl_->contents.done(plan);
}

void ShadowRenderer::recordMask(VkCommandBuffer commands, std::uint32_t slot, const Frame& frame, const Plan& plan,
                                const MaskInputs& inputs, Profiler* profiler)
{
    impl_->device.enter(slot, Retirement::Work::mask);
    const Timed timed(profiler, commands, "mask");
    impl_->maps->makeReadable(commands);
    impl_->mask.record(commands, slot, frame, plan, inputs, impl_->maps->maps(), impl_->placer, impl_->fitter);
}

MapPassFormats ShadowRenderer::mapFormats(bool orthographic) const
{
    return impl_->maps->formats(orthographic);
}

ImageRef ShadowRenderer::mask() const
{
    return describe(impl_->mask.mask());
}

ImageRef ShadowRenderer::maps() const
{
    return describe(impl_->maps->maps());
}

FilterCost ShadowRenderer::filterCost(std::uint32_t slot) const
{
    return impl_->maps->cost(slot);
}

MapReuse ShadowRenderer::reuse(std::uint32_t slot) const
{
    return impl_->reuse[slot];
}

std::vector<DepthLayer> ShadowRenderer::depthLayers(std::uint32_t view) const
{
    return impl_->placer.read(view);
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
