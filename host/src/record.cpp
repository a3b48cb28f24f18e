// SPDX-License-Identifier: Apache-2.0
// The commands of one frame.
#include "frame_renderer_impl.h"
#include "rendering.h"

#include <array>
#include <span>

namespace gnomon::host {

void FrameRenderer::Impl::record(Present* present)
{
    frame_set = screen->frameSet(slot, finished.masks.view);
    VkCommandBuffer cmd = now().commands->begin();
    profiler.beginFrame(cmd, slot);
    if (brings_sky) {
        sky_table->record(cmd, slot);
    }
    if (deform_now) {
        profiler.beginPass(cmd, "deform");
        scene.geometry.recordDeformed(cmd, now().deformed);
        profiler.endPass(cmd);
    }
    if (forward.on) {
        recordForward(cmd);
    } else {
        recordDeferred(cmd);
    }
    if (screen->bloom) {
        recordBloom(cmd);
    }
    recordPicture(cmd);
    if (present != nullptr) {
        present->record(cmd, finished);
    }
}

void FrameRenderer::Impl::recordDeferred(VkCommandBuffer cmd)
{
    recordDepth(cmd);
    recordGBuffer(cmd);
    if (instead != nullptr) {
        recordInstead(cmd);
    } else if (plan != nullptr) {
        recordShadows(cmd);
    }
    if (occluded) {
        recordOcclusion(cmd);
    }
    recordLight(cmd);
}

void FrameRenderer::Impl::recordDepth(VkCommandBuffer cmd)
{
    const Targets& targets = screen->targets;
    memory.names().begin(cmd, "depth");
    profiler.beginPass(cmd, "depth");
    barrier(cmd, targets.depth, discardAfter(kDepthRead), kDepthWrite);
    VkRenderingAttachmentInfo depth = attachment(targets.depth, kDepthWrite.layout, VK_ATTACHMENT_LOAD_OP_CLEAR);
    depth.clearValue.depthStencil.depth = 0.0F;
    beginRendering(cmd, targets.drawn, {}, &depth);
    setViewport(cmd, targets.drawn);
    // As for the G-buffer: nothing opaque may be in sight.
    vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, scene.pipelines.sky);
    profiler.addDraws(draws.recordOpaque(cmd, scene.pipelines, scene.pipelines.depth_alone, frame_set));
    vkCmdEndRendering(cmd);
    barrier(cmd, targets.depth, kDepthWrite, kDepthRead);
    profiler.endPass(cmd);
    memory.names().end(cmd);
}

void FrameRenderer::Impl::recordGBuffer(VkCommandBuffer cmd)
{
    const Targets& targets = screen->targets;
    memory.names().begin(cmd, "g-buffer");
    profiler.beginPass(cmd, "g-buffer");
    std::array<VkRenderingAttachmentInfo, std::tuple_size_v<GBufferFormats>> colours{};
    const std::size_t count = gbuffer.shape.count();
    for (std::size_t i = 0; i < count; ++i) {
        const Image& image = targets.gbuffer[gbuffer.shape.image(i)];
        barrier(cmd, image, discardAfter(kSampledByAll), kColourWrite);
        // Where nothing is drawn only depth and receivers are looked at.
        const bool cleared = &image == &targets.receivers();
        colours[i] = attachment(image, kColourWrite.layout,
                                cleared ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_DONT_CARE);
    }
    const VkRenderingAttachmentInfo depth = attachment(targets.depth, kDepthRead.layout, VK_ATTACHMENT_LOAD_OP_LOAD);
    beginRendering(cmd, targets.drawn, std::span(colours).first(count), &depth);
    setViewport(cmd, targets.drawn);
    // A pipeline before the first set [drivers: set-first], for nothing opaque may be in sight.
    vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, scene.pipelines.sky);
    profiler.addDraws(draws.recordOpaque(cmd, scene.pipelines, *gbuffer.pipelines, frame_set));
    vkCmdEndRendering(cmd);
    for (std::size_t i = 0; i < count; ++i) {
        barrier(cmd, targets.gbuffer[gbuffer.shape.image(i)], kColourWrite, kSampledByAll);
    }
    profiler.endPass(cmd);
    memory.names().end(cmd);
}

