// SPDX-License-Identifier: Apache-2.0
#include "classics.h"

#include "draw_view.h"

#include <gnomon/error.h>
#include <gnomon/pack/frame_passes.h>

#include <string>

namespace gnomon::vulkan {
namespace {

/// The classic technique that the options name first; empty: none.
std::string classicNamed(const ResolvedOptions& options)
{
    const Technique& technique = options.technique();
    if (options.traits().ids || options.hasFins() || !options.hasMaps()) {
        return "filter " + std::string(nameOf(technique.filter));
    }
    if (options.hasSmoothies()) {
        return "soften smoothies";
    }
    if (technique.partition == Partition::paraboloid) {
        return "partition paraboloid";
    }
    if (technique.motion == Motion::step_alternate) {
        return "motion step-alternate";
    }
    return isDrawnTwice(options) ? "caster-faces midpoint" : "";
}

void refuseNamed(const std::string& name)
{
    if (!name.empty()) {
        throw Error("draw " + name, "it is a classic technique, and ShadowRendererOptions::classics is null",
                    "link gnomon::vulkan_classics and set it to makeClassics()");
    }
}

} // namespace

void checkClassics(const ResolvedOptions& options, const Classics* classics)
{
    if (classics == nullptr) {
        refuseNamed(classicNamed(options));
    }
}

void checkClassics(const Plan& plan, const Classics* classics)
{
    if (classics != nullptr) {
        return;
    }
    for (const ResolvedOptions& options : *plan.options) {
        refuseNamed(classicNamed(options));
    }
    // A host may have made the plan by hand.
    for (const LightPlan& light : plan.lights) {
        refuseNamed(light.volume_count > 0 ? "filter volumes" : pack::takesTurns(light) ? "motion step-alternate" : "");
    }
}

} // namespace gnomon::vulkan
