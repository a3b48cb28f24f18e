// SPDX-License-Identifier: Apache-2.0
// Specialization constants that a technique's options decide, for passes that are made for one technique.
#pragma once

#include <gnomon/export.h>
#include <gnomon/options.h>
#include <gnomon/plan.h>

#include <cstdint>

namespace gnomon::pack {

/// The filter whose shader module reads maps of these options: readingFilter(), and `id` for `depth_id` too, because
/// those share a module where TechniqueConstants::filter chooses. nameOf() is the module's name in
/// shaders/CMakeLists.txt and in GNOMON_FILTER_MODULES.
[[nodiscard]] GNOMON_API Filter filterModule(const ResolvedOptions& options);

/// The constants of gnomon/technique_constants.glsl: four bytes each, in their order.
struct TechniqueConstants {
    std::int32_t kernel_width = 0;    // kernelWidth()
    std::int32_t disc_taps = 0;       // taps of the discs, else 0
    std::uint32_t automatic_bias = 0; // 0 or 1, as a VkBool32
    std::int32_t moment_flags = 0;    // flags of shared/moment_rule.h
    std::int32_t moment_sampling = 0; // MapSampling
    std::int32_t moment_layers = 0;   // layers of lvsm, else 0
    std::int32_t depth_holding = 0;   // how a texel holds depths: depthHolding()
    std::uint32_t few_views = 0;      // fewViewsOf() of the frame's plan
    std::int32_t filter = 0;          // readingFilter(), for a module of two filters

    bool operator==(const TechniqueConstants&) const = default;
};

/// The constants of lights with these options. `few_views` is left 0, which serves every plan.
[[nodiscard]] GNOMON_API TechniqueConstants techniqueConstants(const ResolvedOptions& options);

/// The number of views that a pass has to look among where a light with these options is alone in a plan: at most
/// kFewViews, some of which may be unused (fillViews()). 0 for the step motions, whose suns have two positions,
/// and for partition virtual, whose views are found by a table.
[[nodiscard]] GNOMON_API std::uint32_t fewViews(const ResolvedOptions& options);
/// The number of views of a plan, for such a pass: 0 where the plan has several lights, no views, more than kFewViews,
/// or views of two positions of a sun.
[[nodiscard]] GNOMON_API std::uint32_t fewViewsOf(const Plan& plan);
/// fewViewsOf() for a pass that asks for only this one of the plan's lights.
[[nodiscard]] GNOMON_API std::uint32_t fewViewsOf(const Plan& plan, const LightPlan& light);

/// The constant_ids of shaders/passes/mask.frag, four bytes each, in their order. Those of 0 and 1 are a VkBool32, or
/// in GLSL a bool.
struct MaskConstants {
    TechniqueConstants technique;       // few_views: MaskDraw::few_views
    std::uint32_t has_normals = 0;      // MaskImages::normals
    std::uint32_t in_software = 0;      // numbers that all pixels share come from the vertex shader; see mask.frag
    std::uint32_t has_smooth = 0;       // MaskImages::smooth
    std::uint32_t tints = 0;            // views of the draw's options have maps of tints
    std::uint32_t shows_rays = 0;       // ShadowRendererOptions::shows_rays
    std::uint32_t confidence = 0;       // for the pass that joins frames: FilterTraits::weighs_frames
    std::uint32_t coloured = 0;         // MaskDraw::coloured
    std::uint32_t tile_channels = 0;    // CompactMaskRule::channels
    std::uint32_t takes_away = 0;       // for a compact mask, a draw that shares: it draws the light that is lost
    std::uint32_t paraboloid = 0;       // views may be ViewProjection::paraboloid
    std::uint32_t has_ids = 0;          // MaskImages::ids
    std::uint32_t slices_alone = 0;     // ToldApart::slices
    std::uint32_t paired = 0;           // MaskDraw::paired; of modules for one view alone
    std::uint32_t pixels_per_texel = 1; // 2 where one pixel of each 2 x 2 is drawn (MaskSize::half)
    std::uint32_t layered = 0;          // views may be ViewServes::layered
    std::uint32_t orthographic = 0;     // MaskDraw::orthographic
    std::uint32_t settles = 0;          // draws the pixels that blocks settle, and leaves others
    std::uint32_t pages = 0;            // a point's view is found by fillPageTable()

    bool operator==(const MaskConstants&) const = default;
};

/// The images that a mask's pass reads besides the camera's depth.
struct MaskImages {
    bool normals = false; // of the surface
    bool ids = false;     // of objects
    bool smooth = false;  // smooth surfaces
};
/// The constants of the mask's draws of lights with these options. What differs from draw to draw is left as it is.
[[nodiscard]] GNOMON_API MaskConstants maskConstants(const ResolvedOptions& options, const MaskImages& images);

} // namespace gnomon::pack
