// SPDX-License-Identifier: Apache-2.0
// How a light's shadows are made: the one struct that planner, backend and program are configured by. resolve() checks
// it and fills in what follows from it, so nobody has to compare two descriptions of one technique.
// Keys, units and ranges of every member, as a table: option_table.h.
#pragma once

#include <gnomon/bias.h>
#include <gnomon/choices.h>
#include <gnomon/export.h>
#include <gnomon/moment_options.h>
#include <gnomon/screen_blur_options.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace gnomon {

inline constexpr std::uint32_t kMaxCascades = 6; // the largest CascadeOptions::count

/// How the maps of one light's cascades are drawn. They are the same either way, bit for bit.
enum class CascadePass : std::uint8_t {
    automatic, // the backend's choice: `each`
    each,      // every map in a pass of its own
    layered,   // one pass for those that viewsTogether() puts together: what casts in a map is drawn to its layer
};
[[nodiscard]] GNOMON_API std::string_view nameOf(CascadePass value);

/// How Partition::cascades and sdsm divide the camera's depth.
struct CascadeOptions {
    std::uint32_t count = 4; // 1 .. kMaxCascades
    /// The practical split: 1 divides logarithmically, as perspective shrinks things, 0 evenly. F. Zhang, H. Sun,
    /// L. Xu, L. K. Lun, "Parallel-split shadow maps for large-scale virtual environments", 2006, eq. 5.
    double lambda = 0.75;
    /// Where all cascades but the last end, metres from the eye along its view: > 0, ascending, count - 1 of them.
    /// Zeros: the practical split.
    std::array<double, kMaxCascades - 1> ends_m{};
    double blend = 0.1; // share of a cascade's own depth over which it fades into the next: 0 .. 0.5
    CascadePass pass = CascadePass::automatic; // makes a difference only in time
    /// With a bound on what a frame draws (ShadowOptions::draw_budget_texels, draw_budget_ms) and Partition::cascades:
    /// the room on each side of what is seen of a slice, for all maps but a light's first. It is a share of the slice's
    /// width and depth, 0 .. 0.5. Each of these maps then takes turns by itself (ViewContents::waited). A map is 1 + 2
    /// room times as wide, and its texels are as much larger. 0: a light's maps take turns together.
    double room = 0.0;

    /// Splits are given, not computed.
    [[nodiscard]] bool explicitEnds() const
    {
        return std::ranges::any_of(ends_m, [](double end_m) { return end_m != 0.0; });
    }
    bool operator==(const CascadeOptions&) const = default;
};

/// How partition multi divides what a light shines on.
enum class MultiDivide : std::uint8_t {
    space,     // by directions, and by how fine texels have to be
    receivers, // objects are gathered into cones of at most 120 degrees: T. Forsyth, GDC 2006
};
[[nodiscard]] GNOMON_API std::string_view nameOf(MultiDivide value);

/// Partition multi.
struct MultiOptions {
    MultiDivide divide = MultiDivide::space; // space or receivers are divided among frustums
    /// Texels a pixel that each part of the picture gets, as long as a light's texels last: 0.125 .. 8. Nothing: 1, and
    /// then the remaining texels are given out too, until a texel is an eighth of a pixel. They are not given out where
    /// a frame's drawing is bounded (draw_budget_texels, draw_budget_ms), where map_size is given, by receivers, nor
    /// with most_times.
    std::optional<double> texels_per_pixel;
    /// The largest ratio of the texels a pixel that two places in one frustum need: 2 .. 1024, a power of two, rounded
    /// down; less is 2. The last of four frustums in one direction serves all that is left. 0: frustums are divided
    /// where that saves texels. T. Forsyth (GDC 2006) has 4. With MultiDivide::receivers no receiver has more than this
    /// many times the texels per degree that it wants, whatever the number; 0 is 4.
    double most_times = 0.0;
    /// With motion snap: the frames over which frustums fade over into others where their texels or the places that
    /// they serve change; 0 .. 64. 0: at once.
    std::uint32_t fade_frames = 8;
    bool operator==(const MultiOptions&) const = default;
};

/// When a sun that moves in steps takes the next one.
enum class StepBy : std::uint8_t { angle, time };
[[nodiscard]] GNOMON_API std::string_view nameOf(StepBy value);

