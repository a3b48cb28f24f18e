// SPDX-License-Identifier: Apache-2.0
// The six independent choices that make up a shadow technique, as closed sets. Any combination works or is refused up
// front with a sentence that says why. A new technique is a value here, a file, and its lines in tables:
// CONTRIBUTING.md.
#pragma once

#include <gnomon/export.h>

#include <gnomon/shared/filter_numbers.h> // Filter

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace gnomon {

/// The type of a light. It decides what the light's maps have to cover.
enum class LightType : std::uint8_t { directional, spot, point };
/// How receivers are divided among frustums. automatic: the planner chooses partition and fit for each light and frame,
/// and resolve() chooses the filter by quality (docs/techniques/auto.md).
enum class Partition : std::uint8_t { single, cascades, sdsm, cube, paraboloid, multi, automatic, virtual_pages };
/// How a frustum's projection is shaped.
enum class Fit : std::uint8_t { uniform, lispsm, lispsm_simple, tsm, psm, scene, automatic };
/// The step that softens the mask on the screen.
enum class Soften : std::uint8_t { none, blur, smoothies, converge };
/// How a map follows a moving camera or sun.
enum class Motion : std::uint8_t { free, snap, step_jump, step_band, step_blend, step_alternate };

/// The kernel of Filter::pcf. Filter::smoothies tests its map with it too.
enum class PcfKernel : std::uint8_t {
    bilinear_2x2,
    gaussian_3x3,
    gaussian_5x5,
    gaussian_7x7,
    poisson,
    vogel,
    box_3x3,       // nine point samples a texel apart, all with the same weight
    projected_3x3, // box_3x3 with its offsets divided by the map's w, in metres from a lamp, at most 1: as published
};

/// The format of a map's texel. filterTraits().formats lists those that a filter can use.
enum class MapFormat : std::uint8_t {
    d16,
    d32f,
    r32f,
    rg16,
    rg16f,
    rg32f,
    rgba16,
    rgba16f,
    rgba32f,
    r16f,
    rgba8,
    d24,
    r8,
    r16,
    rg8
};

/// One value each of the choices that a user makes (the light brings its own).
struct Technique {
    Partition partition = Partition::automatic; // how receivers are divided among frustums
    Fit fit = Fit::automatic;                   // how each frustum's projection is shaped
    Filter filter = Filter::automatic;          // the value that a texel stores, and its test
    Soften soften = Soften::none;               // how the mask is softened on the screen
    Motion motion = Motion::free;               // how maps follow a moving camera or sun

    bool operator==(const Technique&) const = default;
};
/// One uniform map and a small kernel, 3x3 unless PcfOptions say otherwise: what other techniques are held against.
inline constexpr Technique kPlainTechnique{Partition::single, Fit::uniform, Filter::pcf, Soften::none, Motion::free};

/// One row of the table of all values: what `gnomon list` prints and every parser reads.
struct ChoiceValue {
    std::string_view choice;  // "light", "partition", "fit", "filter", "soften", "motion"
    std::string_view name;    // as typed on the command line; unique over all choices, except auto and smoothies
    std::uint8_t value;       // the value in the choice's enum
    std::string_view summary; // one line
    std::string_view source;  // author, title, year
};
/// All values of all choices, in the order of the enums.
[[nodiscard]] GNOMON_API std::span<const ChoiceValue> choiceValues();
/// The row of a name, or null.
[[nodiscard]] GNOMON_API const ChoiceValue* findChoice(std::string_view choice, std::string_view name);
/// The name of an enum's value.
[[nodiscard]] GNOMON_API std::string_view nameOf(LightType value);
[[nodiscard]] GNOMON_API std::string_view nameOf(Partition value);
[[nodiscard]] GNOMON_API std::string_view nameOf(Fit value);
[[nodiscard]] GNOMON_API std::string_view nameOf(Filter value);
[[nodiscard]] GNOMON_API std::string_view nameOf(Soften value);
[[nodiscard]] GNOMON_API std::string_view nameOf(Motion value);
[[nodiscard]] GNOMON_API std::string_view nameOf(PcfKernel value);
[[nodiscard]] GNOMON_API std::string_view nameOf(MapFormat value);
/// The kernel of a name; nothing where there is none.
[[nodiscard]] GNOMON_API std::optional<PcfKernel> findPcfKernel(std::string_view name);
/// The format of a name; nothing where there is none.
[[nodiscard]] GNOMON_API std::optional<MapFormat> findMapFormat(std::string_view name);

/// Facts of a filter that planning and the backend need; one row per filter but automatic.
struct FilterTraits {
    Filter filter;                      // whose facts these are
    std::span<const MapFormat> formats; // usable, the default first
    std::string_view formats_reason;    // the sentence for a user who asks for another format
    bool depth_only = false;            // a bare depth attachment can hold it
    bool clamps_near = false;           // a caster before the near plane may be clamped onto it
    bool filterable = false;            // texels may be averaged: MomentOptions apply, and receivers are drawn too
    bool integrates_light = false;      // it always does, by comparing single depths: integratesLight() (options.h)
    bool weighs_frames = false; // Soften::converge: a frame counts for more, the nearer to a texel's centre it reads
    bool ids = false;           // texels hold ids of objects (object_ids.h): receivers are drawn too, and the mask gets
                                // the object of each pixel
    bool has_metric = false;    // MomentOptions::metric counts; other filters read linear depths alone
    bool has_maps = true;       // false: it counts faces of shadow volumes, and a light so planned has no views
};
/// Bytes of a texel, colour or depth as the filter reads it; 0 of what is no format.
[[nodiscard]] GNOMON_API std::uint32_t texelBytes(MapFormat format);
/// The row of a filter. Null for automatic, which stands for another filter (filterOf()).
[[nodiscard]] GNOMON_API const FilterTraits* filterTraits(Filter filter);

/// Why this combination cannot be had, as a sentence that lives as long as the program; nothing when it can.
[[nodiscard]] GNOMON_API std::optional<std::string_view> refusal(LightType light, const Technique& technique);
/// Why no light of any type can be planned so; nothing when one can.
[[nodiscard]] GNOMON_API std::optional<std::string_view> refusal(const Technique& technique);
/// Why this filter cannot use this format; nothing when it can.
[[nodiscard]] GNOMON_API std::optional<std::string_view> refusal(Filter filter, MapFormat format);

} // namespace gnomon
