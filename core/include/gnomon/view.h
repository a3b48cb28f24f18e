// SPDX-License-Identifier: Apache-2.0
// A view of the plan: a frustum of one light and its map. The planner's steps write a part each: Views the projection,
// casters, what it serves and the fit, then the place that Places has found, and Schedule the contents.
#pragma once

#include <gnomon/frame.h>
#include <gnomon/options.h>

#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace gnomon {

inline constexpr std::uint32_t kNoIndex = 0xFFFFFFFFU; // stands for no index at all

/// A rectangle of one layer of the atlas, in texels.
struct Tile {
    std::uint32_t layer = 0;  // page of the atlas
    std::uint32_t x = 0;      // its first texel, from the left
    std::uint32_t y = 0;      // its first texel, from the top
    std::uint32_t width = 0;  // texels
    std::uint32_t height = 0; // texels
};

/// Some of a tile's texels, counted from its first one. Width 0: none.
struct TexelRect {
    std::uint32_t x = 0;      // from the tile's left
    std::uint32_t y = 0;      // from the tile's top
    std::uint32_t width = 0;  // texels
    std::uint32_t height = 0; // texels

    /// There is no texel in it.
    [[nodiscard]] bool empty() const { return width == 0 || height == 0; }
};

/// Which half of a texel's bits holds a map: two maps may share one target (ResolvedOptions::paired_maps).
enum class TexelPart : std::uint8_t { whole, first, second };

/// Names a map: one square of the pages (and part of its texels), for as long as one frustum of a light has it. The
/// name is never given again after the light gives up the map; the index is, with another generation.
struct MapId {
    std::uint32_t index = kNoIndex; // small and dense: less than Plan::map_count, so it may index a table
    std::uint32_t generation = 0;   // tells maps with the same index apart

    /// It names a map.
    [[nodiscard]] explicit operator bool() const { return index != kNoIndex; }
    friend bool operator==(const MapId&, const MapId&) = default;
};

/// Names the contents of a map's texels: all that its drawing depends on. No number is given twice, not even by two
/// planners of one process. 0: nothing, or unknown contents.
using ContentNumber = std::uint64_t;

/// The least distance of a receiver's place from its tile's edge, in texels, at which a filter reads no texel outside
/// the tile. The filter reads texels whose centres are up to `reach_texels` away (>= 0.5, along x and y each), and the
/// centre of a texel at the edge is half a texel inside. The mask uses a view only for receivers at least so far
/// inside.
[[nodiscard]] constexpr double tileMarginTexels(double reach_texels)
{
    constexpr double kRounding_texels = 1e-3; // a receiver on the far edge itself is in the next texel
    return kRounding_texels + reach_texels - 0.5;
}

/// How a view measures depth: d' = dot(metric_ws, (p, 1)) = (d - near) / (far - near). Under parallel light d is metres
/// along the ray, from a plane across it or one that leans with the receivers (ShadowOptions::level_depth): along each
/// ray d' grows by 1 / (far - near) per metre. For a light with a place d is metres along its axis, the map's middle:
/// along a ray at an angle from that, d' grows by the angle's cosine / (far - near) per metre. For a paraboloid d is
/// metres from the light, which no row gives: use depthOnMap() (plan_views.h).
struct DepthMetric {
    glm::dvec4 metric_ws{0.0}; // the row that gives d' for a point of the world
    double near_m = 0.0;       // where d' is 0
    double far_m = 1.0;        // where d' is 1
};

