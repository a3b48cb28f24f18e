// SPDX-License-Identifier: Apache-2.0
// Where on the screen which views of a stepping sun are seen. A pixel outside of the band that joins two positions must
// not pay for both, whatever a device makes of branches: so a layer of the mask is drawn in upright strips, each with
// what it needs alone.
#pragma once

#include <gnomon/plan.h>

#include <gpu_structs.h>

#include <array>

namespace gnomon::vulkan {

/// Views of a light that count, as ranges of Plan::views.
struct ShownViews {
    std::uint32_t first = 0; // of the only position that is seen, or the earlier one of both
    std::uint32_t count = 0;
    std::uint32_t later_first = 0;
    std::uint32_t later_count = 0; // 0: one position alone is seen
};

/// Which positions of the sun.
enum class SunShown : std::uint8_t { all, earlier, later };
/// Nothing for a light without a map.
[[nodiscard]] ShownViews shownViews(const Plan& plan, const LightPlan& light, SunShown shown);

/// A strip of the screen.
struct MaskRegion {
    std::uint32_t begin = 0; // pixels, x
    std::uint32_t end = 0;
    std::array<SunShown, shared::kLightsPerLayer> shown{}; // by mask channel
};
struct MaskRegions {
    static constexpr std::uint32_t kMost = 2 * shared::kLightsPerLayer + 1;
    std::array<MaskRegion, kMost> regions;
    std::uint32_t count = 0;

    [[nodiscard]] const MaskRegion* begin() const { return regions.data(); }
    [[nodiscard]] const MaskRegion* end() const { return regions.data() + count; }
};
/// They cover a screen of this width, from left to right.
[[nodiscard]] MaskRegions maskRegions(const Plan& plan, std::uint32_t layer, std::uint32_t width);

/// GpuMaskLayer::steps of a light.
[[nodiscard]] glm::vec4 stepRule(const SunSteps& steps);

} // namespace gnomon::vulkan
