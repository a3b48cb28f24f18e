// SPDX-License-Identifier: Apache-2.0
// The beginning of a pass over images.
#pragma once

#include "commands.h"

#include <span>

namespace gnomon::host {

[[nodiscard]] VkRenderingAttachmentInfo attachment(const Image& image, VkImageLayout layout, VkAttachmentLoadOp load);
/// `depth` may be null.
void beginRendering(VkCommandBuffer cmd, VkExtent2D extent, std::span<const VkRenderingAttachmentInfo> colours,
                    const VkRenderingAttachmentInfo* depth);
/// Viewport and scissor: all of it.
void setViewport(VkCommandBuffer cmd, VkExtent2D extent);

} // namespace gnomon::host
