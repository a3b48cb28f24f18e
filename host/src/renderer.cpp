// SPDX-License-Identifier: Apache-2.0
#include "renderer_impl.h"

#include <gnomon/error.h>

#include <algorithm>
#include <string>

namespace gnomon::host {
namespace {

constexpr std::uint32_t kMaxPasses = 256;

VkExtent2D drawnExtent(const RenderOptions& options)
{
    const std::uint32_t scale = options.anti_aliasing == AntiAliasing::ssaa4 ? 2 : 1;
    return {options.width * scale, options.height * scale};
}

ToneFacts toneFacts(const RenderOptions& options)
{
    ToneFacts facts;
    facts.average_four = options.anti_aliasing == AntiAliasing::ssaa4;
    if (options.bloom.on) {
        const std::uint32_t levels = bloomLevels({options.width, options.height}, options.bloom.levels);
        facts.bloom = options.bloom.intensity / static_cast<float>(levels);
        facts.bloom_radius = options.bloom.radius;
    }
    return facts;
}

void checkBloom(const BloomOptions& bloom)
{
    const auto within = [](const char* name, float value, float low, float high) {
        if (!(value >= low && value <= high)) {
            throw Error("making a picture with bloom", std::string(name) + " is " + std::to_string(value),
                        "choose one from " + std::to_string(low) + " to " + std::to_string(high));
        }
    };
    within("its threshold", bloom.threshold, 0.0F, 64.0F);
    within("its knee", bloom.knee, 0.0F, 1.0F);
    within("its intensity", bloom.intensity, 0.0F, 4.0F);
    within("its radius", bloom.radius, 0.5F, 3.0F);
    within("its number of levels", static_cast<float>(bloom.levels), 1.0F, 8.0F);
}

const RenderOptions& checked(const Gpu& gpu, const RenderOptions& options)
{
    const std::uint32_t limit = gpu.properties().limits.maxImageDimension2D;
    const std::uint32_t scale = options.anti_aliasing == AntiAliasing::ssaa4 ? 2 : 1;
    const auto refuse = [](const std::string& found) {
        throw Error("making a picture", found, "choose a size within it");
    };
    if (options.width == 0 || options.height == 0) {
        refuse("a size of " + std::to_string(options.width) + "x" + std::to_string(options.height) + " has no pixel");
    }
    if (options.width > limit / scale || options.height > limit / scale) {
        refuse(std::to_string(options.width) + "x" + std::to_string(options.height) +
               " is beyond the device's limit of " + std::to_string(limit / scale) + " on a side");
    }
    if (options.bloom.on) {
        checkBloom(options.bloom);
    }
    return options;
}

} // namespace

Renderer::Impl::Impl(Gpu& the_gpu, const scene::Scene& the_scene, const scene::State& state,
                     const RenderOptions& the_options)
    : gpu(the_gpu), scene(the_scene), options(checked(the_gpu, the_options)), memory(the_gpu),
      uploader(std::make_unique<Uploader>(the_gpu, memory)), textures(the_gpu, memory, *uploader, the_scene),
      materials(the_gpu, memory, *uploader, textures, the_scene), geometry(memory, *uploader, the_scene, state),
      pipelines(the_gpu, memory.names(), materials, toneFacts(options)),
      targets(memory, drawnExtent(options), {options.width, options.height},
              options.anti_aliasing == AntiAliasing::fxaa),
      draws(memory, geometry, materials, the_scene, state), commands(the_gpu, memory.names(), "frame"),
      profiler(the_gpu.view(), 1, kMaxPasses), planner(options.shadow)
{
    frame_buffer = memory.buffer("host frame data", sizeof(FrameData), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, Place::host);
    uploader->flush();
    uploader.reset();
    fillObjectSet(state, objects);
    visible.reserve(state.objects.size());
    by_distance.reserve(state.objects.size());
    if (toneFacts(options).bloom > 0.0F) {
        bloom.emplace(gpu, memory, options.bloom, targets.light, targets.shown,
                      options.anti_aliasing == AntiAliasing::ssaa4, textures.plainSampler());
    }
    makeFrameSet();
    if (options.shadows) {
        vulkan::ShadowRendererOptions wish;
        wish.filter = vulkan::filterOptionsOf(options.shadow);
        wish.frames_in_flight = 1; // draw() waits, so that its times are whole
        wish.pipeline_cache = gpu.pipelineCache();
        shadows.emplace(gpu.view(), wish);
        vulkan::CasterDrawerOptions caster_wish;
        caster_wish.orthographic = shadows->mapFormats(true);
        caster_wish.perspective = shadows->mapFormats(false);
        caster_wish.frames_in_flight = 1;
        caster_wish.pipeline_cache = gpu.pipelineCache();
        casters.emplace(gpu.view(), caster_wish);
        draws.fillCasters(*casters);
        shadows->setCascadePass(options.shadow.cascades.pass);
        casters->setCascadePass(options.shadow.cascades.pass);
    }
}

Renderer::Impl::~Impl()
{
    vkDeviceWaitIdle(gpu.view().device);
    vkDestroyDescriptorPool(gpu.view().device, pool, nullptr);
}

void Renderer::Impl::makeFrameSet()
{
    VkDevice device = gpu.view().device;
    const std::array<VkDescriptorPoolSize, 2> sizes{
        {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1}, {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 10}}};
    VkDescriptorPoolCreateInfo pool_info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    pool_info.maxSets = 1;
    pool_info.poolSizeCount = sizes.size();
    pool_info.pPoolSizes = sizes.data();
    check(vkCreateDescriptorPool(device, &pool_info, nullptr, &pool), "making a descriptor pool");
    VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    info.descriptorPool = pool;
    info.descriptorSetCount = 1;
    info.pSetLayouts = &pipelines.frame_layout;
    check(vkAllocateDescriptorSets(device, &info, &frame_set), "making a descriptor set");
    memory.names().name(VK_OBJECT_TYPE_DESCRIPTOR_POOL, pool, "frame");
    memory.names().name(VK_OBJECT_TYPE_DESCRIPTOR_SET, frame_set, "frame");

