// SPDX-License-Identifier: Apache-2.0
#include "classics.h"
#include "renderer_parts.h"
#include "reuse_count.h"
#include "timed.h"
#include "usage.h"

#include <gnomon/pack/page_table.h>
#include <gnomon/pack/soften_draws.h>

#include <gnomon/shared/gpu_structs.h>
#include <gnomon/vulkan/classic_pass.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

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
        : device(view, options_in.classics ? options_in.classics->modules() : ShaderList{}),
          options(checked(options_in)), layered(view.features.layered),
          parts(std::make_unique<RendererParts>(device, options, layered))
    {
    }

    [[nodiscard]] static const ShadowRendererOptions& checked(const ShadowRendererOptions& given)
    {
        (void)checkedFrames(given.frames_in_flight);
        return given;
    }
    /// Makes all anew if a call before left it half way.
    void mend()
    {
        if (spoilt) {
            auto fresh = std::make_unique<RendererParts>(device, options, layered);
            device.retire(std::move(parts)); // frames in flight may use it
            parts = std::move(fresh);
            spoilt = false;
        }
    }
    /// Work that leaves the parts to be made anew when it throws.
    template <class Work>
    void whole(Work&& work)
    {
        const bool before = std::exchange(spoilt, true);
        work(*parts);
        spoilt = before;
    }

    Device device;
    ShadowRendererOptions options;
    bool layered;
    std::unique_ptr<RendererParts> parts;
    bool spoilt = false;
};

ShadowRenderer::ShadowRenderer(const DeviceView& device, const ShadowRendererOptions& options)
    : impl_(std::make_unique<Impl>(device, options))
{
}

ShadowRenderer::~ShadowRenderer() = default;

void ShadowRenderer::warmUp(const ResolvedOptions& options, const WarmUp& what)
{
    checkClassics(options, impl_->options.classics.get());
    impl_->mend();
    impl_->whole([&](RendererParts& parts) {
        if (!options.hasMaps()) {
            parts.mask.warmUp(options, what);
            return;
        }
        // Two options may have maps of one kind and be in one plan: each gets its own.
        if (std::ranges::find(parts.spares, options, &Spare::options) == parts.spares.end()) {
            std::unique_ptr<MapClass> maps = parts.makeClass(options);
            maps->recorder->warmUp(options);
            parts.spares.push_back({options, std::move(maps)});
        }
        if (options.fitsOnGpu()) {
            parts.fitter.warmUp();
        }
        if (pack::hasPages(options) && impl_->options.compact.channels == 0) {
            parts.seen.warmUp();
        }
        parts.mask.warmUp(options, what);
    });
}

void ShadowRenderer::reset()
{
    impl_->spoilt = true;
}

bool ShadowRenderer::prepare(const Plan& plan, VkExtent2D screen)
{
    pack::checkPlan("prepare for a plan", plan);
    checkClassics(plan, impl_->options.classics.get());
    impl_->mend();
    bool changed = false;
    impl_->whole([&](RendererParts& parts) { changed = parts.prepare(plan, screen); });
    return changed;
}

void ShadowRenderer::recordBounds(VkCommandBuffer commands, std::uint32_t slot, const Plan& plan,
                                  const MaskInputs& inputs, Profiler* profiler)
{
    constexpr const char* kTried = "record shadow bounds";
    impl_->parts->checkUse(kTried, commands, slot, plan);
    if (CascadeFitter::fits(plan)) {
        RendererParts::checkInputs(kTried, inputs);
    }
    impl_->device.enter(slot, Retirement::Work::bounds);
    if (pack::has(impl_->parts->passes, pack::FramePassKind::bounds)) {
        const Timed timed(profiler, commands, "shadow bounds");
        impl_->whole([&](RendererParts& parts) { parts.fitter.record(commands, slot, plan, inputs); });
    }
}

