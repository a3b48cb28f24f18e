// SPDX-License-Identifier: Apache-2.0
#include "fin_maps.h"

#include "draw_view.h"
#include "samplers.h"

#include <gnomon/pack/filter_rule.h>

#include <gnomon/shared/smoothies.h>

#include <array>

namespace gnomon::vulkan {
namespace {

constexpr const char* kPurpose = "smoothies";
constexpr std::array kMapType{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER};

MapPassFormats finFormats()
{
    MapPassFormats formats;
    formats.colour = kFinFormat;
    formats.depth = kFinOrderFormat;
    return formats;
}

} // namespace

FinMaps::FinMaps(Device& device, const ResolvedOptions& options, const DrawFins& draw)
    : device_(device), draw_(draw), reach_(static_cast<std::int32_t>(options.asked().smoothies.reach_texels)),
      quantum_(pack::depthQuantum(options.format())), nearest_(makeSampler(device, VK_FILTER_NEAREST)),
      sets_(device, kMapType, VK_SHADER_STAGE_FRAGMENT_BIT)
{
}

void FinMaps::setMaps(const Image& maps)
{
    ImageInfo info;
    info.format = kFinFormat;
    info.extent = maps.info().extent;
    info.layers = maps.info().layers;
    info.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    info.purpose = kPurpose;
    Image fresh(device_, info);
    Image depth(device_, {kFinOrderFormat, info.extent, 1, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
                          VK_IMAGE_ASPECT_DEPTH_BIT, kPurpose});
    device_.retire(std::move(image_));
    device_.retire(std::move(depth_));
    image_ = std::move(fresh);
    depth_ = std::move(depth);
    has_layout_ = false;

    sets_.reset(1); // frames in flight may use the one that was there
    set_ = sets_.take(kPurpose);
    const DescriptorSets::Write read =
        DescriptorSets::image(0, nearest_.get(), maps.view(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    sets_.write(set_, {&read, 1});
}

void FinMaps::begin(VkCommandBuffer commands)
{
    ImageBarrier barrier;
    barrier.image = image_.image();
    barrier.layer_count = image_.info().layers;
    barrier.old_layout = has_layout_ ? VK_IMAGE_LAYOUT_GENERAL : VK_IMAGE_LAYOUT_UNDEFINED;
    barrier.new_layout = VK_IMAGE_LAYOUT_GENERAL;
    barrier.source_stages =
        kMapReaders | VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT; // the last frame's come first
    barrier.source_access = VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
    barrier.target_stages = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT | kMapReaders;
    barrier.target_access = VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT |
                            VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
    recordBarrier(device_, commands, barrier);
    has_layout_ = true;
}

/// All maps use the one image that says which fin is kept.
void FinMaps::awaitMap(VkCommandBuffer commands) const
{
    ImageBarrier barrier;
    barrier.image = depth_.image();
    barrier.aspect = VK_IMAGE_ASPECT_DEPTH_BIT;
    barrier.new_layout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
    barrier.source_stages = kDepthStages;
    barrier.source_access = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
    barrier.target_stages = kDepthStages;
    barrier.target_access = kDepthAccess;
    recordBarrier(device_, commands, barrier);
}

void FinMaps::record(const MapJob& job)
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
    bool drawn = false;
    for (std::uint32_t i = 0; i < job.plan.views.size(); ++i) {
        if (job.of(i).draw) {
            beginOnce();
            recordMap(job, i);
            drawn = true;
        }
    }
    if (drawn) {
        MemoryBarrier barrier;
        barrier.source_stages = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
        barrier.source_access = VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
        barrier.target_stages = kMapReaders;
        barrier.target_access = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
        recordBarrier(device_, job.commands, barrier);
    }
}

/// Where what is drawn anew may change what lies over a texel or what it shows: of what moves and of what stands still.
void FinMaps::recordMap(const MapJob& job, std::uint32_t index) const
{
    const View& view = job.plan.views[index];
    // A fin reaches so far beyond its edge, and a texel's lean is its neighbours'.
    const VkRect2D area = widened(redrawnArea(view, job.of(index).whole), view.place.tile, reach_ + 2, reach_ + 2);
    awaitMap(job.commands);
    beginViewLabel(device_, job.commands, job.plan, index);
    VkRenderingAttachmentInfo colour{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    colour.imageView = image_.layer(view.place.tile.layer);
    colour.imageLayout = VK_IMAGE_LAYOUT_GENERAL;
    colour.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    colour.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    colour.clearValue.color.uint32[0] = static_cast<std::uint32_t>(shared::packSmoothie({1.0F, -1.0F}));
    VkRenderingAttachmentInfo depth{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    depth.imageView = depth_.layer(0);
    depth.imageLayout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
    depth.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    depth.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    depth.clearValue.depthStencil = {1.0F, 0};
    VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
    info.renderArea = area;
    info.layerCount = 1;
    info.colorAttachmentCount = 1;
    info.pColorAttachments = &colour;
    info.pDepthAttachment = &depth;
    device_.vk.CmdBeginRendering(job.commands, &info);
    setViewport(device_, job.commands, view.place.tile);
    device_.vk.CmdSetScissor(job.commands, 0, 1, &area);
    FinPass pass{passOf(job, index, VK_COLOR_COMPONENT_R_BIT), set_, quantum_};
    pass.map.formats = finFormats();
    pass.map.classic = nullptr;
    pass.map.casters = pack::castersOf(job.plan, view, pack::CasterShare::all);
    draw_(pass);
    device_.vk.CmdEndRendering(job.commands);
    device_.endLabel(job.commands);
}

} // namespace gnomon::vulkan
