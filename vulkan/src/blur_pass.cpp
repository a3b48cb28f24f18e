// SPDX-License-Identifier: Apache-2.0
#include "blur_pass.h"

#include "barriers.h"
#include "draw_view.h"
#include <gnomon/pack/filter_rule.h>

#include <gnomon_spirv.h>

#include <cassert>

namespace gnomon::vulkan {
namespace {

std::uint32_t texelBytes(VkFormat format)
{
    switch (format) {
    case VK_FORMAT_R16_SFLOAT:
        return 2;
    case VK_FORMAT_R32_SFLOAT:
    case VK_FORMAT_R16G16_UNORM:
    case VK_FORMAT_R16G16_SFLOAT:
        return 4;
    case VK_FORMAT_R32G32B32A32_SFLOAT:
        return 16;
    default: // two of 32 bits, four of 16
        return 8;
    }
}

constexpr VkAccessFlags2 kAttachmentAccess =
    VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;

} // namespace

BlurPass::BlurPass(FilterLayout& layout, const ResolvedOptions& options, VkFormat format)
    : layout_(layout), moments_(options.moments()),
      path_(moments_.blur_path == BlurPath::automatic ? BlurPath::compute : moments_.blur_path),
      radius_(blurRadius(moments_)), texel_bytes_(texelBytes(format)),
      image_layers_(imageLayersPerMap(options.filter(), moments_))
{
    assert(radius_ > 0 && radius_ <= shared::kMostBlurRadius);
    const pack::FilterConstants constants = pack::filterConstants(options);
    logarithms_ = (constants.flags & shared::kMomentLogSpace) != 0;
    along_x_ = layout.makeCompute(moments_.samples == 1 ? spirv::blur_moments_comp : spirv::blur_moments_samples_comp,
                                  constants, "moments blurred along x");
    blocks_ = layout.makeCompute(spirv::blur_blocks_comp, constants, "blocks to blur");
    along_y_ = path_ == BlurPath::compute ? layout.makeCompute(spirv::blur_comp, constants, "blur along y")
                                          : layout.makeFragment(spirv::blur_frag, constants, format, "blur along y");
}

void BlurPass::makeSets(const MomentImages& images)
{
    FilterBindings along_x = images.between(images.depth.layer(0), images.scratch.level(0));
    along_x.source_is_depth = true;
    set_x_ = layout_.makeSet(along_x);
    set_y_ = layout_.makeSet(images.between(images.scratch.level(0), images.maps.level(0)));
}

namespace {

/// Clears the flags of blocks. Both kinds of shaders read the last view's flags and scratch image.
void clearFlags(const Device& device, VkCommandBuffer commands, VkBuffer blocks)
{
    MemoryBarrier barrier;
    barrier.source_stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
    barrier.target_stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
    barrier.target_access = VK_ACCESS_2_TRANSFER_WRITE_BIT;
    recordBarrier(device, commands, barrier);
    device.vk.CmdFillBuffer(commands, blocks, 0, VK_WHOLE_SIZE, 0);
    barrier.source_stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
    barrier.source_access = VK_ACCESS_2_TRANSFER_WRITE_BIT;
    barrier.target_stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    barrier.target_access = VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
    recordBarrier(device, commands, barrier);
}

} // namespace

void BlurPass::record(const FilterStep& step, const MomentImages& images) const
{
    const Device& device = layout_.device();
    clearFlags(device, step.commands, images.blocks.buffer());
    const shared::FilterPassPlace place = pack::placeFromDepths(step);
    layout_.bind(step.commands, VK_PIPELINE_BIND_POINT_COMPUTE, along_x_.get(), set_x_, step.counts_offset, place);
    device.vk.CmdDispatch(step.commands, static_cast<std::uint32_t>(place.size.z),
                          static_cast<std::uint32_t>(place.size.w), step.image_layers);
    waitForShaders(device, step.commands);
    recordBlocks(step);
    if (path_ == BlurPath::compute) {
        recordCompute(step);
    } else {
        recordFragment(step, images);
    }
}

void BlurPass::recordBlocks(const FilterStep& step) const
{
    const shared::FilterPassPlace place = pack::placeOf(step);
    layout_.bind(step.commands, VK_PIPELINE_BIND_POINT_COMPUTE, blocks_.get(), set_y_, step.counts_offset, place);
    layout_.device().vk.CmdDispatch(step.commands, pack::groupsOf(static_cast<std::uint32_t>(place.size.z), 8),
                                    pack::groupsOf(static_cast<std::uint32_t>(place.size.w), 8), 1);
}

void BlurPass::recordCompute(const FilterStep& step) const
{
    const Device& device = layout_.device();
    const shared::FilterPassPlace place = pack::placeOf(step);
    waitForShaders(device, step.commands);
    layout_.bind(step.commands, VK_PIPELINE_BIND_POINT_COMPUTE, along_y_.get(), set_y_, step.counts_offset, place);
    device.vk.CmdDispatch(step.commands, static_cast<std::uint32_t>(place.size.z),
                          static_cast<std::uint32_t>(place.size.w), step.image_layers);
    waitForShaders(device, step.commands);
}

void BlurPass::recordFragment(const FilterStep& step, const MomentImages& images) const
{
    const Device& device = layout_.device();
    MemoryBarrier barrier;
    // The scratch image and the flags were written.
    barrier.source_stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    barrier.source_access = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
    barrier.target_stages = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
    barrier.target_access =
        VK_ACCESS_2_SHADER_SAMPLED_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_READ_BIT | kAttachmentAccess;
    recordBarrier(device, step.commands, barrier);
    for (std::uint32_t i = 0; i < step.image_layers; ++i) {
        const Tile area{step.first_layer + i, step.tile.x, step.tile.y, step.tile.width, step.tile.height};
        VkRenderingAttachmentInfo colour{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
        colour.imageView = images.maps.layer(area.layer);
        colour.imageLayout = VK_IMAGE_LAYOUT_GENERAL;
        colour.loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
        colour.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
        VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
        info.renderArea = areaOf(area);
        info.layerCount = 1;
        info.colorAttachmentCount = 1;
        info.pColorAttachments = &colour;
        shared::FilterPassPlace place = pack::placeOf(step);
        place.source.z = static_cast<int>(i);
        device.vk.CmdBeginRendering(step.commands, &info);
        setViewport(device, step.commands, area);
        layout_.bind(step.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, along_y_.get(), set_y_, step.counts_offset, place);
        device.vk.CmdDraw(step.commands, 3, 1, 0, 0);
        device.vk.CmdEndRendering(step.commands);
    }
    // The map was written, the scratch image read.
    barrier.source_stages = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
    barrier.source_access = VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
    barrier.target_stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    barrier.target_access = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
    recordBarrier(device, step.commands, barrier);
}

FilterCost BlurPass::cost(const shared::BlurCounts& counts) const
{
    constexpr std::uint64_t kDepthBytes = 4;
    constexpr std::uint64_t kBlock = shared::kBlockTexels;
    const std::uint64_t blurred = counts.blurred;
    const std::uint64_t all = blurred + counts.filled;
    const std::uint64_t of_slope = moments_.derivative_variance ? 4 : 0;
    // A thread's walk through a block begins and ends a radius beyond it.
    const std::uint64_t depths_read = all * (kBlock + 2 * radius_) / kBlock * (moments_.samples + of_slope);
    std::uint64_t texels_read = blurred * (kBlock + 2 * radius_) / kBlock;
    FilterCost cost;
    cost.path = path_;
    cost.texels = all + blurred;
    cost.taps = depths_read + texels_read;
    if (path_ == BlurPath::fragment) {
        texels_read = blurred * (2 * radius_ + 1);
        const std::uint64_t filtered = 1 + 2 * ((radius_ + 1) / 2); // reads of two texels each
        cost.taps = depths_read + (logarithms_ ? texels_read : blurred * filtered);
    }
    cost.bytes_moved = depths_read * kDepthBytes + (texels_read + 2 * all) * texel_bytes_;
    cost.bytes_minimum = all / image_layers_ * moments_.samples * kDepthBytes + (2 * blurred + all) * texel_bytes_;
    return cost;
}

} // namespace gnomon::vulkan