void ShadowRenderer::recordMaps(VkCommandBuffer commands, std::uint32_t slot, const Plan& plan, const DrawCasters& draw,
                                Profiler* profiler)
{
    constexpr const char* kTried = "record shadow maps";
    impl_->parts->checkUse(kTried, commands, slot, plan);
    impl_->parts->checkFitted(kTried, plan);
    if (!draw) {
        refuseUse(kTried, "there is no function that draws casters", "hand in a DrawCasters");
    }
    impl_->device.enter(slot, Retirement::Work::maps);
    impl_->whole([&](RendererParts& parts) {
        const std::span<const pack::ViewWork> work = parts.notes.workFor(plan);
        parts.reuse[slot] = countReuse(plan, work);
        for (const pack::FramePass& pass : parts.passes) {
            if (pass.kind == pack::FramePassKind::maps) {
                const ClassicPass classic{.formats = classicFormats((*plan.options)[pass.options])};
                const MapJob job{.commands = commands,
                                 .slot = slot,
                                 .plan = plan,
                                 .options = pass.options,
                                 .work = work,
                                 .draw = draw,
                                 .classic = classic.formats != ClassicFormats{} ? &classic : nullptr,
                                 .placements = parts.fitter.views(),
                                 .profiler = profiler};
                parts.classes[pass.options]->recorder->record(job);
                if (parts.classes[pass.options]->tints.record(job)) {
                    parts.notes.change();
                }
            }
        }
        parts.notes.done(plan);
    });
}

void ShadowRenderer::recordMask(VkCommandBuffer commands, std::uint32_t slot, const Plan& plan,
                                const MaskInputs& inputs, Profiler* profiler)
{
    constexpr const char* kTried = "record the mask";
    impl_->parts->checkUse(kTried, commands, slot, plan);
    impl_->parts->checkFitted(kTried, plan);
    RendererParts::checkInputs(kTried, inputs);
    if (inputs.object_id == VK_NULL_HANDLE &&
        std::ranges::any_of(plan.lights, [](const LightPlan& light) { return light.first_object_id != kNoIndex; })) {
        refuseUse(kTried, "filters id and depth-id tell objects apart, and MaskInputs::object_id is null",
                  "hand in the image of objects' ids");
    }
    if (!inputs.object_pieces && hasPieces(plan)) {
        refuseUse(kTried, "id.of face tells pieces of objects apart, and MaskInputs::object_pieces is false",
                  "have each pixel's piece in the upper bits of its object's number");
    }
    const VkExtent2D made = impl_->parts->mask.mask().info().extent;
    if (!impl_->parts->has_mask || inputs.extent.width != made.width || inputs.extent.height != made.height) {
        refuseUse(kTried, "prepare() made no mask of this size", "call prepare() with the size of the inputs first");
    }
    const bool softens =
        std::ranges::any_of(plan.lights, [&](const LightPlan& light) { return pack::softens(plan, light); });
    if (softens && !impl_->parts->mask.holdsSoften(plan)) {
        refuseUse(kTried, "prepare() made no images for this plan's blur", "call prepare() with it first");
    }
    const bool halves =
        std::ranges::any_of(plan.lights, [&](const LightPlan& light) { return pack::halvesMask(plan, light); });
    if (halves && !impl_->parts->mask.holdsSpread(plan)) {
        refuseUse(kTried, "prepare() made no image of half the mask's size", "call prepare() with this plan first");
    }
    if (!impl_->parts->mask.holdsMarks(plan)) {
        refuseUse(kTried, "prepare() made no marks for this plan's filters", "call prepare() with this plan first");
    }
    impl_->device.enter(slot, Retirement::Work::mask);
    bool kept = false;
    impl_->whole([&](RendererParts& parts) {
        parts.mask.describe(plan, inputs, parts.classes, parts.notes.changes());
        kept = parts.mask.holds();
        if (kept) {
            parts.mask.keep(slot);
        }
        parts.mask_kept[slot] = kept ? 1 : 0;
    });
    const auto look = [&](RendererParts& parts) {
        parts.seen.record(commands, slot, plan, inputs, parts.mask.mask(), kept);
    };
    if (kept) {
        impl_->whole(look);
        return;
    }
    std::optional<Timed> timed(std::in_place, profiler, commands, "mask");
    impl_->whole([&](RendererParts& parts) {
        for (const std::unique_ptr<MapClass>& maps : parts.classes) {
            if (maps) {
                maps->recorder->makeReadable(commands);
            }
        }
        parts.mask.record(commands, slot, plan, inputs, parts.classes, parts.fitter);
    });
    timed.reset();
    if (softens) {
        timed.emplace(profiler, commands, "soften");
        impl_->whole([&](RendererParts& parts) { parts.mask.recordSoften(commands, slot, plan, inputs); });
        timed.reset();
    }
    impl_->whole(look);
}

std::span<const PageRequests> ShadowRenderer::pageRequests(std::uint32_t slot) const
{
    return impl_->parts->seen.read(slot);
}

