// SPDX-License-Identifier: Apache-2.0
#include "forward_shadows.h"

#include "host/view.h"

#include <gnomon/pack/shading_buffers.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <span>

namespace gnomon::host {
namespace {

constexpr const char* kPurpose = "host forward shadows";

constexpr VkDeviceSize kFewBytes = shared::kFewViews * sizeof(shared::GpuView);

} // namespace

ForwardShadows::ForwardShadows(SceneData& scene, const ResolvedOptions& options, std::uint32_t slots)
    : gpu_(scene.gpu), pipelines_(scene.pipelines), memory_(scene.gpu),
      of_blended_(scene.pipelines.blended.whole != VK_NULL_HANDLE ? scene.pipelines.shadowedFor(options)
                                                                  : SurfacePipelines{}),
      map_sampler_(scene.textures.mipSampler(options.filterable())), texel_sampler_(scene.textures.mipSampler(false)),
      slots_(slots)
{
    for (Slot& slot : slots_) {
        slot.constants =
            memory_.buffer(kPurpose, sizeof(shared::GpuConstants), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, Place::host);
        slot.lights = memory_.buffer(kPurpose, kMaxLights * sizeof(shared::GpuLight),
                                     VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, Place::host);
    }
    makeSets();
}

void ForwardShadows::makeSets()
{
    const auto count = static_cast<std::uint32_t>(slots_.size());
    std::array<VkDescriptorPoolSize, kMapsBindings.size()> sizes{};
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        sizes[i] = {kMapsBindings[i], count};
    }
    VkDescriptorPoolCreateInfo pool_info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    pool_info.maxSets = count;
    pool_info.poolSizeCount = sizes.size();
    pool_info.pPoolSizes = sizes.data();
    VkDevice device = gpu_.view().device;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    check(vkCreateDescriptorPool(device, &pool_info, nullptr, &pool), "making a descriptor pool");
    pool_ = {gpu_, pool};
    memory_.names().name(VK_OBJECT_TYPE_DESCRIPTOR_POOL, pool, "maps");
    VkDescriptorSetLayout layout = pipelines_.maps_layout.get();
    VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    info.descriptorPool = pool;
    info.descriptorSetCount = 1;
    info.pSetLayouts = &layout;
    for (Slot& slot : slots_) {
        check(vkAllocateDescriptorSets(device, &info, &slot.set), "making a descriptor set");
        memory_.names().name(VK_OBJECT_TYPE_DESCRIPTOR_SET, slot.set, "maps");
    }
}

void ForwardShadows::describe(std::uint32_t slot, const Plan& plan, const vulkan::ShadowRenderer& renderer)
{
    // A renderer has one RenderOptions::shadow for all lights, so its plans have one of Plan::options, and one set of
    // maps serves every light.
    assert(plan.options->size() == 1);
    Slot& now = slots_[slot];
    const std::size_t views = plan.views.size();
    const std::size_t room = std::max<std::size_t>(views, shared::kFewViews);
    memory_.grow(now.views, room * sizeof(shared::GpuView),
                 VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, kPurpose);
    const vulkan::ImageRef maps = renderer.maps();
    const pack::MapImage image{{maps.extent.width, maps.extent.height}, maps.levels};
    // forward.frag has an orthographic camera's points from gl_FragCoord.z, as a depth buffer would have them.
    const pack::DrawPrecision precision{.sub_pixel_bits = memory_.limits().subPixelPrecisionBits,
                                        .receivers_from_depth = isOrthographic(plan.made_for.camera),
                                        .depth_rounding = 0.0F};
    pack::fillConstants(plan, 0, plan.made_for.size_px, image, precision,
                        *static_cast<shared::GpuConstants*>(now.constants.mapped));
    pack::fillLights(plan, {static_cast<shared::GpuLight*>(now.lights.mapped), kMaxLights});
    const std::size_t objects = std::max<std::size_t>(pack::objectVectorCount(plan), 1);
    memory_.grow(now.objects, objects * sizeof(glm::vec4), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, kPurpose);
    pack::fillObjects(plan, {static_cast<glm::vec4*>(now.objects.mapped), objects});
    const std::span into(static_cast<shared::GpuView*>(now.views.mapped), room);
    pack::fillViews(plan, {&image, 1}, into);
    renderer.placeTints(plan, into);
    writeSet(now, renderer);
}

// Written every time: images may be others, and one may have the handle of one that is gone.
void ForwardShadows::writeSet(const Slot& slot, const vulkan::ShadowRenderer& renderer) const
{
    const vulkan::ImageRef maps = renderer.maps();
    // Most filters have no blocks, and most frames no tints [drivers: unwritten].
    const auto orMaps = [&maps](const vulkan::ImageRef& image) {
        return image.view != VK_NULL_HANDLE ? image : maps;
    };
    const vulkan::ImageRef blocks = orMaps(renderer.blocks());
    const vulkan::ImageRef tints = orMaps(renderer.tints());
    const std::array<VkDescriptorImageInfo, 3> images{{{map_sampler_, maps.view, maps.layout},
                                                       {texel_sampler_, blocks.view, blocks.layout},
                                                       {texel_sampler_, tints.view, tints.layout}}};
    const std::array<VkDescriptorBufferInfo, 6> buffers{{{slot.constants.handle, 0, VK_WHOLE_SIZE},
                                                         {slot.lights.handle, 0, VK_WHOLE_SIZE},
                                                         {slot.views.handle, 0, VK_WHOLE_SIZE},
                                                         {renderer.depthLayersBuffer().buffer, 0, VK_WHOLE_SIZE},
                                                         {slot.objects.handle, 0, VK_WHOLE_SIZE},
                                                         {slot.views.handle, 0, kFewBytes}}};
    std::array<VkWriteDescriptorSet, kMapsBindings.size()> writes{};
    std::size_t image = 0;
    std::size_t buffer = 0;
    for (std::uint32_t i = 0; i < writes.size(); ++i) {
        const bool is_image = kMapsBindings[i] == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
        writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        writes[i].dstSet = slot.set;
        writes[i].dstBinding = i;
        writes[i].descriptorCount = 1;
        writes[i].descriptorType = kMapsBindings[i];
        writes[i].pImageInfo = is_image ? &images[image++] : nullptr;
        writes[i].pBufferInfo = is_image ? nullptr : &buffers[buffer++];
    }
    vkUpdateDescriptorSets(gpu_.view().device, writes.size(), writes.data(), 0, nullptr);
}

void ForwardShadows::recordViews(VkCommandBuffer commands, std::uint32_t slot, const Plan& plan,
                                 vulkan::ShadowRenderer& renderer) const
{
    renderer.recordViews(commands, slot, plan, slots_[slot].views.handle);
}

void ForwardShadows::bind(VkCommandBuffer commands, std::uint32_t slot) const
{
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_.shadowed_layout.get(), 2, 1,
                            &slots_[slot].set, 0, nullptr);
}

} // namespace gnomon::host
