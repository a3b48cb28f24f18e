// SPDX-License-Identifier: Apache-2.0
// The built-in worlds by name, and scenes by name or file. Worlds whose numbers are needed elsewhere have a header.
#pragma once

#include "scene/gltf.h"
#include "scene/model.h"

#include <cstdint>
#include <span>
#include <string_view>

namespace gnomon::worlds {

/// A built-in world, finished (finishScene called).
struct World {
    std::string_view name;
    std::string_view summary; // one line
    scene::Scene (*make)(std::uint64_t seed);
};
/// All built-in worlds, in the order shown to people.
[[nodiscard]] std::span<const World> all();
/// The built-in world of that name; null where there is none.
[[nodiscard]] const World* find(std::string_view name);

/// Throws Error where load() would find neither a built-in world nor a file that may be glTF. Reads nothing.
void requireThere(std::string_view name_or_file);

/// Loads a built-in world by its name, or a file by its path. Throws Error when there is neither.
[[nodiscard]] scene::Scene load(std::string_view name_or_file, std::uint64_t seed, const scene::Limits& limits = {});

} // namespace gnomon::worlds
