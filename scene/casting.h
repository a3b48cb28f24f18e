// SPDX-License-Identifier: Apache-2.0
// Who casts and who receives, as a file or a command line says it of a node and of what is below it.
#pragma once

#include "scene/model.h"

#include <cstdint>
#include <optional>

namespace gnomon::scene {

inline constexpr std::uint32_t kMostGroups = 32;
/// Of Node::bias_m, either way.
inline constexpr double kMostBias_m = 1e6;

/// Whatever is absent stays as it is.
struct Casting {
    std::optional<bool>
        casts; // false: in no map of any filter; Node::casts alone leaves it to filters to spare drawing
    std::optional<bool> receives;
    std::optional<bool> moves; // false says nothing: what an animation moves, moves
    std::optional<float> bias_m;
    std::optional<std::uint32_t> groups; // Node::groups; of no effect beside `casts` false

    [[nodiscard]] bool empty() const { return !casts && !receives && !moves && !bias_m && !groups; }
};
/// What holds below a node: what is said there, and of all else what is said above it.
[[nodiscard]] Casting casting(const Casting& above, const Casting& there);
void apply(const Casting& casting, Node& node);
/// To a node and all that is below it. Precondition: parents stand before their children.
void applyBelow(const Casting& casting, std::uint32_t node, Scene& scene);

} // namespace gnomon::scene