void FrameRenderer::Impl::recordShadows(VkCommandBuffer cmd)
{
    const Targets& targets = screen->targets;
    vulkan::MaskInputs inputs = depthInputs();
    inputs.normal = targets.normals().view;
    inputs.normal_format = targets.normals().format;
    inputs.smooth = gbuffer.shape.smooth ? targets.smooth().view : VK_NULL_HANDLE;
    inputs.object_id = gbuffer.shape.ids ? targets.receivers().view : VK_NULL_HANDLE;
    inputs.object_pieces = gbuffer.shape.ids; // scene.vert
    inputs.content = options.reuse_masks ? content : 0;
    recordMaps(cmd, inputs);
    vulkan::ShadowRenderer& renderer = shadows->renderer;
    if (shadows->volumes) {
        shadows->volumes->beginFrame(slot, shadows->volume_meshes->geometry(scene.geometry.positions),
                                     draws.transforms());
    }
    if (!frame_lights.empty()) {
        renderer.recordMask(cmd, slot, *plan, inputs, &profiler);
    }
    if (hasTiles()) {
        shadows->tiles->describe(slot, renderer.maskTiles(slot));
    }
}

vulkan::MaskInputs FrameRenderer::Impl::depthInputs() const
{
    const Targets& targets = screen->targets;
    vulkan::MaskInputs inputs;
    inputs.extent = targets.drawn;
    inputs.depth = targets.depth.view;
    inputs.depth_layout = kDepthRead.layout;
    return inputs;
}

void FrameRenderer::Impl::recordMaps(VkCommandBuffer cmd, const vulkan::MaskInputs& inputs)
{
    vulkan::ShadowRenderer& renderer = shadows->renderer;
    vulkan::CasterDrawer& casters = shadows->casters;
    renderer.recordBounds(cmd, slot, *plan, inputs, &profiler);
    casters.beginFrame(slot, *plan, scene.casterGeometry(), draws.transforms());
    if (shadows->fins) {
        shadows->fins->beginFrame(slot, shadows->volume_meshes->geometry(scene.geometry.positions), draws.transforms());
    }
    // It holds one pointer, for which nothing is allocated.
    const vulkan::DrawCasters draw = [this](const vulkan::MapPass& pass) {
        profiler.addDraws(shadows->casters.draw(pass));
    };
    renderer.recordMaps(cmd, slot, *plan, draw, &profiler);
    if (const ForwardShadows* const lookup = forwardShadows()) {
        lookup->recordViews(cmd, slot, *plan, renderer);
    }
}

void FrameRenderer::Impl::recordInstead(VkCommandBuffer cmd)
{
    barrier(cmd, *instead, discardAfter(kSampled), kCopyTarget);
    VkBufferImageCopy copy{};
    copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, instead->layers};
    copy.imageExtent = {instead->extent.width, instead->extent.height, 1};
    vkCmdCopyBufferToImage(cmd, now().instead_staging.handle, instead->handle, kCopyTarget.layout, 1, &copy);
    barrier(cmd, *instead, kCopyTarget, kSampled);
}

void FrameRenderer::Impl::recordOcclusion(VkCommandBuffer cmd)
{
    const Occlusion& occlusion = *screen->occlusion;
    screenPass(cmd, "ambient occlusion", occlusion.search, occlusion.searched);
    barrier(cmd, occlusion.searched, kColourWrite, kSampled);
    screenPass(cmd, "occlusion blur", occlusion.smoothen, occlusion.smooth);
    barrier(cmd, occlusion.smooth, kColourWrite, kSampled);
}

