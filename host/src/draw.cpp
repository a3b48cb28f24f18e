// SPDX-License-Identifier: Apache-2.0
// One frame, from the scene's state to the picture.
#include "renderer_impl.h"

#include <gnomon/error.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <string>

namespace gnomon::host {
namespace {

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start)
{
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

VkRenderingAttachmentInfo attachment(const Image& image, VkImageLayout layout, VkAttachmentLoadOp load)
{
    VkRenderingAttachmentInfo info{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    info.imageView = image.view;
    info.imageLayout = layout;
    info.loadOp = load;
    info.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    return info;
}

void beginRendering(VkCommandBuffer cmd, VkExtent2D extent, std::span<const VkRenderingAttachmentInfo> colours,
                    const VkRenderingAttachmentInfo* depth)
{
    VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
    info.renderArea = {{0, 0}, extent};
    info.layerCount = 1;
    info.colorAttachmentCount = static_cast<std::uint32_t>(colours.size());
    info.pColorAttachments = colours.data();
    info.pDepthAttachment = depth;
    vkCmdBeginRendering(cmd, &info);
}

} // namespace

FrameTimes Renderer::draw(const scene::State& state, const Eye& eye, const std::vector<ShadedLight>& lights,
                          const std::vector<ImageF>* masks_instead)
{
    return impl_->drawFrame(state, eye, lights, masks_instead, Maps::planned);
}

void Renderer::drawAgain(const scene::State& state, const Eye& eye, const std::vector<ShadedLight>& lights)
{
    impl_->drawFrame(state, eye, lights, nullptr, Maps::kept);
}

FrameTimes Renderer::Impl::drawFrame(const scene::State& state, const Eye& eye, const std::vector<ShadedLight>& lights,
                                     const std::vector<ImageF>* masks_instead, Maps maps)
{
    const bool has_mask = masks_instead != nullptr || shadows.has_value();
    FrameTimes times;
    const Clock::time_point start = Clock::now();
    update(state);
    look(state, eye, lights);
    times.advance_ms = millisecondsSince(start);

    const Clock::time_point plan_start = Clock::now();
    mask_instead = masks_instead != nullptr;
    if (maps == Maps::kept) {
        keepPlan();
    } else {
        makePlan();
    }
    times.plan_ms = millisecondsSince(plan_start);

    const Clock::time_point record_start = Clock::now();
    draws.build(state, sight.eye_ws, visible);
    if (masks_instead != nullptr) {
        writeInstead(*masks_instead);
    }
    writeFrameData(state, lights, has_mask);
    record(has_mask);
    times.record_ms = millisecondsSince(record_start);

    commands.finish();
    times.frame_ms = millisecondsSince(start);
    for (const vulkan::PassRecord& pass : profiler.results(0)) {
        times.passes.push_back(pass);
    }
    if (shadows && masks_instead == nullptr) {
        times.reuse = shadows->reuse(0);
    }
    return times;
}

void Renderer::Impl::keepPlan()
{
    if (plan != nullptr && plan != &kept_plan) {
        kept_plan = *plan;
        plan = &kept_plan;
    }
    for (View& view : kept_plan.views) {
        view.redraw = false;
        view.redraw_kept = false;
    }
}

void Renderer::Impl::update(const scene::State& state)
{
    deform_now = geometry.deforms() && deformed_at_s != state.time_s;
    if (deform_now) {
        geometry.writeDeformed(scene, state);
        deformed_at_s = state.time_s;
    }
    draws.update(state, objects, deform_now);
}

void Renderer::Impl::look(const scene::State& state, const Eye& eye, const std::vector<ShadedLight>& lights)
{
    if (lights.size() > kMaxLights) {
        throw Error("lighting the scene", std::to_string(lights.size()) + " lights",
                    "use at most " + std::to_string(kMaxLights));
    }
    sight = sightOf(eye, options.width, options.height, state.bounds_ws);
    frame.index = next_index++;
    frame.time_s = state.time_s;
    frame.camera = cameraOf(eye, options.width, options.height, state.bounds_ws);
    frame.size_px = {targets.drawn.width, targets.drawn.height};
    frame_lights.clear();
    for (const ShadedLight& light : lights) {
        frame_lights.push_back(light.caster);
    }
    frame.lights = frame_lights;
    frame.objects = &objects;
    light_count = lights.size();
    visible.clear();
    const Frustum frustum = frustumFromClip(frame.camera.clip_from_world);
    objects.query(frustum.planes, ObjectSet::Want::all, visible);
    sortNearestFirst();
}

// Instances of a part are drawn in this order, so that near ones hide far ones before those are shaded.
void Renderer::Impl::sortNearestFirst()
{
    const glm::vec3 eye(sight.eye_ws);
    by_distance.clear();
    for (const std::uint32_t object : visible) {
        const glm::vec3 to = objects.bounds(object).centre() - eye;
        by_distance.emplace_back(glm::dot(to, to), object);
    }
    std::sort(by_distance.begin(), by_distance.end());
    std::transform(by_distance.begin(), by_distance.end(), visible.begin(), [](const auto& one) { return one.second; });
}

void Renderer::Impl::makePlan()
{
    if (!shadows || mask_instead) {
        plan = nullptr;
        return;
    }
    if (!options.reuse_maps) {
        planner.reset();
    }
    plan = &planner.plan(frame);
    if (shadows->prepare(*plan, targets.drawn)) {
        mask_view = VK_NULL_HANDLE; // a new view may have an old one's handle
    }
}

void Renderer::Impl::writeFrameData(const scene::State& state, const std::vector<ShadedLight>& lights, bool has_mask)
{
    cookie_layers.clear();
    for (const ShadedLight& light : lights) {
        cookie_layers.push_back(light.cookie == scene::kNone ? -1 : textures.cookieLayer(light.cookie));
    }
    const double exposure = exposureOf(lights, state.bounds_ws, state.environment);
    auto& data = *static_cast<FrameData*>(frame_buffer.mapped);
    fillFrameData(data, sight, targets.drawn.width, targets.drawn.height, lights, cookie_layers, exposure,
                  state.environment, has_mask && !lights.empty());
    for (std::size_t i = 0; plan != nullptr && i < lights.size(); ++i) {
        data.lights[i].right.w = static_cast<float>(plan->lights[i].mask_layer * 4 + plan->lights[i].mask_channel);
    }
}

void Renderer::Impl::writeInstead(const std::vector<ImageF>& masks)
{
    const auto refuse = [](const std::string& found) {
        throw Error("using other masks", found);
    };
    if (masks.size() != light_count) {
        refuse(std::to_string(masks.size()) + " masks for " + std::to_string(light_count) + " lights");
    }
    const auto layers = static_cast<std::uint32_t>(std::max<std::size_t>((masks.size() + 3) / 4, 1));
    if (instead.handle == VK_NULL_HANDLE || instead.layers < layers) {
        ImageWish wish;
        wish.name = "masks instead";
        wish.purpose = "host pictures";
        wish.format = VK_FORMAT_R8G8B8A8_UNORM;
        wish.extent = targets.drawn;
        wish.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
        wish.layers = layers;
        wish.array_view = true;
        instead = memory.image(wish);
    }
    const std::uint32_t width = targets.drawn.width;
    const std::uint32_t height = targets.drawn.height;
    const std::size_t layer_bytes = std::size_t{4} * width * height;
    memory.grow(instead_staging, layer_bytes * instead.layers, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, "host pictures");
    auto* const bytes = static_cast<std::uint8_t*>(instead_staging.mapped);
    std::memset(bytes, 255, layer_bytes * instead.layers);
    const std::uint32_t scale = width / options.width;
    for (std::size_t light = 0; light < masks.size(); ++light) {
        const ImageF& mask = masks[light];
        if (mask.width != options.width || mask.height != options.height) {
            refuse("a mask of " + std::to_string(mask.width) + "x" + std::to_string(mask.height));
        }
        std::uint8_t* out = bytes + layer_bytes * (light / 4) + light % 4;
        for (std::uint32_t y = 0; y < height; ++y) {
            for (std::uint32_t x = 0; x < width; ++x, out += 4) {
                const float seen = std::clamp(*mask.pixel(x / scale, y / scale), 0.0F, 1.0F);
                *out = static_cast<std::uint8_t>(std::lround(seen * 255.0F));
            }
        }
    }
}

void Renderer::Impl::record(bool has_mask)
{
    if (has_mask && light_count > 0) {
        bindMask(mask_instead ? instead.view : shadows->mask().view);
    } else {
        bindMask(textures.cookies().imageView); // an array that is always there, and not read then
    }
    VkCommandBuffer cmd = commands.begin();
    profiler.beginFrame(cmd, 0);
    if (deform_now) {
        profiler.beginPass(cmd, "deform");
        geometry.recordDeformed(cmd);
        profiler.endPass(cmd);
    }
    recordGBuffer(cmd);
    if (mask_instead) {
        recordInstead(cmd);
    } else if (plan != nullptr) {
        recordShadows(cmd);
    }
    recordLight(cmd);
    if (bloom) {
        recordBloom(cmd);
    }
    recordPicture(cmd);
}

void Renderer::Impl::setViewport(VkCommandBuffer cmd, VkExtent2D extent) const
{
    const VkViewport viewport{0.0F, 0.0F, static_cast<float>(extent.width), static_cast<float>(extent.height),
                              0.0F, 1.0F};
    const VkRect2D scissor{{0, 0}, extent};
    vkCmdSetViewport(cmd, 0, 1, &viewport);
    vkCmdSetScissor(cmd, 0, 1, &scissor);
}

void Renderer::Impl::recordGBuffer(VkCommandBuffer cmd)
{
    memory.names().begin(cmd, "g-buffer");
    profiler.beginPass(cmd, "g-buffer");
    std::array<VkRenderingAttachmentInfo, 4> colours{};
    for (std::size_t i = 0; i < colours.size(); ++i) {
        barrier(cmd, targets.gbuffer[i], kDiscard, kColourWrite);
        // Where nothing is drawn only depth and ids are looked at.
        const VkAttachmentLoadOp load = i == 3 ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_DONT_CARE;
        colours[i] = attachment(targets.gbuffer[i], kColourWrite.layout, load);
    }
    barrier(cmd, targets.depth, kDiscard, kDepthWrite);
    VkRenderingAttachmentInfo depth = attachment(targets.depth, kDepthWrite.layout, VK_ATTACHMENT_LOAD_OP_CLEAR);
    depth.clearValue.depthStencil.depth = 0.0F;
    beginRendering(cmd, targets.drawn, colours, &depth);
    setViewport(cmd, targets.drawn);
    profiler.addDraws(draws.recordOpaque(cmd, pipelines, frame_set));
    vkCmdEndRendering(cmd);
    for (const Image& image : targets.gbuffer) {
        barrier(cmd, image, kColourWrite, kSampledByAll);
    }
    barrier(cmd, targets.depth, kDepthWrite, kDepthRead);
    profiler.endPass(cmd);
    memory.names().end(cmd);
}

void Renderer::Impl::recordShadows(VkCommandBuffer cmd)
{
    vulkan::MaskInputs inputs;
    inputs.extent = targets.drawn;
    inputs.depth = targets.depth.view;
    inputs.depth_layout = kDepthRead.layout;
    inputs.normal = targets.normals().view;
    inputs.object_id = targets.ids().view;
    shadows->recordBounds(cmd, 0, frame, *plan, inputs, &profiler);
    casters->beginFrame(0, *plan, draws.casterGeometry(), draws.transforms());
    shadows->recordMaps(
        cmd, 0, frame, *plan, [this](const vulkan::MapPass& pass) { profiler.addDraws(casters->draw(pass)); },
        &profiler);
    if (light_count > 0) {
        shadows->recordMask(cmd, 0, frame, *plan, inputs, &profiler);
    }
}

void Renderer::Impl::recordInstead(VkCommandBuffer cmd) const
{
    barrier(cmd, instead, kDiscard, kCopyTarget);
    VkBufferImageCopy copy{};
    copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, instead.layers};
    copy.imageExtent = {targets.drawn.width, targets.drawn.height, 1};
    vkCmdCopyBufferToImage(cmd, instead_staging.handle, instead.handle, kCopyTarget.layout, 1, &copy);
    barrier(cmd, instead, kCopyTarget, kSampled);
}

void Renderer::Impl::recordLight(VkCommandBuffer cmd)
{
    memory.names().begin(cmd, "light");
    profiler.beginPass(cmd, "light");
    barrier(cmd, targets.light, kDiscard, kColourWrite);
    const VkRenderingAttachmentInfo colour =
        attachment(targets.light, kColourWrite.layout, VK_ATTACHMENT_LOAD_OP_DONT_CARE);
    const VkRenderingAttachmentInfo depth = attachment(targets.depth, kDepthRead.layout, VK_ATTACHMENT_LOAD_OP_LOAD);
    beginRendering(cmd, targets.drawn, {&colour, 1}, &depth);
    setViewport(cmd, targets.drawn);
    const bool all_directional = std::all_of(frame_lights.begin(), frame_lights.end(),
                                             [](const Light& l) { return l.type == LightType::directional; });
    for (VkPipeline pipeline : {pipelines.shadeFor(light_count, all_directional), pipelines.sky}) {
        vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
        // After the pipeline: it may be the frame's first, see SceneDraws::recordOpaque.
        vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines.screen_layout, 0, 1, &frame_set, 0,
                                nullptr);
        vkCmdDraw(cmd, 3, 1, 0, 0);
    }
    vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines.scene_layout, 0, 1, &frame_set, 0, nullptr);
    draws.bindStreams(cmd);
    profiler.addDraws(2 + draws.recordEmissive(cmd, pipelines) + draws.recordBlended(cmd, pipelines));
    vkCmdEndRendering(cmd);
    barrier(cmd, targets.light, kColourWrite, bloom ? kSampledByAll : kSampled);
    profiler.endPass(cmd);
    memory.names().end(cmd);
}

