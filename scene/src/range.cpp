// SPDX-License-Identifier: Apache-2.0
#include "scene/range.h"

#include <gnomon/error.h>
#include <gnomon/world_range.h>

#include <cmath>
#include <string_view>

namespace gnomon::scene {
namespace {

bool isFinite(const glm::vec3& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool hasNan(const glm::vec3& v)
{
    return std::isnan(v.x) || std::isnan(v.y) || std::isnan(v.z);
}

/// An object without a vertex has an empty box, and so has one that is not a number.
bool isPlaced(const Aabb& box)
{
    return box.empty() ? !hasNan(box.min) && !hasNan(box.max) : isFinite(box.min) && isFinite(box.max);
}

} // namespace

void requireInRange(const State& state, const std::string& tried)
{
    for (const Object& object : state.objects) {
        if (!isPlaced(object.bounds_ws)) {
            throw Error(tried, "the place of an object of node '" + state.nodes[object.node].name + "' is not finite",
                        "look at its transform and those above it");
        }
    }
    if (const std::string_view fault = rangeFault(state.bounds_ws); !fault.empty()) {
        throw Error(tried, std::string(fault), "scale it, or move it to the origin");
    }
    if (!state.bounds_ws.empty() && state.bounds_ws.extent() == glm::vec3(0.0F)) {
        throw Error(tried, "the scene has no size: all of it is one point", "look at its transforms");
    }
}

} // namespace gnomon::scene
