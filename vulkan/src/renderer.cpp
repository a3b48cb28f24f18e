// SPDX-License-Identifier: Apache-2.0
#include "cascade_fitter.h"
#include "map_class.h"
#include "mask_pass.h"
#include "reuse_count.h"
#include "timed.h"
#include "usage.h"

#include <gnomon/error.h>
#include <gnomon/pack/frame_passes.h>
#include <gnomon/vulkan/shadow_renderer.h>

#include <algorithm>
#include <memory>
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

// Made by warmUp(), without images.
struct Spare {
    ResolvedOptions options; // that it was made for; it may serve others, too
    std::unique_ptr<MapClass> maps;
};

/// All that a renderer makes. One that a call left half way, because something threw, is given up as a whole.
struct Parts {
    Parts(Device& device_in, const ShadowRendererOptions& options_in, bool layered_in)
        : device(device_in), options(options_in), fitter(device, options.frames_in_flight, options.pipeline_cache),
          mask(device, options), layered(layered_in), reuse(options.frames_in_flight)
    {
    }

    [[nodiscard]] std::unique_ptr<MapClass> makeClass(const ResolvedOptions& wanted);
    [[nodiscard]] std::unique_ptr<MapClass> takeClass(const ResolvedOptions& wanted);
    void matchClasses(const Plan& plan);
    [[nodiscard]] bool prepare(const Plan& plan, VkExtent2D screen);
    void check(const ResolvedOptions& wanted) const;
    /// Before anything is recorded.
    void checkUse(const char* tried, VkCommandBuffer commands, std::uint32_t slot, const Plan& plan) const;
    void checkInputs(const char* tried, const Frame& frame, const Plan& plan, const MaskInputs& inputs) const;
    void checkFitted(const char* tried, const Plan& plan) const;

    Device& device;
    const ShadowRendererOptions& options;
    MapClasses classes; // by options of the last plan; null where no light has named them
    std::vector<Spare> spares;
    CascadeFitter fitter;
    MaskPassRecorder mask;
    bool layered;                        // the device can
    std::vector<pack::FramePass> passes; // of the plan that was prepared last
    std::vector<MapReuse> reuse;         // by slot
    MapNotes notes;
    PreparedSize prepared;
    bool has_mask = false; // prepare() was given a screen
};

void Parts::check(const ResolvedOptions& wanted) const
{
    if (wanted.cascades().pass == CascadePass::layered && !layered) {
        throw Error("draw cascades in one pass", "the device was made without shaderOutputLayer",
                    "draw each in a pass of its own");
    }
}

void Parts::checkUse(const char* tried, VkCommandBuffer commands, std::uint32_t slot, const Plan& plan) const
{
    checkCommands(tried, commands);
    checkSlot(tried, slot, options.frames_in_flight);
    checkPlan(tried, plan);
    bool fits = prepared.holds(plan);
    for (const LightPlan& light : plan.lights) {
        const std::uint32_t i = light.options;
        fits = fits && i < classes.size() && classes[i] && classes[i]->serves((*plan.options)[i]);
    }
    if (!fits) {
        refuseUse(tried, "the plan needs other images than those that are there", "call prepare() with it first");
    }
}

void Parts::checkInputs(const char* tried, const Frame& frame, const Plan& plan, const MaskInputs& inputs) const
{
    if (frame.lights.size() != plan.lights.size()) {
        refuseUse(tried, "the frame has other lights than the plan", "hand in the frame that was planned");
    }
    if (inputs.depth == VK_NULL_HANDLE) {
        refuseUse(tried, "MaskInputs::depth is null", "hand in the camera's depth");
    }
    if (inputs.extent.width == 0 || inputs.extent.height == 0) {
        refuseUse(tried, "MaskInputs::extent is 0", "say how large the camera's depth is");
    }
}

void Parts::checkFitted(const char* tried, const Plan& plan) const
{
    if (!fitter.isFitted(plan)) {
        refuseUse(tried, "the plan's cascades are fitted on the GPU, and were not yet",
                  "call recordBounds() with it first");
    }
}

