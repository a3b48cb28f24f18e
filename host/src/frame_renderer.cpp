// SPDX-License-Identifier: Apache-2.0
#include "abandoned.h"
#include "frame_renderer_impl.h"
#include "texels.h"

#include <gnomon/error.h>

#include <algorithm>
#include <cassert>
#include <string>

namespace gnomon::host {
namespace {

constexpr std::uint32_t kMaxPasses = 256;
constexpr std::uint32_t kMaxFramesInFlight = 4;

const RenderOptions& checkedShading(const RenderOptions& options)
{
    const std::string_view refusal =
        options.shading == Shading::forward ? refusalOfForward(options) : std::string_view();
    if (!refusal.empty()) {
        throw Error("shading forward", std::string(refusal), "shade deferred");
    }
    return options;
}

std::uint32_t slotsOf(const RenderOptions& options)
{
    assert(options.frames_in_flight >= 1 && options.frames_in_flight <= kMaxFramesInFlight);
    return options.frames_in_flight;
}

std::shared_ptr<Shadows> makeShadows(SceneData& scene, const RenderOptions& options, vulkan::Profiler& profiler)
{
    return options.shadows ? std::make_shared<Shadows>(scene, options, profiler) : nullptr;
}

} // namespace

FrameRenderer::Impl::Impl(SceneData& the_scene, const RenderOptions& the_options)
    : scene(the_scene), gpu(the_scene.gpu), options(checkedShading(the_options)), memory(the_scene.gpu),
      draws(memory, the_scene.table, the_scene.geometry, the_scene.materials, slotsOf(the_options)),
      profiler(the_scene.gpu.view(), slotsOf(the_options), kMaxPasses), slots(slotsOf(the_options)),
      read_commands(the_scene.gpu, memory.names(), "read-back")
{
    for (Slot& one : slots) {
        one.frame_data =
            memory.buffer("host frame data", sizeof(FrameData), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, Place::host);
        one.commands = std::make_unique<Commands>(gpu, memory.names(), "frame");
        if (scene.geometry.deforms()) {
            one.deformed = scene.geometry.makeStaging(memory);
        }
    }
    visible.reserve(scene.table.objects.size());
    by_distance.reserve(scene.table.objects.size());
    if (options.sky == SkyModel::physical) {
        sky_table.emplace(scene, memory, slots.size());
    }
    if (options.shading == Shading::forward && options.shadows && !scene.pipelines.readsMaps()) {
        throw Error("shading forward", "the device has too few samplers for maps beside textures", "shade deferred");
    }
    screen = makeScreen(options);
    shadows = makeShadows(scene, options, profiler);
}

std::shared_ptr<Screen> FrameRenderer::Impl::makeScreen(const RenderOptions& wish) const
{
    std::vector<Buffer> frame_data;
    for (const Slot& one : slots) {
        frame_data.push_back(one.frame_data);
    }
    return std::make_shared<Screen>(scene, wish, frame_data,
                                    sky_table ? sky_table->descriptor() : scene.textures.cookies());
}

void FrameRenderer::Impl::settle() noexcept
{
    for (Slot& one : slots) {
        one.commands->settle();
    }
    read_commands.settle();
}

FrameRenderer::FrameRenderer(const SceneOnGpu& scene, const RenderOptions& options)
    : impl_(std::make_unique<Impl>(*scene.data_, options))
{
}

FrameRenderer::~FrameRenderer()
{
    impl_->settle();
    if (impl_->gpu.abandoned()) {
        keepForGood(std::move(impl_)); // the library's objects would destroy what the GPU may still be at work with
    }
}

void FrameRenderer::resize(std::uint32_t width, std::uint32_t height)
{
    RenderOptions next = impl_->options;
    next.width = width;
    next.height = height;
    impl_->screen = impl_->makeScreen(next);
    impl_->options = next;
}

void FrameRenderer::setShadows(const std::optional<ShadowOptions>& wanted)
{
    RenderOptions next = impl_->options;
    next.shadows = wanted.has_value();
    next.shadow = wanted.value_or(next.shadow);
    (void)checkedShading(next);
    impl_->shadows = makeShadows(impl_->scene, next, impl_->profiler);
    impl_->options = next;
}

const RenderOptions& FrameRenderer::options() const
{
    return impl_->options;
}

Picture FrameRenderer::read(const WantedImages& wanted)
{
    Impl& self = *impl_;
    if (self.next_index == 0 || !self.whole) {
        throw Error("reading a picture back", "nothing has been drawn yet");
    }
    ReadBack back(self.gpu, wanted);
    back.record(self.read_commands.begin(), self.finished);
    self.read_commands.finish();
    return back.picture();
}

ImageF FrameRenderer::readMap(std::uint32_t layer)
{
    Impl& self = *impl_;
    constexpr const char* kTried = "reading a shadow map back";
    if (self.plan == nullptr) {
        throw Error(kTried, "the last frame had no shadow map");
    }
    const vulkan::ImageRef maps = self.now().shadows->renderer.maps();
    if (layer >= maps.layers) {
        throw Error(kTried, "layer " + std::to_string(layer) + " of " + std::to_string(maps.layers));
    }
    const TexelForm form = formOf(maps.format);
    ImageF image(maps.extent.width, maps.extent.height, form.channels);
    TexelCopies copies(self.gpu);
    copies.begin(TexelCopies::bytesOf(maps));
    VkCommandBuffer cmd = self.read_commands.begin();
    const void* const texels = copies.add(cmd, maps, layer);
    TexelCopies::end(cmd);
    self.read_commands.finish();
    copies.makeVisible();
    if (!convert(texels, form.number, image.values)) {
        throw Error(kTried, "its format cannot be read");
    }
    return image;
}

bool FrameRenderer::masksReadIds() const
{
    return impl_->gbuffer.shape.ids;
}

const Plan& FrameRenderer::plan() const
{
    Impl& self = *impl_;
    if (self.plan == nullptr) {
        return self.no_plan;
    }
    self.finish();
    return self.now().shadows->fittedPlan(self.slot);
}

vulkan::FilterCost FrameRenderer::filterCost() const
{
    Impl& self = *impl_;
    self.finish();
    return self.plan != nullptr ? self.now().shadows->renderer.filterCost(self.slot) : vulkan::FilterCost{};
}

std::vector<pack::DepthLayer> FrameRenderer::depthLayers(std::uint32_t view) const
{
    Impl& self = *impl_;
    self.finish();
    const bool known = self.plan != nullptr && view < self.plan->views.size();
    return known ? self.now().shadows->renderer.depthLayers(*self.plan, view) : std::vector<pack::DepthLayer>{};
}

std::vector<vulkan::MemoryUse> FrameRenderer::memory() const
{
    const Impl& self = *impl_;
    std::vector<vulkan::MemoryUse> uses = self.scene.memory.uses();
    const auto add = [&uses](std::span<const vulkan::MemoryUse> others) {
        uses.insert(uses.end(), others.begin(), others.end());
    };
    add(self.memory.uses());
    add(self.screen->memory());
    if (self.shadows) {
        add(self.shadows->renderer.memory());
        add(self.shadows->casters.memory());
        if (self.shadows->volume_meshes) {
            add(self.shadows->volume_meshes->memory());
        }
        if (self.shadows->forward) {
            add(self.shadows->forward->memory());
        }
    }
    std::erase_if(uses, [](const vulkan::MemoryUse& use) { return use.bytes == 0; });
    return uses;
}

CascadePass FrameRenderer::cascadePass() const
{
    const bool layered = impl_->shadows && impl_->options.shadow.cascades.pass == CascadePass::layered;
    return layered ? CascadePass::layered : CascadePass::each;
}

} // namespace gnomon::host
