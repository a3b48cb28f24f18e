// SPDX-License-Identifier: Apache-2.0
// From one slice of a light to a view: what matters to it, how that is put into a map, and who is drawn.
#pragma once

#include "auto/warp_search.h"
#include "cascade_turns.h"
#include "depth_range.h"
#include "recipe.h"
#include "region.h"

#include <span>
#include <vector>

namespace gnomon {

struct FrustumInput {
    const Frame& frame;
    const Recipe& recipe;
    const CameraView& camera;                 // measured or bounded, as the recipe needs it
    std::span<const std::uint32_t> receivers; // that the camera sees
    std::span<const std::uint32_t> levellers; // by whom level depth is measured
    const Light& light;                       // shining from where the map is drawn
    const Slice& slice;
    std::uint32_t map_size = 0; // texels on a side
    double strength = 1.0;      // strength of the warp, with fit auto
    glm::dvec2 grid_move_texels{0.0};
    Aabb scene_ws{};                      // with fit scene: what its map is made around
    std::span<const WorldLayer> layers{}; // with layers of the world
    const Sight* sight = nullptr;         // by which a warp is held against none; null: it is as its fit says
    ViewGround* ground = nullptr;         // null, or where to say what the view was planned for
    std::uint32_t halvings = 0;           // for predict(): how many times the largest side was halved to map_size
};

struct Prediction {
    MapError error;
    BySize edges{};           // edgesBySize()
    double coarsest_px = 0.0; // coarsestTexel_px()
    FacingTexels facing;      // where there is no point, of one amid what is seen, which counts for half a one
    bool lies = false;        // the slice has receivers, so it may have a map
    double size = 0.0;        // longer side of what the map has to show, as LightRect has it
};

/// Size of the shadow that a map's error is judged by, pixels of the picture.
inline constexpr double kFeature_px = 300.0;

[[nodiscard]] bool isFinite(const View& view);

class FrustumPlanner {
public:
    /// ok or fallback: fills in all of `view` but whose it is, where its map is and what of it is to be drawn, and
    /// appends its casters, ascending. Else both are as they were. Keeps its memory.
    Outcome plan(const FrustumInput& input, View& view, std::vector<std::uint32_t>& casters);

    /// Appends, ascending, who can cast on what the camera sees of the slice; of a point light all around it. ok,
    /// no_receiver or no_caster. volume_casters.cpp.
    Outcome listCasters(const FrustumInput& input, std::vector<std::uint32_t>& casters);

    /// Appends the slice of `input` as fit tsm divides it into `count` affine segments (fit/tsm_segments.h), near ones
    /// first; the slice itself where nothing of it is seen. Neighbours blend over the share `blend` of the nearer one.
    void divideTsm(const FrustumInput& input, std::uint32_t count, double blend, std::vector<Slice>& out);

    /// With what error the slice's map will be read, found before it is drawn. With fit auto `strength` is that of the
    /// frame before (0: there was none) and becomes the one to draw by. Keeps its memory.
    [[nodiscard]] Prediction predict(const FrustumInput& input, const Sight& sight, double& strength);

private:
    /// How the slice's map lies across the light, before anybody is drawn.
    struct Lie {
        LightSpace space;
        double border_texels = 0.0;
        double least_size = 0.0;
        double light_reach = 0.0; // ViewProjection::light_reach
        Outcome outcome;          // not ok: the slice needs no map
    };
    [[nodiscard]] Lie lieOf(const FrustumInput& input);
    [[nodiscard]] MapFrame frameOfWarp(const FrustumInput& input, const Lie& lie, const Warp& warp) const;
    [[nodiscard]] FitInput fitInputOf(const FrustumInput& input, const Lie& lie) const;
    [[nodiscard]] Warp warpOf(const FrustumInput& input, const Lie& lie) const;
    [[nodiscard]] Warp drawnWarp(const FrustumInput& input, const Lie& lie);
    [[nodiscard]] FacingTexels facingAmid(const FrustumInput& input, const Sight& sight, const Lie& lie,
                                          const Warp& warp, const MapFrame& frame);
    void outlinePlaces(const FrustumInput& input, const Lie& lie);
    [[nodiscard]] Outcome widenForLight(const FrustumInput& input, const RegionInput& around, Lie& lie);
    /// The seen part of a half space around a light (Slice::paraboloid) and the casters there: hemisphere_plan.cpp.
    struct SeenHalf {
        glm::dvec3 low_ws{0.0}; // box around the seen part and the light
        glm::dvec3 high_ws{0.0};
        double near_m = 0.0; // distances from the light: of the nearest caster,
        double far_m = 0.0;  // and of the farthest place that is seen
    };
    [[nodiscard]] Outcome seeHalf(const FrustumInput& input, const LightSpace& space, SeenHalf& seen);
    [[nodiscard]] Outcome gatherHalf(const FrustumInput& input, const LightSpace& space, double texel, SeenHalf& seen,
                                     std::vector<std::uint32_t>& casters);
    Outcome planHalf(const FrustumInput& input, View& view, std::vector<std::uint32_t>& casters);
    [[nodiscard]] Prediction predictHalf(const FrustumInput& input, const Sight& sight);
    [[nodiscard]] DepthRange rangeOf(const FrustumInput& input, const LightSpace& space, const View& view) const;
    Outcome listCastersAround(const FrustumInput& input, std::vector<std::uint32_t>& casters);
    void measureDepth(const FrustumInput& input, const LightSpace& space, const DepthRange& range, View& view) const;

    Region region_;
    std::vector<std::uint32_t> near_casters_;
    std::vector<LitPoint> lit_;
    std::vector<glm::dvec2> places_; // outlinePlaces()
    std::vector<glm::dvec2> scratch_;
    std::vector<double> texels_px_;
    ConvexBody half_body_; // planHalf()
    std::vector<Plane> planes_;
};

} // namespace gnomon
