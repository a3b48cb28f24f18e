// SPDX-License-Identifier: Apache-2.0
#include "depth_blocks.h"

#include "draw_view.h"
#include "pipelines.h"

#include <gnomon/pack/filter_passes.h>
#include <gnomon/pack/filter_rule.h>

#include <gnomon/shared/map_blocks.h>
#include <gnomon_spirv.h>

#include <algorithm>
#include <array>

namespace gnomon::vulkan {
namespace {

constexpr std::uint32_t kLevelsOfPass = shared::kBlockLevelsOfPass;

} // namespace

DepthBlocks::Kind DepthBlocks::makeKind(VkDescriptorType source, std::span<const std::uint32_t> code,
                                        VkPipelineCache cache)
{
    constexpr VkDescriptorType kTarget = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
    Kind kind;
    kind.sets = DescriptorSets(device_, std::array{source, kTarget, kTarget}, VK_SHADER_STAGE_COMPUTE_BIT);
    kind.layout = makePipelineLayout(device_, kind.sets.layout(), VK_SHADER_STAGE_COMPUTE_BIT, sizeof(Push));
    kind.pipeline = makeComputePipeline(device_, {code, nullptr, kind.layout.get(), cache, "blocks of shadow maps"});
    return kind;
}

DepthBlocks::DepthBlocks(Device& device, VkPipelineCache cache)
    : device_(device), nearest_(makeSampler(device, VK_FILTER_NEAREST)),
      from_maps_(makeKind(VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, spirv::depth_blocks_map_comp, cache)),
      from_blocks_(makeKind(VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, spirv::depth_blocks_comp, cache))
{
}

void DepthBlocks::setMaps(const Image& maps)
{
    const ImageInfo& of_maps = maps.info();
    ImageInfo info;
    info.format = VK_FORMAT_R32_UINT;
    const glm::uvec2 size_px(of_maps.extent.width, of_maps.extent.height);
    const glm::uvec2 extent = pack::blocksExtent(size_px);
    info.levels = pack::blockLevels(size_px);
    info.extent = {extent.x, extent.y};
    info.layers = of_maps.layers;
    info.usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    info.purpose = "blocks of shadow maps";
    Image fresh(device_, info);
    device_.retire(std::move(image_));
    image_ = std::move(fresh);
    maps_ = of_maps.extent;
    layers_ = of_maps.layers;
    is_new_ = true;
    has_layout_ = false;

    passes_.clear();
    from_maps_.sets.reset(1);
    from_blocks_.sets.reset(pack::blockPassCount(info.levels));
    addPass(from_maps_, 0,
            DescriptorSets::image(0, nearest_.get(), maps.view(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL));
    for (std::uint32_t first = kLevelsOfPass; first < info.levels; first += kLevelsOfPass) {
        addPass(from_blocks_, first,
                DescriptorSets::image(0, VK_NULL_HANDLE, image_.level(first - 1), VK_IMAGE_LAYOUT_GENERAL));
    }
}

void DepthBlocks::addPass(Kind& kind, std::uint32_t first_level, const DescriptorSets::Write& source)
{
    const std::uint32_t last = image_.info().levels - 1;
    std::array<DescriptorSets::Write, 1 + kLevelsOfPass> writes{source};
    for (std::uint32_t i = 0; i < kLevelsOfPass; ++i) { // beyond the last there is nothing to write
        writes[1 + i] = DescriptorSets::image(1 + i, VK_NULL_HANDLE, image_.level(std::min(first_level + i, last)),
                                              VK_IMAGE_LAYOUT_GENERAL);
    }
    const Pass& pass = passes_.emplace_back(Pass{&kind, kind.sets.take("blocks of shadow maps"), first_level});
    kind.sets.write(pass.set, writes);
}

void DepthBlocks::record(const MapJob& job)
{
    if (is_new_) {
        recordAll(job.commands);
        return;
    }
    bool begun = false;
    for (std::uint32_t i = 0; i < job.plan.views.size(); ++i) {
        if (!job.of(i).draw) {
            continue;
        }
        if (!begun) {
            begin(job.commands);
            begun = true;
        }
        const View& view = job.plan.views[i];
        recordArea(job.commands, redrawnArea(view, job.of(i).whole), view.place.tile.layer);
    }
    if (begun) {
        end(job.commands);
    }
}

void DepthBlocks::recordAll(VkCommandBuffer commands)
{
    begin(commands);
    for (std::uint32_t layer = 0; layer < layers_; ++layer) {
        recordArea(commands, {{0, 0}, maps_}, layer);
    }
    end(commands);
    is_new_ = false;
}

void DepthBlocks::begin(VkCommandBuffer commands)
{
    ImageBarrier barrier;
    barrier.image = image_.image();
    barrier.layer_count = layers_;
    barrier.old_layout = has_layout_ ? VK_IMAGE_LAYOUT_GENERAL : VK_IMAGE_LAYOUT_UNDEFINED;
    barrier.new_layout = VK_IMAGE_LAYOUT_GENERAL;
    barrier.source_stages = kMapReaders; // the last frame's reads come first; there is nothing to make visible
    barrier.target_stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    barrier.target_access = VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
    recordBarrier(device_, commands, barrier);
    has_layout_ = true;
}

void DepthBlocks::end(VkCommandBuffer commands)
{
    MemoryBarrier barrier;
    barrier.source_stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    barrier.source_access = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
    barrier.target_stages = kMapReaders;
    barrier.target_access = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
    recordBarrier(device_, commands, barrier);
}

void DepthBlocks::recordArea(VkCommandBuffer commands, const VkRect2D& area, std::uint32_t layer)
{
    MemoryBarrier barrier;
    barrier.source_stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    barrier.source_access = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
    barrier.target_stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    barrier.target_access = VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
    for (std::uint32_t i = 0; i < passes_.size(); ++i) {
        dispatch(commands, passes_[i],
                 pack::blockPass(i, {maps_.width, maps_.height},
                                 {layer, static_cast<std::uint32_t>(area.offset.x),
                                  static_cast<std::uint32_t>(area.offset.y), area.extent.width, area.extent.height}));
        recordBarrier(device_, commands, barrier); // the next pass reads them, or other layers are written
    }
}

void DepthBlocks::dispatch(VkCommandBuffer commands, const Pass& pass, const pack::BlockPass& work)
{
    const Push push{work.first, work.last};
    device_.vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pass.kind->pipeline.get());
    device_.vk.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pass.kind->layout.get(), 0, 1, &pass.set,
                                     0, nullptr);
    device_.vk.CmdPushConstants(commands, pass.kind->layout.get(), VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof push, &push);
    device_.vk.CmdDispatch(commands, work.groups_x, work.groups_y, 1);
}

} // namespace gnomon::vulkan
