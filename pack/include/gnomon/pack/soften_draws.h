// SPDX-License-Identifier: Apache-2.0
// The draws of the pass that blurs the mask on the screen (soften=blur): four lights at a time where their options are
// the same.
#pragma once

#include <gnomon/export.h>
#include <gnomon/plan.h>

#include <cstdint>
#include <vector>

namespace gnomon::pack {

/// One layer of the mask, blurred by one set of options.
struct SoftenDraw {
    std::uint32_t layer = 0;    // layer of the mask
    ScreenBlurOptions blur;     // how it is blurred
    std::uint32_t channels = 0; // bit i: channel i is blurred
    bool whole = true;          // no other light with a map has a channel of the layer: all of them may be written
};

/// Is the light's part of the mask blurred?
[[nodiscard]] GNOMON_API bool softens(const Plan& plan, const LightPlan& light);
/// Lists the draws in the order of the lights. Keeps the memory of `out`.
GNOMON_API void listSoftenDraws(const Plan& plan, std::vector<SoftenDraw>& out);

} // namespace gnomon::pack
