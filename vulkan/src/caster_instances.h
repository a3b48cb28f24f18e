// SPDX-License-Identifier: Apache-2.0
// What the instances of casters bring to caster.vert: rows that take an object's own points to a map, and of a
// pass of several views the layer that the map is.
#pragma once

#include <gnomon/plan.h>
#include <gnomon/vulkan/shadow_renderer.h>

#include <gnomon/vulkan/caster_drawer.h>

#include <cstdint>
#include <span>

namespace gnomon::vulkan {

/// Bytes: the rows, and of several views one more vec4, whose first four bytes are the layer.
[[nodiscard]] constexpr std::uint32_t instanceBytes(bool perspective, bool layered)
{
    return (pack::casterRowCount(!perspective) + (layered ? 1U : 0U)) * static_cast<std::uint32_t>(sizeof(glm::vec4));
}

/// For each handle of `list`, an index into `transforms`.
void writeInstances(const View& view, std::span<const std::uint32_t> list, std::span<const Rows3x4> transforms,
                    glm::vec4* out);

/// Of a pass of several views: `places` are those of casters in all their lists, one list after the other.
void writeLayeredInstances(const MapPass& pass, std::span<const std::uint32_t> places,
                           std::span<const Rows3x4> transforms, glm::vec4* out);

} // namespace gnomon::vulkan
