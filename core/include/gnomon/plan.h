// SPDX-License-Identifier: Apache-2.0
// The plan of one frame: which maps to draw, with which matrices, where in the atlas, and who draws in them. Plain
// data: a host without our backend can do the GPU work from it alone.
#pragma once

#include <gnomon/choices.h>
#include <gnomon/export.h>
#include <gnomon/frame.h>
#include <gnomon/geometry.h>
#include <gnomon/options.h>
#include <gnomon/view.h>

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

/// The outcome of planning a light, as a value with a reason. Never an exception, never a silent fallback.
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
/// The name in JSON and reports; static text.
[[nodiscard]] GNOMON_API std::string_view nameOf(OutcomeKind kind);

/// The outcome of planning a light, and why.
struct Outcome {
    OutcomeKind kind = OutcomeKind::ok; // the outcome in one word
    std::string_view reason;            // a sentence with static lifetime; empty for ok

    /// Its mask channel comes from a map, or with filter volumes from counts (ok, fallback); otherwise it reads 1
    /// everywhere.
    [[nodiscard]] bool hasMap() const { return kind == OutcomeKind::ok || kind == OutcomeKind::fallback; }
};

/// The fit that the GPU found for a view with ViewProjection::gpu_cascade. A place (x, y) on the base map, in [-1, 1],
/// is ((x, y) - centre) * scale on the view's own map.
struct FittedView {
    glm::dvec2 scale{1.0};                                     // how many times finer than the base map, by axis
    glm::dvec2 centre{0.0};                                    // centre of the view's rectangle, on the base map
    double begin_m = -std::numeric_limits<double>::infinity(); // as ViewSlice
    double end_m = std::numeric_limits<double>::infinity();    // as ViewSlice
    double blend_m = 0.0;                                      // as ViewSlice
    /// The rectangle of the base map that the slice's pixels lie in; low > high: there are none, and the view is the
    /// base map.
    glm::dvec2 seen_low{1.0};
    glm::dvec2 seen_high{-1.0}; // its other corner

    /// No pixel of the picture is in the slice.
    [[nodiscard]] bool empty() const { return seen_low.x > seen_high.x; }
};
/// The view as it was drawn, made of its base map and the fit that was found.
[[nodiscard]] GNOMON_API View viewAsFitted(const View& base, const FittedView& found);

/// The two positions of a sun that moves in steps, and how their visibilities are joined: with v by the earlier and u
/// by the later position, v + (u - v) * weight. At x (0: left edge of the picture, 1: right)
///   a = band > 0 ? clamp((edge - x) / band, 0, 1) : share,  weight = smooth ? a^2 (3 - 2 a) : a.
/// Based on: P. Fortier, "Shadow maps for moving light sources", IceFall Games, 2010.
struct SunSteps {
    bool stepping = false; // false: the light's own direction; nothing below counts
    /// The light has views of two positions (SunPosition); else of SunPosition::only.
    bool paired = false;
    glm::dvec3 earlier_ws{0.0, -1.0, 0.0}; // unit, the way light travels
    glm::dvec3 later_ws{0.0, -1.0, 0.0};   // unit
    double share = 0.0;                    // how far the sun itself has moved from one to the other: 0 .. 1
    bool smooth = false;                   // the weight is a cubic of the share, else linear
    double band = 0.0;                     // width, share of the picture's; 0: the weight is the same all over
    double edge = 0.0;                     // the band's right end
    /// Maps by turns (step-alternate): this frame draws and reads only the maps of `read`, and joins the result with
    /// the last frame's result for the other position.
    bool alternate = false;
    SunPosition read = SunPosition::earlier; // which position's maps are drawn and read now
};

/// The choice that Partition::automatic and Fit::automatic made for a light, and why.
struct AutoChoice {
    bool made = false; // the light leaves one of them to the planner, and something was in sight to choose by
    Partition partition = Partition::single; // the partition that was chosen
    double texels_per_pixel = 0.0;           // predicted before drawing: geometric mean over what is probably seen
    double error = 0.0;                      // predicted share of wrong pixels, 0 .. 1; useful only for comparison
    double other_error = 0.0;                // the same for the partition that was not taken; 0: there was no other
    /// How many times the side of its maps was halved, because finer texels are predicted to gain nothing, or less than
    /// their time is worth.
    std::uint32_t halvings = 0;
    double time_ms = 0.0; // predicted, of a frame with this light, by Frame::rates; useful only for comparison
    RateSource rates = RateSource::gpu; // the origin of these rates
    std::string_view reason;            // a sentence with static lifetime
};

/// soften=converge: the point of the light that shines in this frame (convergeSample()). The light's maps are drawn
/// from there, and its mask is joined with those of the frames before.
struct LightSample {
    bool joined = false;                     // false: the light's own place; nothing below counts
    glm::dvec3 position_ws{0.0};             // spot, point: metres
    glm::dvec3 direction_ws{0.0, -1.0, 0.0}; // unit, the way light travels
    std::uint32_t number = 0;                // frames since the last cut, from 0 on, modulo 1024; noise depends on it
};