/// The part of the seen points that a view serves: a range of dot(axis, (p, 1)) / dot(over, (p, 1)).
/// - Mostly that is the camera's depth, metres from the eye along its view; `over` gives 1.
/// - A lamp's views by partition multi have that depth over the depth along the light's axis, which has no unit. The
///   lower it is, the finer the map has to be.
/// - The segments of fit tsm (`across`) have a place along the trapezoid: metres from the eye across the light, or over
///   a lamp's depth.
struct ViewSlice {
    glm::dvec4 axis{0.0};                                      // the row of the numerator
    double begin_m = -std::numeric_limits<double>::infinity(); // where it begins; -infinity: nowhere
    double end_m = std::numeric_limits<double>::infinity();    // where it ends; infinity: nowhere
    /// The view before it fades over into this one from begin_m to begin_m + blend_m, and serves that range too. 0:
    /// there is none before it.
    double blend_m = 0.0;
    glm::dvec4 over{0.0, 0.0, 0.0, 1.0}; // 1 everywhere, or the row `w` of the view's sector
    bool across = false;                 // it is measured along the map, and not along the camera's view

    /// It is less than everything.
    [[nodiscard]] bool bounded() const { return std::isfinite(begin_m) || std::isfinite(end_m); }
    /// It is a ratio over a lamp's depth.
    [[nodiscard]] bool isRatio() const { return glm::dvec3(over) != glm::dvec3(0.0); }
    /// The value at a point in the view's sector.
    [[nodiscard]] double depthAt(const glm::dvec3& p_ws) const
    {
        return glm::dot(axis, glm::dvec4(p_ws, 1.0)) / glm::dot(over, glm::dvec4(p_ws, 1.0));
    }
    /// Does the slice hold a point? Never one behind the lamp that it is measured from.
    [[nodiscard]] bool holds(const glm::dvec3& p_ws) const
    {
        const double depth_m = glm::dot(axis, glm::dvec4(p_ws, 1.0));
        const double unit = glm::dot(over, glm::dvec4(p_ws, 1.0));
        return !bounded() || (unit > 0.0 && depth_m >= begin_m * unit && depth_m <= end_m * unit);
    }
};

/// The part of a light's directions that a view serves, where views of one light stand side by side: the points p with
/// |dot(x, (p, 1))| and |dot(y, (p, 1))| both at most dot(w, (p, 1)), p in world space. A map shows more, for filters
/// to read, but not all casters there. By default it is everything. For a lamp, dot(w, (p, 1)) is metres along an axis.
struct ViewSector {
    glm::dvec4 x{0.0};                // the row across the sector
    glm::dvec4 y{0.0};                // the other row across
    glm::dvec4 w{0.0, 0.0, 0.0, 1.0}; // the row that bounds both

    /// It is less than everything.
    [[nodiscard]] bool bounded() const
    {
        return x != glm::dvec4(0.0) || y != glm::dvec4(0.0) || w != glm::dvec4(0.0, 0.0, 0.0, 1.0);
    }
    /// Is a point of the world in it?
    [[nodiscard]] bool holds(const glm::dvec3& p_ws) const
    {
        const glm::dvec4 p(p_ws, 1.0);
        return std::max(std::abs(glm::dot(x, p)), std::abs(glm::dot(y, p))) <= glm::dot(w, p);
    }
};

/// The square that a page of partition virtual shows, of the 2^depth on a side of one of its light's roots.
struct ViewPage {
    std::uint32_t face = 0;  // of the cube around a lamp: +x, -x, +y, -y, +z, -z; of another light 0
    std::uint32_t depth = 0; // 0: the root
    std::uint32_t x = 0;     // place among the squares, from the root's lower end
    std::uint32_t y = 0;     // the same along the other axis

    bool operator==(const ViewPage&) const = default;
};

/// The quality of a fit. Sides of texels are as in ViewProjection::texel_xy_m, in x and y of the map.
struct FitReport {
    double strength = 1.0;          // width of the widest texel over that of the narrowest; 1: no warp
    glm::dvec2 finest_texel{0.0};   // a warped map's finest texel on seen and lit receivers
    glm::dvec2 coarsest_texel{0.0}; // and the coarsest one
};

/// A layer of depth, in the view's own depths: d'' = clamp((d' - near) / (far - near), 0, 1). Both may lie outside of
/// [0, 1]. Both zero: none.
struct DepthSpan {
    double near = 0.0; // where the layer begins
    double far = 0.0;  // where it ends

