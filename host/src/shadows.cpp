// SPDX-License-Identifier: Apache-2.0
#include "shadows.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace gnomon::host {
namespace {

/// Ids say which object does not receive, if there is one, and tell objects apart for filters that do.
GBufferShape readBy(const DrawTable& table, const ResolvedOptions& options)
{
    return {!table.all_receive || options.traits().ids, table.any_smooth};
}

vulkan::ShadowRendererOptions rendererOptions(const SceneData& scene, const RenderOptions& options,
                                              const GBufferShape& reads, vulkan::ClassicCallbacks callbacks)
{
    vulkan::ShadowRendererOptions wish;
    if (std::ranges::find(scene.table.blended, 1) != scene.table.blended.end()) {
        wish.is_blended = [&blended = scene.table.blended](std::uint32_t object) {
            return blended[object] != 0;
        };
    }
    wish.mask_shape = vulkan::MaskShape{true, reads.ids, reads.smooth}; // as recordShadows() gives them
    wish.frames_in_flight = options.frames_in_flight;
    wish.pipeline_cache = scene.gpu.pipelineCache();
    wish.compact = options.compact_mask;
    wish.shows_rays = options.shows_rays;
    wish.classics = vulkan::makeClassics(std::move(callbacks));
    return wish;
}

vulkan::CasterDrawerOptions casterOptions(const Gpu& gpu, const RenderOptions& options)
{
    vulkan::CasterDrawerOptions wish;
    wish.frames_in_flight = options.frames_in_flight;
    wish.pipeline_cache = gpu.pipelineCache();
    wish.vertices.piece = {VK_FORMAT_R16_UINT, sizeof(VertexAttributes),
                           offsetof(VertexAttributes, normal) + 3 * sizeof(std::int16_t)};
    wish.vertices.colour = {VK_FORMAT_R16G16B16A16_UNORM, sizeof(VertexAttributes), offsetof(VertexAttributes, colour)};
    return wish;
}

vulkan::ClassicCallbacks classicCallbacks(Shadows& shadows, vulkan::Profiler& profiler)
{
    vulkan::ClassicCallbacks callbacks;
    callbacks.fins = [&](const vulkan::FinPass& pass) {
        profiler.addDraws(shadows.fins->draw(pass));
    };
    callbacks.volumes = [&](const vulkan::VolumePass& pass) {
        profiler.addDraws(shadows.volumes->draw(pass));
    };
    return callbacks;
}

bool isFitted(const View& view)
{
    return view.projection.gpu_cascade != kNoIndex;
}

} // namespace

Shadows::Shadows(SceneData& scene, const RenderOptions& options, vulkan::Profiler& profiler)
    : reads(readBy(scene.table, resolvedOrThrow(options.shadow))), planner(resolvedOrThrow(options.shadow).asked()),
      renderer(scene.gpu.view(), rendererOptions(scene, options, reads, classicCallbacks(*this, profiler))),
      casters(scene.gpu.view(), casterOptions(scene.gpu, options))
{
    casters.setScene(scene.table.caster_parts, scene.table.caster_objects, scene.table.caster_batches);
    casters.setBiases(scene.table.biases_m);
    if (options.compact_mask.channels > 0) {
        tiles.emplace(scene, options.frames_in_flight);
    }
    const ResolvedOptions resolved = resolvedOrThrow(options.shadow);
    if (!resolved.hasMaps()) { // nor has what is blended any to look up its shadows in
        volume_meshes.emplace(scene, VolumeMeshes::Use::volumes);
        volumes.emplace(scene.gpu.view(),
                        vulkan::VolumeDrawerOptions{options.frames_in_flight, scene.gpu.pipelineCache()});
        volumes->setScene(volume_meshes->objects());
    }
    if (resolved.hasFins()) {
        volume_meshes.emplace(scene, VolumeMeshes::Use::fins);
        fins.emplace(scene.gpu.view(), vulkan::FinDrawerOptions{options.frames_in_flight, scene.gpu.pipelineCache()});
        fins->setScene(volume_meshes->objects());
    }
    if (resolved.hasMaps() && scene.pipelines.readsMaps()) {
        forward.emplace(scene, resolved, options.frames_in_flight);
    }
}

const Plan& Shadows::planAgain(const Frame& frame)
{
    if (plan != &kept_) {
        kept_ = *plan;
        plan = &kept_;
    }
    kept_.made_for.camera = frame.camera;
    kept_.made_for.size_px = frame.size_px;
    for (View& view : kept_.views) {
        view.contents.redraw = false;
        view.contents.redraw_kept = false;
        view.contents.presumes = view.contents.makes;
        view.contents.kept_presumes = view.contents.kept_makes;
    }
    return kept_;
}

const Plan& Shadows::fittedPlan(std::uint32_t slot)
{
    if (std::none_of(plan->views.begin(), plan->views.end(), isFitted)) {
        return *plan;
    }
    if (fitted_frame_ != plan->frame) {
        fitted_ = *plan;
        fitted_frame_ = plan->frame;
        const std::vector<FittedView> found = renderer.fittedViews(slot);
        for (std::size_t i = 0; i < found.size(); ++i) {
            View& view = fitted_.views[i];
            view = isFitted(view) ? viewAsFitted(view, found[i]) : view;
        }
    }
    return fitted_;
}

} // namespace gnomon::host
