// SPDX-License-Identifier: Apache-2.0
// Which of a plan's views a picture is made of, for who asks what one pixel reads; which of them one pass can draw, for
// who draws them; and which channels of the mask a light has.
#pragma once

#include <gnomon/export.h>
#include <gnomon/plan.h>

#include <cstdint>
#include <optional>
#include <span>

namespace gnomon {

/// The options of the light that a view belongs to: as index, and as value.
[[nodiscard]] inline std::uint32_t optionsIndexOf(const Plan& plan, const View& view)
{
    return plan.lights[view.light].options;
}
/// The options themselves.
[[nodiscard]] inline const ResolvedOptions& optionsOf(const Plan& plan, const View& view)
{
    return (*plan.options)[optionsIndexOf(plan, view)];
}

/// The channels of its mask layer that are a light's: bit i for channel i.
[[nodiscard]] constexpr std::uint32_t maskChannelsOf(const LightPlan& light)
{
    return light.mask_coloured ? 0xFU : 1U << light.mask_channel;
}
/// How many channels each layer of the plan's mask has: 1 or 4. One is enough for a single light without colours.
[[nodiscard]] GNOMON_API std::uint32_t maskChannelCount(const Plan& plan);

/// The position of a sun that says more of this frame's picture; by turns, the one that is read.
[[nodiscard]] GNOMON_API SunPosition strongerPosition(const SunSteps& steps);

/// What the later one of a stepping sun's positions counts for, 0 .. 1, at `x` from the picture's left edge (0) to its
/// right (1): the weight of SunSteps. Precondition: steps.paired.
[[nodiscard]] GNOMON_API double laterWeight(const SunSteps& steps, double x);

/// The views of a light that belong to one of its sun's positions: a range of Plan::views, of which a receiver takes
/// the first that has it. Empty where there is no map.
[[nodiscard]] GNOMON_API std::span<const View> viewsOf(const Plan& plan, std::uint32_t light, SunPosition sun);

/// Texels of its tile, and of the kept layer beside, that a view has drawn: none where its map holds what it should.
[[nodiscard]] GNOMON_API std::uint64_t texelsToDraw(const View& view);
/// Where a view's map has a point: -1 .. 1 over its tile, x right and y down, beyond that beside it. Nothing for a
/// point behind the map, which of a paraboloid is the one direction straight behind.
[[nodiscard]] GNOMON_API std::optional<glm::dvec2> placeOnMap(const View& view, const glm::dvec3& p_ws);
/// What the map would store there if it could: d' as DepthMetric has it, 0 at the near distance and 1 at the far one.
[[nodiscard]] GNOMON_API double depthOnMap(const View& view, const glm::dvec3& p_ws);

/// How many views from `first` on one pass can draw that says for each caster which layer it goes to, 1 to
/// kMaxCascades: cascades of one light that are drawn whole and at once, at one place of consecutive layers and by the
/// same pipelines. `all`: views that say they need not be drawn again are drawn too. 1 also where `first` itself is not
/// to be drawn.
[[nodiscard]] GNOMON_API std::uint32_t viewsTogether(const Plan& plan, std::uint32_t first, bool all = false);

} // namespace gnomon
