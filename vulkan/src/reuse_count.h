// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gnomon/vulkan/shadow_renderer.h>

namespace gnomon::vulkan {

/// What recording the maps of this plan draws and what it does not; `all`: whatever the plan says, every map is drawn.
/// A filterable map is restored whole.
[[nodiscard]] MapReuse countReuse(const Plan& plan, bool all, bool filterable, CascadePass pass);

} // namespace gnomon::vulkan
