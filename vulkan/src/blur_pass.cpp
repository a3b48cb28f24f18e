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

BlurPass::BlurPass(FilterLayout& layout, const FilterConstants& constants, VkFormat format, BlurPath path)
    : layout_(layout), path_(path), radius_(static_cast<std::uint32_t>(constants.radius)),
      texel_bytes_(texelBytes(format)), logarithms_((constants.flags & shared::kMomentLogSpace) != 0),
      blocks_(layout.makeCompute(spirv::blur_blocks_comp, constants, "blocks to blur")),
      along_x_(makeDirection(constants, 0, format)), along_y_(makeDirection(constants, 1, format))
{
    assert(path != BlurPath::automatic && radius_ > 0 && constants.radius <= shared::kMostBlurRadius);
}

BlurPass::Direction BlurPass::makeDirection(FilterConstants constants, int axis, VkFormat format)
{
    constants.axis = axis;
    const char* name = axis == 0 ? "blur along x" : "blur along y";
    Direction direction;
    direction.pipeline = path_ == BlurPath::compute ? layout_.makeCompute(spirv::blur_comp, constants, name)
                                                    : layout_.makeFragment(spirv::blur_frag, constants, format, name);
    return direction;
}

void BlurPass::makeSets(const MomentImages& images)
{
    const Image& maps = images.maps;
    const Image& scratch = images.scratch;
    along_x_.set = layout_.makeSet(images.between(maps.level(0), scratch.level(0)));
    along_y_.set = layout_.makeSet(images.between(scratch.level(0), maps.level(0)));
}

void BlurPass::record(const FilterStep& step, const MomentImages& images) const
{
    recordBlocks(step);
    if (path_ == BlurPath::compute) {
        recordCompute(step);
    } else {
        recordFragment(step, images);
    }
}

void BlurPass::recordBlocks(const FilterStep& step) const
{
    const shared::FilterPassPlace place = placeOf(step);
    layout_.bind(step.commands, VK_PIPELINE_BIND_POINT_COMPUTE, blocks_.get(), along_x_.set, step.counts_offset, place);
    layout_.device().vk.CmdDispatch(step.commands, groupsOf(static_cast<std::uint32_t>(place.size.z), 8),
                                    groupsOf(static_cast<std::uint32_t>(place.size.w), 8), 1);
}

namespace {

/// From the maps to the scratch image, whose tile is at its corner.
shared::FilterPassPlace alongX(const FilterStep& step)
{
    shared::FilterPassPlace place = placeOf(step);
    place.target = {0, 0, 0, place.target.w};
    return place;
}
/// And back.
shared::FilterPassPlace alongY(const FilterStep& step)
{
    shared::FilterPassPlace place = placeOf(step);
    place.source = {0, 0, 0, place.source.w};
    return place;
}

} // namespace

void BlurPass::recordCompute(const FilterStep& step) const
{
    const Device& device = layout_.device();
    const auto dispatch = [&](const Direction& direction, const shared::FilterPassPlace& place) {
        waitForShaders(device, step.commands);
        layout_.bind(step.commands, VK_PIPELINE_BIND_POINT_COMPUTE, direction.pipeline.get(), direction.set,
                     step.counts_offset, place);
        device.vk.CmdDispatch(step.commands, static_cast<std::uint32_t>(place.size.z),
                              static_cast<std::uint32_t>(place.size.w), step.image_layers);
    };
    dispatch(along_x_, alongX(step));
    dispatch(along_y_, alongY(step));
    waitForShaders(device, step.commands);
}

void BlurPass::recordFragment(const FilterStep& step, const MomentImages& images) const
{
    const Device& device = layout_.device();
    MemoryBarrier barrier;
    // The map and the flags were written; and the scratch image was read for the view before.
    barrier.source_stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
    barrier.source_access = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
    barrier.target_stages = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
    barrier.target_access =
        VK_ACCESS_2_SHADER_SAMPLED_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_READ_BIT | kAttachmentAccess;
    recordBarrier(device, step.commands, barrier);
    for (std::uint32_t i = 0; i < step.image_layers; ++i) {
        shared::FilterPassPlace place = alongX(step);
        place.source.z += static_cast<int>(i);
        draw(step, along_x_, place, images.scratch, i);
    }
    // The map was read, the scratch image written.
    barrier.source_stages = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
    barrier.source_access = VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
    recordBarrier(device, step.commands, barrier);
    for (std::uint32_t i = 0; i < step.image_layers; ++i) {
        shared::FilterPassPlace place = alongY(step);
        place.source.z = static_cast<int>(i);
        draw(step, along_y_, place, images.maps, step.first_layer + i);
    }
    barrier.source_stages = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
    barrier.target_stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    barrier.target_access = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
    recordBarrier(device, step.commands, barrier);
}

void BlurPass::draw(const FilterStep& step, const Direction& direction, const shared::FilterPassPlace& place,
                    const Image& target, std::uint32_t layer) const
{
    const Device& device = layout_.device();
    const Tile area{layer, static_cast<std::uint32_t>(place.target.x), static_cast<std::uint32_t>(place.target.y),
                    step.tile.width, step.tile.height};
    VkRenderingAttachmentInfo colour{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    colour.imageView = target.layer(layer);
    colour.imageLayout = VK_IMAGE_LAYOUT_GENERAL;
    colour.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD; // blocks without casters stay as they are
    colour.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
    info.renderArea = areaOf(area);
    info.layerCount = 1;
    info.colorAttachmentCount = 1;
    info.pColorAttachments = &colour;
    device.vk.CmdBeginRendering(step.commands, &info);
    setViewport(device, step.commands, area);
    layout_.bind(step.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, direction.pipeline.get(), direction.set,
                 step.counts_offset, place);
    device.vk.CmdDraw(step.commands, 3, 1, 0, 0);
    device.vk.CmdEndRendering(step.commands);
}

FilterCost BlurPass::cost(const shared::BlurCounts& counts) const
{
    const std::uint64_t kernel = 2 * radius_ + 1;
    FilterCost cost;
    cost.path = path_;
    cost.texels = std::uint64_t{counts.blurred_x} + counts.blurred_y;
    std::uint64_t texels_read = cost.texels * kernel; // with a merged read for the two that it reads
    if (path_ == BlurPath::compute && !logarithms_) {
        // A thread's run of outputs shares its reads.
        cost.taps = texels_read = cost.texels * (shared::kBlurOutputs + 2 * radius_) / shared::kBlurOutputs;
    } else if (logarithms_) {
        cost.taps = texels_read;
    } else {
        // Of a block's 32 rows across the direction, the first and the last read texels one by one (blur.frag).
        const std::uint64_t merged = 1 + 2 * ((radius_ + 1) / 2);
        cost.taps = cost.texels * (15 * merged + kernel) / 16;
    }
    cost.taps += counts.filled;
    cost.bytes_moved = (texels_read + cost.texels + 2 * std::uint64_t{counts.filled}) * texel_bytes_;
    cost.bytes_minimum = 2 * cost.texels * texel_bytes_;
    return cost;
}

} // namespace gnomon::vulkan
