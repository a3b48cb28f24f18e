// SPDX-License-Identifier: Apache-2.0
#define GNOMON_REAL double
#include "stepping_suns.h"

#include <gnomon/shared/sun_steps.h>

#include <algorithm>
#include <cmath>

namespace gnomon::test {
namespace {

constexpr std::uint32_t kMapSize = 256;
constexpr glm::dvec3 kEarlier{0.8, -0.9, -0.35};
constexpr glm::dvec3 kLater{0.65, -0.9, -0.55};

glm::dvec3 directionOf(std::uint32_t light, SunPosition position)
{
    return (position == SunPosition::later) == (light == 0) ? kLater : kEarlier;
}

/// Posts all over the ground, so that much of the picture is shadow's edges and what hides behind something.
void addPosts(Scene& scene)
{
    for (int i = 0; i < 49; ++i) {
        const int x = i % 7 - 3;
        const int z = i / 7 - 3;
        const double height = 0.5 + 0.1 * (i % 5);
        scene.boxes.push_back({{1.9 * x + 0.3 * z, height, 1.9 * z - 0.2 * x}, {0.12, height, 0.12}, 0.37 * i});
    }
}

/// The views of one position, with tiles from the atlas's end on.
void addViews(const Setting& setting, const Scene& scene, const Camera& camera, const glm::dvec3& direction,
              SunPosition position, std::uint32_t light, Plan& plan)
{
    const std::uint32_t count = setting.slices == Slices::two ? 2 : 1;
    for (std::uint32_t i = 0; i < count; ++i) {
        const bool second = setting.paired_texels && position == SunPosition::later;
        const std::uint32_t layer = second ? plan.pages[0].layers - count + i : plan.pages[0].layers;
        View view = makeView(scene, makeSun(direction), light, {layer, 0, 0, kMapSize, kMapSize});
        plan.pages[0].layers += second ? 0 : 1;
        view.serves.sun = position;
        if (setting.paired_texels) {
            view.place.part = second ? TexelPart::second : TexelPart::first;
        }
        if (count == 2) {
            // A different size, so that the slices can be told apart.
            if (i == 1) {
                view.projection.clip_from_world =
                    glm::dmat4(0.7, 0, 0, 0, 0, 0.7, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1) * view.projection.clip_from_world;
                view.projection.texel_m /= 0.7;
            }
            const glm::dvec3 axis = glm::normalize(-camera.eye_ws);
            view.serves.slice.axis = glm::dvec4(axis, -glm::dot(axis, camera.eye_ws));
            view.serves.slice.begin_m = i == 0 ? -1e9 : 12.0;
            view.serves.slice.end_m = i == 0 ? 15.0 : 1e9;
            view.serves.slice.blend_m = i == 0 ? 0.0 : 3.0;
        }
        view.casters.count = static_cast<std::uint32_t>(plan.casters.size());
        plan.views.push_back(view);
        ++plan.lights[light].view_count;
    }
}

Plan emptyPlan(const Setting& setting, const Scene& scene, std::size_t lights)
{
    Plan plan = makePlan(scene, {}, {}, {kMapSize, kMapSize, 0}, setting.options);
    plan.mask_layers = 1;
    for (std::uint32_t i = 0; i < lights; ++i) {
        plan.lights.push_back({0, 0, 0, i, {}});
    }
    return plan;
}

shared::real4 ruleOf(const SunSteps& s)
{
    return {s.share, s.edge, s.band > 0.0 ? 1.0 / s.band : 0.0, s.smooth ? 1.0 : 0.0};
}

} // namespace

Setting settingOf(const StepCase& c)
{
    Setting setting;
    setting.options.technique.filter = c.filter;
    setting.options.format = c.format;
    setting.slices = c.slices;
    setting.paired_texels = c.paired_texels;
    return setting;
}

std::ostream& operator<<(std::ostream& out, const StepCase& c)
{
    return out << c.name;
}

Suns::Suns(const Setting& setting_in, std::size_t lights, const vulkan::MemoryHooks& memory)
    : bench(kStepScreen, setting_in.options, true, false, memory), setting(setting_in)
{
    addPosts(bench.scene);
    const glm::dvec3 between = glm::normalize(glm::normalize(kEarlier) + glm::normalize(kLater));
    bench.setLights(std::vector<Light>(lights, makeSun(between)),
                    std::vector<Tile>(lights, Tile{0, 0, 0, kMapSize, kMapSize}), {kMapSize, kMapSize, 1});
}

std::vector<Mask> Suns::maskOf(SunPosition position)
{
    Plan plan = emptyPlan(setting, bench.scene, bench.lights.size());
    plan.made_for.camera = bench.camera;
    plan.made_for.lights = bench.lights;
    for (std::uint32_t i = 0; i < bench.lights.size(); ++i) {
        plan.lights[i].first_view = static_cast<std::uint32_t>(plan.views.size());
        addViews(setting, bench.scene, bench.camera, directionOf(i, position), SunPosition::only, i, plan);
        if (setting.paired_texels) {
            for (View& view : plan.views) {
                view.place.part = TexelPart::whole;
            }
        }
    }
    return draw(plan);
}

Plan Suns::planOf(const std::vector<SunSteps>& steps) const
{
    Plan plan = emptyPlan(setting, bench.scene, bench.lights.size());
    plan.made_for.camera = bench.camera;
    plan.made_for.lights = bench.lights;
    for (std::uint32_t i = 0; i < bench.lights.size(); ++i) {
        LightPlan& light = plan.lights[i];
        light.first_view = static_cast<std::uint32_t>(plan.views.size());
        light.steps = steps[i];
        light.steps.stepping = true;
        light.steps.paired = true;
        light.steps.earlier_ws = glm::normalize(directionOf(i, SunPosition::earlier));
        light.steps.later_ws = glm::normalize(directionOf(i, SunPosition::later));
        for (const SunPosition position : {SunPosition::earlier, SunPosition::later}) {
            addViews(setting, bench.scene, bench.camera, directionOf(i, position), position, i, plan);
        }
    }
    return plan;
}

std::vector<Mask> Suns::maskOf(const std::vector<SunSteps>& steps)
{
    return draw(planOf(steps));
}

std::vector<Mask> Suns::draw(const Plan& plan)
{
    bench.plan = plan;
    bench.prepare();
    bench.record(1);
    std::vector<Mask> masks;
    for (std::uint32_t i = 0; i < bench.lights.size(); ++i) {
        masks.push_back(bench.readMask(i));
    }
    return masks;
}

double worstOff(const Mask& mask, const Mask& earlier, const Mask& later, const SunSteps& steps)
{
    double worst = 0.0;
    for (std::size_t i = 0; i < mask.size(); ++i) {
        const double x = (double(i % kStepScreen.width) + 0.5) / kStepScreen.width;
        const double weight = shared::stepWeight(ruleOf(steps), x);
        const double expected = shared::steppedVisibility(steps255(earlier, i), steps255(later, i), weight);
        worst = std::max(worst, std::abs(steps255(mask, i) - expected));
    }
    return worst;
}

std::size_t countDifferent(const Mask& a, const Mask& b)
{
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        count += a[i] != b[i] ? 1 : 0;
    }
    return count;
}

SunSteps blendOf(double share, bool smooth)
{
    SunSteps steps;
    steps.share = share;
    steps.smooth = smooth;
    return steps;
}

} // namespace gnomon::test
