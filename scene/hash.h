// SPDX-License-Identifier: Apache-2.0
// A hash that tells scenes apart, in result files and in the cache of truths.
#pragma once

#include "scene/model.h"
#include "scene/state.h"

#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace gnomon::scene {

struct Hash128 {
    std::uint64_t high = 0;
    std::uint64_t low = 0;
    auto operator<=>(const Hash128&) const = default;
};
/// 32 hexadecimal digits.
[[nodiscard]] std::string toString(const Hash128& hash);

/// A 128-bit hash over bytes (XXH3), fed piece by piece. Vectors feed their length first, so that pieces do not run
/// into each other.
class Hasher {
public:
    Hasher();
    ~Hasher();
    Hasher(const Hasher&) = delete;
    Hasher& operator=(const Hasher&) = delete;

    void addBytes(std::span<const std::byte> bytes);
    /// Types without padding only, so that equal values give equal bytes.
    template <typename T>
    void add(const T& value)
    {
        static_assert(std::is_trivially_copyable_v<T>);
        static_assert(std::has_unique_object_representations_v<T> || std::is_floating_point_v<T>,
                      "feed its members one by one");
        addBytes(std::as_bytes(std::span(&value, 1)));
    }
    /// Elements must be free of padding: numbers, or vectors and matrices of them.
    template <typename T>
    void addAll(const std::vector<T>& values)
    {
        static_assert(std::is_trivially_copyable_v<T>);
        add(static_cast<std::uint64_t>(values.size()));
        addBytes(std::as_bytes(std::span(values)));
    }
    void addText(std::string_view text);
    [[nodiscard]] Hash128 value() const;

private:
    void* state_; // XXH3_state_t
};

/// The hash of all in a scene that a picture, a mask or a truth can depend on: geometry, places, materials, textures,
/// images, skins, animations, lights, cameras, environment. Names and notices are left out. A procedural world's
/// animators cannot be hashed: see stateHash().
[[nodiscard]] Hash128 sceneHash(const Scene& scene);

/// The hash of all that a state adds to its scene for a mask or a truth: the places of objects and lights, deformed
/// vertices, flags. The brightness of lights and sky is left out.
[[nodiscard]] Hash128 stateHash(const State& state);

} // namespace gnomon::scene
