// SPDX-License-Identifier: Apache-2.0
// Shared steps of all passes that draw a view's casters.
#pragma once

#include "map_recorder.h"

namespace gnomon::vulkan {

inline constexpr VkPipelineStageFlags2 kDepthStages =
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;
inline constexpr VkAccessFlags2 kDepthAccess =
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
// Maps are read by our mask pass and by hosts that shade from them.
inline constexpr VkPipelineStageFlags2 kMapReaders =
    VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;

[[nodiscard]] VkRect2D areaOf(const Tile& tile);
/// Viewport and scissor.
void setViewport(const Device& device, VkCommandBuffer commands, const Tile& tile);
void beginViewLabel(const Device& device, VkCommandBuffer commands, const Plan& plan, std::uint32_t view);
/// The pass of a view, without its casters.
[[nodiscard]] MapPass passOf(const MapJob& job, std::uint32_t view, VkColorComponentFlags colour_mask);
/// Calls the host's callback for them. Rendering has begun.
void drawView(const MapJob& job, std::uint32_t view, pack::CasterShare share, VkColorComponentFlags colour_mask);
/// The part of the map's tile that is drawn again: all of it, or ViewContents::dirty for a map that is restored.
[[nodiscard]] VkRect2D redrawnArea(const View& view, bool all);
/// `area` widened by x and y texels on each side, within the tile.
[[nodiscard]] VkRect2D widened(const VkRect2D& area, const Tile& tile, std::int32_t x, std::int32_t y);
/// Are the casters of a map drawn in two passes, one for each of their first two surfaces?
[[nodiscard]] bool isDrawnTwice(const ResolvedOptions& options);
/// Do the options of the view's light ask for passes of several views?
[[nodiscard]] bool isDrawnTogether(const Plan& plan, std::uint32_t view);
/// How many views from `first` on one pass draws (viewsTogether()), of those that are to be drawn; 1 where the options
/// ask for one pass each.
[[nodiscard]] std::uint32_t drawnTogether(const Plan& plan, std::span<const pack::ViewWork> work, std::uint32_t first);

} // namespace gnomon::vulkan