/// The plan of one light of the frame.
struct LightPlan {
    std::uint32_t first_view = 0;   // range of Plan::views; a paired light's views of the earlier position come first
    std::uint32_t view_count = 0;   // 0: it has no map
    std::uint32_t mask_layer = 0;   // layer of the mask image
    std::uint32_t mask_channel = 0; // 0..3: its visibility, in which blended casters count as a grey
    /// The layer belongs to this light alone: red, green and blue are the shares of each that arrive, 0 .. 1, and
    /// mask_channel is 3. Set by Translucent::colour, with or without blended casters.
    bool mask_coloured = false;
    std::uint32_t options = 0; // Light::options
    /// How many times the side of its maps was halved so that all lights have room (ShadowOptions::budget_texels). The
    /// most halved map counts.
    std::uint32_t halved = 0;
    /// For how many frames its maps have been out of date, this one included: its turn has not come
    /// (ShadowOptions::draw_budget_texels). Its views are those that it had before, with nothing to draw: shadows stay
    /// as they were, and places outside these maps are lit. Where cascades wait by themselves, the longest wait. 0:
    /// nothing waits.
    std::uint32_t waited = 0;
    /// Filters id and depth-id: where the ids of this light begin in Plan::object_ids. kNoIndex: it has none.
    std::uint32_t first_object_id = kNoIndex;
    Outcome outcome;    // drawn as asked, or why not
    SunSteps steps;     // a sun that moves in steps
    AutoChoice choice;  // the choice that auto made
    LightSample sample; // soften converge
    /// Filter volumes: it has no views. Range of Plan::casters: the objects whose shadow volumes are to be counted,
    /// ascending; all of them ObjectFlags::closed. 0 for every other filter.
    std::uint32_t first_volume = 0;
    std::uint32_t volume_count = 0; // how many objects to count
    std::uint32_t left_out = 0;     // casters that are not closed, with OpenCasters::skip
};

/// The images that hold the maps of one of the planner's options. None of the numbers falls while a map is in use. A
/// backend copies an image that grows into the larger one: the plan assumes that drawn maps are still there.
struct MapPages {
    std::uint32_t width = 0;       // texels; a page is as large as the largest map
    std::uint32_t height = 0;      // texels
    std::uint32_t layers = 0;      // pages of maps: Tile::layer is less
    std::uint32_t kept_layers = 0; // pages of maps of still casters alone: ViewContents::kept_layer is less
    /// Texels that the maps of all its lights want, in sight or not.
    std::uint64_t wanted_texels = 0;
    std::uint64_t given_texels = 0; // texels that they have; never more than they want
    /// Texels of its lights' maps that this plan draws (texelsToDraw()).
    std::uint64_t drawn_texels = 0;
    std::uint32_t waiting_lights = 0; // lights whose turn has not come
    std::uint32_t waiting_maps = 0;   // maps of these lights that wait
    std::uint32_t longest_wait = 0;   // frames
};

/// The frame that a plan was made for, as far as backends need it. A plan also serves a second eye close by: set
/// `camera` in a copy of the plan, and let its views draw nothing (ViewContents::redraw, presumes = makes).
struct PlannedFrame {
    Camera camera;             // Frame::camera
    glm::uvec2 size_px{0};     // Frame::size_px
    std::vector<Light> lights; // as the host gave them
    Aabb scene_ws{};           // around all objects, ObjectSet::bounds()
    std::uint64_t objects = 0; // ObjectSet::identity(); 0: there were none
    std::uint64_t version = 0; // ObjectSet::version()
};

/// The drawing that one frame needs, and the outcome of each light.
struct Plan {
    std::uint64_t frame = 0; // Frame::index
    PlannedFrame made_for;   // the frame, as far as backends need it
    /// Differs between any two planners of a process. Maps of two planners may lie at the same place under different
    /// names, so a backend that gets another planner's plan forgets its notes about the last one's maps.
    std::uint64_t planner = 0;
    /// The planner's options, never null and never empty in a plan that it made. LightPlan::options is the index, also
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
    /// The number of this plan among its planner's, from 1 on. The next plan goes on from it.
    std::uint64_t number = 0;
    bool cut = false; // this plan goes on from none: Frame::cut, another ObjectSet, or a planner's first
    /// Filters id and depth-id (object_ids.h): for each light that has ids, one for each object of `object_bounds`; 0
    /// for an object that does not cast.
    std::vector<std::uint16_t> object_ids;
    /// By object index, the bounds within which filter depth-id measures depths (shareIdBounds()). Empty where no light
    /// has ids.
    std::vector<Aabb> object_bounds;
    /// By object index, ObjectFlags::pieces. Empty where no light has ids of pieces (IdOf::face).
    std::vector<std::uint16_t> object_pieces;
    /// soften=converge: boxes around all objects that came, went or changed since the plan before, where they are and
    /// where they were; world space. At most kMostMoved.
    std::vector<Aabb> moved_ws;
};
inline constexpr std::size_t kMostMoved = 16; // the most boxes in Plan::moved_ws

/// The plan as JSON text, two-space indented, keys and numbers the same on every machine (shortest round-trip form).
[[nodiscard]] GNOMON_API std::string toJson(const Plan& plan);

} // namespace gnomon
