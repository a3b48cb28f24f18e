// SPDX-License-Identifier: Apache-2.0
#include "host/view.h"
#include "scene/state.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace gnomon::host {
namespace {

struct Corner {
    std::uint64_t place = 0;
    std::uint32_t object = 0;
    glm::vec3 normal_ws{0.0F};
};

/// Places are told apart by a millionth of the scene's longest side: the same corner by two transforms is off by less.
std::uint64_t placeOf(const glm::vec3& p_ws, const Aabb& bounds_ws)
{
    constexpr double kCells = (1U << 20U) - 1;
    const glm::dvec3 size = glm::dvec3(bounds_ws.max) - glm::dvec3(bounds_ws.min);
    const double longest = std::max({size.x, size.y, size.z, 1e-30});
    std::uint64_t place = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double share = (static_cast<double>(p_ws[axis]) - static_cast<double>(bounds_ws.min[axis])) / longest;
        place = place << 21U | static_cast<std::uint64_t>(std::llround(std::clamp(share, 0.0, 1.0) * kCells));
    }
    return place;
}

/// Marks objects of one place whose surfaces go on in each other.
void markJoined(std::span<const Corner> corners, std::vector<std::uint8_t>& joined)
{
    constexpr std::size_t kMostCompared = 16;
    const float smooth = std::cos(static_cast<float>(scene::kCreaseAngle_rad));
    for (std::size_t i = 0; i < corners.size(); ++i) {
        for (std::size_t j = i + 1; j < std::min(corners.size(), i + kMostCompared); ++j) {
            const Corner& a = corners[i];
            const Corner& b = corners[j];
            if (a.object != b.object && glm::dot(a.normal_ws, b.normal_ws) > smooth) {
                joined[a.object] = joined[b.object] = 1;
            }
        }
    }
}

} // namespace

std::vector<std::uint8_t> joinedObjects(const scene::Scene& scene, const scene::State& state)
{
    std::vector<std::uint8_t> joined(state.objects.size(), 0);
    std::vector<Corner> corners;
    for (std::uint32_t i = 0; i < state.objects.size(); ++i) {
        const scene::Object& object = state.objects[i];
        if (object.dynamic || !object.receives || object.bounds_ws.empty()) {
            continue;
        }
        const scene::Primitive& primitive = scene.meshes[object.mesh].primitives[object.primitive];
        const glm::mat3 normal_ws = glm::transpose(glm::inverse(glm::mat3(object.world_from_object)));
        for (std::size_t v = 0; v < primitive.positions.size(); ++v) {
            const glm::vec3 p_ws(object.world_from_object * glm::vec4(primitive.positions[v], 1.0F));
            corners.push_back({placeOf(p_ws, state.bounds_ws), i, glm::normalize(normal_ws * primitive.normals[v])});
        }
    }
    std::ranges::stable_sort(corners, {}, &Corner::place);
    for (auto first = corners.begin(); first != corners.end();) {
        const auto last = std::find_if(first, corners.end(), [&](const Corner& c) { return c.place != first->place; });
        markJoined({first, last}, joined);
        first = last;
    }
    return joined;
}

} // namespace gnomon::host
