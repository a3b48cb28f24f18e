// SPDX-License-Identifier: Apache-2.0
// Closed ways over the map, for squads to march on and roads to be trodden by them.
#pragma once

#include <glm/vec2.hpp>

#include <array>
#include <span>
#include <vector>

namespace gnomon::worlds {

/// Coordinates are x and z in metres.
class Loop {
public:
    struct Place {
        glm::vec2 position{0.0F};
        glm::vec2 direction{0.0F, 1.0F}; // unit
    };

    /// A closed Catmull-Rom curve through `corners`, resampled to about `kStep_m` apart.
    explicit Loop(std::span<const glm::vec2> corners);

    [[nodiscard]] float length_m() const { return length_m_; }
    /// `distance_m` wraps around.
    [[nodiscard]] Place at(float distance_m) const;
    [[nodiscard]] std::span<const Place> samples() const { return samples_; }

    static constexpr float kStep_m = 0.5F;

private:
    std::vector<Place> samples_; // the first once more at the end
    float length_m_ = 0.0F;
    float samples_per_m_ = 1.0F;
};

inline constexpr std::size_t kLoopCount = 5;
/// The ring street of the camp, the western and the eastern round, the far round, the training field's.
[[nodiscard]] std::array<Loop, kLoopCount> makeLoops();

} // namespace gnomon::worlds
