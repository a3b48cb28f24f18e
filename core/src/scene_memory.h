// SPDX-License-Identifier: Apache-2.0
// Findings about a scene that a planner makes once and keeps: the box that fit=scene is made around, and layers of the
// world.
#pragma once

#include <gnomon/frame.h>

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon {

class SceneMemory {
public:
    /// To be called in each frame before anything is asked. Another ObjectSet is another scene.
    void follow(const ObjectSet& objects);
    void forget();

    /// Around all objects. It stays as it is until one of them leaves it; then it is larger by a sixteenth on the sides
    /// that were left, so that what moves on does not move it in each frame.
    [[nodiscard]] const Aabb& box_ws() const { return box_ws_; }
    /// `count` layers of height, 1 .. kMaxDepthLayers, found when they are asked for first.
    [[nodiscard]] std::span<const WorldLayer> layers(const ObjectSet& objects, std::uint32_t count);

private:
    std::uint64_t objects_ = 0; // ObjectSet::identity(); 0: none
    Aabb box_ws_;
    std::vector<std::vector<WorldLayer>> layers_; // by count - 1
};

/// Layers of height by where objects gather: Lloyd's relaxation over the heights of the objects' middles, an object
/// counting once, however large it is. A layer reaches from the lowest to the highest that its objects do, without a
/// fiftieth of them at each end: a peak would make a layer of ground several times as deep. Empty without objects.
[[nodiscard]] std::vector<WorldLayer> findLayers(const ObjectSet& objects, std::uint32_t count);

} // namespace gnomon
