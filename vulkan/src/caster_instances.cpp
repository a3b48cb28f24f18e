// SPDX-License-Identifier: Apache-2.0
#include "caster_instances.h"

#include <array>
#include <cassert>
#include <cstddef>
#include <cstring>

namespace gnomon::vulkan {

void writeInstances(const View& view, std::span<const std::uint32_t> list, const CasterPlaces& casters, glm::vec4* out)
{
    const pack::CasterRows rows(view);
    for (const std::uint32_t object : list) {
        out = rows.write(casters.world_from_object[object], out, casters.bias_m(object));
    }
}

void writeIdInstances(const MapPass& pass, std::span<const std::uint32_t> list, const CasterPlaces& casters,
                      glm::vec4* out)
{
    const pack::CasterRows rows(*pass.view);
    for (const std::uint32_t object : list) {
        const pack::CasterId caster = pack::casterIdOf(*pass.plan, *pass.view, object);
        out = rows.write(casters.world_from_object[object], out, casters.bias_m(object));
        *out++ = pack::composedRow(caster.depth_ws, casters.world_from_object[object]);
        *out++ = glm::vec4(caster.id, caster.ids, 0.0F, 0.0F); // the third: piece 0 of objects that have but one id
    }
}

void writeLayeredInstances(const MapPass& pass, std::span<const std::uint32_t> places, const CasterPlaces& casters,
                           glm::vec4* out)
{
    assert(pass.view_count <= kMaxCascades);
    std::array<pack::CasterRows, kMaxCascades> maps;
    std::array<std::size_t, kMaxCascades + 1> begins{};
    for (std::uint32_t i = 0; i < pass.view_count; ++i) {
        maps[i] = pack::CasterRows(pass.plan->views[pass.view_index + i]);
        begins[i + 1] = begins[i] + pass.castersOf(i).size();
    }
    for (const std::uint32_t place : places) {
        std::uint32_t layer = 0;
        while (place >= begins[layer + 1]) {
            ++layer;
        }
        const std::uint32_t object = pass.castersOf(layer)[place - begins[layer]];
        out = maps[layer].write(casters.world_from_object[object], out, casters.bias_m(object));
        *out = glm::vec4(0.0F);
        std::memcpy(out++, &layer, sizeof layer);
    }
}

} // namespace gnomon::vulkan