    friend bool operator==(const DepthSpan&, const DepthSpan&) = default;
};

/// Which of a stepping sun's two positions a view belongs to (SunSteps).
enum class SunPosition : std::uint8_t { only, earlier, later };

/// How a view takes the world to its map.
struct ViewProjection {
    glm::dmat4 clip_from_world{1.0}; // z in [0, w] beyond the near plane; y down; differs for a paraboloid
    DepthMetric metric;              // how the map measures depth
    bool orthographic = true; // neither for a lamp nor warped; then the rasteriser's z is the metric, up to rounding
    bool clamp_near = true;   // casters before the near plane are to be clamped onto it, not cut
    /// The light's rays are parallel. Otherwise they come from light_place_ws, and the map is a perspective one or a
    /// paraboloid.
    bool parallel = true;
    /// The map is a paraboloid of the half space in ViewServes::sector. Then clip_from_world takes a point to (q, 1 /
    /// s): q is from the light to the point, in axes of the map (x right, y down, z along its axis) and in lengths of
    /// far - near. The point's place on the map is s q.xy / (q.z + |q|), -1 .. 1 over its tile, and its depth is |q| +
    /// metric.metric_ws.w (placeOnMap(), depthOnMap()). The half space is a disc of radius s; the rest of the tile is
    /// room for kernels.
    bool paraboloid = false;
    /// The point that depths are measured from. Directional: the centre of what is seen, moved back against the light
    /// until every possible caster is in front (Marinescu 2011, eq. 6); spot, point: the light's position.
    glm::dvec3 light_place_ws{0.0};
    /// Side of a texel: metres across a directional light, or metres at 1 m distance from a light with a place. In a
    /// warped map it is the longest side on seen and lit receivers.
    double texel_m = 0.0;
    glm::dvec2 texel_xy_m{0.0}; // both sides of a texel, in x and y of the map; texel_m is the longer one
    /// Room on all sides for the rays to the rest of the light (integratesLight()), in texel_m's units of length.
    double light_reach = 0.0;
    /// Partition::sdsm: the index of this cascade of its light. Then the view describes the light's base map, and the
    /// GPU finds the view's rectangle on it and the slice that it serves (FittedView). Depth and casters are the base
    /// map's. Such a view is always drawn again. kNoIndex: the view is as described here.
    std::uint32_t gpu_cascade = kNoIndex;
    /// With gpu_cascade: how far the fitted view has yet to be moved, in its own texels. Other views have been moved
    /// already.
    glm::dvec2 grid_move_texels{0.0};
};

/// The casters that are drawn into a view's map (ObjectFlags::casts): a range of Plan::casters. With a kept layer,
/// first the still ones, then the moving ones (ObjectFlags::dynamic), each ascending; without one, all ascending.
struct ViewCasters {
    std::uint32_t first = 0; // index into Plan::casters
    std::uint32_t count = 0; // how many there are
    std::uint32_t still = 0; // how many of them stand still; used only with a kept layer
};

/// Which points a view serves, and with which weight.
struct ViewServes {
    SunPosition sun = SunPosition::only; // which position of a stepping sun
    ViewSlice slice;                     // which depths
    ViewSector sector;                   // which directions
    ViewPage page;                       // partition virtual: where the sector lies
    /// How far it has faded in over the light's views before it that serve the same place: 0 .. 1. Less than 1 only
    /// while frustums of partition multi change under motion snap (MultiOptions::fade_frames).
    double faded_in = 1.0;
    /// MultiDivide::receivers: its light's views overlap, finest first. The weight of each at a point is its
    /// opacityAt(), but at most the share that the views before it leave. All weights add up to 1.
    bool layered = false;
    double rim = 0.0; // layered: share of half its sector's width over which it fades out towards the sector's border
    /// LayerPlacement::world: the layers of the world in this view's depths, from near to far. Otherwise there are
    /// none.
    std::array<DepthSpan, kMaxDepthLayers> layers{};

