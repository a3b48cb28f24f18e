// SPDX-License-Identifier: Apache-2.0
// Which of a light's views a strip of the screen shows.
#pragma once

#include <gnomon/pack/mask_draws.h>

namespace gnomon::pack {

/// Views of a light that count, as ranges of Plan::views.
struct ShownViews {
    std::uint32_t first = 0; // first view of the only position that is seen, or of the earlier one of both
    std::uint32_t count = 0;
    std::uint32_t later_first = 0;
    std::uint32_t later_count = 0; // 0: one position alone is seen
};
/// Nothing for a light without a map.
[[nodiscard]] ShownViews shownViews(const Plan& plan, const LightPlan& light, SunShown shown);
/// GpuLight::steps of a light.
[[nodiscard]] glm::vec4 stepRule(const SunSteps& steps);
/// Light `index` of the frame. A light of which nothing is shown is left as it is.
void fillLight(const Plan& plan, std::size_t index, SunShown shown, shared::GpuLight& out);

} // namespace gnomon::pack
