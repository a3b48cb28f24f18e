// SPDX-License-Identifier: Apache-2.0
// Further demands of a pass on the callback that draws casters. CasterDrawer meets all of them. A callback of the
// host's own needs this header for options with CasterFaces or CasterCull, and with classic techniques
// (<gnomon/vulkan/classics.h>) for Partition::paraboloid and the filters id and depth-id.
#pragma once

#include <gnomon/choices.h>
#include <gnomon/export.h>
#include <gnomon/options.h>

#include <vulkan/vulkan.h>

namespace gnomon::vulkan {

/// The formats that the host's caster pipelines must be made for, beside MapPassFormats.
struct ClassicFormats {
    /// CasterFaces::back: leave out triangles that face the light. Keep those of casters that are open, thin or
    /// two-sided, whose shadow would have holes.
    bool back_faces = false;
    /// CasterCull: triangles of all casters that are left out, open or not.
    CasterCull cull = CasterCull::none;
    /// CasterFaces::midpoint, the second pass of a map: discard fragments that do not lie behind
    /// ClassicPass::first_surface (gnomonCasterBehind() in gnomon/caster.glsl). A callback that draws them all gets a
    /// map of the first surface.
    bool behind_first = false;
    /// ViewProjection::paraboloid: vertices are placed by gnomonCasterParaboloid(), and fragments have the metric of
    /// gnomonCasterRadial() or are discarded (caster.glsl). It goes to gl_FragDepth beside a colour attachment, too.
    bool paraboloid = false;
    /// Filters id and depth-id: the colour attachment holds gnomonCasterIdTexel() of the object's pack::casterIdOf().
    bool ids = false;
    /// IdOf::face, with `ids`: the id is gnomonCasterPieceId() of the triangle's piece.
    bool pieces = false;

    bool operator==(const ClassicFormats&) const = default;
};

/// MapPass::classic.
struct ClassicPass {
    ClassicFormats formats; // classicFormats() of the light's options
    /// With behind_first: a set with one COMBINED_IMAGE_SAMPLER at binding 0, FRAGMENT stage, whose texel at
    /// gl_FragCoord.xy is the depth of the first surface.
    VkDescriptorSet first_surface = VK_NULL_HANDLE;
    float first_quantum = 0.0F; // largest error of first_surface, in depths of the map
};

/// The formats that maps with these options need. With CasterFaces::midpoint they are those of the first of a map's two
/// passes; the second has behind_first, too.
[[nodiscard]] GNOMON_API ClassicFormats classicFormats(const ResolvedOptions& options);

} // namespace gnomon::vulkan