/// The event that a step of Motion::step_jump waits for once it is due.
enum class StepWait : std::uint8_t {
    none,
    camera, // a frame in which the camera moves or is cut: a jump is less visible where the whole picture changes
};
[[nodiscard]] GNOMON_API std::string_view nameOf(StepWait value);

/// How the step motions divide a sun's course.
struct StepOptions {
    StepBy by = StepBy::angle;               // the next step is due by angle or by time
    double angle_rad = 0.008726646259971648; // by angle: 0.5 degrees, about the sun's own width; 0.01 .. 28 degrees
    double interval_s = 2.0;                 // by time: 0.01 .. 86400, of Frame::time_s
    bool smooth = false;                     // step-blend, -band, -alternate: the share as a cubic, else linear
    double band = 0.25;                      // step-band: its width, share of the picture's: 0.01 .. 1
    StepWait wait = StepWait::none;          // step-jump; the other motions have no jump to hide
    /// With a wait: the longest that a due step waits, s, of Frame::time_s; 0 .. 86400. Meanwhile the shadow lags
    /// behind the moving sun.
    double longest_wait_s = 10.0;

    bool operator==(const StepOptions&) const = default;
};

/// Whether still casters are drawn apart and kept, so that only moving ones have to be drawn again.
enum class KeepStill : std::uint8_t {
    automatic, // where a motion holds a map for many frames under a moving sun: the step motions
    never,
    always,
};
[[nodiscard]] GNOMON_API std::string_view nameOf(KeepStill value);

/// How blended casters change light, where a host says which casters are blended (ShadowRendererOptions::is_blended).
enum class Translucent : std::uint8_t {
    none,   // nothing: they cast no shadow, and no maps of tints are made or drawn
    grey,   // each lets 1 - alpha (1 - colour) through, and the mask has the luminance of the white light that arrives
    colour, // as grey, and the mask also has red, green and blue of that light: LightPlan::mask_coloured
};
[[nodiscard]] GNOMON_API std::string_view nameOf(Translucent value);

/// How shadows are lightened by b (ShadowOptions::lighten).
enum class LightenAs : std::uint8_t {
    remap, // V (1 - b) + b: full shadow is b, penumbrae keep their shape
    add,   // V + b, at most 1, as A. Marinescu has it, 2011: a V above 1 - b becomes fully lit
};
[[nodiscard]] GNOMON_API std::string_view nameOf(LightenAs value);

/// The kernel of Filter::pcf.
struct PcfOptions {
    PcfKernel kernel = PcfKernel::gaussian_3x3; // which texels are compared, and their weights
    std::uint32_t taps = 16;                    // poisson, vogel: 4 .. 64
    float radius_texels = 2.5F;                 // poisson, vogel: 0.5 .. 16
    /// Gaussian kernels: standard deviation, 0.3 .. 4; nothing: a quarter of the kernel's width.
    std::optional<float> sigma_texels;

    bool operator==(const PcfOptions&) const = default;
};
/// Texels on a side of a separable kernel: 1 (bilinear), 3, 5 or 7; 0 for the discs. For nine equal point samples it is
/// shared::kBoxKernel or kProjectedKernel, which are below 0 (gnomon/shared/pcf_weights.h).
[[nodiscard]] GNOMON_API int kernelWidth(PcfKernel kernel);

/// Soften::smoothies and Filter::smoothies.
struct SmoothiesOptions {
    /// Texels that edges are widened by, 4 .. 32: no penumbra is wider than that. Their cost grows with it.
    std::uint32_t reach_texels = 16;

    bool operator==(const SmoothiesOptions&) const = default;
};

/// Which texels filters id and depth-id read, and how they count (gnomon/shared/object_ids.h).
enum class IdTest : std::uint8_t {
    automatic, // `any` for id, `priority` for depth-id
    any,       // lit where one of the four nearest texels is: shadows shrink by a texel at the most
    priority,  // the nearest texel; one whose object lies behind is ignored where the object has other texels
    nearest,   // the nearest texel alone: dark halos where it is just beside the object
};
[[nodiscard]] GNOMON_API std::string_view nameOf(IdTest value);

