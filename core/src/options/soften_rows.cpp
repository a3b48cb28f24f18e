// SPDX-License-Identifier: Apache-2.0
// The options of soften=blur. A new one is one row here.
#include "options/option_access.h"
#include "options/option_rows.h"

namespace gnomon {
namespace {

using enum OptionType;

bool blurs(const ShadowOptions& o)
{
    return o.technique.soften == Soften::blur;
}
bool blursByPoints(const ShadowOptions& o)
{
    return blurs(o) && o.screen_blur.kernel == ScreenKernel::poisson;
}
bool blursTwice(const ShadowOptions& o)
{
    return blurs(o) && o.screen_blur.kernel != ScreenKernel::poisson;
}
bool blursByGaussian(const ShadowOptions& o)
{
    return blurs(o) && o.screen_blur.kernel == ScreenKernel::gaussian;
}

} // namespace

void addSoftenRows(std::vector<OptionRow>& table)
{
    constexpr std::string_view kBlur = "soften blur";
    const OptionRow rows[]{
        // clang-format off
        {.key = "soften.kernel", .type = choice, .form = "NAME", .choices = namesOf<ScreenKernel>, .doc = "of the blur on the screen: gaussian and box in two passes, poisson a disc in one", .used = blurs, .used_when = kBlur, GNOMON_MEMBER(screen_blur.kernel)},
        {.key = "soften.strength", .type = real, .form = "PX", .unit = "pixels", .min = 0.25, .max = 8, .doc = "from tap to tap", .used = blurs, .used_when = kBlur, GNOMON_MEMBER(screen_blur.strength_px)},
        {.key = "soften.size", .type = choice, .form = "NAME", .choices = namesOf<ScreenSize>, .doc = "of the images that it is worked out in", .used = blurs, .used_when = kBlur, GNOMON_MEMBER(screen_blur.size)},
        {.key = "soften.edges", .type = choice, .form = "NAME", .choices = namesOf<ScreenEdges>, .doc = "edge-aware: from a pixel's own surface alone; plain: over silhouettes too", .used = blurs, .used_when = kBlur, GNOMON_MEMBER(screen_blur.edges)},
        {.key = "soften.taps", .type = choice, .form = "NAME", .choices = namesOf<ScreenTaps>, .doc = "symmetric, or as published: too bright and off to one side", .used = blursByGaussian, .used_when = "soften blur and soften.kernel gaussian", GNOMON_MEMBER(screen_blur.taps)},
        {.key = "soften.points", .type = integer, .form = "N", .min = 4, .max = 64, .doc = "of the disc", .used = blursByPoints, .used_when = "soften blur and soften.kernel poisson", GNOMON_MEMBER(screen_blur.points)},
        {.key = "soften.passes", .type = integer, .form = "N", .min = 1, .max = 2, .doc = "1: along x alone, to look at", .used = blursTwice, .used_when = "soften blur and soften.kernel gaussian or box", GNOMON_MEMBER(screen_blur.passes)},
        // clang-format on
    };
    table.insert(table.end(), std::begin(rows), std::end(rows));
}

} // namespace gnomon
