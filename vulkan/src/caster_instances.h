// SPDX-License-Identifier: Apache-2.0
// The instance data of casters for caster.vert: rows that take an object's own points to a map, and in a pass of
// several views the map's layer.
#pragma once

#include <gnomon/plan.h>
#include <gnomon/vulkan/shadow_renderer.h>

#include <gnomon/vulkan/caster_drawer.h>

#include <cstdint>
#include <span>

namespace gnomon::vulkan {

/// Bytes: the rows, and for several views one more vec4, whose first four bytes are the layer. For maps of ids, which
/// never have several views, two more: the row of the depth beside the id, and the id.
[[nodiscard]] constexpr std::uint32_t instanceBytes(bool perspective, bool layered, bool ids = false)
{
    return (pack::casterRowCount(!perspective) + (layered ? 1U : 0U) + (ids ? 2U : 0U)) *
           static_cast<std::uint32_t>(sizeof(glm::vec4));
}

/// The places of objects, by index.
struct CasterPlaces {
    std::span<const Rows3x4> world_from_object;
    std::span<const float> biases_m; // beyond its end: 0

    [[nodiscard]] double bias_m(std::uint32_t object) const
    {
        return object < biases_m.size() ? static_cast<double>(biases_m[object]) : 0.0;
    }
};

/// For each object of `list`.
void writeInstances(const View& view, std::span<const std::uint32_t> list, const CasterPlaces& casters, glm::vec4* out);

/// Writes the instances of a pass of one view whose map holds ids.
void writeIdInstances(const MapPass& pass, std::span<const std::uint32_t> list, const CasterPlaces& casters,
                      glm::vec4* out);

/// Writes the instances of a pass of several views: `places` are those of casters in all their lists, one list after
/// the other.
void writeLayeredInstances(const MapPass& pass, std::span<const std::uint32_t> places, const CasterPlaces& casters,
                           glm::vec4* out);

} // namespace gnomon::vulkan
