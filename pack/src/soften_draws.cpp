// SPDX-License-Identifier: Apache-2.0
#include <gnomon/pack/soften_draws.h>

#include <gnomon/plan_views.h>

#include <gnomon/shared/screen_blur.h>

#include <algorithm>

namespace gnomon::pack {
namespace {

constexpr bool is(int number, ScreenKernel kernel)
{
    return number == static_cast<int>(kernel);
}
static_assert(is(shared::kScreenGaussian, ScreenKernel::gaussian) && is(shared::kScreenBox, ScreenKernel::box) &&
              is(shared::kScreenPoisson, ScreenKernel::poisson));

void addLight(const LightPlan& light, const ScreenBlurOptions& blur, std::vector<SoftenDraw>& out)
{
    const auto found = std::ranges::find_if(
        out, [&](const SoftenDraw& draw) { return draw.layer == light.mask_layer && draw.blur == blur; });
    SoftenDraw& draw = found != out.end() ? *found : out.emplace_back(SoftenDraw{light.mask_layer, blur, 0, true});
    draw.channels |= maskChannelsOf(light);
}

} // namespace

bool softens(const Plan& plan, const LightPlan& light)
{
    return light.outcome.hasMap() && (*plan.options)[light.options].technique().soften == Soften::blur;
}

void listSoftenDraws(const Plan& plan, std::vector<SoftenDraw>& out)
{
    out.clear();
    for (const LightPlan& light : plan.lights) {
        if (softens(plan, light)) {
            addLight(light, (*plan.options)[light.options].screen_blur(), out);
        }
    }
    for (const LightPlan& light : plan.lights) {
        for (SoftenDraw& draw : out) {
            const bool beside = draw.layer == light.mask_layer && light.outcome.hasMap();
            draw.whole = draw.whole && !(beside && (maskChannelsOf(light) & draw.channels) == 0);
        }
    }
}

} // namespace gnomon::pack
