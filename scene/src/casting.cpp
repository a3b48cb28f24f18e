// SPDX-License-Identifier: Apache-2.0
#include "scene/casting.h"

#include <cstddef>
#include <vector>

namespace gnomon::scene {

Casting casting(const Casting& above, const Casting& there)
{
    const auto nearest = [](const auto& near, const auto& far) {
        return near ? near : far;
    };
    return {nearest(there.casts, above.casts), nearest(there.receives, above.receives),
            nearest(there.moves, above.moves), nearest(there.bias_m, above.bias_m),
            nearest(there.groups, above.groups)};
}

void apply(const Casting& casting, Node& node)
{
    const bool was_silent = !node.casts && node.groups == 0; // by an earlier word
    const bool is_silent = casting.casts ? !*casting.casts : was_silent;
    const std::uint32_t groups = casting.groups.value_or(was_silent ? Node().groups : node.groups);
    node.groups = is_silent ? 0 : groups;
    node.casts = casting.casts.value_or(node.casts);
    node.receives = casting.receives.value_or(node.receives);
    node.dynamic = node.dynamic || casting.moves.value_or(false);
    node.bias_m = casting.bias_m.value_or(node.bias_m);
}

void applyBelow(const Casting& casting, std::uint32_t node, Scene& scene)
{
    std::vector<bool> below(scene.nodes.size(), false);
    for (std::size_t i = node; i < scene.nodes.size(); ++i) {
        Node& one = scene.nodes[i];
        below[i] = i == node || (one.parent != kNone && below[one.parent]);
        if (below[i]) {
            apply(casting, one);
        }
    }
}

} // namespace gnomon::scene