/// The depth that filter depth-id keeps beside an id.
enum class IdDepth : std::uint8_t {
    object, // depth within the object's own range along the light
    global, // the map's depth, as other filters have it
};
[[nodiscard]] GNOMON_API std::string_view nameOf(IdDepth value);

/// The things that have an id each.
enum class IdOf : std::uint8_t {
    object, // an object does not shade itself
    face,   // each of its pieces (ObjectFlags::pieces), which shade each other. The host says which piece is where
};
[[nodiscard]] GNOMON_API std::string_view nameOf(IdOf value);

/// Filters id and depth-id.
struct IdOptions {
    IdTest test = IdTest::automatic; // which texels are asked
    IdDepth depth = IdDepth::object; // depth-id
    /// depth-id: how far towards the light an object is moved to be compared with itself, as a share of its radius,
    /// which is half its box's diagonal: 0 .. 1. One step of the stored depth is added. Nothing: BiasOptions apply, as
    /// with other filters.
    std::optional<float> bias;
    IdOf of = IdOf::object; // whether an object or a piece does not shade itself

    bool operator==(const IdOptions&) const = default;
};

/// The treatment of casters that filter volumes cannot count (ObjectFlags::closed).
enum class OpenCasters : std::uint8_t {
    refuse, // a light that such a caster may shade gets Outcome refused
    skip,   // they cast nothing (LightPlan::left_out)
};
[[nodiscard]] GNOMON_API std::string_view nameOf(OpenCasters value);

/// Filter volumes.
struct VolumeOptions {
    /// The treatment of open casters. Their count is wrong, which spoils whole streaks of the picture.
    OpenCasters open = OpenCasters::refuse;
    bool operator==(const VolumeOptions&) const = default;
};

/// The size of the images that filters write to, before the mask itself.
enum class MaskSize : std::uint8_t {
    full, // the mask's own: every pixel reads maps
    half, // one pixel of each 2 x 2 reads maps. The others take from those around that show the same surface, or read
          // maps themselves where there are none or they differ. Things thinner than two pixels may be missed
};
[[nodiscard]] GNOMON_API std::string_view nameOf(MaskSize value);

/// The effort that `automatic` may spend within the texels that a light's maps may have.
enum class Quality : std::uint8_t {
    fast,     // one map; filter pcf
    balanced, // one map, or cascades that share its texels, whichever has the smaller predicted error; filter raymarch
    best, // one map, fitted on the GPU to what the camera sees, as sdsm has it: the host gives the camera's depth to
          // ShadowRenderer::recordBounds() before its maps. With a motion other than free: balanced. Filter raymarch
};
[[nodiscard]] GNOMON_API std::string_view nameOf(Quality value);

