// SPDX-License-Identifier: Apache-2.0
#include "mask_tiles.h"

#include "check.h"

#include <array>

namespace gnomon::host {

MaskTiles::MaskTiles(SceneData& scene, std::uint32_t slots) : gpu_(scene.gpu), pipelines_(scene.pipelines)
{
    VkDevice device = gpu_.view().device;
    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, slots};
    VkDescriptorPoolCreateInfo pool_info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    pool_info.maxSets = slots;
    pool_info.poolSizeCount = 1;
    pool_info.pPoolSizes = &size;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    check(vkCreateDescriptorPool(device, &pool_info, nullptr, &pool), "making a descriptor pool");
    pool_ = {gpu_, pool};
    const std::vector<VkDescriptorSetLayout> layouts(slots, pipelines_.tiles_layout.get());
    VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    info.descriptorPool = pool;
    info.descriptorSetCount = slots;
    info.pSetLayouts = layouts.data();
    sets_.resize(slots);
    check(vkAllocateDescriptorSets(device, &info, sets_.data()), "making a descriptor set");
}

// Written every time: the buffer may be another one.
void MaskTiles::describe(std::uint32_t slot, const vulkan::BufferRef& tiles) const
{
    const VkDescriptorBufferInfo buffer{tiles.buffer, 0, VK_WHOLE_SIZE};
    VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    write.dstSet = sets_[slot];
    write.descriptorCount = 1;
    write.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    write.pBufferInfo = &buffer;
    vkUpdateDescriptorSets(gpu_.view().device, 1, &write, 0, nullptr);
}

void MaskTiles::bind(VkCommandBuffer commands, std::uint32_t slot, VkDescriptorSet frame_set) const
{
    const std::array<VkDescriptorSet, 2> sets{frame_set, sets_[slot]};
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_.compact_layout.get(), 0, 2,
                            sets.data(), 0, nullptr);
}

} // namespace gnomon::host
