// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/window/canvas.h"

#include <vulkan/vulkan.h>

namespace gnomon::host {

/// Copies a part of a canvas to `target`, which is to be written by copies, as its layout says.
void recordCanvas(VkCommandBuffer commands, const Canvas& canvas, const PicturePlace& place, VkImage target);

} // namespace gnomon::host
