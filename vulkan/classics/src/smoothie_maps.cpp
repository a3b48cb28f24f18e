// SPDX-License-Identifier: Apache-2.0
#include "smoothie_maps.h"

#include "draw_view.h"
#include "pipelines.h"

#include <gnomon/pack/filter_rule.h>

#include <gnomon_classic_spirv.h>

#include <array>

namespace gnomon::vulkan {
namespace {

constexpr const char* kPurpose = "smoothies";
constexpr std::uint32_t kGroup = 8; // local sizes of the shaders
constexpr VkDescriptorType kRead = VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE;
constexpr VkDescriptorType kStored = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;

/// The next passes read or write the output of one pass.
MemoryBarrier betweenPasses()
{
    MemoryBarrier barrier;
    barrier.source_stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    barrier.source_access = VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
    barrier.target_stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    barrier.target_access = VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
    return barrier;
}

} // namespace

SmoothieMaps::Pass SmoothieMaps::makePass(std::span<const std::uint32_t> code, std::span<const VkDescriptorType> types,
                                          VkPipelineCache cache) const
{
    Pass pass;
    pass.sets = DescriptorSets(device_, types, VK_SHADER_STAGE_COMPUTE_BIT);
    pass.layout = makePipelineLayout(device_, pass.sets.layout(), VK_SHADER_STAGE_COMPUTE_BIT, sizeof(Push));
    pass.pipeline = makeComputePipeline(device_, {code, nullptr, pass.layout.get(), cache, kPurpose});
    return pass;
}

SmoothieMaps::SmoothieMaps(Device& device, const ResolvedOptions& options, VkPipelineCache cache)
    : device_(device), reach_(static_cast<std::int32_t>(options.asked().smoothies.reach_texels)),
      quantum_(pack::depthQuantum(options.format())),
      edges_(makePass(spirv::smoothies_edges_comp, std::array{kRead, kStored}, cache)),
      along_x_(makePass(spirv::smoothies_row_comp, std::array{kStored}, cache)),
      along_y_(makePass(spirv::smoothies_column_comp, std::array{kRead, kStored, kStored}, cache))
{
}

void SmoothieMaps::setMaps(const Image& maps)
{
    ImageInfo info;
    info.format = VK_FORMAT_R32_UINT;
    info.extent = maps.info().extent;
    info.layers = maps.info().layers;
    info.usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    info.purpose = kPurpose;
    Image fresh(device_, info);
    info.layers = 2;
    info.usage = VK_IMAGE_USAGE_STORAGE_BIT;
    Image scratch(device_, info);
    device_.retire(std::move(image_));
    device_.retire(std::move(scratch_));
    image_ = std::move(fresh);
    scratch_ = std::move(scratch);
    has_layout_ = false;

    const auto stored = [](std::uint32_t binding, const Image& image) {
        return DescriptorSets::image(binding, VK_NULL_HANDLE, image.view(), VK_IMAGE_LAYOUT_GENERAL);
    };
    const DescriptorSets::Write source =
        DescriptorSets::image(0, VK_NULL_HANDLE, maps.view(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    bindImages(edges_, std::array{source, stored(1, scratch_)});
    bindImages(along_x_, std::array{stored(0, scratch_)});
    bindImages(along_y_, std::array{source, stored(1, scratch_), stored(2, image_)});
}

void SmoothieMaps::bindImages(Pass& pass, std::span<const DescriptorSets::Write> images)
{
    pass.sets.reset(1);
    pass.set = pass.sets.take(kPurpose);
    pass.sets.write(pass.set, images);
}

void SmoothieMaps::begin(VkCommandBuffer commands)
{
    BarrierBatch barriers(device_, commands);
    for (const Image* const image : {&image_, &scratch_}) {
        ImageBarrier barrier;
        barrier.image = image->image();
        barrier.layer_count = image->info().layers;
        barrier.old_layout = has_layout_ ? VK_IMAGE_LAYOUT_GENERAL : VK_IMAGE_LAYOUT_UNDEFINED;
        barrier.new_layout = VK_IMAGE_LAYOUT_GENERAL;
        barrier.source_stages = kMapReaders; // the last frame's reads come first
        barrier.source_access = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
        barrier.target_stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
        barrier.target_access = VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
        barriers.add(barrier);
    }
    has_layout_ = true;
}

void SmoothieMaps::record(const MapJob& job)
{
    bool begun = false;
    const auto beginOnce = [&] {
        if (!begun) {
            begin(job.commands);
            begun = true;
        }
    };
    if (!has_layout_) {
        beginOnce(); // without a map there is something to bind
    }
    for (std::uint32_t i = 0; i < job.plan.views.size(); ++i) {
        if (job.of(i).draw) {
            beginOnce();
            const View& view = job.plan.views[i];
            recordMap(job.commands, view, redrawnArea(view, job.of(i).whole));
        }
    }
    if (begun) {
        MemoryBarrier barrier;
        barrier.source_stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
        barrier.source_access = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
        barrier.target_stages = kMapReaders;
        barrier.target_access = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
        recordBarrier(device_, job.commands, barrier);
    }
}

void SmoothieMaps::recordMap(VkCommandBuffer commands, const View& view, const VkRect2D& redrawn) const
{
    // A texel that was drawn anew may be an edge now, or be none any more, for all that it reaches; whether its
    // neighbours are edges depends on it, too.
    const std::int32_t touched = reach_ + 2;
    const VkRect2D area = widened(redrawn, view.place.tile, touched, touched);
    const VkRect2D rows = widened(area, view.place.tile, 0, reach_);
    dispatch(commands, edges_, view, widened(rows, view.place.tile, reach_, 0));
    recordBarrier(device_, commands, betweenPasses());
    dispatch(commands, along_x_, view, rows);
    recordBarrier(device_, commands, betweenPasses());
    dispatch(commands, along_y_, view, area);
    recordBarrier(device_, commands, betweenPasses());
}

void SmoothieMaps::dispatch(VkCommandBuffer commands, const Pass& pass, const View& view, const VkRect2D& area) const
{
    const auto at = [](std::uint32_t texel) {
        return static_cast<std::int32_t>(texel);
    };
    const Tile& tile = view.place.tile;
    const Push push{{at(tile.x), at(tile.y), at(tile.x + tile.width) - 1, at(tile.y + tile.height) - 1},
                    {area.offset.x, area.offset.y, at(tile.layer), reach_},
                    {quantum_, 0.0F, 0.0F, 0.0F}};
    device_.vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pass.pipeline.get());
    device_.vk.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pass.layout.get(), 0, 1, &pass.set, 0,
                                     nullptr);
    device_.vk.CmdPushConstants(commands, pass.layout.get(), VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof push, &push);
    device_.vk.CmdDispatch(commands, (area.extent.width + kGroup - 1) / kGroup,
                           (area.extent.height + kGroup - 1) / kGroup, 1);
}

} // namespace gnomon::vulkan