void FrameRenderer::Impl::recordLight(VkCommandBuffer cmd)
{
    const Targets& targets = screen->targets;
    const Pipelines& pipelines = scene.pipelines;
    memory.names().begin(cmd, "light");
    profiler.beginPass(cmd, "light");
    const Image& target = shadedTo();
    barrier(cmd, target, discardAfter(kSampledByAll), kColourWrite);
    const VkRenderingAttachmentInfo colour = attachment(target, kColourWrite.layout, VK_ATTACHMENT_LOAD_OP_DONT_CARE);
    const VkRenderingAttachmentInfo depth = attachment(targets.depth, kDepthRead.layout, VK_ATTACHMENT_LOAD_OP_LOAD);
    beginRendering(cmd, targets.drawn, {&colour, 1}, &depth);
    setViewport(cmd, targets.drawn);
    for (VkPipeline pipeline : {hasTiles() ? shade_compact : shade, sky}) {
        vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
        // After the pipeline: it may be the frame's first, see SceneDraws::recordOpaque.
        if (pipeline == shade_compact) {
            shadows->tiles->bind(cmd, slot, frame_set);
        } else {
            vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines.screen_layout.get(), 0, 1,
                                    &frame_set, 0, nullptr);
        }
        vkCmdDraw(cmd, 3, 1, 0, 0);
    }
    vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines.scene_layout.get(), 0, 1, &frame_set, 0,
                            nullptr);
    draws.bindStreams(cmd);
    const std::uint32_t faded = fading != VK_NULL_HANDLE ? draws.recordFading(cmd, pipelines, fading) : 0;
    profiler.addDraws(2 + faded + draws.recordEmissive(cmd, pipelines) + recordBlended(cmd));
    vkCmdEndRendering(cmd);
    endShading(cmd);
    profiler.endPass(cmd);
    memory.names().end(cmd);
}

/// The image that surfaces are shaded to: the light, or an image after the tone curve.
const Image& FrameRenderer::Impl::shadedTo() const
{
    const Targets& targets = screen->targets;
    if (!toned.on) {
        return targets.light;
    }
    return screen->fxaa != VK_NULL_HANDLE ? targets.toned : targets.picture;
}

void FrameRenderer::Impl::endShading(VkCommandBuffer cmd)
{
    if (!toned.on) {
        barrier(cmd, screen->targets.light, kColourWrite, screen->bloom ? kSampledByAll : kSampled);
    }
}

std::uint32_t FrameRenderer::Impl::recordBlended(VkCommandBuffer cmd)
{
    if (!draws.anyBlended()) {
        return 0;
    }
    const ForwardShadows* const lookup = forwardShadows();
    if (lookup != nullptr) {
        lookup->bind(cmd, slot);
    }
    return draws.recordBlended(cmd, scene.pipelines, lookup != nullptr ? lookup->blended() : scene.pipelines.blended);
}

void FrameRenderer::Impl::recordBloom(VkCommandBuffer cmd)
{
    memory.names().begin(cmd, "bloom");
    profiler.beginPass(cmd, "bloom");
    screen->bloom->record(cmd);
    profiler.endPass(cmd);
    memory.names().end(cmd);
}

void FrameRenderer::Impl::screenPass(VkCommandBuffer cmd, const char* name, VkPipeline pipeline, const Image& target)
{
    memory.names().begin(cmd, name);
    profiler.beginPass(cmd, name);
    barrier(cmd, target, discardAfter(kSampled), kColourWrite);
    const VkRenderingAttachmentInfo colour = attachment(target, kColourWrite.layout, VK_ATTACHMENT_LOAD_OP_DONT_CARE);
    beginRendering(cmd, target.extent, {&colour, 1}, nullptr);
    setViewport(cmd, target.extent);
    vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, scene.pipelines.screen_layout.get(), 0, 1, &frame_set,
                            0, nullptr);
    vkCmdDraw(cmd, 3, 1, 0, 0);
    vkCmdEndRendering(cmd);
    profiler.addDraws(1);
    profiler.endPass(cmd);
    memory.names().end(cmd);
}

void FrameRenderer::Impl::recordPicture(VkCommandBuffer cmd)
{
    const Targets& targets = screen->targets;
    const bool smooth = screen->fxaa != VK_NULL_HANDLE;
    if (!toned.on) {
        screenPass(cmd, "tone", screen->tone, smooth ? targets.toned : targets.picture);
    }
    if (smooth) {
        barrier(cmd, targets.toned, kColourWrite, kSampled);
        screenPass(cmd, "fxaa", screen->fxaa, targets.picture);
    }
    barrier(cmd, targets.picture, kColourWrite, kCopySource);
}

} // namespace gnomon::host
