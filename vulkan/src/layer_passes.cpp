// SPDX-License-Identifier: Apache-2.0
#include "layer_passes.h"

#include "barriers.h"
#include "pipelines.h"

#include <gnomon/shared/layer_gaps.h>
#include <gnomon_spirv.h>

#include <array>

namespace gnomon::vulkan {
namespace {

constexpr std::uint32_t kGroupSide = 32; // texels of a group along x and y, of either first pass

constexpr VkShaderStageFlags kStage = VK_SHADER_STAGE_COMPUTE_BIT;
constexpr std::array kTypes{VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                            VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};

std::uint32_t groupsFor(std::int32_t texels, std::int32_t step)
{
    const std::uint32_t sampled =
        (static_cast<std::uint32_t>(texels) + static_cast<std::uint32_t>(step) - 1) / static_cast<std::uint32_t>(step);
    return (sampled + kGroupSide - 1) / kGroupSide;
}

VkDeviceSize sumsOf(const MomentOptions& options)
{
    return options.placement == LayerPlacement::gaps ? shared::kGapBins * shared::kGapColumns : shared::kDepthBins;
}

std::span<const std::uint32_t> countShader(const MomentOptions& options)
{
    const bool samples = options.samples > 1;
    if (options.placement == LayerPlacement::gaps) {
        return samples ? std::span<const std::uint32_t>(spirv::depth_layers_gaps_samples_comp)
                       : std::span<const std::uint32_t>(spirv::depth_layers_gaps_comp);
    }
    return samples ? std::span<const std::uint32_t>(spirv::depth_layers_histogram_samples_comp)
                   : std::span<const std::uint32_t>(spirv::depth_layers_histogram_comp);
}

} // namespace

LayerPasses::LayerPasses(Device& device, const ResolvedOptions& options, VkPipelineCache cache)
    : device_(device), sum_bytes_(sumsOf(options.moments()) * sizeof(std::uint32_t)),
      sums_(device, sum_bytes_, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
            "histogram of depths"),
      sets_(device, kTypes, kStage),
      count_layout_(makePipelineLayout(device, sets_.layout(), kStage, sizeof(shared::GpuHistogramPush))),
      place_layout_(makePipelineLayout(device, sets_.layout(), kStage, sizeof(shared::GpuPlacePush)))
{
    const bool by_gaps = options.moments().placement == LayerPlacement::gaps;
    count_ = makeComputePipeline(
        device, {countShader(options.moments()), nullptr, count_layout_.get(), cache, "histogram of depths"});
    const auto place = by_gaps ? std::span<const std::uint32_t>(spirv::depth_layers_part_comp)
                               : std::span<const std::uint32_t>(spirv::depth_layers_place_comp);
    place_ = makeComputePipeline(device, {place, nullptr, place_layout_.get(), cache, "places of layers"});
}

void LayerPasses::setImages(VkImageView depth, VkBuffer layers)
{
    sets_.reset(1); // frames in flight may use the set that was there
    set_ = sets_.take("depth layers");
    const std::array writes{DescriptorSets::image(0, VK_NULL_HANDLE, depth, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL),
                            DescriptorSets::buffer(1, sums_.buffer()), DescriptorSets::buffer(2, layers)};
    sets_.write(set_, writes);
}

void LayerPasses::record(VkCommandBuffer commands, const Job& job)
{
    constexpr VkPipelineStageFlags2 kCompute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    constexpr VkPipelineStageFlags2 kClear = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
    constexpr VkAccessFlags2 kRead = VK_ACCESS_2_SHADER_STORAGE_READ_BIT;
    constexpr VkAccessFlags2 kReadWrite = kRead | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
    const auto wait = [&](const MemoryBarrier& barrier) {
        recordBarrier(device_, commands, barrier);
    };
    const auto run = [&](VkPipeline pipeline, VkPipelineLayout layout, const auto& push, std::uint32_t x,
                         std::uint32_t y) {
        device_.vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
        device_.vk.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &set_, 0, nullptr);
        device_.vk.CmdPushConstants(commands, layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof push, &push);
        device_.vk.CmdDispatch(commands, x, y, 1);
    };
    // The view before is done with the histogram, and the last frame with this view's layers.
    wait({kCompute | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT, kClear | kCompute,
          VK_ACCESS_2_TRANSFER_WRITE_BIT | kReadWrite});
    device_.vk.CmdFillBuffer(commands, sums_.buffer(), 0, sum_bytes_, 0);
    wait({kClear, VK_ACCESS_2_TRANSFER_WRITE_BIT, kCompute, kReadWrite});

    run(count_.get(), count_layout_.get(), job.histogram, groupsFor(job.histogram.tile.z, job.histogram.more.x),
        groupsFor(job.histogram.tile.w, job.histogram.more.x));
    wait({kCompute, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT, kCompute, kRead});

    run(place_.get(), place_layout_.get(), job.place, 1, 1);
    wait({kCompute, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
          kCompute | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_2_HOST_BIT,
          kRead | VK_ACCESS_2_HOST_READ_BIT});
}

} // namespace gnomon::vulkan
