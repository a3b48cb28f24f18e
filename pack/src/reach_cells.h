// SPDX-License-Identifier: Apache-2.0
// Where the lights of one layer of the mask reach, as rectangles each of which some of them reach all over.
#pragma once

#include <gnomon/pack/light_lists.h>

#include <gnomon/shared/gpu_structs.h>

#include <array>

namespace gnomon::pack {

/// screenBounds() of a light of a frame. `scene_ws`: of all objects, for a light without a range; empty: such a light
/// has all of the picture, as has one whose range is no number.
[[nodiscard]] ScreenBounds litPixels(const Light& light, const Camera& camera, const Aabb& scene_ws,
                                     glm::uvec2 size_px);

/// By channel, up to kLightsPerLayer.
class LayerReach {
public:
    struct Reach {
        std::uint32_t channels = 0; // the light's: one bit, or all for a coloured one
        ScreenBounds pixels;
    };

    /// Adds a light with these channels. Two lights with one channel, which only a hand-made plan has, count where both
    /// reach.
    void add(std::uint32_t channels, const ScreenBounds& pixels);
    [[nodiscard]] const Reach* begin() const { return lights_.data(); }
    [[nodiscard]] const Reach* end() const { return lights_.data() + count_; }

private:
    std::array<Reach, shared::kLightsPerLayer> lights_;
    std::size_t count_ = 0;
};

struct ReachCell {
    ScreenBounds pixels;
    std::uint32_t channels = 0; // channels of lights that may reach all of it, never 0
};

/// The parts of a rectangle that lights reach, top down and from left to right. They do not overlap.
class ReachCells {
public:
    static constexpr std::size_t kMostEdges = 2 * shared::kLightsPerLayer + 2;
    static constexpr std::size_t kMost = (kMostEdges - 1) * (kMostEdges - 1);

    ReachCells(const LayerReach& reach, const ScreenBounds& within);
    [[nodiscard]] const ReachCell* begin() const { return cells_.data(); }
    [[nodiscard]] const ReachCell* end() const { return cells_.data() + count_; }
    [[nodiscard]] std::size_t size() const { return count_; }

private:
    void add(const ReachCell& cell);

    std::array<ReachCell, kMost> cells_;
    std::size_t count_ = 0;
};

} // namespace gnomon::pack
