// SPDX-License-Identifier: Apache-2.0
// The commands of a frame that is shaded as it is drawn.
#include "frame_renderer_impl.h"
#include "rendering.h"

#include <algorithm>

namespace gnomon::host {

std::string_view refusalOfForward(const RenderOptions& options)
{
    if (!options.shadows) {
        return {};
    }
    const Technique& technique = options.shadow.technique;
    if (options.compact_mask.channels > 0) {
        return "a compact mask is a mask";
    }
    if (technique.soften == Soften::blur || technique.soften == Soften::converge) {
        return "soften=blur and converge work on the mask";
    }
    if (options.shadow.mask_size != MaskSize::full) {
        return "mask-size=half is of a mask";
    }
    if (technique.motion == Motion::step_alternate) {
        return "step-alternate reads the mask of the frame before";
    }
    if (!hasMaps(options.shadow)) {
        return "volumes are counted into a mask";
    }
    return {};
}

void FrameRenderer::Impl::chooseForward(const ShadedBy& by)
{
    ForwardFacts& facts = forward.facts;
    facts = {};
    facts.by = by;
    if (plan != nullptr && !plan->views.empty()) {
        const ResolvedOptions& resolved = plan->options->front(); // as ForwardShadows::describe()
        facts.fragment = forwardFragment(resolved);
        facts.orthographic =
            std::ranges::all_of(plan->views, [](const View& view) { return view.projection.orthographic; });
        facts.technique = pack::techniqueConstants(resolved);
        facts.technique.few_views = pack::fewViewsOf(*plan);
        // The one view would be at a fixed place of uniforms [drivers: fixed-place].
        if (facts.technique.few_views == 1 && resolved.filter() != Filter::hard && resolved.filter() != Filter::pcf) {
            facts.technique.few_views = 0;
        }
        facts.layered = std::ranges::any_of(plan->views, [](const View& view) { return view.serves.layered; });
        facts.tints = shadows->renderer.tints().image != VK_NULL_HANDLE;
    }
    forward.pipelines = &scene.pipelines.forwardFor(facts);
}

void FrameRenderer::Impl::recordForward(VkCommandBuffer cmd)
{
    recordDepth(cmd);
    if (plan != nullptr) {
        recordMaps(cmd, depthInputs());
    }
    recordSurfaces(cmd);
}

/// Everything that is seen, to the light or to the picture itself.
void FrameRenderer::Impl::recordSurfaces(VkCommandBuffer cmd)
{
    const Targets& targets = screen->targets;
    const Pipelines& pipelines = scene.pipelines;
    const Image& target = shadedTo();
    memory.names().begin(cmd, "forward");
    profiler.beginPass(cmd, "forward");
    barrier(cmd, target, discardAfter(kSampledByAll), kColourWrite);
    const VkRenderingAttachmentInfo colour = attachment(target, kColourWrite.layout, VK_ATTACHMENT_LOAD_OP_DONT_CARE);
    const VkRenderingAttachmentInfo depth = attachment(targets.depth, kDepthRead.layout, VK_ATTACHMENT_LOAD_OP_LOAD);
    beginRendering(cmd, targets.drawn, {&colour, 1}, &depth);
    setViewport(cmd, targets.drawn);
    const ForwardShadows* const lookup = forwardShadows();
    const VkDescriptorSet maps = lookup != nullptr ? lookup->set(slot) : VK_NULL_HANDLE;
    std::uint32_t count = draws.recordOpaque(cmd, pipelines, *forward.pipelines, frame_set, maps);
    vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, sky);
    vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines.screen_layout.get(), 0, 1, &frame_set, 0,
                            nullptr);
    vkCmdDraw(cmd, 3, 1, 0, 0);
    ++count;
    if (draws.anyBlended() || fading != VK_NULL_HANDLE) {
        vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines.scene_layout.get(), 0, 1, &frame_set, 0,
                                nullptr);
        draws.bindStreams(cmd);
        count += fading != VK_NULL_HANDLE ? draws.recordFading(cmd, pipelines, fading) : 0;
        count += recordBlended(cmd);
    }
    profiler.addDraws(count);
    vkCmdEndRendering(cmd);
    endShading(cmd);
    profiler.endPass(cmd);
    memory.names().end(cmd);
}

} // namespace gnomon::host
