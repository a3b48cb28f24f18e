// SPDX-License-Identifier: Apache-2.0
#include <gnomon/choice_rules.h>

#include <array>

namespace gnomon {
namespace {

constexpr bool kNeeds = true;
constexpr bool kRefuses = false;

template <class Enum>
constexpr std::uint8_t choiceNumber(Enum value)
{
    return static_cast<std::uint8_t>(value);
}

template <class... Enums>
constexpr std::uint32_t choiceBits(Enums... values)
{
    return (0U | ... | (1U << choiceNumber(values)));
}

constexpr std::array kRules{
    ChoiceRule{Choice::light, choiceNumber(LightType::point), Choice::partition,
               choiceBits(Partition::cube, Partition::paraboloid, Partition::multi, Partition::automatic,
                          Partition::virtual_pages),
               kNeeds,
               "a point light, or a spot light wider than 120 degrees, shines farther around than one frustum "
               "holds; it needs partition cube, paraboloid, multi, virtual or auto",
               Filter::volumes},
    ChoiceRule{Choice::partition, choiceNumber(Partition::cube), Choice::light, choiceBits(LightType::directional),
               kRefuses,
               "cube is the six faces around a light that has a place; a sun needs another partition, or auto"},
    ChoiceRule{Choice::partition, choiceNumber(Partition::sdsm), Choice::motion, choiceBits(Motion::free), kNeeds,
               "sdsm fits its maps on the GPU to each frame's depth buffer, so nobody can hold them still; it needs "
               "motion free"},
    ChoiceRule{Choice::partition, choiceNumber(Partition::multi), Choice::motion,
               choiceBits(Motion::free, Motion::snap), kNeeds,
               "multi gives each frame the frustums that its picture asks for, and those of two positions of a sun are "
               "not the same; it needs motion free or snap"},
    ChoiceRule{
        Choice::partition, choiceNumber(Partition::paraboloid), Choice::filter,
        choiceBits(Filter::hard, Filter::pcf, Filter::automatic), kNeeds,
        "paraboloid bends straight lines, and is no more than a baseline: its maps hold depths that are compared "
        "one by one; it needs filter hard, pcf or auto, which is pcf then"},
    ChoiceRule{Choice::partition, choiceNumber(Partition::paraboloid), Choice::fit,
               choiceBits(Fit::uniform, Fit::automatic), kNeeds,
               "paraboloid has no frustum that a fit could shape; it needs fit uniform or auto, which is uniform then"},
    ChoiceRule{Choice::partition, choiceNumber(Partition::paraboloid), Choice::motion, choiceBits(Motion::free), kNeeds,
               "paraboloid is no more than a baseline, and nothing of it is held still; it needs motion free"},
    ChoiceRule{Choice::partition, choiceNumber(Partition::paraboloid), Choice::soften, choiceBits(Soften::converge),
               kRefuses,
               "paraboloid cannot move its texels over what it shows, as converge does from frame to frame; it needs "
               "soften none"},
    ChoiceRule{Choice::partition, choiceNumber(Partition::paraboloid), Choice::light, choiceBits(LightType::point),
               kNeeds,
               "paraboloid is the two half spaces around a point light; a sun or a spot light needs another partition, "
               "or auto"},
    ChoiceRule{Choice::partition, choiceNumber(Partition::paraboloid), Choice::soften, choiceBits(Soften::smoothies),
               kRefuses,
               "paraboloid bends straight lines, and smoothies measure along straight ones how far an edge is; it "
               "needs soften none"},
    ChoiceRule{
        Choice::soften, choiceNumber(Soften::smoothies), Choice::filter,
        choiceBits(Filter::hard, Filter::pcf, Filter::automatic), kNeeds,
        "smoothies lie beside a map of depths that are compared one by one; other filters have a softness of "
        "their own, and filter smoothies has them already. They need filter hard, pcf or auto, which is pcf then"},
    ChoiceRule{Choice::fit, choiceNumber(Fit::scene), Choice::partition,
               choiceBits(Partition::single, Partition::automatic), kNeeds,
               "scene is one map around all of the scene, whatever is seen of it; it needs partition single or auto, "
               "which is single then"},
    ChoiceRule{
        Choice::fit, choiceNumber(Fit::scene), Choice::light, choiceBits(LightType::directional), kNeeds,
        "scene backs a sun out until all of the scene is before it; a light with a place stands where it stands, "
        "and needs another fit"},
    ChoiceRule{Choice::fit, choiceNumber(Fit::scene), Choice::soften, choiceBits(Soften::converge), kRefuses,
               "converge moves its maps in each frame, and those of scene stay as they are; it needs another fit"},
    ChoiceRule{Choice::filter, choiceNumber(Filter::volumes), Choice::partition,
               choiceBits(Partition::single, Partition::automatic), kNeeds,
               "volumes has no maps, so there are no frustums to divide a light among; it needs partition single or "
               "auto, for a point light too"},
    ChoiceRule{Choice::filter, choiceNumber(Filter::volumes), Choice::fit, choiceBits(Fit::uniform, Fit::automatic),
               kNeeds, "volumes has no maps, so there is no frustum to shape; it needs fit uniform or auto"},
    ChoiceRule{
        Choice::filter, choiceNumber(Filter::volumes), Choice::motion, choiceBits(Motion::free), kNeeds,
        "volumes has no maps to hold still or to step with, and counts anew in each frame; it needs motion free"},
    ChoiceRule{Choice::filter, choiceNumber(Filter::volumes), Choice::soften,
               choiceBits(Soften::smoothies, Soften::converge), kRefuses,
               "volumes has no maps, which smoothies and converge work on; it needs soften none or blur"},
    ChoiceRule{
        Choice::partition, choiceNumber(Partition::virtual_pages), Choice::fit,
        choiceBits(Fit::uniform, Fit::automatic), kNeeds,
        "virtual has squares of one grid for pages, which no fit could shape; it needs fit uniform or auto, which "
        "is uniform then"},
    ChoiceRule{Choice::partition, choiceNumber(Partition::virtual_pages), Choice::filter,
               choiceBits(Filter::hard, Filter::pcf, Filter::pcss, Filter::raymarch, Filter::automatic), kNeeds,
               "virtual keeps depths in pages with narrow borders, which have no room for what is averaged or widened "
               "beside them; it needs filter hard, pcf, pcss, raymarch or auto"},
    ChoiceRule{
        Choice::partition, choiceNumber(Partition::virtual_pages), Choice::motion,
        choiceBits(Motion::free, Motion::snap), kNeeds,
        "virtual has pages that stand still by themselves, and those of two positions of a sun are not the same; "
        "it needs motion free or snap"},
    ChoiceRule{Choice::partition, choiceNumber(Partition::virtual_pages), Choice::soften,
               choiceBits(Soften::none, Soften::blur), kNeeds,
               "virtual holds its pages still, which soften converge moves in each frame, and has no room beside "
               "them for smoothies; it needs soften none or blur"},
    ChoiceRule{Choice::soften, choiceNumber(Soften::converge), Choice::motion, choiceBits(Motion::free), kNeeds,
               "converge moves its maps in each frame, so nobody can hold them still; it needs motion free"},
};

std::string_view nameOf(Choice choice)
{
    return kChoiceNames[static_cast<std::size_t>(choice)];
}

bool refusesValue(const ChoiceRule& rule, std::uint32_t value)
{
    return value < 32U && ((rule.named >> value & 1U) != 0) != rule.is_needed;
}

} // namespace

bool ChoiceRule::applies(LightType light, const Technique& technique) const
{
    const std::array given{choiceNumber(light),
                           choiceNumber(technique.partition),
                           choiceNumber(technique.fit),
                           choiceNumber(technique.filter),
                           choiceNumber(technique.soften),
                           choiceNumber(technique.motion)};
    return given[choiceNumber(choice)] == value && refusesValue(*this, given[choiceNumber(other)]) &&
           technique.filter != apart;
}

bool ChoiceRule::concerns(const ChoiceValue& row) const
{
    return row.choice == nameOf(choice) ? row.value == value
                                        : row.choice == nameOf(other) && refusesValue(*this, row.value);
}

std::string ChoiceRule::refuses() const
{
    std::string text;
    std::string names;
    std::string_view last;
    for (const ChoiceValue& row : choiceValues()) {
        if (row.choice == nameOf(choice) && row.value == value) {
            text = std::string(row.choice) + " " + std::string(row.name) + " with ";
        } else if (row.choice == nameOf(other) && (named >> row.value & 1U) != 0) {
            names += (names.empty() ? "" : ", ") + std::string(last);
            last = row.name;
        }
    }
    text += (is_needed ? "every " : "") + std::string(nameOf(other)) + (is_needed ? " but " : " ") + names +
            (names.empty() ? "" : " and ") + std::string(last);
    return apart ? text + ", filter " + std::string(gnomon::nameOf(*apart)) + " apart" : text;
}

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
