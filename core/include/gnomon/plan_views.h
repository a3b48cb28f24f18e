// SPDX-License-Identifier: Apache-2.0
// Questions about a plan's views: which of them a pixel reads, which of them one pass can draw, and which channels of
// the mask a light has.
#pragma once

#include <gnomon/export.h>
#include <gnomon/plan.h>

#include <cstdint>
#include <optional>
#include <span>

namespace gnomon {

/// The index of the options of the light that a view belongs to.
[[nodiscard]] inline std::uint32_t optionsIndexOf(const Plan& plan, const View& view)
{
    return plan.lights[view.light].options;
}
/// The options of the light that a view belongs to.
[[nodiscard]] inline const ResolvedOptions& optionsOf(const Plan& plan, const View& view)
{
    return (*plan.options)[optionsIndexOf(plan, view)];
}

/// The channels of its mask layer that belong to a light: bit i for channel i.
[[nodiscard]] constexpr std::uint32_t maskChannelsOf(const LightPlan& light)
{
    return light.mask_coloured ? 0xFU : 1U << light.mask_channel;
}
/// How many channels each layer of the plan's mask has: 1 or 4. One is enough for a single light without colours.
[[nodiscard]] GNOMON_API std::uint32_t maskChannelCount(const Plan& plan);

/// The position of a sun that counts for more in this frame's picture. With maps by turns, the position that is read.
[[nodiscard]] GNOMON_API SunPosition strongerPosition(const SunSteps& steps);

/// The weight of a stepping sun's later position (SunSteps), 0 .. 1, at `x` from the picture's left edge (0) to its
/// right (1). Precondition: steps.paired.
[[nodiscard]] GNOMON_API double laterWeight(const SunSteps& steps, double x);

/// The views of a light that belong to one of its sun's positions: a range of Plan::views. A receiver takes the first
/// of them that serves it. Empty where there is no map.
[[nodiscard]] GNOMON_API std::span<const View> viewsOf(const Plan& plan, std::uint32_t light, SunPosition sun);

/// Texels that a view draws in its tile and in its kept layer: none where its map is up to date.
[[nodiscard]] GNOMON_API std::uint64_t texelsToDraw(const View& view);
/// The place of a point on a view's map: -1 .. 1 over its tile, x right and y down, and beyond that outside the tile.
/// Nothing for a point behind the map, which for a paraboloid is only the direction straight behind.
[[nodiscard]] GNOMON_API std::optional<glm::dvec2> placeOnMap(const View& view, const glm::dvec3& p_ws);
/// The depth that the map would store for a point: d' as DepthMetric has it, 0 at the near distance and 1 at the far
/// one, not clamped.
[[nodiscard]] GNOMON_API double depthOnMap(const View& view, const glm::dvec3& p_ws);

/// How many views from `first` on one pass can draw that sends each caster to its layers, 1 to kMaxCascades. They are
/// cascades of one light that are drawn whole and at once, at one place of consecutive layers and with the same
/// pipelines. `all`: views that need not be drawn again are drawn too. 1 also where `first` itself is not to be drawn.
[[nodiscard]] GNOMON_API std::uint32_t viewsTogether(const Plan& plan, std::uint32_t first, bool all = false);

} // namespace gnomon
