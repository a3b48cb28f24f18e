// SPDX-License-Identifier: Apache-2.0
// A plan as the C interface shows it.
#pragma once

#include <gnomon/gnomon.h>

#include <gnomon/pack/frame_passes.h>
#include <gnomon/plan.h>

#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::c {

/// Texts with an end, each kept once and for good: sentences of plans are few.
class Texts {
public:
    const char* operator()(std::string_view text);

private:
    std::set<std::string, std::less<>> kept_;
};

/// Keeps its memory from plan to plan.
struct FlatPlan {
    GnomonPlan plan{};
    std::vector<GnomonLightPlan> lights;
    std::vector<GnomonView> views;
    std::vector<GnomonPages> pages;
    std::vector<GnomonPass> passes;
    std::vector<GnomonBounds> moved;
    std::vector<pack::FramePass> listed; // the passes, as pack lists them
    Texts texts;
};
/// Its lists of numbers are the plan's own, which must live as long as `out` is read.
void flatten(const Plan& plan, FlatPlan& out);

} // namespace gnomon::c
