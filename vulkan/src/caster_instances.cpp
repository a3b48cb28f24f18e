// SPDX-License-Identifier: Apache-2.0
#include "caster_instances.h"

#include <glm/gtc/matrix_access.hpp>

#include <array>
#include <cassert>
#include <cstddef>
#include <cstring>

namespace gnomon::vulkan {
namespace {

// Rows of a view's map, in the order in which an instance brings them.
struct MapRows {
    std::array<glm::dvec4, instanceRows(true)> rows{};
    std::uint32_t count = 0;
};

MapRows rowsOf(const View& view)
{
    const auto row = [&](int i) {
        return glm::row(view.clip_from_world, i);
    };
    const glm::dvec4 metric = view.metric.metric_ws;
    if (view.orthographic) {
        return {{row(0), row(1), metric}, 3};
    }
    return {{row(0), row(1), row(2), row(3), metric}, 5};
}

// Row vector of the map times an object's transform: what the vertex shader multiplies the object's own points by.
glm::vec4 composed(const glm::dvec4& row, const Rows3x4& t)
{
    return {row.x * glm::dvec4(t.x) + row.y * glm::dvec4(t.y) + row.z * glm::dvec4(t.z) +
            glm::dvec4(0.0, 0.0, 0.0, row.w)};
}

glm::vec4* write(const MapRows& map, const Rows3x4& t, glm::vec4* out)
{
    for (std::uint32_t i = 0; i < map.count; ++i) {
        *out++ = composed(map.rows[i], t);
    }
    return out;
}

} // namespace

void writeInstances(const View& view, std::span<const std::uint32_t> list, std::span<const Rows3x4> transforms,
                    glm::vec4* out)
{
    const MapRows map = rowsOf(view);
    for (const std::uint32_t handle : list) {
        out = write(map, transforms[handle], out);
    }
}

void writeLayeredInstances(const MapPass& pass, std::span<const std::uint32_t> places,
                           std::span<const Rows3x4> transforms, glm::vec4* out)
{
    assert(pass.view_count <= kMaxCascades);
    std::array<MapRows, kMaxCascades> maps;
    std::array<std::size_t, kMaxCascades + 1> begins{};
    for (std::uint32_t i = 0; i < pass.view_count; ++i) {
        maps[i] = rowsOf(pass.plan->views[pass.view_index + i]);
        begins[i + 1] = begins[i] + pass.castersOf(i).size();
    }
    for (const std::uint32_t place : places) {
        std::uint32_t layer = 0;
        while (place >= begins[layer + 1]) {
            ++layer;
        }
        out = write(maps[layer], transforms[pass.castersOf(layer)[place - begins[layer]]], out);
        *out = glm::vec4(0.0F);
        std::memcpy(out++, &layer, sizeof layer);
    }
}

} // namespace gnomon::vulkan
