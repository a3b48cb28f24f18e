// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gnomon/pack/map_notes.h>
#include <gnomon/vulkan/shadow_renderer.h>

namespace gnomon::vulkan {

/// Counts the maps that recording this plan draws, and those that it does not. A filterable map is restored whole.
[[nodiscard]] MapReuse countReuse(const Plan& plan, std::span<const pack::ViewWork> work);

} // namespace gnomon::vulkan
