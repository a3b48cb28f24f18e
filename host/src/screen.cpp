// SPDX-License-Identifier: Apache-2.0
#include "screen.h"

#include "frame_data.h"

#include <gnomon/error.h>

#include <algorithm>
#include <array>
#include <string>

namespace gnomon::host {
namespace {

constexpr std::uint32_t kSurfacesBinding = 2;
constexpr std::uint32_t kMaskBinding = 3;
constexpr std::uint32_t kNormalsBinding = 9;
constexpr std::uint32_t kSearchedBinding = 10;
constexpr std::uint32_t kOcclusionBinding = 11;

ToneFacts toneFacts(const RenderOptions& options)
{
    ToneFacts facts;
    facts.curve = options.tone;
    facts.dither = options.dither;
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

void checkOcclusion(const AmbientOcclusionOptions& occlusion)
{
    constexpr float kFarthest_m = 1e6F;
    if (!(occlusion.radius_m >= 0.0F && occlusion.radius_m <= kFarthest_m)) {
        throw Error("making a picture with ambient occlusion",
                    "its radius is " + std::to_string(occlusion.radius_m) + " m",
                    "choose one up to 1000000 m, or 0 to have it found");
    }
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
    if (options.ambient_occlusion.on) {
        checkOcclusion(options.ambient_occlusion);
    }
    return options;
}

} // namespace

VkExtent2D drawnExtent(const RenderOptions& options)
{
    const std::uint32_t scale = options.anti_aliasing == AntiAliasing::ssaa4 ? 2 : 1;
    return {options.width * scale, options.height * scale};
}

Screen::Screen(SceneData& scene, const RenderOptions& options, std::span<const Buffer> frame_data,
               const VkDescriptorImageInfo& sky_tables)
    : scene_(scene), memory_(scene.gpu),
      targets(memory_, drawnExtent(checked(scene.gpu, options)), {options.width, options.height},
              options.anti_aliasing == AntiAliasing::fxaa)
{
    const ToneFacts tone_facts = toneFacts(options);
    if (tone_facts.bloom > 0.0F) {
        bloom.emplace(scene.gpu, memory_, options.bloom, targets.light, targets.shown, tone_facts.average_four,
                      scene.textures.plainSampler());
    }
    tone = scene.pipelines.toneFor(tone_facts);
    fxaa = options.anti_aliasing == AntiAliasing::fxaa ? scene.pipelines.fxaa() : VK_NULL_HANDLE;
    makeSets(frame_data, sky_tables);
}

void Screen::makeSets(std::span<const Buffer> frame_data, const VkDescriptorImageInfo& sky_tables)
{
    VkDevice device = scene_.gpu.view().device;
    const auto count = static_cast<std::uint32_t>(frame_data.size());
    const std::array<VkDescriptorPoolSize, 2> sizes{
        {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, count},
         {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, (kFrameBindings - 1) * count}}};
    VkDescriptorPoolCreateInfo pool_info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    pool_info.maxSets = count;
    pool_info.poolSizeCount = sizes.size();
    pool_info.pPoolSizes = sizes.data();
    VkDescriptorPool pool = VK_NULL_HANDLE;
    check(vkCreateDescriptorPool(device, &pool_info, nullptr, &pool), "making a descriptor pool");
    pool_ = {scene_.gpu, pool};
    memory_.names().name(VK_OBJECT_TYPE_DESCRIPTOR_POOL, pool, "frame");
    const std::vector<VkDescriptorSetLayout> layouts(count, scene_.pipelines.frame_layout.get());
    VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    info.descriptorPool = pool;
    info.descriptorSetCount = count;
    info.pSetLayouts = layouts.data();
    sets_.resize(count);
    check(vkAllocateDescriptorSets(device, &info, sets_.data()), "making a descriptor set");

