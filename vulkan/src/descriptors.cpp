// SPDX-License-Identifier: Apache-2.0
#include "descriptors.h"

#include <algorithm>
#include <cassert>

namespace gnomon::vulkan {

DescriptorSets::DescriptorSets(Device& device, DescriptorTypes types, VkShaderStageFlags stages)
    : device_(&device), type_count_(types.size())
{
    assert(types.size() <= kMostBindings);
    std::copy(types.begin(), types.end(), types_.begin());
    std::array<VkDescriptorSetLayoutBinding, kMostBindings> bindings{};
    for (std::uint32_t i = 0; i < types.size(); ++i) {
        bindings[i] = {i, types[i], 1, stages, nullptr};
    }
    VkDescriptorSetLayoutCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    info.bindingCount = static_cast<std::uint32_t>(types.size());
    info.pBindings = bindings.data();
    VkDescriptorSetLayout layout = VK_NULL_HANDLE;
    check(device.vk.CreateDescriptorSetLayout(device.handle(), &info, nullptr, &layout),
          "create a descriptor set layout");
    layout_ = {device, layout};
}

void DescriptorSets::reset(std::uint32_t count)
{
    std::array<VkDescriptorPoolSize, kMostBindings> sizes{}; // a type may stand there more than once
    for (std::size_t i = 0; i < type_count_; ++i) {
        sizes[i] = {types_[i], count};
    }
    VkDescriptorPoolCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    info.maxSets = count;
    info.poolSizeCount = static_cast<std::uint32_t>(type_count_);
    info.pPoolSizes = sizes.data();
    VkDescriptorPool pool = VK_NULL_HANDLE;
    check(device_->vk.CreateDescriptorPool(device_->handle(), &info, nullptr, &pool), "create a descriptor pool");
    DescriptorPool fresh(*device_, pool);
    device_->retire(std::move(pool_));
    pool_ = std::move(fresh);
}

VkDescriptorSet DescriptorSets::take(const char* name)
{
    const VkDescriptorSetLayout layout = layout_.get();
    const VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO, nullptr, pool_.get(), 1,
                                           &layout};
    VkDescriptorSet set = VK_NULL_HANDLE;
    check(device_->vk.AllocateDescriptorSets(device_->handle(), &info, &set), "allocate a descriptor set");
    device_->name(VK_OBJECT_TYPE_DESCRIPTOR_SET, handleBits(set), name);
    return set;
}

void DescriptorSets::write(VkDescriptorSet set, std::span<const Write> writes) const
{
    assert(writes.size() <= kMostBindings);
    std::array<VkWriteDescriptorSet, kMostBindings> updates{};
    for (std::size_t i = 0; i < writes.size(); ++i) {
        assert(writes[i].binding < type_count_);
        updates[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        updates[i].dstSet = set;
        updates[i].dstBinding = writes[i].binding;
        updates[i].descriptorCount = 1;
        updates[i].descriptorType = types_[writes[i].binding];
        updates[i].pImageInfo = &writes[i].image; // only the one for the type is read
        updates[i].pBufferInfo = &writes[i].buffer;
    }
    device_->vk.UpdateDescriptorSets(device_->handle(), static_cast<std::uint32_t>(writes.size()), updates.data(), 0,
                                     nullptr);
}

PipelineLayout makePipelineLayout(Device& device, VkDescriptorSetLayout set, VkShaderStageFlags stages,
                                  std::uint32_t push_bytes)
{
    const VkPushConstantRange push{stages, 0, push_bytes};
    const VkPipelineLayoutCreateInfo info{
        VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO, nullptr, 0, 1, &set, push_bytes > 0 ? 1U : 0U, &push};
    VkPipelineLayout layout = VK_NULL_HANDLE;
    check(device.vk.CreatePipelineLayout(device.handle(), &info, nullptr, &layout), "create a pipeline layout");
    return {device, layout};
}

} // namespace gnomon::vulkan