/// All settings of a light's shadows. The defaults are among the best techniques that there are.
struct ShadowOptions {
    Technique technique;                 // one value each of the choices, except the light's type
    Quality quality = Quality::balanced; // the effort of `automatic`
    std::optional<MapFormat> format;     // a texel's format; nothing: the filter's first format
    /// Texels on a side of one map, 16 .. 16384. Cascades that partition auto chose share the texels of one such map:
    /// four have half the side. Nothing: the planner chooses the largest side for which the light has texels; or a
    /// half, a quarter or an eighth of that, where finer texels are predicted to gain nothing, or less than their time
    /// is worth (Frame::rates). Quality best and max_texels leave time out. Maps that a motion keeps are as large as
    /// possible.
    std::optional<std::uint32_t> map_size;
    /// Texels of all maps of a light together where map_size is nothing, 1024 .. 268435456 (16384 x 16384). The maps of
    /// each of a stepping sun's two positions may have this many. Nothing: as many as its memory has room for.
    std::optional<std::uint32_t> max_texels;
    /// The memory of all maps of a sun, and of a spot or point light, where neither map_size nor max_texels is given:
    /// MiB, 0.0625 .. 1024. It is that of the texels alone, 4 bytes for each at least; images beside maps (blocks,
    /// edges, kept maps) are not counted. A page has as many texels as the larger of both has room for.
    double sun_memory_mib = 64.0;
    double lamp_memory_mib = 16.0; // as sun_memory_mib
    /// Receivers farther from the eye than this get no shadow, metres; 0: no limit.
    double max_distance_m = 0.0;
    double fade = 0.1; // share of max_distance_m over which shadows fade away: 0 .. 1
    /// Fit tsm with partition single and motion free: affine segments that the trapezoid is drawn in, each with a map
    /// of its own, near ones smaller; 1 .. kMaxCascades. 1: all of it by one projective warp. Segments are T. Forsyth's
    /// ("Extremely Practical Shadows", GDC 2006).
    std::uint32_t tsm_segments = 1;
    CascadeOptions cascades;                     // partitions cascades and sdsm
    MultiOptions multi;                          // partition multi
    StepOptions steps;                           // the step motions
    KeepStill keep_still = KeepStill::automatic; // two images instead of one where it is done
    /// Room around the fitted rectangle for the filter's kernel, texels; 0 .. 64. Nothing: as much as the kernel needs,
    /// at least 4. At most a quarter of map_size is used, so that half of the map is left.
    std::optional<double> border_texels;
    /// Filterable maps under parallel light: measure depth from a plane that leans with the receivers, so that level
    /// ground is level in depth whatever the sun's height. It is still metres along the ray. False: along the light's
    /// axis, as maps of bare depth always do.
    bool level_depth = true;
    /// Pages that the maps of these options may take: 1 .. 2048. Maps of still casters may take as many again.
    std::uint32_t max_layers = 64;
    /// Texels that the maps of all lights with these options may have together, 1024 .. 2^35; 0: as many as max_layers
    /// pages have. A page has no more either. Where lights want more, the sides of their maps are halved, first those
    /// that do least for the picture with their texels (LightPlan::halved). Lights that find no room for maps of 16
    /// texels get Outcome atlas_full.
    std::uint64_t budget_texels = 0;
    /// Texels that the maps of all lights with these options may have drawn in one frame, 0 .. 2^35; 0: no bound. Where
    /// more are out of date, lights take turns: those are drawn first that matter most to the picture and have waited
    /// longest, each with all its maps, at least one light a frame. The others keep the views that they had
    /// (LightPlan::waited). A light that has no maps to keep does not wait, whatever the bound is.
    std::uint64_t draw_budget_texels = 0;
    /// The same bound in milliseconds of the device's time, 0 .. 10000; 0: none. The planner has no clock: it goes by
    /// Frame::draw_ms_per_texel, which the host measures (DrawRate). As long as that is not known, this bounds nothing.
    /// The tighter of both bounds counts.
    double draw_budget_ms = 0.0;
    /// With a bound on what is drawn: frames for which a light, or a cascade by itself, waits at most, 1 .. 64. Then it
    /// is drawn whatever the bound is.
    std::uint32_t longest_wait = 8;
    PcfOptions pcf;                              // filters pcf, smoothies
    SmoothiesOptions smoothies;                  // soften and filter smoothies
    IdOptions ids;                               // filters id, depth-id
    BiasOptions bias;                            // maps that compare depths
    CasterFaces faces = CasterFaces::nearest;    // which surface of its casters a map holds
    CasterCull cull = CasterCull::none;          // which triangles of all casters are left out
    Translucent translucent = Translucent::grey; // where a host says which casters are blended
    /// The visibility that full shadow becomes: 0 .. 1. It is applied to the filter's result for each map, before maps
    /// of one light are joined.
    float lighten = 0.0F;
    LightenAs lighten_as = LightenAs::remap; // add: refused with soften converge, which averages frames afterwards
    MomentOptions moments;                   // filters vsm, lvsm, esm, evsm, msm; hard and pcf use the metric alone
    MaskSize mask_size = MaskSize::full;     // half: refused with filter volumes and with soften converge
    ScreenBlurOptions screen_blur;           // soften blur
    VolumeOptions volumes;                   // filter volumes

    bool operator==(const ShadowOptions&) const = default;
};

