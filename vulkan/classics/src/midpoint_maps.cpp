// SPDX-License-Identifier: Apache-2.0
#include "midpoint_maps.h"

#include "barriers.h"
#include "draw_view.h"
#include "kept_depth.h"
#include "pipelines.h"
#include "samplers.h"

#include <gnomon/vulkan/classic_pass.h>

#include <gnomon_classic_spirv.h>
#include <gnomon_spirv.h>

#include <algorithm>

namespace gnomon::vulkan {
namespace {

constexpr VkShaderStageFlags kStage = VK_SHADER_STAGE_FRAGMENT_BIT;
constexpr std::array kTwo{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER};

ImageBarrier barrierOf(const Image& surface)
{
    ImageBarrier barrier;
    barrier.image = surface.image();
    barrier.aspect = VK_IMAGE_ASPECT_DEPTH_BIT;
    return barrier;
}

} // namespace

MidpointMaps::MidpointMaps(Device& device, const MapStorage& storage, VkPipelineCache cache)
    : device_(device), storage_(storage), sampler_(makeSampler(device, VK_FILTER_NEAREST)),
      first_sets_(device, std::span(kTwo).first(1), kStage), both_sets_(device, kTwo, kStage),
      layout_(makePipelineLayout(device, both_sets_.layout(), kStage, 0))
{
    const ShaderModule vertex = makeShader(device, spirv::mask_vert);
    const ShaderModule fragment = makeShader(device, spirv::midpoint_frag);
    const TwoStages stages = stagesOf(vertex, fragment);
    GraphicsState state;
    state.stages = stages;
    state.layout = layout_.get();
    state.depth_format = storage.depth;
    state.cache = cache;
    state.name = "midpoint";
    pipeline_ = makeGraphicsPipeline(device, state);
}

void MidpointMaps::cover(VkExtent2D page)
{
    const VkExtent2D have = surfaces_[1] ? surfaces_[1].info().extent : VkExtent2D{};
    if (have.width >= page.width && have.height >= page.height) {
        return;
    }
    const VkExtent2D extent{std::max(have.width, page.width), std::max(have.height, page.height)};
    for (Image& surface : surfaces_) {
        device_.retire(std::move(surface));
        surface = Image(device_, {storage_.depth, extent, 1,
                                  VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
                                  VK_IMAGE_ASPECT_DEPTH_BIT, "shadow map depth"});
    }
    const auto read = [&](std::uint32_t binding) {
        return DescriptorSets::image(binding, sampler_.get(), surfaces_[binding].layer(0),
                                     VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    };
    const std::array reads{read(0), read(1)};
    first_sets_.reset(1); // frames in flight may use the sets that were there
    first_ = first_sets_.take("first surface");
    first_sets_.write(first_, std::span(reads).first(1));
    both_sets_.reset(1);
    both_ = both_sets_.take("surfaces");
    both_sets_.write(both_, reads);
}

void MidpointMaps::beginSurface(VkCommandBuffer commands, const Image& surface, const Tile& tile) const
{
    ImageBarrier barrier = barrierOf(surface); // the last map's contents are not needed
    barrier.new_layout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
    barrier.source_stages = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
    barrier.target_stages = kDepthStages;
    barrier.target_access = kDepthAccess;
    recordBarrier(device_, commands, barrier);
    beginDepthRendering(device_, commands, tile, surface.layer(0), VK_ATTACHMENT_LOAD_OP_CLEAR);
}

void MidpointMaps::makeReadable(VkCommandBuffer commands, const Image& surface) const
{
    ImageBarrier barrier = barrierOf(surface);
    barrier.old_layout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
    barrier.new_layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    barrier.source_stages = kDepthStages;
    barrier.source_access = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
    barrier.target_stages = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
    barrier.target_access = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
    recordBarrier(device_, commands, barrier);
}

void MidpointMaps::drawCasters(const MapJob& job, std::uint32_t view)
{
    const VkCommandBuffer commands = job.commands;
    const Tile& tile = job.plan.views[view].place.tile;
    ClassicPass behind = job.classic != nullptr ? *job.classic : ClassicPass{};
    behind.formats.behind_first = true;
    behind.first_surface = first_;
    behind.first_quantum = depthRounding(storage_.depth);
    MapPass pass = passOf(job, view, 0);
    pass.casters = pack::castersOf(job.plan, job.plan.views[view], pack::CasterShare::all);
    for (const Image& surface : surfaces_) {
        beginSurface(commands, surface, tile);
        job.draw(pass);
        device_.vk.CmdEndRendering(commands);
        makeReadable(commands, surface);
        pass.classic = &behind;
    }
}

void MidpointMaps::drawMap(VkCommandBuffer commands) const
{
    device_.vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_.get());
    device_.vk.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_.get(), 0, 1, &both_, 0,
                                     nullptr);
    device_.vk.CmdDraw(commands, 3, 1, 0, 0);
}

} // namespace gnomon::vulkan