    VkSampler nearest = textures.nearestSampler();
    const VkDescriptorBufferInfo buffer{frame_buffer.handle, 0, sizeof(FrameData)};
    const VkDescriptorImageInfo cookies = textures.cookies();
    const VkImageView toned = targets.toned.view != VK_NULL_HANDLE ? targets.toned.view : targets.light.view;
    const VkImageView glow = bloom ? bloom->result().view : targets.light.view; // not read then
    const std::array<VkDescriptorImageInfo, 10> images{
        {{nearest, targets.depth.view, kDepthRead.layout},
         {nearest, targets.gbuffer[0].view, kSampled.layout},
         {nearest, targets.gbuffer[1].view, kSampled.layout},
         {nearest, targets.gbuffer[2].view, kSampled.layout},
         {nearest, targets.gbuffer[3].view, kSampled.layout},
         cookies, // in the mask's place until there is one: an array too, and never read then
         cookies,
         {nearest, targets.light.view, kSampled.layout},
         {textures.plainSampler(), toned, kSampled.layout},
         {textures.plainSampler(), glow, kSampled.layout}}};
    std::array<VkWriteDescriptorSet, 11> writes{};
    for (std::uint32_t i = 0; i < writes.size(); ++i) {
        writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        writes[i].dstSet = frame_set;
        writes[i].dstBinding = i;
        writes[i].descriptorCount = 1;
        writes[i].descriptorType =
            i == 0 ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER : VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
        writes[i].pBufferInfo = i == 0 ? &buffer : nullptr;
        writes[i].pImageInfo = i == 0 ? nullptr : &images[i - 1];
    }
    vkUpdateDescriptorSets(device, writes.size(), writes.data(), 0, nullptr);
}

void Renderer::Impl::bindMask(VkImageView view)
{
    if (view == mask_view) {
        return;
    }
    mask_view = view;
    const VkDescriptorImageInfo image{textures.nearestSampler(), view, kSampled.layout};
    VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    write.dstSet = frame_set;
    write.dstBinding = 6;
    write.descriptorCount = 1;
    write.descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    write.pImageInfo = &image;
    vkUpdateDescriptorSets(gpu.view().device, 1, &write, 0, nullptr);
}

Renderer::Renderer(Gpu& gpu, const scene::Scene& scene, const scene::State& state, const RenderOptions& options)
    : impl_(std::make_unique<Impl>(gpu, scene, state, options))
{
}

Renderer::~Renderer() = default;

const Plan& Renderer::plan() const
{
    Impl& self = *impl_;
    if (self.plan == nullptr) {
        return self.no_plan;
    }
    const auto fits = [](const View& view) {
        return view.gpu_cascade != kNoIndex;
    };
    if (std::none_of(self.plan->views.begin(), self.plan->views.end(), fits)) {
        return *self.plan;
    }
    if (self.fitted_frame != self.plan->frame) {
        self.fitted = *self.plan;
        self.fitted_frame = self.plan->frame;
        const std::vector<FittedView> found = self.shadows->fittedViews(0);
        for (std::size_t i = 0; i < found.size(); ++i) {
            View& view = self.fitted.views[i];
            view = fits(view) ? viewAsFitted(view, found[i]) : view;
        }
    }
    return self.fitted;
}

std::vector<vulkan::MemoryUse> Renderer::memory() const
{
    std::vector<vulkan::MemoryUse> uses = impl_->memory.uses();
    std::erase_if(uses, [](const vulkan::MemoryUse& use) { return use.bytes == 0; });
    if (impl_->shadows) {
        for (const auto& more : {impl_->shadows->memory(), impl_->casters->memory()}) {
            uses.insert(uses.end(), more.begin(), more.end());
        }
    }
    return uses;
}

vulkan::CascadePass Renderer::cascadePass() const
{
    return impl_->shadows ? impl_->shadows->cascadePass() : vulkan::CascadePass::each;
}

vulkan::FilterCost Renderer::filterCost() const
{
    return impl_->plan != nullptr ? impl_->shadows->filterCost(0) : vulkan::FilterCost{};
}

std::vector<vulkan::DepthLayer> Renderer::depthLayers(std::uint32_t view) const
{
    const bool known = impl_->plan != nullptr && view < impl_->plan->views.size();
    return known ? impl_->shadows->depthLayers(view) : std::vector<vulkan::DepthLayer>{};
}

} // namespace gnomon::host
