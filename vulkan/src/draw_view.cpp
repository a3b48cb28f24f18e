// SPDX-License-Identifier: Apache-2.0
#include "draw_view.h"

#include <gnomon/plan_views.h>

#include <algorithm>
#include <cassert>
#include <cstdio>

namespace gnomon::vulkan {

VkRect2D areaOf(const Tile& tile)
{
    return {{static_cast<std::int32_t>(tile.x), static_cast<std::int32_t>(tile.y)}, {tile.width, tile.height}};
}

void setViewport(const Device& device, VkCommandBuffer commands, const Tile& tile)
{
    const VkViewport viewport{static_cast<float>(tile.x),
                              static_cast<float>(tile.y),
                              static_cast<float>(tile.width),
                              static_cast<float>(tile.height),
                              0.0F,
                              1.0F};
    const VkRect2D area = areaOf(tile);
    device.vk.CmdSetViewport(commands, 0, 1, &viewport);
    device.vk.CmdSetScissor(commands, 0, 1, &area);
}

void beginViewLabel(const Device& device, VkCommandBuffer commands, const Plan& plan, std::uint32_t view)
{
    char label[64];
    std::snprintf(label, sizeof label, "shadow map of light %u, view %u", plan.views[view].light, view);
    device.beginLabel(commands, label);
}

MapPass passOf(const MapJob& job, std::uint32_t index, VkColorComponentFlags colour_mask)
{
    const View& view = job.plan.views[index];
    MapPass pass;
    pass.commands = job.commands;
    pass.formats = mapFormats(optionsOf(job.plan, view), view.projection.orthographic);
    pass.classic = job.classic;
    pass.plan = &job.plan;
    pass.view = &view;
    pass.view_index = index;
    pass.colour_mask = colour_mask;
    pass.clip_from_world = glm::mat4(view.projection.clip_from_world);
    pass.metric_ws = glm::vec4(view.projection.metric.metric_ws);
    if (view.projection.gpu_cascade != kNoIndex) {
        pass.placement = job.placements;
        pass.placement_offset = index * kPlacementStride;
    }
    return pass;
}

void drawView(const MapJob& job, std::uint32_t index, pack::CasterShare share, VkColorComponentFlags colour_mask)
{
    MapPass pass = passOf(job, index, colour_mask);
    pass.casters = pack::castersOf(job.plan, job.plan.views[index], share);
    job.draw(pass);
}

VkRect2D redrawnArea(const View& view, bool all)
{
    return areaOf(pack::redrawnPart(view, all));
}

VkRect2D widened(const VkRect2D& area, const Tile& tile, std::int32_t x, std::int32_t y)
{
    const auto from = [](std::int32_t begin, std::int32_t by, std::uint32_t low) {
        return std::max(begin - by, static_cast<std::int32_t>(low));
    };
    const auto to = [](std::int32_t begin, std::uint32_t size, std::int32_t by, std::uint32_t high) {
        return std::min(begin + static_cast<std::int32_t>(size) + by, static_cast<std::int32_t>(high));
    };
    const VkOffset2D first{from(area.offset.x, x, tile.x), from(area.offset.y, y, tile.y)};
    const VkOffset2D end{to(area.offset.x, area.extent.width, x, tile.x + tile.width),
                         to(area.offset.y, area.extent.height, y, tile.y + tile.height)};
    return {first, {static_cast<std::uint32_t>(end.x - first.x), static_cast<std::uint32_t>(end.y - first.y)}};
}

bool isDrawnTwice(const ResolvedOptions& options)
{
    return options.asked().faces == CasterFaces::midpoint;
}

bool isDrawnTogether(const Plan& plan, std::uint32_t view)
{
    return optionsOf(plan, plan.views[view]).cascades().pass == CascadePass::layered;
}

std::uint32_t drawnTogether(const Plan& plan, std::span<const pack::ViewWork> work, std::uint32_t first)
{
    const std::uint32_t most = isDrawnTogether(plan, first) ? viewsTogether(plan, first, true) : 1;
    std::uint32_t count = 0;
    while (count < most && work[first + count].draw) {
        ++count;
    }
    return std::max(count, 1U);
}

} // namespace gnomon::vulkan
