// SPDX-License-Identifier: Apache-2.0
// For passes that are made for one technique: what its options decide, as specialization constants.
#pragma once

#include <gnomon/export.h>
#include <gnomon/options.h>
#include <gnomon/plan.h>

#include <cstdint>
#include <string_view>

namespace gnomon::pack {

/// Which shader module has a filter. Those that are alike share one, and TechniqueConstants::filter chooses there.
enum class FilterModule : std::uint8_t { hard, pcf, pcss, raymarch, moments, warped, ids, count };
/// As shaders/CMakeLists.txt names its modules, and GNOMON_FILTER_MODULES those of hosts; static text.
[[nodiscard]] GNOMON_API std::string_view nameOf(FilterModule module);
/// Of the filter that reads maps of these options (readingFilter()).
[[nodiscard]] GNOMON_API FilterModule filterModule(const ResolvedOptions& options);

/// The constants of gnomon/technique_constants.glsl: four bytes each, in their order.
struct TechniqueConstants {
    std::int32_t kernel_width = 0;    // kernelWidth()
    std::int32_t disc_taps = 0;       // of the discs, else 0
    std::uint32_t automatic_bias = 0; // 0 or 1, as a VkBool32
    std::int32_t moment_flags = 0;    // flags of shared/moment_rule.h
    std::int32_t moment_sampling = 0; // MapSampling
    std::int32_t moment_layers = 0;   // of lvsm, else 0
    std::int32_t depth_holding = 0;   // what a texel of depth holds
    std::uint32_t few_views = 0;      // fewViewsOf() of the frame's plan
    std::int32_t filter = 0;          // readingFilter(), of a module that is compiled for several

    bool operator==(const TechniqueConstants&) const = default;
};

/// Of lights with these options. `few_views` is left 0, which serves every plan.
[[nodiscard]] GNOMON_API TechniqueConstants techniqueConstants(const ResolvedOptions& options);

/// A light that is never seen from two positions, alone in a plan, may have few views: then a pass may look among so
/// many, at most kFewViews, of which some may be left over (fillViews()). Else 0.
[[nodiscard]] GNOMON_API std::uint32_t fewViews(const ResolvedOptions& options);
/// The same of a plan as it is: 0 where it has several lights, no views, more than kFewViews, or views of two positions
/// of a sun.
[[nodiscard]] GNOMON_API std::uint32_t fewViewsOf(const Plan& plan);
/// Of a pass that asks for this one of the plan's lights alone.
[[nodiscard]] GNOMON_API std::uint32_t fewViewsOf(const Plan& plan, const LightPlan& light);

} // namespace gnomon::pack
