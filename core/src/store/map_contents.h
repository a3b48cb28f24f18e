// SPDX-License-Identifier: Apache-2.0
// The contents of a map's texels, as one value.
#pragma once

#include <gnomon/object_set.h>
#include <gnomon/plan.h>

#include <array>
#include <span>
#include <vector>

namespace gnomon {

/// The part of a view that its texels depend on, besides the casters.
struct MapProjection {
    glm::dmat4 clip_from_world{1.0};
    glm::dvec4 metric_ws{0.0};
    bool orthographic = true;
    bool clamp_near = true;
    std::uint64_t ids_key = 0;
    std::array<DepthSpan, kMaxDepthLayers> layers{};

    friend bool operator==(const MapProjection&, const MapProjection&) = default;
};
[[nodiscard]] MapProjection projectionOf(const View& view);

/// An object that moves, and where in its map it may be.
struct Mover {
    std::uint32_t object = 0;
    TexelRect texels;
};

struct MapContents {
    MapProjection projection;
    std::uint64_t version = 0;        // the object set's version when it was drawn
    std::vector<std::uint32_t> still; // casters, ascending; all of them for a map that is drawn all at once
    std::vector<Mover> moving;        // those that were drawn over a kept copy of `still`; ascending

    /// Would drawing these casters now give the same, except for `moving`? `changes` are ObjectSet::allChanges().
    [[nodiscard]] bool show(const MapProjection& now, std::span<const std::uint32_t> casters,
                            std::span<const std::uint64_t> changes) const;
    [[nodiscard]] bool showMovers() const;
    void fill(const MapProjection& now, std::span<const std::uint32_t> casters, std::uint64_t now_version);
};

/// Finds where each mover is. Returns what of the tile is not as `drawn` has it: where something moves, or did.
[[nodiscard]] TexelRect placeMovers(const View& view, const MapContents& drawn, const ObjectSet& objects,
                                    std::span<Mover> movers);

/// Where a box may be in a view's tile: around its image, a texel more on each side, cut by the tile. All of the tile
/// where the box is partly behind a light with a place, and of a paraboloid.
[[nodiscard]] TexelRect texelsOf(const View& view, const Aabb& box_ws);
/// Around both; an empty one changes nothing.
[[nodiscard]] TexelRect merge(const TexelRect& a, const TexelRect& b);

} // namespace gnomon
