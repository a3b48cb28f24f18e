// SPDX-License-Identifier: Apache-2.0
// The plan of one frame: which maps to draw, with which matrices, where in the atlas, and who draws in them. Plain
// data: a host without our backend can do the GPU work from it alone.
#pragma once

#include <gnomon/choices.h>
#include <gnomon/export.h>
#include <gnomon/frame.h>
#include <gnomon/geometry.h>
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
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon {

inline constexpr std::uint32_t kNoIndex = 0xFFFFFFFFU; // stands for no index at all

/// What became of a light, as a value with a reason. Never an exception, never a silent fallback.
enum class OutcomeKind : std::uint8_t {
    ok,
    fallback,         // drawn, but not as asked; the reason says what was done instead
    no_shadow_wanted, // Light::casts_shadow is false
    no_receiver,      // nothing that the camera sees is in the light's reach
    no_caster,        // nothing can throw a shadow on what the camera sees
    degenerate,       // the numbers do not describe a light or a view (not finite, zero direction …)
    refused,          // the combination of choices is refused (refusal())
    atlas_full,       // no room for its maps
};
/// As JSON and reports have it; static text.
[[nodiscard]] GNOMON_API std::string_view nameOf(OutcomeKind kind);

/// What became of a light, and why.
struct Outcome {
    OutcomeKind kind = OutcomeKind::ok; // what, in one word
    std::string_view reason;            // a sentence with static lifetime; empty for ok

    /// Its mask channel comes from a map, or with filter volumes from counts (ok, fallback); otherwise it reads 1
    /// everywhere.
    [[nodiscard]] bool hasMap() const { return kind == OutcomeKind::ok || kind == OutcomeKind::fallback; }
};

/// A rectangle of one layer of the atlas, in texels.
struct Tile {
    std::uint32_t layer = 0;  // page of the atlas
    std::uint32_t x = 0;      // of its first texel, from the left
    std::uint32_t y = 0;      // of its first texel, from the top
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

/// Which half of a texel's bits holds a map: two may share one target (ResolvedOptions::paired_maps).
enum class TexelPart : std::uint8_t { whole, first, second };

/// Names a map: one square of the pages (and part of its texels), for as long as one frustum of a light has it. A map
/// that its light gives up takes its name with it; the index is used again, with another generation.
struct MapId {
    std::uint32_t index = kNoIndex; // small and dense: less than Plan::map_count, so it may index a table
    std::uint32_t generation = 0;   // which of those that had the index

    /// It names a map.
    [[nodiscard]] explicit operator bool() const { return index != kNoIndex; }
    friend bool operator==(const MapId&, const MapId&) = default;
};

/// Names what the texels of a map hold: all that its drawing depends on. No number is given twice, not even by two
/// planners of one process. 0: nothing, or nothing that is known.
using ContentNumber = std::uint64_t;

/// How far from its tile's edge a receiver's place in the map must be, in texels, so that a filter which reads texels
/// whose centres are up to `reach_texels` away (>= 0.5, along x and y each) reads none outside the tile: the centre of
/// a texel at the edge is half a texel inside. The mask takes a view for a receiver that is so far inside its tile
/// only.
[[nodiscard]] constexpr double tileMarginTexels(double reach_texels)
{
    constexpr double kRounding_texels = 1e-3; // a receiver on the far edge itself is in the next texel
    return kRounding_texels + reach_texels - 0.5;
}

/// How a view measures depth: d' = dot(metric_ws, (p, 1)) = (d - near) / (far - near). Under parallel light d is metres
/// along the ray, from a plane across it or one that leans with the receivers (ShadowOptions::level_depth): along each
/// ray d' grows by 1 / (far - near) per metre. Of a light with a place d is metres along its axis, the map's middle:
/// along a ray at an angle from that, d' grows by the angle's cosine / (far - near) per metre. Of a paraboloid d is
/// metres from the light, and no row gives it: depthOnMap() (plan_views.h) does.
struct DepthMetric {
    glm::dvec4 metric_ws{0.0}; // the row that gives d' of a point of the world
    double near_m = 0.0;       // where d' is 0
    double far_m = 1.0;        // where d' is 1
};

/// The share of what is seen that a view serves: a range of dot(axis, (p, 1)) / dot(over, (p, 1)).
/// - Mostly that is the camera's depth, metres from the eye along its view; `over` gives 1.
/// - A lamp's views by partition multi have that depth over the depth along the light's axis, which has no unit. The
///   lower it is, the finer the map has to be.
/// - The segments of fit tsm (`across`) have a place along the trapezoid: metres from the eye across the light, or over
///   a lamp's depth.
struct ViewSlice {
    glm::dvec4 axis{0.0};                                      // the row of what is counted
    double begin_m = -std::numeric_limits<double>::infinity(); // where it begins; -infinity: nowhere
    double end_m = std::numeric_limits<double>::infinity();    // where it ends; infinity: nowhere
    /// Where the view before it, which serves as far as here too, fades over into this one: from begin_m to begin_m +
    /// blend_m. 0: there is none before it.
    double blend_m = 0.0;
    glm::dvec4 over{0.0, 0.0, 0.0, 1.0}; // 1 everywhere, or the row `w` of the view's sector
    bool across = false;                 // it counts along the map, and not along the camera's view

    /// It is less than everything.
    [[nodiscard]] bool bounded() const { return std::isfinite(begin_m) || std::isfinite(end_m); }
    /// It counts over a lamp's depth.
    [[nodiscard]] bool isRatio() const { return glm::dvec3(over) != glm::dvec3(0.0); }
    /// Of a point in the view's sector.
    [[nodiscard]] double depthAt(const glm::dvec3& p_ws) const
    {
        return glm::dot(axis, glm::dvec4(p_ws, 1.0)) / glm::dot(over, glm::dvec4(p_ws, 1.0));
    }
    /// Of any point; behind a lamp that it counts from, none.
    [[nodiscard]] bool holds(const glm::dvec3& p_ws) const
    {
        const double depth_m = glm::dot(axis, glm::dvec4(p_ws, 1.0));
        const double unit = glm::dot(over, glm::dvec4(p_ws, 1.0));
        return !bounded() || (unit > 0.0 && depth_m >= begin_m * unit && depth_m <= end_m * unit);
    }
};

/// Where views of one light stand side by side, the part of its directions that one of them serves: the points p with
/// |dot(x, (p, 1))| and |dot(y, (p, 1))| both at most dot(w, (p, 1)), p in world space. A map shows more, for filters
/// to read, but not all that casts there. By default it is everything. Where w is a lamp's, it is metres along an axis.
struct ViewSector {
    glm::dvec4 x{0.0};                // the row across the sector
    glm::dvec4 y{0.0};                // the other row across
    glm::dvec4 w{0.0, 0.0, 0.0, 1.0}; // the row that both are held against

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

/// What a fit achieved. Sides of texels are as View::texel_xy_m has them, in x and y of the map.
struct FitReport {
    double strength = 1.0;          // how many times as wide the widest texel is as the narrowest; 1: no warp
    glm::dvec2 finest_texel{0.0};   // of a warped map: of what is seen and lit, where it is drawn most finely
    glm::dvec2 coarsest_texel{0.0}; // and most coarsely
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

/// One map to draw: a frustum of one light.
struct View {
    std::uint32_t light = 0;         // index into Frame::lights
    glm::dmat4 clip_from_world{1.0}; // z in [0, w] beyond the near plane; y down; but see paraboloid
    DepthMetric metric;              // what the map's depths are
    bool orthographic = true; // neither a lamp's nor warped; then the rasteriser's z is the metric, up to rounding
    bool clamp_near = true;   // casters before the near plane are to be clamped onto it, not cut
    /// Side of a texel: metres across a directional light, or metres at 1 m distance from a light with a place. Of a
    /// warped map it is the longest of what is seen and lit.
    double texel_m = 0.0;
    Tile tile;                         // where in the light's pages the map is
    TexelPart part = TexelPart::whole; // of the tile's texels
    /// Range of Plan::casters: what is drawn, see ObjectFlags::casts. First those that stand still, then those that
    /// move (ObjectFlags::dynamic), each ascending; without a kept layer, all ascending.
    std::uint32_t first_caster = 0;
    std::uint32_t caster_count = 0; // how many there are
    std::uint32_t still_count = 0;  // how many of them stand still; of use with a kept layer only
    MapId map;                      // which map it is, from frame to frame
    /// What the map must hold for the drawing below to be enough, and what it holds afterwards. A backend that notes
    /// for each MapId::index what it drew last, and finds another number there than `presumes`, draws all of the tile
    /// from all casters, whatever `redraw` and `dirty` say; it then holds `makes` all the same. So a frame that was
    /// skipped, an image that was lost and a second renderer mend themselves. Presumes 0: all is drawn in any case.
    /// Makes 0: nobody reads the map in this frame; it is to be left as it is.
    ContentNumber presumes = 0;
    ContentNumber makes = 0; // what it holds afterwards; 0: leave it
    bool redraw = true;      // makes != presumes: something is to be drawn
    /// Layer of the images that hold maps of still casters alone (same size and place there as `tile`), from which the
    /// map is restored before those that move are drawn over it. Of the plan's views no other one has the same texels
    /// of it, or it has another `part` of them. kNoIndex: the map is drawn all at once.
    std::uint32_t kept_layer = kNoIndex;
    bool redraw_kept = false; // draw the still casters into the kept layer first; then `dirty` is all of the tile
    /// The square of the kept layer is a map like any other, with its own name and contents. Where it does not hold
    /// what it should, the still casters are drawn into it first, and then all of the tile is dirty.
    MapId kept_map;
    ContentNumber kept_presumes = 0; // as `presumes`, of the kept map
    ContentNumber kept_makes = 0;    // as `makes`, of the kept map
    /// With a kept layer and `redraw`: what has to be restored and drawn over, because something that moves is there or
    /// was when the map was drawn last.
    TexelRect dirty;
    SunPosition sun = SunPosition::only; // of a stepping sun, which of its positions
    glm::dvec2 texel_xy_m{0.0};          // both sides of a texel, in x and y of the map; texel_m is the longer one
    FitReport fit;                       // how good the fit is
    /// Room on all sides for the rays to the rest of the light (integratesLight()), in texel_m's units of
    /// length.
    double light_reach = 0.0;
    ViewSlice slice;   // which depths it serves
    ViewSector sector; // which directions it serves
    /// How far it has faded in over the light's views before it, where they serve the same place: 0 .. 1. Less than 1
    /// only while frustums of partition multi change under motion snap (MultiOptions::fade_frames).
    double faded_in = 1.0;
    /// MultiDivide::receivers: its light's views overlap, finest first. Each counts for its opacityAt() a point, but no
    /// more than those before it leave, and all together for 1.
    bool layered = false;
    double rim = 0.0; // layered: share of half its sector's width over which it fades out towards the sector's border
    /// Layered, of a point in its sector: 0 .. 1.
    [[nodiscard]] double opacityAt(const glm::dvec3& p_ws) const
    {
        const glm::dvec4 p(p_ws, 1.0);
        const double across = std::max(std::abs(glm::dot(sector.x, p)), std::abs(glm::dot(sector.y, p)));
        const double inside = 1.0 - across / glm::dot(sector.w, p);
        return (rim > 0.0 ? std::clamp(inside / rim, 0.0, 1.0) : 1.0) * faded_in;
    }
    /// What it counts for at a depth (ViewSlice::depthAt()) where a view before it serves the place, too: 0 .. 1.
    [[nodiscard]] double shareAt(double depth_m) const
    {
        const bool fades = slice.blend_m > 0.0;
        const double over = fades ? std::clamp((depth_m - slice.begin_m) / slice.blend_m, 0.0, 1.0) : 1.0;
        return fades || faded_in < 1.0 ? over * faded_in : 0.0;
    }
    /// Partition::sdsm: which of its light's cascades this is. Then what is above says how the light's base map lies,
    /// and the GPU finds which rectangle of it the view shows and which slice it serves (FittedView). Depth and casters
    /// are the base map's. Always to be drawn again. kNoIndex: all is as it says here.
    std::uint32_t gpu_cascade = kNoIndex;
    /// The light's rays are parallel. Otherwise they come from light_place_ws, and the map is a perspective one or a
    /// paraboloid.
    bool parallel = true;
    /// The map is a paraboloid, of the half space that `sector` has. Then clip_from_world takes a point to (q, 1 / s):
    /// q is from the light to the point, in axes of the map (x right, y down, z along its axis) and in lengths of far -
    /// near; and the map has it at s q.xy / (q.z + |q|), of -1 .. 1 over its tile, with depth |q| + metric.metric_ws.w
    /// (placeOnMap(), depthOnMap()). The half space is a disc of radius s, beside which there is room for kernels.
    bool paraboloid = false;
    /// Where depths are measured from. Directional: the centre of what is seen, backed out against the light until
    /// everything that can cast is in front (Marinescu 2011, eq. 6); spot, point: the light's position.
    glm::dvec3 light_place_ws{0.0};
    /// For how many frames its map has been out of date, this one included, as LightPlan::waited has it. Then matrices,
    /// casters and tile are those that it had. Of a cascade that waits by itself (CascadeOptions::room) `slice` is this
    /// frame's. 0: its map is what it should be.
    std::uint32_t waited = 0;
    /// Filters id and depth-id: names the ids that its casters are drawn with. A map that was drawn with others is out
    /// of date. 0: no ids.
    std::uint64_t ids_key = 0;
    /// LayerPlacement::world: the layers of the world as this view has them, from near to far. Else all are none.
    std::array<DepthSpan, kMaxDepthLayers> layers{};
    /// With gpu_cascade: how far the view is to be moved over what it shows, in its own texels. Else it has been.
    glm::dvec2 grid_move_texels{0.0};
};

/// What the GPU found for a view with View::gpu_cascade: with (x, y) a place on the base map, in [-1, 1], the view's
/// own is ((x, y) - centre) * scale.
struct FittedView {
    glm::dvec2 scale{1.0};                                     // how many times finer than the base map, by axis
    glm::dvec2 centre{0.0};                                    // of what the view shows, on the base map
    double begin_m = -std::numeric_limits<double>::infinity(); // as ViewSlice
    double end_m = std::numeric_limits<double>::infinity();    // as ViewSlice
    double blend_m = 0.0;                                      // as ViewSlice
    /// Of the base map, the rectangle that the slice's pixels lie in; low > high: there are none, and the view is the
    /// base map.
    glm::dvec2 seen_low{1.0};
    glm::dvec2 seen_high{-1.0}; // its other corner

    /// No pixel of the picture is in the slice.
    [[nodiscard]] bool empty() const { return seen_low.x > seen_high.x; }
};
/// The view as it was drawn: what is known of it beforehand is its base map.
[[nodiscard]] GNOMON_API View viewAsFitted(const View& base, const FittedView& found);

/// Where a sun that moves in steps stands for its maps, and how what they say is joined: with v and u the visibilities
/// by the earlier and the later position, v + (u - v) * weight, where at x (0: left edge of the picture, 1: right)
///   a = band > 0 ? clamp((edge - x) / band, 0, 1) : share,  weight = smooth ? a^2 (3 - 2 a) : a.
/// Based on: P. Fortier, "Shadow maps for moving light sources", IceFall Games, 2010.
struct SunSteps {
    bool stepping = false; // false: the light's own direction; nothing below counts
    /// There are views of two positions (SunPosition); else of one alone, SunPosition::only.
    bool paired = false;
    glm::dvec3 earlier_ws{0.0, -1.0, 0.0}; // unit, the way light travels
    glm::dvec3 later_ws{0.0, -1.0, 0.0};   // unit
    double share = 0.0;                    // how far the sun itself has got from one to the other: 0 .. 1
    bool smooth = false;                   // the weight is a cubic of the share, else linear
    double band = 0.0;                     // width, share of the picture's; 0: the weight is the same all over
    double edge = 0.0;                     // the band's right end
    /// Maps by turns (step-alternate): this frame draws and reads those of `read` alone, and joins them with what the
    /// frame before made of the other one.
    bool alternate = false;
    SunPosition read = SunPosition::earlier; // which position's maps are drawn and read now
};

/// What Partition::automatic and Fit::automatic came to for a light, and why.
struct AutoChoice {
    bool made = false; // the light leaves one of them to the planner, and something was in sight to choose by
    Partition partition = Partition::single; // what partition auto came to
    double texels_per_pixel = 0.0; // predicted, before anything is drawn: geometric mean over what is probably seen
    double error = 0.0;            // predicted share of that which is wrong, 0 .. 1; of use for comparing only
    double other_error = 0.0;      // the same for the partition that was not taken; 0: there was no other
    /// How many times the side of its maps was halved, because finer texels are predicted to gain nothing.
    std::uint32_t halvings = 0;
    std::string_view reason; // a sentence with static lifetime
};

/// soften=converge: where a light shines from in this frame, a point of the light itself (convergeSample()). Its maps
/// are drawn from there, and its mask is joined with those of the frames before.
struct LightSample {
    bool joined = false;                     // false: the light's own place; nothing below counts
    glm::dvec3 position_ws{0.0};             // of a spot or point light, metres
    glm::dvec3 direction_ws{0.0, -1.0, 0.0}; // unit, the way light travels
    std::uint32_t number = 0; // of the frame since the last cut, from 0 on, modulo 1024: what noise goes by
};

/// What was planned for one light of the frame.
struct LightPlan {
    std::uint32_t first_view = 0;   // range of Plan::views; of a paired light the earlier position's come first
    std::uint32_t view_count = 0;   // 0: it has no map
    std::uint32_t mask_layer = 0;   // of the mask image
    std::uint32_t mask_channel = 0; // 0..3: visibility, by which blended casters count as a grey
    /// The layer is this light's alone: red, green and blue are what arrives of each, of 1, and mask_channel is 3.
    /// Translucent::colour, whether there are blended casters or not.
    bool mask_coloured = false;
    std::uint32_t options = 0; // Light::options
    /// How many times the side of its maps was halved, or of that one where it was most often, so that all lights have
    /// room (ShadowOptions::budget_texels).
    std::uint32_t halved = 0;
    /// For how many frames its maps have been out of date, this one included: its turn has not come
    /// (ShadowOptions::draw_budget_texels). Its views are those that it had before, with nothing to draw: the place is
    /// in shadow as it was, and what these maps do not show is lit. Of single cascades the longest. 0: nobody waits.
    std::uint32_t waited = 0;
    /// Filters id and depth-id: where in Plan::object_ids those of this light begin. kNoIndex: it has none.
    std::uint32_t first_object_id = kNoIndex;
    Outcome outcome;    // drawn as asked, or why not
    SunSteps steps;     // a sun that moves in steps
    AutoChoice choice;  // what auto came to
    LightSample sample; // soften converge
    /// Filter volumes: it has no views. Range of Plan::casters: the objects whose shadow volumes are to be counted,
    /// ascending; all of them ObjectFlags::closed. 0 for every other filter.
    std::uint32_t first_volume = 0;
    std::uint32_t volume_count = 0; // how many objects that is
    std::uint32_t left_out = 0;     // casters that are not closed, with OpenCasters::skip
};

/// The images that the maps of one of the planner's options lie in. None of the numbers falls while a map is in use, so
/// an image that grows can be copied into the larger one: the plan takes it that what was drawn is still there.
struct MapPages {
    std::uint32_t width = 0;       // texels; a page is as large as the largest map
    std::uint32_t height = 0;      // texels
    std::uint32_t layers = 0;      // pages of maps: Tile::layer is less
    std::uint32_t kept_layers = 0; // pages of maps of still casters alone: View::kept_layer is less
    /// Texels of all its lights' maps, in sight or not: as they want them, and as they have them.
    std::uint64_t wanted_texels = 0;
    std::uint64_t given_texels = 0; // as they have them, never more than they want
    /// Texels of its lights' maps that this plan draws (texelsToDraw()), how many of its lights wait, with how many
    /// maps, and the longest LightPlan::waited.
    std::uint64_t drawn_texels = 0;
    std::uint32_t waiting_lights = 0; // lights whose turn has not come
    std::uint32_t waiting_maps = 0;   // maps whose turn has not come
    std::uint32_t longest_wait = 0;   // frames
};

/// The frame that a plan was made for, as far as backends ask. A plan serves another eye close by, too: set `camera` in
/// a copy of it, and its views to draw nothing more (View::redraw, presumes = makes).
struct PlannedFrame {
    Camera camera;             // Frame::camera
    glm::uvec2 size_px{0};     // Frame::size_px
    std::vector<Light> lights; // as the host gave them
    Aabb scene_ws{};           // around all objects, ObjectSet::bounds()
    std::uint64_t objects = 0; // ObjectSet::identity(); 0: there were none
    std::uint64_t version = 0; // ObjectSet::version()
};

/// What there is to draw in one frame, and what each light came to.
struct Plan {
    std::uint64_t frame = 0; // Frame::index
    PlannedFrame made_for;   // the frame, as far as backends ask
    /// Differs between any two planners of a process. Maps of two planners may lie at the same place under different
    /// names, so a backend that is handed another planner's plan forgets what it noted of the last one's maps.
    std::uint64_t planner = 0;
    /// Those of the planner, never null and never empty in a plan that it made: LightPlan::options is the index, also
    /// into `pages`. The defaults stand for options that are refused. They last as long as any copy of the plan.
    std::shared_ptr<const std::vector<ResolvedOptions>> options;
    std::vector<LightPlan> lights;        // one per light of the frame, in its order
    std::vector<View> views;              // all maps of the frame, light after light
    std::vector<std::uint32_t> casters;   // object indices, view after view; with filter volumes light after light
    std::vector<std::uint32_t> receivers; // object indices that the camera sees, ascending
    std::vector<MapPages> pages = std::vector<MapPages>(1); // one for each of the planner's options
    /// One past the largest MapId::index that any light has, in sight or not, kept layers included.
    std::uint32_t map_count = 0;
    std::uint32_t mask_layers = 0; // one for every four lights without colours, and one for each coloured light
    /// Which of its planner's plans this is, from 1 on: the next one goes on from it.
    std::uint64_t number = 0;
    bool cut = false; // this plan goes on from none: Frame::cut, another ObjectSet, or a planner's first
    /// Filters id and depth-id (object_ids.h): for each light that has any, one for each object of `object_bounds`; 0
    /// of what does not cast.
    std::vector<std::uint16_t> object_ids;
    /// By index, the bounds within which filter depth-id counts an object's depths (shareIdBounds()). Empty where no
    /// light has ids.
    std::vector<Aabb> object_bounds;
    /// ObjectFlags::pieces of them. Empty where no light has ids of pieces (IdOf::face).
    std::vector<std::uint16_t> object_pieces;
    /// soften=converge: boxes around all objects that came, went or changed since the plan before, where they are and
    /// where they were; world space. At most kMostMoved.
    std::vector<Aabb> moved_ws;
};
inline constexpr std::size_t kMostMoved = 16; // of Plan::moved_ws

/// The plan as JSON text, two-space indented, keys and numbers the same on every machine (shortest round-trip form).
[[nodiscard]] GNOMON_API std::string toJson(const Plan& plan);

} // namespace gnomon