    VkSampler nearest = scene_.textures.nearestSampler();
    const VkDescriptorImageInfo cookies = scene_.textures.cookies();
    const VkImageView toned = targets.toned.view != VK_NULL_HANDLE ? targets.toned.view : targets.light.view;
    const VkImageView glow = bloom ? bloom->result().view : targets.light.view; // not read then
    const std::array<VkDescriptorImageInfo, kFrameBindings - 1> images{
        {{nearest, targets.depth.view, kDepthRead.layout},
         cookies, // in the place of surfaces
         cookies, // in the mask's place
         cookies,
         {nearest, targets.light.view, kSampled.layout},
         {scene_.textures.plainSampler(), toned, kSampled.layout},
         {scene_.textures.plainSampler(), glow, kSampled.layout},
         sky_tables,
         cookies, // in the place of normals and occlusion
         cookies,
         cookies}};
    for (std::uint32_t slot = 0; slot < count; ++slot) {
        memory_.names().name(VK_OBJECT_TYPE_DESCRIPTOR_SET, sets_[slot], "frame");
        const VkDescriptorBufferInfo buffer{frame_data[slot].handle, 0, sizeof(FrameData)};
        std::array<VkWriteDescriptorSet, kFrameBindings> writes{};
        for (std::uint32_t i = 0; i < writes.size(); ++i) {
            writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
            writes[i].dstSet = sets_[slot];
            writes[i].dstBinding = i;
            writes[i].descriptorCount = 1;
            writes[i].descriptorType =
                i == 0 ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER : VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
            writes[i].pBufferInfo = i == 0 ? &buffer : nullptr;
            writes[i].pImageInfo = i == 0 ? nullptr : &images[i - 1];
        }
        vkUpdateDescriptorSets(device, writes.size(), writes.data(), 0, nullptr);
    }
}

void Screen::needOcclusion()
{
    if (!occlusion) {
        occlusion.emplace(memory_, scene_.pipelines, targets.drawn);
    }
}

VkDescriptorSet Screen::frameSet(std::uint32_t slot, VkImageView mask) const
{
    // Written every time: a view may have the handle of one that is gone.
    VkDescriptorImageInfo image = scene_.textures.cookies(); // an array that is always there, and not read then
    if (mask != VK_NULL_HANDLE) {
        image = {scene_.textures.nearestSampler(), mask, kSampled.layout};
    }
    VkSampler nearest = scene_.textures.nearestSampler();
    const VkDescriptorImageInfo surfaces{nearest, targets.surfaces().view, kSampled.layout};
    const VkDescriptorImageInfo normals{nearest, targets.normals().view, kSampled.layout};
    // Where it is not wanted, whole numbers that are not read.
    const auto occluded = [&](Image Occlusion::*which) {
        return occlusion ? VkDescriptorImageInfo{nearest, ((*occlusion).*which).view, kSampled.layout} : surfaces;
    };
    const std::array<std::pair<std::uint32_t, VkDescriptorImageInfo>, 5> images{
        {{kMaskBinding, image},
         {kSurfacesBinding, surfaces},
         {kNormalsBinding, normals},
         {kSearchedBinding, occluded(&Occlusion::searched)},
         {kOcclusionBinding, occluded(&Occlusion::smooth)}}};
    std::array<VkWriteDescriptorSet, images.size()> writes{};
    for (std::size_t i = 0; i < writes.size(); ++i) {
        writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        writes[i].dstSet = sets_[slot];
        writes[i].dstBinding = images[i].first;
        writes[i].descriptorCount = 1;
        writes[i].descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
        writes[i].pImageInfo = &images[i].second;
    }
    const bool shaded_deferred = targets.surfaces().view != VK_NULL_HANDLE;
    vkUpdateDescriptorSets(scene_.gpu.view().device, shaded_deferred ? writes.size() : 1, writes.data(), 0, nullptr);
    return sets_[slot];
}

const Image& Screen::insteadFor(std::uint32_t layers)
{
    if (instead_.handle == VK_NULL_HANDLE || instead_.layers < layers) {
        ImageWish wish;
        wish.name = "masks instead";
        wish.purpose = "host pictures";
        wish.format = VK_FORMAT_R8G8B8A8_UNORM;
        wish.extent = targets.drawn;
        wish.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
        wish.layers = layers;
        wish.array_view = true;
        instead_ = memory_.image(wish);
    }
    return instead_;
}

} // namespace gnomon::host
