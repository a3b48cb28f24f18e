// SPDX-License-Identifier: Apache-2.0
// The pipelines of passes over the whole screen.
#include "pipeline_wish.h"

#include <algorithm>
#include <bit>
#include <string>
#include <utility>

namespace gnomon::host {

VkPipeline Pipelines::makeSky(const SkyFacts& facts, bool over_surface)
{
    Wish wish;
    wish.vertex = over_surface ? "screen_over_surface.vert" : "screen.vert";
    setToning(wish, facts.toned);
    wish.scene = over_surface;
    wish.blend = over_surface;
    wish.depth = true;
    wish.compare = VK_COMPARE_OP_EQUAL; // with nothing's, or with what depth_alone drew
    wish.name = over_surface ? "fading" : "sky";
    const std::string shader = facts.physical ? "sky_physical" : "sky";
    const std::string fragment = shader + (over_surface ? "_over_surface.frag" : ".frag");
    wish.fragment = fragment;
    wish.constants[kDrawsSky] = VK_TRUE;
    wish.constants[kNight] = facts.night ? VK_TRUE : VK_FALSE;
    return make(wish);
}

VkPipeline Pipelines::skyFor(const SkyFacts& facts)
{
    if (facts == SkyFacts{}) {
        return sky;
    }
    const auto found = std::ranges::find(sky_, facts, &std::pair<SkyFacts, VkPipeline>::first);
    return found != sky_.end() ? found->second : sky_.emplace_back(facts, makeSky(facts)).second;
}

VkPipeline Pipelines::fadingFor(const SkyFacts& facts)
{
    const auto found = std::ranges::find(fading_, facts, &std::pair<SkyFacts, VkPipeline>::first);
    return found != fading_.end() ? found->second : fading_.emplace_back(facts, makeSky(facts, true)).second;
}

VkPipeline Pipelines::toneFor(const ToneFacts& facts)
{
    const auto found = std::find_if(tone_.begin(), tone_.end(), [&](const auto& one) { return one.first == facts; });
    if (found != tone_.end()) {
        return found->second;
    }
    Wish wish;
    wish.name = "tone";
    wish.vertex = "fullscreen.vert";
    wish.fragment = "tone.frag";
    wish.colours = {&kPictureFormat, 1};
    wish.constants = {facts.average_four, facts.bloom > 0.0F, std::bit_cast<VkBool32>(facts.bloom),
                      std::bit_cast<VkBool32>(facts.bloom_radius)};
    wish.constants[kFilmic] = facts.curve == ToneCurve::filmic;
    wish.constants[kDither] = facts.dither;
    return tone_.emplace_back(facts, make(wish)).second;
}

VkPipeline Pipelines::fxaa()
{
    if (fxaa_ == VK_NULL_HANDLE) {
        Wish wish;
        wish.name = "fxaa";
        wish.vertex = "fullscreen.vert";
        wish.fragment = "fxaa.frag";
        wish.colours = {&kPictureFormat, 1};
        fxaa_ = make(wish);
    }
    return fxaa_;
}

VkPipeline Pipelines::makeOcclusion(const char* name, std::string_view fragment)
{
    Wish wish;
    wish.name = name;
    wish.vertex = "screen.vert";
    wish.fragment = fragment;
    wish.colours = {&kOcclusionFormat, 1};
    return make(wish);
}

VkPipeline Pipelines::occlusionSearch()
{
    if (occlusion_search_ == VK_NULL_HANDLE) {
        occlusion_search_ = makeOcclusion("occlusion search", "occlusion_search.frag");
    }
    return occlusion_search_;
}

VkPipeline Pipelines::occlusionSmooth()
{
    if (occlusion_smooth_ == VK_NULL_HANDLE) {
        occlusion_smooth_ = makeOcclusion("occlusion smooth", "occlusion_smooth.frag");
    }
    return occlusion_smooth_;
}

void Pipelines::setLights(Wish& wish, const ShadedBy& by) const
{
    wish.constants[kFixedLights] = by.fixed_lights;
    wish.constants[kDirectionalOnly] = by.all_directional ? VK_TRUE : VK_FALSE;
    wish.constants[kPhysicalOnly] = physical_only_ ? VK_TRUE : VK_FALSE;
    wish.constants[kPhong2005] = by.phong_2005 ? VK_TRUE : VK_FALSE;
    wish.constants[kOccluded] = by.occluded ? VK_TRUE : VK_FALSE;
    setToning(wish, by.toned);
}

void Pipelines::setToning(Wish& wish, const Toning& toned)
{
    wish.constants[kToned] = toned.on ? VK_TRUE : VK_FALSE;
    wish.constants[kFilmic] = toned.curve == ToneCurve::filmic ? VK_TRUE : VK_FALSE;
    wish.constants[kDither] = toned.dither ? VK_TRUE : VK_FALSE;
    wish.colours = {toned.on ? &kPictureFormat : &kLightFormat, 1};
}

VkPipeline Pipelines::makeShade(const ShadedBy& by, bool compact)
{
    Wish wish;
    wish.name = compact ? "shade compact" : "shade";
    wish.vertex = "screen.vert";
    wish.fragment = compact ? "shade_compact.frag" : "shade.frag";
    setLights(wish, by);
    wish.depth = true;
    wish.compare = VK_COMPARE_OP_LESS;
    wish.layout = compact ? compact_layout.get() : VK_NULL_HANDLE;
    return make(wish);
}

VkPipeline Pipelines::shadeCompact(const ShadedBy& by)
{
    const auto found = std::ranges::find(shade_compact_, by, &std::pair<ShadedBy, VkPipeline>::first);
    return found != shade_compact_.end() ? found->second : shade_compact_.emplace_back(by, makeShade(by, true)).second;
}

VkPipeline Pipelines::shadeFor(const ShadedBy& by)
{
    const auto found = std::ranges::find(shade_, by, &std::pair<ShadedBy, VkPipeline>::first);
    return found != shade_.end() ? found->second : shade_.emplace_back(by, makeShade(by, false)).second;
}

} // namespace gnomon::host
