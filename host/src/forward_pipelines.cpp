// SPDX-License-Identifier: Apache-2.0
// Pipelines of surfaces that are shaded as they are drawn.
#include "pipeline_wish.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>

namespace gnomon::host {

std::string forwardFragment(const ResolvedOptions& options)
{
    std::string module(options.hasSmoothies() ? "smoothies" : nameOf(pack::filterModule(options)));
    std::ranges::replace(module, '-', '_');
    return "forward_" + module + ".frag";
}

SurfacePipelines Pipelines::shadowedFor(const ResolvedOptions& options)
{
    const std::string fragment = forwardFragment(options);
    const pack::TechniqueConstants technique = pack::techniqueConstants(options);
    const auto found = std::ranges::find_if(
        shadowed_, [&](const Shadowed& one) { return one.fragment == fragment && one.technique == technique; });
    if (found != shadowed_.end()) {
        return found->pipelines;
    }
    Wish wish = blendedWish();
    wish.fragment = fragment;
    wish.layout = shadowed_layout.get();
    std::memcpy(&wish.constants[kTechnique], &technique, sizeof technique);
    return shadowed_.emplace_back(Shadowed{fragment, technique, makeSurface(wish, blended_is_cut_)}).pipelines;
}

void Pipelines::makeDepthAlone()
{
    for (std::size_t i = 0; i < opaque_kinds_.size(); ++i) {
        if (opaque_kinds_[i] == Kind::none) {
            continue;
        }
        Wish wish;
        wish.name = "depth";
        wish.scene = true;
        wish.depth = true;
        wish.depth_write = true;
        wish.compare = VK_COMPARE_OP_GREATER_OR_EQUAL;
        const auto kind = static_cast<SurfaceKind>(i);
        setKind(wish, kind);
        const bool masked = kind == SurfaceKind::masked || kind == SurfaceKind::full_masked;
        wish.vertex = masked ? "scene.vert" : "depth.vert";
        wish.fragment = masked ? "depth_masked.frag" : "";
        depth_alone[i] = makeSurface(wish, opaque_kinds_[i] == Kind::cut);
    }
}

const KindPipelines& Pipelines::forwardFor(const ForwardFacts& facts)
{
    const auto found = std::ranges::find(forward_, facts, &std::pair<ForwardFacts, KindPipelines>::first);
    if (found != forward_.end()) {
        return found->second;
    }
    KindPipelines made{};
    for (std::size_t i = 0; i < opaque_kinds_.size(); ++i) {
        if (opaque_kinds_[i] == Kind::none) {
            continue;
        }
        Wish wish;
        wish.name = "forward";
        wish.vertex = "scene.vert";
        wish.fragment = facts.fragment;
        setKind(wish, static_cast<SurfaceKind>(i));
        setLights(wish, facts.by);
        wish.constants[kOpaque] = VK_TRUE;
        wish.constants[kEmits] = emissive.whole != VK_NULL_HANDLE ? VK_TRUE : VK_FALSE;
        wish.constants[kTints] = facts.tints ? VK_TRUE : VK_FALSE;
        wish.constants[kLayered] = facts.layered ? VK_TRUE : VK_FALSE;
        wish.constants[kOrthographic] = facts.orthographic ? VK_TRUE : VK_FALSE;
        std::memcpy(&wish.constants[kTechnique], &facts.technique, sizeof facts.technique);
        wish.scene = true;
        wish.depth = true;
        wish.compare = VK_COMPARE_OP_EQUAL; // with what depth_alone drew, without what masks cut away
        wish.layout = shadowed_layout.get();
        made[i] = makeSurface(wish, opaque_kinds_[i] == Kind::cut);
    }
    return forward_.emplace_back(facts, made).second;
}

} // namespace gnomon::host
