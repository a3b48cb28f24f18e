// SPDX-License-Identifier: Apache-2.0
// The table of all choices and what is made from it; choice_rules.cpp has what does not go together. A new technique
// has a row here and one in the table of its folder (fit/fit.h, partition/partition.h, motion/motion.h; kFilters
// below).
#include <gnomon/choice_rules.h>

#include <algorithm>
#include <array>

namespace gnomon {
namespace {

template <class Enum>
constexpr std::uint8_t number(Enum value)
{
    return static_cast<std::uint8_t>(value);
}

constexpr std::string_view kMarinescu =
    "A. Marinescu, Achieving real-time soft shadows using layered variance shadow maps (LVSM) in a real-time strategy "
    "(RTS) game, 2011";
constexpr std::string_view kForsyth = "T. Forsyth, Extremely Practical Shadows, GDC 2006";
constexpr std::string_view kShastry = "A. S. Shastry, Soft-Edged Shadows, 2005";
constexpr std::string_view kIceFall = "P. Fortier (IceFall Games), Shadow maps for moving light sources, 2010";
constexpr std::string_view kLayered = "A. Lauritzen, M. McCool, Layered Variance Shadow Maps, 2008";
constexpr std::string_view kWilliams = "L. Williams, Casting Curved Shadows on Curved Surfaces, 1978";

// Where texels of a map are compared with the pixels that they are seen by.
constexpr std::string_view kDense =
    "D. B. Lloyd, D. Tuft, S. Yoon, D. Manocha, Warping and partitioning for low error shadow maps, 2006";

constexpr std::string_view kRays =
    "S. Xie, E. Tabellion, A. Pearce, Soft shadows by ray tracing multilayer transparent shadow maps, 2007";

constexpr std::string_view kChanDurand = "E. Chan, F. Durand, Rendering Fake Soft Shadows with Smoothies, 2003";

constexpr std::string_view kLight = "light";
constexpr std::string_view kPartition = "partition";
constexpr std::string_view kFit = "fit";
constexpr std::string_view kFilter = "filter";
constexpr std::string_view kSoften = "soften";
constexpr std::string_view kMotion = "motion";

constexpr std::array kValues{
    ChoiceValue{kLight, "directional", number(LightType::directional), "a sun: parallel rays", kMarinescu},
    ChoiceValue{kLight, "spot", number(LightType::spot), "a cone of up to 180 degrees, with a cookie texture",
                kShastry},
    ChoiceValue{kLight, "point", number(LightType::point), "shines all around", kForsyth},

    ChoiceValue{kPartition, "single", number(Partition::single), "one frustum for all receivers of a light",
                kMarinescu},
    ChoiceValue{kPartition, "cascades", number(Partition::cascades),
                "slices of the camera's frustum by the practical split",
                "F. Zhang et al., Parallel-split shadow maps for large-scale virtual environments, 2006"},
    ChoiceValue{kPartition, "sdsm", number(Partition::sdsm), "slices fitted to the depth buffer",
                "A. Lauritzen, M. Salvi, A. Lefohn, Sample Distribution Shadow Maps, 2011"},
    ChoiceValue{kPartition, "cube", number(Partition::cube), "six faces around a light that has a place", kForsyth},
    ChoiceValue{
        kPartition, "paraboloid", number(Partition::paraboloid), "two half spaces around a point light",
        "S. Brabec, T. Annen, H.-P. Seidel, Shadow Mapping for Hemispherical and Omnidirectional Light Sources, 2002"},
    ChoiceValue{kPartition, "multi", number(Partition::multi),
                "as many frustums as what is seen asks for, each with a map of its own size", kForsyth},
    ChoiceValue{kPartition, "auto", number(Partition::automatic),
                "single or cascades, whichever is predicted to err less; cube of a point light", kDense},
    ChoiceValue{
        kPartition, "virtual", number(Partition::virtual_pages),
        "pages of a grid that stands still, finest where the picture has edges of shadows",
        "R. Fernando, S. Fernandez, K. Bala, D. P. Greenberg, Adaptive Shadow Maps, 2001; A. Lefohn, S. Sengupta, "
        "J. Owens, Resolution-Matched Shadow Maps, 2007; M. Giegl, M. Wimmer, Fitted Virtual Shadow Maps, 2007; "
        "O. Olsson et al., Efficient Virtual Shadow Maps for Many Lights, 2014"},

    ChoiceValue{kFit, "uniform", number(Fit::uniform), "the light-space box of what matters", kMarinescu},
    ChoiceValue{kFit, "lispsm", number(Fit::lispsm), "perspective perpendicular to the light",
                "M. Wimmer, D. Scherzer, W. Purgathofer, Light Space Perspective Shadow Maps, 2004"},
    ChoiceValue{kFit, "lispsm-simple", number(Fit::lispsm_simple),
                "perspective along the viewer's depth over what is seen", kForsyth},
    ChoiceValue{kFit, "tsm", number(Fit::tsm), "a trapezoid around what is seen, 80 % of the map for the near part",
                "T. Martin, T.-S. Tan, Anti-aliasing and Continuity with Trapezoidal Shadow Maps, 2004"},
    ChoiceValue{kFit, "psm", number(Fit::psm), "drawn in post-perspective space",
                "M. Stamminger, G. Drettakis, Perspective Shadow Maps, 2002"},
    ChoiceValue{kFit, "scene", number(Fit::scene), "made once around all of the scene, and still under any camera",
                kMarinescu},
    ChoiceValue{kFit, "auto", number(Fit::automatic), "lispsm-simple as strong as is predicted to err least", kDense},

    ChoiceValue{kFilter, "hard", number(Filter::hard), "one depth comparison per pixel", kWilliams},
    ChoiceValue{kFilter, "pcf", number(Filter::pcf), "weighted mean of the comparisons in a kernel",
                "W. Reeves, D. Salesin, R. Cook, Rendering Antialiased Shadows with Depth Maps, 1987"},
    ChoiceValue{kFilter, "pcss", number(Filter::pcss), "penumbra as wide as the blocker's distance asks",
                "R. Fernando, Percentage-Closer Soft Shadows, 2005"},
    ChoiceValue{kFilter, "raymarch", number(Filter::raymarch), "rays to points of the light, through the map", kRays},
    ChoiceValue{kFilter, "vsm", number(Filter::vsm), "two moments and Chebyshev's bound",
                "W. Donnelly, A. Lauritzen, Variance Shadow Maps, 2006"},
    ChoiceValue{kFilter, "lvsm", number(Filter::lvsm), "variance maps in layers of depth", kLayered},
    ChoiceValue{kFilter, "esm", number(Filter::esm), "an exponential of depth",
                "T. Annen et al., Exponential Shadow Maps, 2008"},
    ChoiceValue{kFilter, "evsm", number(Filter::evsm), "moments of two exponential warps", kLayered},
    ChoiceValue{kFilter, "msm", number(Filter::msm), "four moments",
                "C. Peters, R. Klein, Moment Shadow Mapping, 2015"},
    ChoiceValue{kFilter, "id", number(Filter::id), "object ids instead of depth", kForsyth},
    ChoiceValue{kFilter, "depth-id", number(Filter::depth_id), "object id, then depth inside the object", kForsyth},
    ChoiceValue{kFilter, "volumes", number(Filter::volumes),
                "no texel: counts the faces of casters' shadow volumes at each pixel",
                "M. McGuire, J. F. Hughes, K. T. Egan, M. J. Kilgard, C. Everitt, Fast, Practical and Robust Shadows, "
                "2003"},
    ChoiceValue{kFilter, "smoothies", number(Filter::smoothies),
                "pcf, and fins along casters' silhouettes that make edges as wide as the light asks", kChanDurand},
    ChoiceValue{kFilter, "auto", number(Filter::automatic), "raymarch, or pcf of quality fast", kRays},

    ChoiceValue{kSoften, "none", number(Soften::none), "visibility as the filter gives it", kShastry},
    ChoiceValue{kSoften, "blur", number(Soften::blur), "the mask blurred on the screen, by a separable Gaussian",
                kShastry},
    ChoiceValue{kSoften, "smoothies", number(Soften::smoothies), "edges of the map widened by the light's size",
                kChanDurand},
    ChoiceValue{kSoften, "converge", number(Soften::converge),
                "each frame another point of the light, averaged over frames",
                "D. Scherzer et al., Real-Time Soft Shadows Using Temporal Coherence, 2009"},

    ChoiceValue{kMotion, "free", number(Motion::free), "the map follows camera and sun exactly", kMarinescu},
    ChoiceValue{kMotion, "snap", number(Motion::snap), "the map moves by whole texels",
                "M. Valient, Stable Rendering of Cascaded Shadow Maps, 2008"},
    ChoiceValue{kMotion, "step-jump", number(Motion::step_jump), "the sun steps, the shadows jump", kIceFall},
    ChoiceValue{kMotion, "step-band", number(Motion::step_band), "each step sweeps over the screen in a band",
                kIceFall},
    ChoiceValue{kMotion, "step-blend", number(Motion::step_blend), "two steps blended over time", kIceFall},
    ChoiceValue{kMotion, "step-alternate", number(Motion::step_alternate), "two steps drawn in alternate frames",
                kIceFall},
};

template <class Enum>
struct Named {
    Enum value;
    std::string_view name;
};

constexpr std::array kKernels{
    Named<PcfKernel>{PcfKernel::bilinear_2x2, "2x2"}, Named<PcfKernel>{PcfKernel::gaussian_3x3, "3x3"},
    Named<PcfKernel>{PcfKernel::gaussian_5x5, "5x5"}, Named<PcfKernel>{PcfKernel::gaussian_7x7, "7x7"},
    Named<PcfKernel>{PcfKernel::poisson, "poisson"},  Named<PcfKernel>{PcfKernel::vogel, "vogel"},
    Named<PcfKernel>{PcfKernel::box_3x3, "3x3-box"},  Named<PcfKernel>{PcfKernel::projected_3x3, "3x3-projected"},
};
constexpr std::array kFormats{
    Named<MapFormat>{MapFormat::d16, "d16"},         Named<MapFormat>{MapFormat::d32f, "d32f"},
    Named<MapFormat>{MapFormat::r32f, "r32f"},       Named<MapFormat>{MapFormat::rg16, "rg16"},
    Named<MapFormat>{MapFormat::rg16f, "rg16f"},     Named<MapFormat>{MapFormat::rg32f, "rg32f"},
    Named<MapFormat>{MapFormat::rgba16, "rgba16"},   Named<MapFormat>{MapFormat::rgba16f, "rgba16f"},
    Named<MapFormat>{MapFormat::rgba32f, "rgba32f"}, Named<MapFormat>{MapFormat::r16f, "r16f"},
    Named<MapFormat>{MapFormat::rgba8, "rgba8"},     Named<MapFormat>{MapFormat::d24, "d24"},
    Named<MapFormat>{MapFormat::r8, "r8"},           Named<MapFormat>{MapFormat::r16, "r16"},
    Named<MapFormat>{MapFormat::rg8, "rg8"},
};

// d32f first: under a parallel light the rasteriser's own depth is the metric, so a depth-only pass is enough.
// rg16, rg16f and rgba8: two maps a texel, each of 16 bits.
constexpr std::array kDepthFormats{MapFormat::d32f,  MapFormat::r32f,  MapFormat::d16, MapFormat::rg16,
                                   MapFormat::rg16f, MapFormat::rgba8, MapFormat::d24};
constexpr std::array kRayFormats{MapFormat::d32f, MapFormat::r32f, MapFormat::d16};
constexpr std::array kIdFormats{MapFormat::r16, MapFormat::r8};
// An id and a depth: 8 bits each, 16, or an id and a depth in full floats.
constexpr std::array kDepthIdFormats{MapFormat::rg16, MapFormat::rg8, MapFormat::rg32f};
constexpr std::array kVsmFormats{MapFormat::rg32f, MapFormat::rg16, MapFormat::rg16f};
constexpr std::array kLvsmFormats{MapFormat::rgba16, MapFormat::rgba16f, MapFormat::rgba32f};
constexpr std::array kEsmFormats{MapFormat::r32f, MapFormat::r16f};
// Two channels: the positive warp alone.
constexpr std::array kEvsmFormats{MapFormat::rgba32f, MapFormat::rgba16f, MapFormat::rg32f, MapFormat::rg16f};
constexpr std::array kNoFormats{MapFormat::d32f}; // for a filter without maps, which stores nothing
constexpr std::array kMsmFormats{MapFormat::rgba16, MapFormat::rgba32f};
constexpr std::string_view kOneDepth =
    "this filter compares one depth per texel; it stores d32f, d24, r32f or d16, or two "
    "maps a texel: rg16, rg16f or rgba8";
constexpr std::array kFilters{
    FilterTraits{.filter = Filter::hard,
                 .formats = kDepthFormats,
                 .formats_reason = kOneDepth,
                 .depth_only = true,
                 .clamps_near = true,
                 .weighs_frames = true,
                 .has_metric = true},
    FilterTraits{.filter = Filter::pcf,
                 .formats = kDepthFormats,
                 .formats_reason = kOneDepth,
                 .depth_only = true,
                 .clamps_near = true,
                 .weighs_frames = true,
                 .has_metric = true},
    FilterTraits{.filter = Filter::pcss,
                 .formats = kRayFormats,
                 .formats_reason = "pcss takes the mean of blockers' depths, one per texel: d32f, r32f or d16",
                 .depth_only = true,
                 .integrates_light = true,
                 .weighs_frames = true},
    FilterTraits{.filter = Filter::raymarch,
                 .formats = kRayFormats,
                 .formats_reason = "raymarch follows rays through one depth per texel: d32f, r32f or d16",
                 .depth_only = true,
                 .integrates_light = true,
                 .weighs_frames = true},
    FilterTraits{.filter = Filter::vsm,
                 .formats = kVsmFormats,
                 .formats_reason = "vsm stores two moments: rg32f, rg16 or rg16f; of four channels it would waste two, "
                                   "where lvsm has a second layer",
                 .clamps_near = true,
                 .filterable = true,
                 .has_metric = true},
    FilterTraits{.filter = Filter::lvsm,
                 .formats = kLvsmFormats,
                 .formats_reason = "lvsm stores two moments each of two layers: rgba16, rgba16f or rgba32f",
                 .clamps_near = true,
                 .filterable = true,
                 .has_metric = true},
    FilterTraits{.filter = Filter::esm,
                 .formats = kEsmFormats,
                 .formats_reason = "esm stores one exponential, which only a float holds: r32f or r16f",
                 .clamps_near = true,
                 .filterable = true,
                 .has_metric = true},
    FilterTraits{.filter = Filter::evsm,
                 .formats = kEvsmFormats,
                 .formats_reason =
                     "evsm stores moments of exponentials, which only a float holds: rgba32f, rgba16f, or "
                     "with the positive warp alone rg32f, rg16f",
                 .clamps_near = true,
                 .filterable = true,
                 .has_metric = true},
    FilterTraits{.filter = Filter::msm,
                 .formats = kMsmFormats,
                 .formats_reason = "msm stores four moments in a basis made for unorm, or in full floats: rgba16 or "
                                   "rgba32f; half floats round them too coarsely",
                 .clamps_near = true,
                 .filterable = true,
                 .has_metric = true},
    FilterTraits{.filter = Filter::id,
                 .formats = kIdFormats,
                 .formats_reason = "id stores an object's id and nothing else: r16 or r8",
                 .clamps_near = true,
                 .ids = true},
    FilterTraits{.filter = Filter::depth_id,
                 .formats = kDepthIdFormats,
                 .formats_reason = "depth-id stores an object's id and a depth: rg16, rg8 or rg32f",
                 .clamps_near = true,
                 .ids = true},
    FilterTraits{.filter = Filter::volumes,
                 .formats = kNoFormats,
                 .formats_reason = "volumes counts faces and has no maps, so nothing is stored in texels",
                 .depth_only = true,
                 .clamps_near = true,
                 .has_maps = false},
    FilterTraits{.filter = Filter::smoothies,
                 .formats = kRayFormats,
                 .formats_reason =
                     "smoothies compares one depth per texel, in a map that has its texels for itself: d32f, "
                     "r32f or d16",
                 .depth_only = true,
                 .weighs_frames = true},
};

template <class Enum>
std::string_view nameIn(std::string_view choice, Enum value)
{
    for (const ChoiceValue& row : kValues) {
        if (row.choice == choice && row.value == number(value)) {
            return row.name;
        }
    }
    return "?";
}

template <class Enum, std::size_t n>
std::string_view nameIn(const std::array<Named<Enum>, n>& table, Enum value)
{
    for (const Named<Enum>& row : table) {
        if (row.value == value) {
            return row.name;
        }
    }
    return "?";
}

template <class Enum, std::size_t n>
std::optional<Enum> findIn(const std::array<Named<Enum>, n>& table, std::string_view name)
{
    for (const Named<Enum>& row : table) {
        if (row.name == name) {
            return row.value;
        }
    }
    return std::nullopt;
}

/// Enumerations that a host made of a number.
template <class Enum>
std::optional<std::string_view> notAValue(std::string_view choice, Enum value)
{
    const bool is_there = std::ranges::any_of(
        kValues, [&](const ChoiceValue& row) { return row.choice == choice && row.value == number(value); });
    return is_there ? std::nullopt : std::optional<std::string_view>("the value is not one of its choice's");
}

} // namespace

std::span<const ChoiceValue> choiceValues()
{
    return kValues;
}

const ChoiceValue* findChoice(std::string_view choice, std::string_view name)
{
    for (const ChoiceValue& row : kValues) {
        if (row.choice == choice && row.name == name) {
            return &row;
        }
    }
    return nullptr;
}

std::string_view nameOf(LightType value)
{
    return nameIn(kLight, value);
}
std::string_view nameOf(Partition value)
{
    return nameIn(kPartition, value);
}
std::string_view nameOf(Fit value)
{
    return nameIn(kFit, value);
}
std::string_view nameOf(Filter value)
{
    return nameIn(kFilter, value);
}
std::string_view nameOf(Soften value)
{
    return nameIn(kSoften, value);
}
std::string_view nameOf(Motion value)
{
    return nameIn(kMotion, value);
}
std::string_view nameOf(PcfKernel value)
{
    return nameIn(kKernels, value);
}
std::string_view nameOf(MapFormat value)
{
    return nameIn(kFormats, value);
}

std::optional<PcfKernel> findPcfKernel(std::string_view name)
{
    return findIn(kKernels, name);
}

std::optional<MapFormat> findMapFormat(std::string_view name)
{
    return findIn(kFormats, name);
}

std::uint32_t texelBytes(MapFormat format)
{
    switch (format) {
    case MapFormat::r8:
        return 1;
    case MapFormat::r16f:
    case MapFormat::d16:
    case MapFormat::r16:
    case MapFormat::rg8:
        return 2;
    case MapFormat::d32f:
    case MapFormat::r32f:
    case MapFormat::rg16:
    case MapFormat::rg16f:
    case MapFormat::rgba8:
    case MapFormat::d24:
        return 4;
    case MapFormat::rg32f:
    case MapFormat::rgba16:
    case MapFormat::rgba16f:
        return 8;
    case MapFormat::rgba32f:
        return 16;
    }
    return 0;
}

const FilterTraits* filterTraits(Filter filter)
{
    for (const FilterTraits& row : kFilters) {
        if (row.filter == filter) {
            return &row;
        }
    }
    return nullptr;
}

std::optional<std::string_view> refusal(LightType light, const Technique& technique)
{
    if (const auto reason = notAValue(kLight, light)) {
        return reason;
    }
    if (const auto reason = notAValue(kPartition, technique.partition)) {
        return reason;
    }
    if (const auto reason = notAValue(kFit, technique.fit)) {
        return reason;
    }
    if (const auto reason = notAValue(kFilter, technique.filter)) {
        return reason;
    }
    if (const auto reason = notAValue(kSoften, technique.soften)) {
        return reason;
    }
    if (const auto reason = notAValue(kMotion, technique.motion)) {
        return reason;
    }
    for (const ChoiceRule& rule : choiceRules()) {
        if (rule.applies(light, technique)) {
            return rule.reason;
        }
    }
    return std::nullopt;
}

std::optional<std::string_view> refusal(const Technique& technique)
{
    for (const LightType light : {LightType::spot, LightType::point}) {
        if (!refusal(light, technique)) {
            return std::nullopt;
        }
    }
    // Where no light can have the combination, a rule that is not about the light gives the reason, if there is one.
    constexpr std::array kLights{LightType::directional, LightType::spot, LightType::point};
    for (const ChoiceRule& rule : choiceRules()) {
        if (std::ranges::all_of(kLights, [&](LightType light) { return rule.applies(light, technique); })) {
            return rule.reason;
        }
    }
    return refusal(LightType::directional, technique);
}

std::optional<std::string_view> refusal(Filter filter, MapFormat format)
{
    if (const auto reason = notAValue(kFilter, filter)) {
        return reason;
    }
    const FilterTraits* traits = filterTraits(filter);
    if (traits == nullptr) {
        return kOneDepth;
    }
    return std::ranges::find(traits->formats, format) != traits->formats.end() ? std::nullopt
                                                                               : std::optional(traits->formats_reason);
}

} // namespace gnomon
