// SPDX-License-Identifier: Apache-2.0
// The attachments that a map's casters are drawn to, and whether they need a fragment shader.
#pragma once

#include <gnomon/export.h>
#include <gnomon/options.h>
#include <gnomon/plan.h>

#include <cstdint>
#include <optional>

namespace gnomon::pack {

/// The attachments of a pass that draws casters. Depth is tested by "less or equal" and written.
struct MapAttachments {
    MapFormat depth = MapFormat::d32f; // of the depth attachment: d16, d24 or d32f
    /// The colour attachment's, which then is the map: a fragment shader writes gnomonCasterTexel()
    /// (gnomon/caster.glsl; caster_colour*.frag of the kit). None: the depths are the map, or with a filterable filter
    /// the moments are made of them.
    std::optional<MapFormat> colour;
    float clear_depth = 1.0F;  // of the depth attachment, before casters are drawn
    float clear_colour = 1.0F; // of every channel of the colour attachment: 1, or 0 for filters id and depth-id
    std::uint32_t samples = 1; // a texel, of both attachments: 1, or with a filterable filter 1 or 4
    /// A fragment shader writes gnomonCasterDepth() as depth (caster_depth*.frag, caster_colour_depth*.frag). With more
    /// than one sample it runs for each (caster_depth_samples*.frag).
    bool write_depth = false;

    /// Need casters without holes a fragment shader? Those with holes always need one.
    [[nodiscard]] bool needFragmentShader() const { return write_depth || colour.has_value(); }
    friend bool operator==(const MapAttachments&, const MapAttachments&) = default;
};

/// Is it a format of depth attachments?
[[nodiscard]] constexpr bool isDepth(MapFormat format)
{
    return format == MapFormat::d16 || format == MapFormat::d24 || format == MapFormat::d32f;
}
/// The attachments of a view with these options. `orthographic`: ViewProjection::orthographic.
/// Precondition: options.hasMaps().
[[nodiscard]] GNOMON_API MapAttachments mapAttachments(const ResolvedOptions& options, bool orthographic);
/// The same of a view of the plan.
[[nodiscard]] GNOMON_API MapAttachments mapAttachments(const Plan& plan, const View& view);

/// The channels of a format's texels that hold this part of them, a bit each: bit 0 red to bit 3 alpha. The others
/// belong to another map: neither clear nor write them. A format that holds one map a texel has only the whole.
[[nodiscard]] GNOMON_API std::uint32_t channelsOfPart(MapFormat format, TexelPart part);

} // namespace gnomon::pack
