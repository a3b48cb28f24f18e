// SPDX-License-Identifier: Apache-2.0
// From the options of a filterable map to the numbers that its shaders get: what is left open is filled in here.
#pragma once

#include <gnomon/vulkan/shadow_renderer.h>

#include <moment_rule.h>

namespace gnomon::vulkan {

[[nodiscard]] bool isFilterable(Filter filter);
/// Precondition: refusal(filter.filter, filter.format, filter.moments) is nothing.
[[nodiscard]] shared::MomentRule momentRuleOf(const FilterOptions& filter);

} // namespace gnomon::vulkan
