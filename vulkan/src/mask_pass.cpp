// SPDX-License-Identifier: Apache-2.0
#include "mask_pass.h"

#include "barriers.h"
#include "samplers.h"

#include <gnomon/pack/frame_passes.h>
#include <gnomon/pack/page_table.h>
#include <gnomon/plan_views.h>

#include <gnomon/shared/gpu_structs.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>

namespace gnomon::vulkan {
namespace {

// Stages that may read the mask after us, and must be done before the next frame writes it.
constexpr VkPipelineStageFlags2 kReaders = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT |
                                           VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT |
                                           VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;

enum Binding : std::uint32_t {
    kConstants,
    kMaps,
    kLights,
    kViews,
    kLayersOrObjects, // for filters by depth, for filters by ids
    kDepth,
    kNormal,
    kObjectId,
    kFewViews,
    kBlocks,
    kSmooth,
    kTints,
    kTiles,
    kBindingCount
};
constexpr std::array<VkDescriptorType, kBindingCount> kTypes{
    VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,         VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
    VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,         VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
    VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,         VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
    VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
    VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,         VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
    VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
    VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};
// No device has to take more in one stage.
static_assert(std::ranges::count(kTypes, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER) <= 4);

} // namespace

void toAttachment(const Device& device, VkCommandBuffer commands, const Image& image)
{
    ImageBarrier barrier;
    barrier.image = image.image();
    barrier.layer_count = image.info().layers;
    barrier.old_layout = VK_IMAGE_LAYOUT_UNDEFINED;
    barrier.new_layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    barrier.source_stages = kReaders;
    barrier.target_stages = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
    barrier.target_access = VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
    recordBarrier(device, commands, barrier);
}

void toReadable(const Device& device, VkCommandBuffer commands, const Image& image)
{
    ImageBarrier barrier;
    barrier.image = image.image();
    barrier.layer_count = image.info().layers;
    barrier.old_layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    barrier.new_layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    barrier.source_stages = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
    barrier.source_access = VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
    barrier.target_stages = kReaders;
    barrier.target_access = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT | VK_ACCESS_2_TRANSFER_READ_BIT;
    recordBarrier(device, commands, barrier);
}

MaskPassRecorder::MaskPassRecorder(Device& device, const ShadowRendererOptions& options)
    : device_(device), slot_count_(options.frames_in_flight), cache_(options.pipeline_cache),
      classics_(options.classics.get()), compact_(checkedRule(options.compact)), pipelines_(device, options),
      slots_(options.frames_in_flight), shape_(options.mask_shape)
{
    makeLayouts();
}

void MaskPassRecorder::makeLayouts()
{
    sets_ = DescriptorSets(device_, kTypes, kMaskStages);
    layout_ = makePipelineLayout(device_, sets_.layout(), kMaskStages, sizeof(MaskPush));
    // Depths must not be averaged, and filtering them is not a feature that formats of depth need have.
    nearest_ = makeSampler(device_, VK_FILTER_NEAREST);
    linear_ = makeSampler(device_, VK_FILTER_LINEAR);
}

void MaskPassRecorder::makeSets(std::uint32_t options)
{
    sets_.reset(slot_count_ * options);
    for (Slot& slot : slots_) {
        slot.sets.clear();
        for (std::uint32_t i = 0; i < options; ++i) {
            slot.sets.push_back(sets_.take("mask"));
        }
    }
}

void MaskPassRecorder::makeObjects(const Plan& plan)
{
    const std::size_t vectors = pack::objectVectorCount(plan);
    if (vectors <= room_.objects) {
        return;
    }
    room_.objects = vectors + vectors / 2;
    now_.numbers.resize(room_.objects);
    for (Slot& slot : slots_) {
        device_.retire(std::move(slot.objects));
        slot.objects =
            HostBuffer(device_, room_.objects * sizeof(glm::vec4), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "constants");
    }
}

void MaskPassRecorder::makePageTables(const Plan& plan)
{
    if (isCompact()) {
        return; // it has lists of lights in their place
    }
    pack::fillPageTable(plan, now_.tiles);
    for (Slot& slot : slots_) {
        makeRoomForTiles(slot);
    }
}

void MaskPassRecorder::makeBuffers(const Plan& plan)
{
    now_.draws.reserve(pack::mostMaskDraws(plan));
    makeObjects(plan);
    makePageTables(plan);
    const auto options = static_cast<std::uint32_t>(plan.options->size());
    const std::uint32_t lights = lightRoomFor(plan);
    const auto views = static_cast<std::uint32_t>(std::max<std::size_t>(plan.views.size(), shared::kFewViews));
    if (options <= room_.options && lights <= room_.lights && views <= room_.views) {
        return;
    }
    if (options > room_.options) {
        makeSets(options);
    }
    const VkPhysicalDeviceLimits& limits = device_.limits();
    const VkDeviceSize align =
        std::max<VkDeviceSize>({limits.minUniformBufferOffsetAlignment, limits.minStorageBufferOffsetAlignment, 16});
    const auto aligned = [&](VkDeviceSize bytes) {
        return (bytes + align - 1) / align * align;
    };
    room_.options = std::max(room_.options, options);
    room_.lights = std::max(room_.lights, lights);
    room_.views = std::max(room_.views, views);
    room_.constants_stride = aligned(sizeof(shared::GpuConstants));
    room_.lights_at = room_.options * room_.constants_stride;
    room_.views_at = room_.lights_at + aligned(room_.lights * sizeof(shared::GpuLight));
    const VkDeviceSize bytes = room_.views_at + room_.views * sizeof(shared::GpuView);
    for (Slot& slot : slots_) {
        device_.retire(std::move(slot.constants));
        slot.constants = HostBuffer(
            device_, bytes, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "constants");
    }
    map_images_.resize(room_.options);
    now_.constants.resize(bytes);
}

void MaskPassRecorder::makeMask(const Plan& plan, VkExtent2D screen)
{
    drawn_is_known_ = false;
    device_.retire(std::move(mask_));
    mask_ = Image(device_,
                  {maskFormat(channelsFor(plan)), screen, layersFor(plan),
                   VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                   VK_IMAGE_ASPECT_COLOR_BIT, "mask"});
}

bool MaskPassRecorder::prepare(const Plan& plan, VkExtent2D screen, const MapClasses& maps)
{
    checkCompact(plan);
    makeBuffers(plan);
    tinted_.assign(maps.size(), 0);
    for (std::size_t i = 0; i < maps.size(); ++i) {
        tinted_[i] = maps[i] && maps[i]->tints.inUse() ? 1 : 0;
    }
    if (!no_numbers_) {
        no_numbers_ = StandIn(device_);
    }
    const ImageInfo& have = mask_.info();
    const bool fits = mask_ && have.format == maskFormat(channelsFor(plan)) && have.layers >= layersFor(plan) &&
                      have.extent.width == screen.width && have.extent.height == screen.height;
    if (!fits) {
        makeMask(plan, screen);
    }
    if (shape_) {
        makePipelines(plan, *shape_);
    }
    prepareHistories(plan);
    prepareMarks(plan);
    prepareSpread(plan);
    prepareSoften(plan);
    prepareVolumes(plan);
    return !fits;
}

void MaskPassRecorder::writeSet(const Slot& slot, std::uint32_t options, const MaskInputs& inputs, const MapClass& maps)
{
    constexpr VkImageLayout kRead = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    const VkSampler sampler = nearest_.get();
    // The shaders name the normals whether they read them or not [drivers: unwritten]. The depth fills in for what is
    // absent; an image of their own does for ids and blocks, which are whole numbers.
    const auto orDepth = [&](std::uint32_t binding, VkImageView view) {
        return view != VK_NULL_HANDLE ? DescriptorSets::image(binding, sampler, view, kRead)
                                      : DescriptorSets::image(binding, sampler, inputs.depth, inputs.depth_layout);
    };
    const VkBuffer constants = slot.constants.buffer();
    const Image* const blocks = maps.recorder->blocks();
    const VkSampler of_maps = maps.filterable() ? linear_.get() : nearest_.get();
    const std::array<DescriptorSets::Write, kBindingCount> writes{
        DescriptorSets::buffer(kConstants, constants, sizeof(shared::GpuConstants), options * room_.constants_stride),
        DescriptorSets::image(kMaps, of_maps, maps.recorder->maps().view(), kRead),
        DescriptorSets::buffer(kLights, constants, room_.lights * sizeof(shared::GpuLight), room_.lights_at),
        DescriptorSets::buffer(kViews, constants, room_.views * sizeof(shared::GpuView), room_.views_at),
        maps.hasIds() && slot.objects ? DescriptorSets::buffer(kLayersOrObjects, slot.objects.buffer())
                                      : DescriptorSets::buffer(kLayersOrObjects, maps.placer.buffer()),
        DescriptorSets::image(kDepth, sampler, inputs.depth, inputs.depth_layout),
        orDepth(kNormal, inputs.normal),
        DescriptorSets::image(kObjectId, sampler,
                              inputs.object_id != VK_NULL_HANDLE ? inputs.object_id : no_numbers_.layer(), kRead),
        DescriptorSets::buffer(kFewViews, constants, shared::kFewViews * sizeof(shared::GpuView), room_.views_at),
        blocks != nullptr ? DescriptorSets::image(kBlocks, sampler, blocks->view(), VK_IMAGE_LAYOUT_GENERAL)
                          : DescriptorSets::image(kBlocks, sampler, no_numbers_.view(), kRead),
        orDepth(kSmooth, inputs.smooth),
        DescriptorSets::image(kTints, sampler,
                              maps.tints.inUse() ? maps.tints.image().view() : maps.recorder->maps().view(), kRead),
        !now_.tiles.empty()
            ? DescriptorSets::buffer(kTiles, slot.tiles.buffer())
            : DescriptorSets::buffer(kTiles, constants, room_.lights * sizeof(shared::GpuLight), room_.lights_at)};
    sets_.write(slot.sets[options], writes);
}

void MaskPassRecorder::fill(Slot& slot, const Plan& plan, const MaskInputs& inputs, const MapClasses& maps)
{
    ++drawings_;
    std::memcpy(slot.constants.data(), now_.constants.data(), now_.constants.size());
    if (!now_.tiles.empty()) {
        fillTiles(slot);
    }
    if (slot.objects) {
        std::memcpy(slot.objects.data(), now_.numbers.data(), now_.numbers.size() * sizeof(glm::vec4));
    }
    for (std::uint32_t i = 0; i < plan.options->size(); ++i) {
        if (maps[i]) {
            writeSet(slot, i, inputs, *maps[i]);
        }
    }
}

void placeTints(const Plan& plan, const MapClasses& maps, std::span<shared::GpuView> views)
{
    for (std::uint32_t i = 0; i < plan.views.size(); ++i) {
        views[i].more.w = static_cast<float>(maps[optionsIndexOf(plan, plan.views[i])]->tints.placeOf(i));
    }
}

void MaskPassRecorder::record(VkCommandBuffer commands, std::uint32_t slot_index, const Plan& plan,
                              const MaskInputs& inputs, const MapClasses& maps, CascadeFitter& fitter)
{
    assert(slot_index < slots_.size());
    assert(plan.made_for.lights.size() == plan.lights.size() && plan.views.size() <= room_.views);
    assert(inputs.depth != VK_NULL_HANDLE);
    assert(inputs.extent.width == mask_.info().extent.width && inputs.extent.height == mask_.info().extent.height);
    drawn_is_known_ = false; // until all of it is there
    no_numbers_.makeReadable(device_, commands);
    Slot& slot = slots_[slot_index];
    fill(slot, plan, inputs, maps);
    if (CascadeFitter::fits(plan)) {
        fitter.recordViews(commands, slot_index, CascadeFitter::Reader::mask,
                           {slot.constants.buffer(), room_.views_at, static_cast<std::uint32_t>(plan.views.size())});
    }
    const bool takes_turns = alternate_ && std::ranges::any_of(plan.lights, pack::takesTurns);
    const bool converges = converge_ && std::ranges::any_of(plan.lights, pack::joinsFrames);
    const MaskJob job{commands, slot_index, plan, inputs, slot.constants.buffer(), room_.constants_stride, no_numbers_};
    // From pass to pass: what the maps alone say, what turns make of it, what frames make of that.
    const Image& joined = converges ? converge_->target() : mask_;
    const Image& drawn = takes_turns ? alternate_->target() : joined;
    recordLayers(commands, plan, slot, drawn);
    if (std::ranges::any_of(plan.lights, [&](const LightPlan& light) { return pack::halvesMask(plan, light); })) {
        recordHalved(commands, slot_index, plan, inputs, drawn);
    }
    if (hasVolumes(plan)) { // beside what the lights with maps have drawn
        volumes_->record(job, drawn);
    }
    toReadable(device_, commands, drawn);
    const auto join = [&](FrameJoiner& frames, const Image& target) {
        toAttachment(device_, commands, target);
        frames.record(job, target);
        toReadable(device_, commands, target);
    };
    if (takes_turns) {
        join(*alternate_, joined);
    } else if (alternate_) {
        alternate_->forget();
    }
    if (converges) {
        join(*converge_, mask_);
    }
    if (now_.inputs != 0) {
        drawn_ = now_; // keeps what it has allocated
        drawn_is_known_ = true;
    }
}

void MaskPassRecorder::recordSoften(VkCommandBuffer commands, std::uint32_t slot, const Plan& plan,
                                    const MaskInputs& inputs)
{
    assert(soften_);
    soften_->record(commands, slot, plan,
                    {inputs.depth, inputs.depth_layout, inputs.normal, slots_[slot].constants.buffer()}, mask_,
                    kReaders);
}

} // namespace gnomon::vulkan