    /// The opacity of a layered view at a point in its sector: 0 .. 1.
    [[nodiscard]] double opacityAt(const glm::dvec3& p_ws) const
    {
        const glm::dvec4 p(p_ws, 1.0);
        const double across = std::max(std::abs(glm::dot(sector.x, p)), std::abs(glm::dot(sector.y, p)));
        const double inside = 1.0 - across / glm::dot(sector.w, p);
        return (rim > 0.0 ? std::clamp(inside / rim, 0.0, 1.0) : 1.0) * faded_in;
    }
    /// Its weight at a depth (ViewSlice::depthAt()) where a view before it serves the place too: 0 .. 1.
    [[nodiscard]] double shareAt(double depth_m) const
    {
        const bool fades = slice.blend_m > 0.0;
        const double over = fades ? std::clamp((depth_m - slice.begin_m) / slice.blend_m, 0.0, 1.0) : 1.0;
        return fades || faded_in < 1.0 ? over * faded_in : 0.0;
    }
};

/// Where a view's map is.
struct ViewPlace {
    MapId map;                         // which map it is, from frame to frame
    Tile tile;                         // where in the light's pages
    TexelPart part = TexelPart::whole; // part of the tile's texels
};

/// The contents of a view's map, and the drawing that it needs.
struct ViewContents {
    /// The contents that the map must hold for the drawing below to be enough. A backend notes for each MapId::index
    /// the contents that it drew last. Where that number is not `presumes`, it draws all of the tile from all casters,
    /// whatever `redraw` and `dirty` say; the map then holds `makes` all the same. So a skipped frame, a lost image and
    /// a second renderer mend themselves. Presumes 0: all is drawn in any case. Makes 0: nobody reads the map in this
    /// frame; it is left as it is.
    ContentNumber presumes = 0;
    ContentNumber makes = 0; // the contents afterwards; 0: leave the map
    bool redraw = true;      // makes != presumes: something is to be drawn
    /// Layer of the images that hold maps of still casters alone (same size and place there as the tile). The map is
    /// restored from it before moving casters are drawn over it. No two views of a plan have the same part of the same
    /// texels there. kNoIndex: the map is drawn all at once.
    std::uint32_t kept_layer = kNoIndex;
    bool redraw_kept = false; // draw the still casters into the kept layer first; then `dirty` is all of the tile
    /// The square of the kept layer is a map like any other, with its own name and contents. Where it is out of date,
    /// the still casters are drawn into it first, and then all of the tile is dirty.
    MapId kept_map;
    ContentNumber kept_presumes = 0; // as `presumes`, of the kept map
    ContentNumber kept_makes = 0;    // as `makes`, of the kept map
    /// With a kept layer and `redraw`: the texels to restore and draw over, because a moving caster is there or was
    /// there when the map was drawn last.
    TexelRect dirty;
    /// For how many frames the map has been out of date, this one included, as in LightPlan::waited. Then projection,
    /// casters and place are those that the view had. For a cascade that waits by itself (CascadeOptions::room) the
    /// slice is this frame's. 0: the map is up to date.
    std::uint32_t waited = 0;
    /// Filters id and depth-id: names the ids that the casters are drawn with. A map that was drawn with others is out
    /// of date. 0: no ids.
    std::uint64_t ids_key = 0;
};

/// One map to draw: a frustum of one light.
struct View {
    std::uint32_t light = 0;   // index into Frame::lights
    ViewProjection projection; // how the world lies on the map
    ViewCasters casters;       // the casters that are drawn into it
    ViewServes serves;         // the points that it serves
    FitReport fit;             // how good the fit is
    ViewPlace place;           // where the map is
    ViewContents contents;     // its contents, and the drawing that it needs
};

} // namespace gnomon
