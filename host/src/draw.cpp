// SPDX-License-Identifier: Apache-2.0
// One frame, from the scene's state to its submission.
#include "frame_renderer_impl.h"
#include "model_bounds.h"

#include <gnomon/converge.h>
#include <gnomon/error.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <string>

namespace gnomon::host {
namespace {

double millisecondsSince(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

vulkan::ImageRef refOf(const Image& image, const Access& last)
{
    return {image.handle, image.view, image.format, image.extent, image.layers, last.layout};
}

} // namespace

void FrameRenderer::submit(const scene::State& state, const Eye& eye, const std::vector<ShadedLight>& lights,
                           Present* present, const std::vector<ImageF>* masks_instead)
{
    impl_->drawFrame(state, eye, lights, present, masks_instead, Maps::planned);
}

FrameTimes FrameRenderer::finish()
{
    Impl& self = *impl_;
    self.finish();
    self.times.frame_ms = millisecondsSince(self.start);
    self.times.passes = {};
    for (const vulkan::PassRecord& pass : self.profiler.results(self.slot)) {
        self.times.passes.push_back(pass);
    }
    self.times.reuse = self.plan != nullptr ? self.now().shadows->renderer.reuse(self.slot) : vulkan::MapReuse{};
    self.times.mask_kept = self.plan != nullptr && self.now().shadows->renderer.maskKept(self.slot);
    return self.times;
}

FrameTimes FrameRenderer::draw(const scene::State& state, const Eye& eye, const std::vector<ShadedLight>& lights,
                               const std::vector<ImageF>* masks_instead)
{
    submit(state, eye, lights, nullptr, masks_instead);
    return finish();
}

void FrameRenderer::drawAgain(const scene::State& state, const Eye& eye, const std::vector<ShadedLight>& lights)
{
    impl_->drawFrame(state, eye, lights, nullptr, nullptr, Maps::kept);
    impl_->finish();
}

void FrameRenderer::Impl::drawFrame(const scene::State& state, const Eye& eye, const std::vector<ShadedLight>& lights,
                                    Present* present, const std::vector<ImageF>* masks_instead, Maps maps)
{
    if (lights.size() > kMaxLights) {
        throw Error("lighting the scene", std::to_string(lights.size()) + " lights",
                    "use at most " + std::to_string(kMaxLights));
    }
    start = Clock::now();
    forgetBroken();
    whole = false;
    prepareFrame(state, eye, lights, masks_instead, maps);
    const Clock::time_point record_start = Clock::now();
    draws.build(slot, state, sight.eye_ws, visible);
    if (masks_instead != nullptr) {
        writeInstead(*masks_instead);
    }
    describeFrame();
    writeFrameData(lights);
    if (ForwardShadows* const lookup = forwardShadows()) {
        lookup->describe(slot, *plan, shadows->renderer);
    }
    record(present);
    now().commands->submit();
    if (maps == Maps::planned && plan != nullptr) {
        for (const MapPages& pages : plan->pages) {
            now().drawn_texels += pages.drawn_texels;
        }
    }
    if (deform_now) {
        scene.deformed_at_s = state.time_s;
    }
    whole = true;
    times.record_ms = millisecondsSince(record_start);
}

/// Resets the library after a frame that ended half way: the GPU never drew what was recorded.
void FrameRenderer::Impl::forgetBroken()
{
    if (!whole && shadows) {
        shadows->renderer.reset();
    }
    if (!whole && sky_table) {
        sky_table->forget();
    }
    plan = nullptr;
    finished = {};
}

void FrameRenderer::Impl::prepareFrame(const scene::State& state, const Eye& eye,
                                       const std::vector<ShadedLight>& lights, const std::vector<ImageF>* masks_instead,
                                       Maps maps)
{
    beginSlot();
    update(state);
    look(state, eye, lights, maps);
    lookAtSky(state, lights);
    times.advance_ms = millisecondsSince(start);
    const Clock::time_point plan_start = Clock::now();
    forward.on = options.shading == Shading::forward && masks_instead == nullptr;
    makePlan(maps, masks_instead != nullptr);
    choosePipelines();
    times.plan_ms = millisecondsSince(plan_start);
}

/// The oldest frame is waited for, and lets go of what it alone used.
void FrameRenderer::Impl::beginSlot()
{
    slot = static_cast<std::uint32_t>(next_index % slots.size());
    now().commands->wait();
    if (next_index >= slots.size()) {
        scene.finishUpload(); // which came before the frame that has been waited for
    }
    learnRate();
    now().drawn_texels = 0;
    now().screen = screen;
    now().shadows = shadows;
}

/// Takes the time that the maps of the slot's finished frame took into the draw rate.
void FrameRenderer::Impl::learnRate()
{
    Shadows* const drawn_by = now().shadows.get();
    if (drawn_by == nullptr || now().drawn_texels == 0 || !(drawn_by->planner.options().draw_budget_ms > 0.0)) {
        return;
    }
    double ms = 0.0;
    for (const vulkan::PassRecord& pass : profiler.results(slot)) {
        const std::string_view name = pass.name;
        if (name == "shadow maps" || name == "shadow filter" || name == "maps of tints") {
            if (!pass.milliseconds) {
                return; // no timestamps: the rate stays unknown, and the budget bounds nothing
            }
            ms += *pass.milliseconds;
        }
    }
    if (drawn_by->warm) {
        drawn_by->draw_rate.take(now().drawn_texels, ms);
    }
    drawn_by->warm = true;
}

void FrameRenderer::Impl::finish()
{
    now().commands->wait();
    scene.finishUpload(); // which came before
}

void FrameRenderer::Impl::update(const scene::State& state)
{
    if (objects.size() == 0) {
        fillObjectSet(state, objects, scene.table.closed, scene.table.pieces, scene.table.joined);
        const float radius_m = options.ambient_occlusion.radius_m;
        occlusion_radius_m = radius_m > 0.0F ? radius_m : scene.occlusionRadius_m();
    }
    const bool deforms = scene.geometry.deforms();
    const bool deformed = deforms && deformed_at_s != state.time_s;
    deformed_at_s = state.time_s;
    // Another renderer may have left the shared vertices as they are at another time.
    deform_now = deforms && scene.deformed_at_s != state.time_s;
    if (deform_now) {
        scene.geometry.writeDeformed(scene.scene, state, now().deformed);
    }
    draws.update(state, objects, deformed);
}

void FrameRenderer::Impl::look(const scene::State& state, const Eye& eye, const std::vector<ShadedLight>& lights,
                               Maps maps)
{
    const VkExtent2D shown = screen->targets.shown;
    const VkExtent2D drawn = screen->targets.drawn;
    const glm::dvec2 drawn_px(drawn.width, drawn.height);
    sight = sightOf(eye, shown.width, shown.height, state.bounds_ws);
    if (options.average_pixels && maps == Maps::planned) {
        sight.jitter = convergeSample(next_sample++).pixel_px * 2.0 / drawn_px;
    }
    frame.index = next_index++;
    frame.time_s = state.time_s;
    frame.camera = cameraOf(sight, drawn_px);
    frame.size_px = {drawn.width, drawn.height};
    frame_lights.clear();
    for (const ShadedLight& light : lights) {
        frame_lights.push_back(light.caster);
    }
    frame.lights = frame_lights;
    frame.objects = &objects;
    visible.clear();
    const Frustum frustum = frustumFromClip(frame.camera.clip_from_world);
    objects.query(frustum.planes, ObjectSet::Want::all, visible);
    sortNearestFirst();
    nameContent();
}

/// Every object is in the set, receiver or not, and whatever moves or deforms it raises the set's version.
void FrameRenderer::Impl::nameContent()
{
    const Shown now{frame.camera, frame.size_px, objects.version()};
    content += content == 0 || now != shown_last ? 1 : 0;
    shown_last = now;
}

void FrameRenderer::Impl::choosePipelines()
{
    Pipelines& pipelines = scene.pipelines;
    // Surfaces that blend, emit, fade or glow add to light, and supersampling averages light.
    const bool at_once = !options.keeps_light && pipelines.blended.whole == VK_NULL_HANDLE &&
                         pipelines.emissive.whole == VK_NULL_HANDLE && !pipelines.fades() && !screen->bloom &&
                         options.anti_aliasing != AntiAliasing::ssaa4;
    toned = at_once ? Toning{true, options.tone, options.dither} : Toning{};
    ShadedBy by;
    by.fixed_lights = frame_lights.size() <= kMostFixedLights ? static_cast<std::uint32_t>(frame_lights.size()) : 0;
    by.all_directional = std::all_of(frame_lights.begin(), frame_lights.end(),
                                     [](const Light& l) { return l.type == LightType::directional; });
    by.phong_2005 = options.reflection == Reflection::phong_2005;
    by.toned = toned;
    const SkyFacts facts{.toned = toned, .physical = all_light->physical, .night = all_light->night_sky};
    sky = pipelines.skyFor(facts);
    fading = pipelines.fades() ? pipelines.fadingFor(facts) : VK_NULL_HANDLE;
    if (forward.on) {
        chooseForward(by);
        return;
    }
    gbuffer.shape = plan != nullptr ? shadows->reads : GBufferShape{};
    gbuffer.pipelines = &pipelines.gbufferFor(gbuffer.shape);
    screen->needGBuffer(pipelines.gbuffer_formats, gbuffer.shape);
    occluded = options.ambient_occlusion.on && options.reflection == Reflection::materials;
    by.occluded = occluded;
    if (occluded) {
        screen->needOcclusion();
    }
    shade = pipelines.shadeFor(by);
    by.fixed_lights = 0; // tiles have any number
    by.all_directional = false;
    shade_compact = options.compact_mask.channels > 0 ? pipelines.shadeCompact(by) : VK_NULL_HANDLE;
}

// Instances of a part are drawn in this order, so that near ones hide far ones before those are shaded.
void FrameRenderer::Impl::sortNearestFirst()
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

void FrameRenderer::Impl::makePlan(Maps maps, bool masked_instead)
{
    instead = nullptr;
    plan = nullptr;
    if (!shadows || masked_instead) {
        return;
    }
    if (maps == Maps::kept) {
        plan = &shadows->planAgain(frame);
    } else {
        if (!options.reuse_maps) {
            shadows->planner.reset();
        }
        frame.draw_ms_per_texel = shadows->draw_rate.msPerTexel();
        frame.rates = scene.gpu.rates();
        frame.clamps_depth = scene.gpu.view().features.depth_clamp;
        frame.requests = shadows->renderer.pageRequests(slot);
        plan = shadows->plan = &shadows->planner.plan(frame);
    }
    (void)shadows->renderer.prepare(*plan, forward.on ? VkExtent2D{} : screen->targets.drawn);
}

void FrameRenderer::Impl::lookAtSky(const scene::State& state, const std::vector<ShadedLight>& lights)
{
    // A ground that was put in is as large as it has to be, and changes nothing of what stands on it.
    fading_objects.assign(scene.pipelines.fades() ? state.objects.size() : 0, 0);
    for (std::size_t i = 0; i < fading_objects.size(); ++i) {
        fading_objects[i] = fades(scene.scene, state.objects[i]) ? 1 : 0;
    }
    all_light = &daylight.at(options.sky, options.exposure_ev, lights,
                             seen_light.find(lights, objects, sight, fading_objects), state.environment);
    brings_sky = sky_table && sky_table->bring(slot, *all_light);
}

void FrameRenderer::Impl::writeFrameData(const std::vector<ShadedLight>& lights)
{
    cookie_layers.clear();
    for (const ShadedLight& light : lights) {
        cookie_layers.push_back(light.cookie == scene::kNone ? -1 : scene.textures.cookieLayer(light.cookie));
    }
    auto& data = *static_cast<FrameData*>(now().frame_data.mapped);
    const VkExtent2D drawn = screen->targets.drawn;
    fillFrameData(data, sight, drawn.width, drawn.height, lights, cookie_layers, *all_light,
                  finished.masks.image != VK_NULL_HANDLE);
    data.ray_x.w = static_cast<float>(occlusion_radius_m);
    for (std::size_t i = 0; plan != nullptr && i < lights.size(); ++i) {
        const LightPlan& planned = plan->lights[i];
        data.lights[i].right.w = maskSlot(planned.mask_layer, planned.mask_channel, planned.mask_coloured);
    }
}

void FrameRenderer::Impl::writeInstead(const std::vector<ImageF>& masks)
{
    const auto refuse = [](const std::string& found) {
        throw Error("using other masks", found);
    };
    if (masks.size() != frame_lights.size()) {
        refuse(std::to_string(masks.size()) + " masks for " + std::to_string(frame_lights.size()) + " lights");
    }
    const VkExtent2D shown = screen->targets.shown;
    const std::uint32_t width = screen->targets.drawn.width;
    const std::uint32_t height = screen->targets.drawn.height;
    instead = &screen->insteadFor(static_cast<std::uint32_t>(std::max<std::size_t>((masks.size() + 3) / 4, 1)));
    const std::size_t layer_bytes = std::size_t{4} * width * height;
    Buffer& staging = now().instead_staging;
    memory.grow(staging, layer_bytes * instead->layers, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, "host pictures");
    auto* const bytes = static_cast<std::uint8_t*>(staging.mapped);
    std::memset(bytes, 255, layer_bytes * instead->layers);
    const std::uint32_t scale = width / shown.width;
    for (std::size_t light = 0; light < masks.size(); ++light) {
        const ImageF& mask = masks[light];
        if (mask.width != shown.width || mask.height != shown.height) {
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

bool FrameRenderer::Impl::hasTiles() const
{
    return plan != nullptr && instead == nullptr && shadows->tiles && !frame_lights.empty();
}

ForwardShadows* FrameRenderer::Impl::forwardShadows()
{
    const bool wanted =
        plan != nullptr && shadows->forward && !plan->views.empty() && (forward.on || draws.anyBlended());
    return wanted ? &*shadows->forward : nullptr;
}

void FrameRenderer::Impl::describeFrame()
{
    const Targets& targets = screen->targets;
    finished = {};
    finished.drawn = targets.drawn;
    finished.shown = targets.shown;
    finished.picture = refOf(targets.picture, kCopySource);
    finished.light = toned.on ? vulkan::ImageRef{} : refOf(targets.light, kSampled);
    finished.glow = screen->bloom ? refOf(screen->bloom->result(), kSampled) : vulkan::ImageRef{};
    finished.depth = refOf(targets.depth, kDepthRead);
    finished.light_count = frame_lights.size();
    finished.plan = plan;
    if (forward.on) {
        return;
    }
    finished.normals = refOf(targets.normals(), kSampled);
    finished.ids = refOf(targets.surfaces(), kSampled);
    finished.compact_masks = hasTiles();
    if (!frame_lights.empty() && (plan != nullptr || instead != nullptr)) {
        finished.masks = instead != nullptr ? refOf(*instead, kSampled) : shadows->renderer.mask();
    }
}

} // namespace gnomon::host
