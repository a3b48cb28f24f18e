// SPDX-License-Identifier: Apache-2.0
// The weights of the blur.
#pragma once

#include <gnomon/moment_options.h>

#include <filter_pass.h>

namespace gnomon::vulkan {

/// Normalised in double precision: the weights of all texels add up to 1. Precondition: blurRadius(options) > 0.
[[nodiscard]] shared::BlurKernel blurKernel(const MomentOptions& options);

} // namespace gnomon::vulkan
