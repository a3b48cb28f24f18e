// SPDX-License-Identifier: Apache-2.0
#include <gnomon/choice_rules.h>

#include <array>

namespace gnomon {
namespace {

bool goesAround(Partition partition)
{
    return partition == Partition::cube || partition == Partition::paraboloid || partition == Partition::multi ||
           partition == Partition::automatic;
}

bool isParaboloid(const Technique& technique)
{
    return technique.partition == Partition::paraboloid;
}

bool isOfScene(const Technique& technique)
{
    return technique.fit == Fit::scene;
}

bool isVolumes(const Technique& technique)
{
    return technique.filter == Filter::volumes;
}

constexpr std::array kRules{
    ChoiceRule{
        [](LightType light, const Technique& t) {
            return light == LightType::point && !goesAround(t.partition) && !isVolumes(t);
        },
        "light point with every partition but cube, paraboloid, multi and auto, filter volumes apart",
        "a point light, or a spot light wider than 120 degrees, shines farther around than one frustum holds; it needs "
        "partition cube, paraboloid, multi or auto"},
    ChoiceRule{[](LightType light, const Technique& t) {
                   return light == LightType::directional && t.partition == Partition::cube;
               },
               "partition cube with light directional",
               "cube is the six faces around a light that has a place; a sun needs another partition, or auto"},
    ChoiceRule{[](LightType, const Technique& t) { return t.partition == Partition::sdsm && t.motion != Motion::free; },
               "partition sdsm with every motion but free",
               "sdsm fits its maps on the GPU to each frame's depth buffer, so nobody can hold them still; it needs "
               "motion free"},
    ChoiceRule{[](LightType, const Technique& t) {
                   return t.partition == Partition::multi && t.motion != Motion::free && t.motion != Motion::snap;
               },
               "partition multi with every motion but free and snap",
               "multi gives each frame the frustums that its picture asks for, and those of two positions of a sun are "
               "not the "
               "same; it needs motion free or snap"},
    ChoiceRule{[](LightType, const Technique& t) {
                   return isParaboloid(t) && t.filter != Filter::hard && t.filter != Filter::pcf &&
                          t.filter != Filter::automatic;
               },
               "partition paraboloid with every filter but hard, pcf and auto",
               "paraboloid bends straight lines, and is no more than a baseline: its maps hold depths that are "
               "compared one by "
               "one; it needs filter hard, pcf or auto, which is pcf then"},
    ChoiceRule{[](LightType, const Technique& t) {
                   return isParaboloid(t) && t.fit != Fit::uniform && t.fit != Fit::automatic;
               },
               "partition paraboloid with every fit but uniform and auto",
               "paraboloid has no frustum that a fit could shape; it needs fit uniform or auto, which is uniform then"},
    ChoiceRule{[](LightType, const Technique& t) { return isParaboloid(t) && t.motion != Motion::free; },
               "partition paraboloid with every motion but free",
               "paraboloid is no more than a baseline, and nothing of it is held still; it needs motion free"},
    ChoiceRule{[](LightType, const Technique& t) { return isParaboloid(t) && t.soften == Soften::converge; },
               "partition paraboloid with soften converge",
               "paraboloid cannot move its texels over what it shows, as converge does from frame to frame; it needs "
               "soften none"},
    ChoiceRule{
        [](LightType light, const Technique& t) { return isParaboloid(t) && light != LightType::point; },
        "partition paraboloid with every light but point",
        "paraboloid is the two half spaces around a point light; a sun or a spot light needs another partition, or "
        "auto"},
    ChoiceRule{
        [](LightType, const Technique& t) { return isParaboloid(t) && t.soften == Soften::smoothies; },
        "partition paraboloid with soften smoothies",
        "paraboloid bends straight lines, and smoothies measure along straight ones how far an edge is; it needs "
        "soften none"},
    ChoiceRule{[](LightType, const Technique& t) {
                   return t.soften == Soften::smoothies && t.filter != Filter::hard && t.filter != Filter::pcf &&
                          t.filter != Filter::automatic;
               },
               "soften smoothies with every filter but hard, pcf and auto",
               "smoothies lie beside a map of depths that are compared one by one; other filters have a softness of "
               "their own, "
               "and filter smoothies has them already. They need filter hard, pcf or auto, which is pcf then"},
    ChoiceRule{[](LightType, const Technique& t) {
                   return isOfScene(t) && t.partition != Partition::single && t.partition != Partition::automatic;
               },
               "fit scene with every partition but single and auto",
               "scene is one map around all of the scene, whatever is seen of it; it needs partition single or auto, "
               "which is single then"},
    ChoiceRule{[](LightType light, const Technique& t) { return isOfScene(t) && light != LightType::directional; },
               "fit scene with every light but directional",
               "scene backs a sun out until all of the scene is before it; a light with a place stands where it "
               "stands, and needs another fit"},
    ChoiceRule{[](LightType, const Technique& t) { return isOfScene(t) && t.soften == Soften::converge; },
               "fit scene with soften converge",
               "converge moves its maps in each frame, and those of scene stay as they are; it needs another fit"},
    ChoiceRule{[](LightType, const Technique& t) {
                   return isVolumes(t) && t.partition != Partition::single && t.partition != Partition::automatic;
               },
               "filter volumes with every partition but single and auto",
               "volumes has no maps, so there are no frustums to divide a light among; it needs partition single or "
               "auto, for a point light too"},
    ChoiceRule{
        [](LightType, const Technique& t) { return isVolumes(t) && t.fit != Fit::uniform && t.fit != Fit::automatic; },
        "filter volumes with every fit but uniform and auto",
        "volumes has no maps, so there is no frustum to shape; it needs fit uniform or auto"},
    ChoiceRule{
        [](LightType, const Technique& t) { return isVolumes(t) && t.motion != Motion::free; },
        "filter volumes with every motion but free",
        "volumes has no maps to hold still or to step with, and counts anew in each frame; it needs motion free"},
    ChoiceRule{[](LightType, const Technique& t) {
                   return isVolumes(t) && t.soften != Soften::none && t.soften != Soften::blur;
               },
               "filter volumes with soften smoothies and converge",
               "volumes has no maps, which smoothies and converge work on; it needs soften none or blur"},
    ChoiceRule{[](LightType, const Technique& t) { return t.soften == Soften::converge && t.motion != Motion::free; },
               "soften converge with every motion but free",
               "converge moves its maps in each frame, so nobody can hold them still; it needs motion free"},
};

} // namespace

std::span<const ChoiceRule> choiceRules()
{
    return kRules;
}

std::optional<std::string_view> refusal(LightType light, const ShadowOptions& options)
{
    if (const auto reason = refusal(light, options.technique)) {
        return reason;
    }
    const Filter filter = filterOf(options);
    const FilterTraits* const traits = filterTraits(filter);
    if (traits != nullptr && traits->has_metric && light == LightType::directional &&
        options.moments.metric == DepthMetricKind::z_over_w) {
        return "depth-metric z-over-w is what a lamp's perspective makes of depth; a sun has none, and needs linear";
    }
    if (light != LightType::directional && hasWorldLayers(filter, options.moments) &&
        options.moments.layer_axis == LayerAxis::height) {
        return "lvsm.placement world: layers of height are layers of depth under parallel light alone; a light with a "
               "place needs lvsm.axis=light, and lvsm.world with both ends of each layer";
    }
    return std::nullopt;
}

} // namespace gnomon