std::unique_ptr<MapClass> Parts::makeClass(const ResolvedOptions& wanted)
{
    check(wanted);
    return std::make_unique<MapClass>(device, wanted, options.frames_in_flight, options.pipeline_cache);
}

std::unique_ptr<MapClass> Parts::takeClass(const ResolvedOptions& wanted)
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
void Parts::matchClasses(const Plan& plan)
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

bool Parts::prepare(const Plan& plan, VkExtent2D screen)
{
    prepared.forget(); // until all of it is there
    has_mask = false;
    pack::listFramePasses(plan, passes);
    matchClasses(plan);
    notes.reserve(plan);
    bool changed = false;
    for (const pack::FramePass& pass : passes) {
        if (pass.kind == pack::FramePassKind::maps) {
            check((*plan.options)[pass.options]);
            const MapRecorder::Prepared maps = classes[pass.options]->recorder->prepare(plan, pass.options);
            classes[pass.options]->tints.prepare(plan, pass.options, options.is_blended);
            changed = changed || maps.changed;
            if (maps.lost) {
                notes.lose(pass.options);
            }
        }
    }
    fitter.prepare(plan);
    const bool wants_mask = screen.width > 0 && screen.height > 0;
    const bool mask_changed = wants_mask && mask.prepare(plan, screen, classes);
    has_mask = wants_mask;
    prepared.take(plan);
    return changed || mask_changed;
}

} // namespace

struct ShadowRenderer::Impl {
    Impl(const DeviceView& view, const ShadowRendererOptions& options_in)
        : device(view), options(checked(options_in)), layered(view.layered),
          parts(std::make_unique<Parts>(device, options, layered))
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
            auto fresh = std::make_unique<Parts>(device, options, layered);
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
    std::unique_ptr<Parts> parts;
    bool spoilt = false;
};

ShadowRenderer::ShadowRenderer(const DeviceView& device, const ShadowRendererOptions& options)
    : impl_(std::make_unique<Impl>(device, options))
{
}

ShadowRenderer::~ShadowRenderer() = default;