void ShadowRenderer::recordViews(VkCommandBuffer commands, std::uint32_t slot, const Plan& plan, VkBuffer views,
                                 VkDeviceSize offset)
{
    constexpr const char* kTried = "complete views";
    impl_->parts->checkUse(kTried, commands, slot, plan);
    if (pack::has(impl_->parts->passes, pack::FramePassKind::bounds)) {
        impl_->parts->checkFitted(kTried, plan);
        if (views == VK_NULL_HANDLE) {
            refuseUse(kTried, "the buffer of views is null", "hand in the one that pack::fillViews() wrote to");
        }
        impl_->parts->fitter.recordViews(commands, slot, CascadeFitter::Reader::host,
                                         {views, offset, static_cast<std::uint32_t>(plan.views.size())});
    }
}

ImageRef ShadowRenderer::mask() const
{
    return describe(impl_->parts->mask.mask());
}

BufferRef ShadowRenderer::maskTiles(std::uint32_t slot) const
{
    return impl_->parts->mask.tiles(slot);
}

ImageRef ShadowRenderer::maps(std::uint32_t options) const
{
    const MapClass* const made = impl_->parts->classOf(options);
    return made != nullptr ? describe(made->recorder->maps()) : ImageRef{};
}

ImageRef ShadowRenderer::blocks(std::uint32_t options) const
{
    const MapClass* const made = impl_->parts->classOf(options);
    const Image* const blocks = made != nullptr ? made->recorder->blocks() : nullptr;
    if (blocks == nullptr) {
        return {};
    }
    ImageRef ref = describe(*blocks);
    ref.layout = VK_IMAGE_LAYOUT_GENERAL;
    return ref;
}

ImageRef ShadowRenderer::tints(std::uint32_t options) const
{
    const MapClass* const made = impl_->parts->classOf(options);
    return made != nullptr && made->tints.inUse() ? describe(made->tints.image()) : ImageRef{};
}

void ShadowRenderer::placeTints(const Plan& plan, std::span<shared::GpuView> views) const
{
    constexpr const char* kTried = "place tints in views";
    impl_->parts->checkPrepared(kTried, plan);
    if (views.size() < plan.views.size()) {
        refuseUse(kTried, "there is no room for the plan's views", "give room for plan.views.size()");
    }
    vulkan::placeTints(plan, impl_->parts->classes, views);
}

BufferRef ShadowRenderer::depthLayersBuffer(std::uint32_t options) const
{
    const MapClass* const made = impl_->parts->classOf(options);
    return made != nullptr ? BufferRef{made->placer.buffer(), made->placer.bytes()} : BufferRef{};
}

FilterCost ShadowRenderer::filterCost(std::uint32_t slot) const
{
    FilterCost sum;
    if (slot >= impl_->parts->options.frames_in_flight) {
        return sum;
    }
    for (const std::unique_ptr<MapClass>& maps : impl_->parts->classes) {
        if (maps && maps->filterable()) {
            const FilterCost one = maps->recorder->cost(slot);
            sum = {sum.texels + one.texels, sum.taps + one.taps, sum.bytes_moved + one.bytes_moved,
                   sum.bytes_minimum + one.bytes_minimum, one.path};
        }
    }
    return sum;
}

bool ShadowRenderer::maskKept(std::uint32_t slot) const
{
    return slot < impl_->parts->mask_kept.size() && impl_->parts->mask_kept[slot] != 0;
}

MapReuse ShadowRenderer::reuse(std::uint32_t slot) const
{
    return slot < impl_->parts->reuse.size() ? impl_->parts->reuse[slot] : MapReuse{};
}

std::vector<pack::DepthLayer> ShadowRenderer::depthLayers(const Plan& plan, std::uint32_t view) const
{
    if (view >= plan.views.size() || plan.views[view].light >= plan.lights.size()) {
        return {};
    }
    const MapClass* const made = impl_->parts->classOf(optionsIndexOf(plan, plan.views[view]));
    return made != nullptr ? made->placer.read(pack::depthLayersSlot(plan, view)) : std::vector<pack::DepthLayer>{};
}

std::vector<FittedView> ShadowRenderer::fittedViews(std::uint32_t slot) const
{
    return impl_->parts->fitter.read(slot);
}

std::span<const MemoryUse> ShadowRenderer::memory() const
{
    return impl_->parts->device.account().uses();
}

} // namespace gnomon::vulkan
