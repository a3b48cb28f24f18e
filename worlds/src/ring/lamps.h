// SPDX-License-Identifier: Apache-2.0
// The lamps of the world `ring`. A lamp's light and bulb are in its middle, and the lamp casts around them.
#pragma once

#include "palette.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::worlds {

/// A lamp's origin is its bulb. `caged` and `sconce` hang on a wall that is kOffWall_m behind them (-z), `pendant`,
/// `pierced` and `lantern` from something kCord_m above, and the others stand on something footOf() below.
enum class Lamp : std::uint8_t { pendant, pierced, lantern, caged, sconce, table, drum, bollard, reactor };
inline constexpr std::size_t kLamps = 9;
inline constexpr float kOffWall_m = 0.15F;
inline constexpr float kCord_m = 1.0F;
[[nodiscard]] float footOf(Lamp lamp);
/// Radius of its bulb, which is that of its light.
[[nodiscard]] float bulbOf(Lamp lamp);

/// The light of a lamp. `strength` is its illuminance at half its range; 1 is a well lit place.
struct Shine {
    Hue hue = Hue::warm;
    float range_m = 5.0F;
    float strength = 1.0F;
};

class LampMaker {
public:
    LampMaker(Scene& scene, const RingPalette& palette);
    void add(Lamp lamp, const Transform& transform, const Shine& shine);
    /// A light without a lamp that casts no shadow.
    void addMood(const glm::vec3& position, const Shine& shine);
    /// The reactor's rings, for the animator: the first of three nodes, each in the one before.
    [[nodiscard]] std::uint32_t rings() const { return rings_; }

private:
    void addRings(std::uint32_t parent);

    Scene& scene_;
    const RingPalette& palette_;
    std::array<std::uint32_t, kLamps> meshes_{};
    std::array<std::uint32_t, kHues> bulbs_{}; // bulbs of radius 1
    std::uint32_t rings_ = 0;
    std::uint32_t count_ = 0;
    std::uint32_t moods_ = 0;
};

} // namespace gnomon::worlds
