// SPDX-License-Identifier: Apache-2.0
// Which nodes cast and receive: set by a file or a command line for a node and all below it.
#pragma once

#include "scene/model.h"

#include <cstdint>
#include <optional>

namespace gnomon::scene {

inline constexpr std::uint32_t kMostGroups = 32;
/// The most of Node::bias_m, to either side.
inline constexpr double kMostBias_m = 1e6;

/// Absent members change nothing.
struct Casting {
    std::optional<bool>
        casts; // false: in no map of any filter; with Node::casts alone filters choose whether to draw it
    std::optional<bool> receives;
    std::optional<bool> moves; // false has no effect: nodes of an animation move
    std::optional<float> bias_m;
    std::optional<std::uint32_t> groups; // Node::groups; of no effect beside `casts` false

    [[nodiscard]] bool empty() const { return !casts && !receives && !moves && !bias_m && !groups; }
};
/// The casting below a node: the members set there, and for absent ones those of `above`.
[[nodiscard]] Casting casting(const Casting& above, const Casting& there);
void apply(const Casting& casting, Node& node);
/// Applies it to a node and all below it. Precondition: parents stand before their children.
void applyBelow(const Casting& casting, std::uint32_t node, Scene& scene);

} // namespace gnomon::scene