void Renderer::Impl::recordBloom(VkCommandBuffer cmd)
{
    memory.names().begin(cmd, "bloom");
    profiler.beginPass(cmd, "bloom");
    bloom->record(cmd);
    profiler.endPass(cmd);
    memory.names().end(cmd);
}

void Renderer::Impl::screenPass(VkCommandBuffer cmd, const char* name, VkPipeline pipeline, const Image& target)
{
    memory.names().begin(cmd, name);
    profiler.beginPass(cmd, name);
    barrier(cmd, target, kDiscard, kColourWrite);
    const VkRenderingAttachmentInfo colour = attachment(target, kColourWrite.layout, VK_ATTACHMENT_LOAD_OP_DONT_CARE);
    beginRendering(cmd, targets.shown, {&colour, 1}, nullptr);
    setViewport(cmd, targets.shown);
    vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines.screen_layout, 0, 1, &frame_set, 0,
                            nullptr);
    vkCmdDraw(cmd, 3, 1, 0, 0);
    vkCmdEndRendering(cmd);
    profiler.addDraws(1);
    profiler.endPass(cmd);
    memory.names().end(cmd);
}

void Renderer::Impl::recordPicture(VkCommandBuffer cmd)
{
    const bool smooth = options.anti_aliasing == AntiAliasing::fxaa;
    screenPass(cmd, "tone", pipelines.tone, smooth ? targets.toned : targets.picture);
    if (smooth) {
        barrier(cmd, targets.toned, kColourWrite, kSampled);
        screenPass(cmd, "fxaa", pipelines.fxaa, targets.picture);
    }
    barrier(cmd, targets.picture, kColourWrite, kCopySource);
}

} // namespace gnomon::host
