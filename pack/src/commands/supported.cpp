// SPDX-License-Identifier: Apache-2.0
#include "commands/supported.h"

#include <gnomon/error.h>
#include <gnomon/pack/frame_passes.h>

#include <algorithm>
#include <string>

namespace gnomon::pack {
namespace {

struct Refusal {
    std::string found;
    const char* todo;
};

constexpr const char* kClassic = "is a classic technique, which the Vulkan backend alone draws";

constexpr const char* kSdsm =
    "partition sdsm fits cascades to the camera's depth on the GPU, which this backend does not do";

/// Empty: nothing is refused.
Refusal refusalOf(const ResolvedOptions& options)
{
    const Technique& technique = options.technique();
    const FilterTraits traits = options.traits();
    const Filter filter = options.filter();
    if (traits.ids || filter == Filter::volumes || filter == Filter::smoothies) {
        return {"filter " + std::string(nameOf(filter)) + " " + kClassic, "take pcf"};
    }
    if (technique.partition == Partition::paraboloid) {
        return {std::string("partition paraboloid ") + kClassic, "take cube"};
    }
    if (technique.partition == Partition::sdsm) {
        return {kSdsm, "take cascades"};
    }
    if (technique.soften == Soften::smoothies) {
        return {std::string("soften smoothies ") + kClassic, "take soften blur"};
    }
    if (technique.soften == Soften::converge) {
        return {"soften converge joins frames, which this backend does not do", "take soften blur"};
    }
    if (technique.motion == Motion::step_alternate) {
        return {std::string("motion step-alternate ") + kClassic, "take step-blend"};
    }
    if (options.asked().faces == CasterFaces::midpoint) {
        return {std::string("caster-faces midpoint ") + kClassic, "take another value of caster-faces"};
    }
    if (options.halvesMask()) {
        return {"mask-size half is not drawn by this backend", "take full"};
    }
    if (options.cascades().pass == CascadePass::layered) {
        return {"cascades.pass layered is not drawn by this backend", "leave it out"};
    }
    if (options.filterable() && options.moments().blur_path == BlurPath::fragment) {
        return {"blur-path fragment is not drawn by this backend, which blurs by compute", "leave it out"};
    }
    return {};
}

} // namespace

void checkSupported(const char* tried, const Plan& plan)
{
    for (std::uint32_t i = 0; i < plan.options->size(); ++i) {
        const Refusal refusal = hasLights(plan, i) ? refusalOf((*plan.options)[i]) : Refusal{};
        if (!refusal.found.empty()) {
            throw Error(tried, refusal.found, refusal.todo);
        }
    }
    const auto isFitted = [](const View& view) {
        return view.projection.gpu_cascade != kNoIndex;
    };
    if (std::ranges::any_of(plan.views, isFitted)) { // partition auto, of quality best
        throw Error(tried, kSdsm, "take quality balanced, or partition cascades");
    }
}

} // namespace gnomon::pack