void ShadowRenderer::warmUp(const ResolvedOptions& options, const WarmUp& what)
{
    impl_->mend();
    impl_->whole([&](Parts& parts) {
        // Two options may have maps of one kind and be in one plan: each gets its own.
        if (std::ranges::find(parts.spares, options, &Spare::options) == parts.spares.end()) {
            std::unique_ptr<MapClass> maps = parts.makeClass(options);
            maps->recorder->warmUp(options);
            parts.spares.push_back({options, std::move(maps)});
        }
        if (options.fitsOnGpu()) {
            parts.fitter.warmUp();
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
    checkPlan("prepare for a plan", plan);
    impl_->mend();
    bool changed = false;
    impl_->whole([&](Parts& parts) { changed = parts.prepare(plan, screen); });
    return changed;
}

void ShadowRenderer::recordBounds(VkCommandBuffer commands, std::uint32_t slot, const Frame& frame, const Plan& plan,
                                  const MaskInputs& inputs, Profiler* profiler)
{
    constexpr const char* kTried = "record shadow bounds";
    impl_->parts->checkUse(kTried, commands, slot, plan);
    if (CascadeFitter::fits(plan)) {
        impl_->parts->checkInputs(kTried, frame, plan, inputs);
    }
    impl_->device.enter(slot, Retirement::Work::bounds);
    if (pack::has(impl_->parts->passes, pack::FramePassKind::bounds)) {
        const Timed timed(profiler, commands, "shadow bounds");
        impl_->whole([&](Parts& parts) { parts.fitter.record(commands, slot, frame, plan, inputs); });
    }
}

void ShadowRenderer::recordMaps(VkCommandBuffer commands, std::uint32_t slot, [[maybe_unused]] const Frame& frame,
                                const Plan& plan, const DrawCasters& draw, Profiler* profiler)
{
    constexpr const char* kTried = "record shadow maps";
    impl_->parts->checkUse(kTried, commands, slot, plan);
    impl_->parts->checkFitted(kTried, plan);
    if (!draw) {
        refuseUse(kTried, "there is no function that draws casters", "hand in a DrawCasters");
    }
    impl_->device.enter(slot, Retirement::Work::maps);
    impl_->whole([&](Parts& parts) {
        const std::span<const ViewWork> work = parts.notes.workFor(plan);
        parts.reuse[slot] = countReuse(plan, work);
        const DrawCasters placed = [&](const MapPass& pass) {
            MapPass with = pass;
            if (pass.view->gpu_cascade != kNoIndex) {
                with.placement = parts.fitter.views();
                with.placement_offset = pass.view_index * kPlacementStride;
            }
            draw(with);
        };
        for (const pack::FramePass& pass : parts.passes) {
            if (pass.kind == pack::FramePassKind::maps) {
                const MapJob job{commands, slot, plan, pass.options, work, placed, profiler};
                parts.classes[pass.options]->recorder->record(job);
                parts.classes[pass.options]->tints.record(job);
            }
        }
        parts.notes.done(plan);
    });
}

void ShadowRenderer::recordMask(VkCommandBuffer commands, std::uint32_t slot, const Frame& frame, const Plan& plan,
                                const MaskInputs& inputs, Profiler* profiler)
{
    constexpr const char* kTried = "record the mask";
    impl_->parts->checkUse(kTried, commands, slot, plan);
    impl_->parts->checkFitted(kTried, plan);
    impl_->parts->checkInputs(kTried, frame, plan, inputs);
    const VkExtent2D made = impl_->parts->mask.mask().info().extent;
    if (!impl_->parts->has_mask || inputs.extent.width != made.width || inputs.extent.height != made.height) {
        refuseUse(kTried, "prepare() made no mask of this size", "call prepare() with the size of the inputs first");
    }
    impl_->device.enter(slot, Retirement::Work::mask);
    const Timed timed(profiler, commands, "mask");
    impl_->whole([&](Parts& parts) {
        for (const std::unique_ptr<MapClass>& maps : parts.classes) {
            if (maps) {
                maps->recorder->makeReadable(commands);
            }
        }
        parts.mask.record(commands, slot, frame, plan, inputs, parts.classes, parts.fitter);
    });
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

ImageRef ShadowRenderer::maps(std::uint32_t options) const
{
    const bool made = options < impl_->parts->classes.size() && impl_->parts->classes[options];
    return made ? describe(impl_->parts->classes[options]->recorder->maps()) : ImageRef{};
}

ImageRef ShadowRenderer::blocks(std::uint32_t options) const
{
    const bool made = options < impl_->parts->classes.size() && impl_->parts->classes[options];
    const Image* const blocks = made ? impl_->parts->classes[options]->recorder->blocks() : nullptr;
    if (blocks == nullptr) {
        return {};
    }
    ImageRef ref = describe(*blocks);
    ref.layout = VK_IMAGE_LAYOUT_GENERAL;
    return ref;
}

BufferRef ShadowRenderer::depthLayersBuffer(std::uint32_t options) const
{
    const bool made = options < impl_->parts->classes.size() && impl_->parts->classes[options];
    return made ? BufferRef{impl_->parts->classes[options]->placer.buffer(),
                            impl_->parts->classes[options]->placer.bytes()}
                : BufferRef{};
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

MapReuse ShadowRenderer::reuse(std::uint32_t slot) const
{
    return slot < impl_->parts->reuse.size() ? impl_->parts->reuse[slot] : MapReuse{};
}

std::vector<pack::DepthLayer> ShadowRenderer::depthLayers(const Plan& plan, std::uint32_t view) const
{
    if (view >= plan.views.size() || plan.views[view].light >= plan.lights.size()) {
        return {};
    }
    const std::uint32_t options = optionsIndexOf(plan, plan.views[view]);
    const bool made = options < impl_->parts->classes.size() && impl_->parts->classes[options];
    return made ? impl_->parts->classes[options]->placer.read(pack::depthLayersSlot(plan, view))
                : std::vector<pack::DepthLayer>{};
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
