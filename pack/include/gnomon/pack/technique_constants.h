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

} // namespace gnomon::pack