/// Options that were checked, with everything that follows from them. resolve() alone makes one.
class GNOMON_API ResolvedOptions {
public:
    /// The options that were asked for, with the filter that is used instead of automatic.
    [[nodiscard]] const ShadowOptions& asked() const { return asked_; }
    /// One value of each choice; the filter is never automatic.
    [[nodiscard]] const Technique& technique() const { return asked_.technique; }
    /// The filter that is used; never automatic.
    [[nodiscard]] Filter filter() const { return asked_.technique.filter; }
    /// The filter's row.
    [[nodiscard]] const FilterTraits& traits() const { return *traits_; }
    /// The format of a texel.
    [[nodiscard]] MapFormat format() const { return format_; }
    /// FilterTraits::filterable
    [[nodiscard]] bool filterable() const { return traits_->filterable; }
    /// FilterTraits::has_maps
    [[nodiscard]] bool hasMaps() const { return traits_->has_maps; }
    /// ShadowOptions::pcf
    [[nodiscard]] const PcfOptions& pcf() const { return asked_.pcf; }
    /// ShadowOptions::ids
    [[nodiscard]] const IdOptions& ids() const { return asked_.ids; }
    /// IdOptions::test, with what automatic stands for.
    [[nodiscard]] IdTest idTest() const;
    /// ShadowOptions::bias
    [[nodiscard]] const BiasOptions& bias() const { return asked_.bias; }
    /// ShadowOptions::moments
    [[nodiscard]] const MomentOptions& moments() const { return asked_.moments; }
    /// The depth that maps store: MomentOptions::metric with a filter that has it (FilterTraits::has_metric), else
    /// linear.
    [[nodiscard]] DepthMetricKind metric() const
    {
        return traits_->has_metric ? asked_.moments.metric : DepthMetricKind::linear;
    }
    /// ShadowOptions::cascades
    [[nodiscard]] const CascadeOptions& cascades() const { return asked_.cascades; }
    /// ShadowOptions::tsm_segments; 1 with every fit but tsm.
    [[nodiscard]] std::uint32_t segments() const;
    /// How partition multi divides a light.
    [[nodiscard]] const MultiOptions& multi() const { return asked_.multi; }
    /// ShadowOptions::screen_blur
    [[nodiscard]] const ScreenBlurOptions& screen_blur() const { return asked_.screen_blur; }
    /// Texels of room around the fitted rectangle: as many as were asked for, or as the filter needs.
    [[nodiscard]] double border_texels() const { return border_texels_; }
    /// Texels on a side of the largest map that a light can have, and of a page.
    [[nodiscard]] std::uint32_t largest_side() const { return largest_side_; }
    /// The same of a light of one type: the page's side, halved until the light has texels for it.
    [[nodiscard]] std::uint32_t largestSide(LightType type) const;
    /// The border of a map with `side` texels on a side: at most a quarter of them.
    [[nodiscard]] double borderOf(std::uint32_t side) const { return std::min(border_texels_, 0.25 * side); }
    /// Only one pixel of each 2 x 2 reads maps where possible: MaskSize::half.
    [[nodiscard]] bool halvesMask() const { return asked_.mask_size == MaskSize::half; }
    /// Receivers between these distances from the eye fade from shadowed to lit, and beyond are lit; metres. End 0:
    /// nothing fades.
    [[nodiscard]] double fadeBegin_m() const { return asked_.max_distance_m * (1.0 - asked_.fade); }
    /// Where fading ends, metres from the eye; 0: nothing fades.
    [[nodiscard]] double fadeEnd_m() const { return asked_.max_distance_m; }
    /// How far from a receiver's place in the map the filter reads: reachTexels().
    [[nodiscard]] float reach_texels() const { return reach_texels_; }
    /// integratesLight() of the options that were asked for.
    [[nodiscard]] bool integratesLight() const;
    /// Maps are fitted on the GPU to the camera's depth.
    [[nodiscard]] bool fitsOnGpu() const;
    /// Beside its map a light has the edges of casters, made wide (docs/techniques/smoothies.md).
    [[nodiscard]] bool hasSmoothies() const { return hasFins() || asked_.technique.soften == Soften::smoothies; }
    /// Filter smoothies: these edges are those of meshes, drawn as fins.
    [[nodiscard]] bool hasFins() const { return asked_.technique.filter == Filter::smoothies; }
    /// A texel has two maps of 16 bits each: a light's two positions of a stepping sun share their tiles.
    [[nodiscard]] bool paired_maps() const { return paired_maps_; }

