// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "device.h"

namespace gnomon::vulkan {

/// Clamps to the edge; linear between mip levels, too, if it is linear.
[[nodiscard]] Sampler makeSampler(Device& device, VkFilter filter);

} // namespace gnomon::vulkan
