// SPDX-License-Identifier: Apache-2.0
// What a pass of a classic technique asks of the callback that draws casters. CasterDrawer does all of it. A callback
// of the host's own needs this header for options with CasterFaces, CasterCull, Partition::paraboloid, or the filters
// id, depth-id and smoothies; without them every member is as it is here.
#pragma once

#include <gnomon/choices.h>
#include <gnomon/export.h>
#include <gnomon/options.h>

#include <vulkan/vulkan.h>

namespace gnomon::vulkan {

/// What the host's caster pipelines must be made for, beside MapPassFormats.
struct ClassicFormats {
    /// CasterFaces::back: leave out triangles that face the light, but not of casters that are open, thin or two-sided,
    /// whose shadow would have holes.
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
    /// Filters id and depth-id: the colour attachment holds gnomonCasterIdTexel() of what pack::casterIdOf() says of
    /// the object.
    bool ids = false;
    /// IdOf::face, with `ids`: the id is gnomonCasterPieceId() of the triangle's piece.
    bool pieces = false;
    /// Filter smoothies, once its map is drawn: fins along the casters' silhouettes (gnomon/shared/smoothie_fins.h),
    /// and not the casters, into an image beside it, R32_UINT, packed as smoothies.h has them. gl_FragDepth =
    /// finOrder(); depth is tested, LESS_OR_EQUAL, and written. Casters that have no fins keep the shadow that their
    /// map gives them.
    bool fins = false;

    bool operator==(const ClassicFormats&) const = default;
};

struct ClassicPass {
    ClassicFormats formats; // classicFormats() of the light's options
    /// With behind_first: a set with one COMBINED_IMAGE_SAMPLER at binding 0, FRAGMENT stage, whose texel at
    /// gl_FragCoord.xy is the depth of the first surface. With fins such a set with the maps, a 2D array whose layer
    /// ViewPlace::tile says.
    VkDescriptorSet first_surface = VK_NULL_HANDLE;
    float first_quantum = 0.0F; // in depths of the map: by what those of first_surface may be off
};

/// What maps of such options ask for. Of CasterFaces::midpoint the first of a map's two passes; the second has
/// behind_first, too.
[[nodiscard]] GNOMON_API ClassicFormats classicFormats(const ResolvedOptions& options);

} // namespace gnomon::vulkan