    /// The same was asked for.
    bool operator==(const ResolvedOptions& other) const { return asked_ == other.asked_; }

private:
    friend struct Resolution resolve(const ShadowOptions& options);
    ResolvedOptions() = default;

    ShadowOptions asked_;
    const FilterTraits* traits_ = nullptr;
    MapFormat format_ = MapFormat::d32f;
    double border_texels_ = 0.0;
    std::uint32_t largest_side_ = 0;
    float reach_texels_ = 0.0F;
    bool paired_maps_ = false;
};

/// The result of resolve(): a checked value, or the sentence that says why not.
struct Resolution {
    std::optional<ResolvedOptions> resolved; // nothing where it is refused
    std::string refusal;                     // empty when resolved

    /// It was not refused.
    [[nodiscard]] explicit operator bool() const { return resolved.has_value(); }
    /// Precondition: not refused.
    [[nodiscard]] const ResolvedOptions& operator*() const { return *resolved; }
    /// Precondition: not refused.
    [[nodiscard]] const ResolvedOptions* operator->() const { return &*resolved; }
};
/// Refuses what lies outside its range, a combination that no light can have (refusal(LightType, Technique) for a
/// directional one), a format that the filter cannot use and moments that do not go together. A light that has further
/// rules gets its own Outcome from the planner.
[[nodiscard]] GNOMON_API Resolution resolve(const ShadowOptions& options);
/// Resolves options that are a host's own constants. Throws Error with the sentence where they are refused.
[[nodiscard]] GNOMON_API ResolvedOptions resolvedOrThrow(const ShadowOptions& options);

/// Maps are fitted on the GPU to the camera's depth: partition sdsm, or auto of quality best with motion free.
[[nodiscard]] GNOMON_API bool fitsOnGpu(const ShadowOptions& options);
/// One frame integrates over the light's whole size, and reads a map as far from a receiver as that needs: filter pcss
/// or raymarch, filter or soften smoothies, or moments whose penumbra is light.
[[nodiscard]] GNOMON_API bool integratesLight(const ShadowOptions& options);
/// Filter or soften smoothies.
[[nodiscard]] GNOMON_API bool hasSmoothies(const ShadowOptions& options);
/// The filter that is used: the one asked for, or the one that automatic stands for, which is pcf where soften or
/// partition cannot have raymarch.
[[nodiscard]] GNOMON_API Filter filterOf(const ShadowOptions& options);
/// The drawing of a frame is bounded, in texels or milliseconds: maps take turns.
[[nodiscard]] GNOMON_API bool boundsDrawing(const ShadowOptions& options);
/// ShadowOptions::tsm_segments, or 1 where the fit is not tsm.
[[nodiscard]] GNOMON_API std::uint32_t segments(const ShadowOptions& options);
/// A light's cascades take turns each by itself (CascadeOptions::room).
[[nodiscard]] GNOMON_API bool turnsByCascade(const ShadowOptions& options);
/// The filter reads maps. Filter volumes does not. It ignores all options of maps, but resolve() refuses it with a
/// format, budgets, caster faces, a kept map or colours.
[[nodiscard]] GNOMON_API bool hasMaps(const ShadowOptions& options);
/// The format that these options store in a texel: ShadowOptions::format or else the filter's first. d32f for an
/// invalid filter.
[[nodiscard]] GNOMON_API MapFormat formatOf(const ShadowOptions& options);
/// Texels of all maps of a light of this type together, where map_size is nothing: max_texels, or those that the type's
/// memory has room for.
[[nodiscard]] GNOMON_API std::uint64_t texelsOf(const ShadowOptions& options, LightType type);
/// Texels on a side of the largest map that a light with these options can have: map_size, or the largest multiple of 8
/// that texelsOf() and budget_texels have room for.
[[nodiscard]] GNOMON_API std::uint32_t largestSide(const ShadowOptions& options);
/// How far from a receiver's place in the map a filter reads: the centres of the texels that it reads are at most so
/// many texels away, along x and y each. The border has room for this. For a filterable map it covers reads at the
/// finest level. Reads of coarser levels, of anisotropic sampling and of esm in the receiver's neighbourhood are moved
/// inside the tile where they would leave it, and need no room.
[[nodiscard]] GNOMON_API float reachTexels(const ShadowOptions& options);

} // namespace gnomon
