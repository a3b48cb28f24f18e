// SPDX-License-Identifier: Apache-2.0
#include "layer_relaxation.h"

#include <gnomon_spirv.h>

#include <array>

namespace gnomon::vulkan {
namespace {

constexpr VkDeviceSize kHistogramBytes = shared::kDepthBins * sizeof(std::uint32_t);
constexpr std::uint32_t kGroupSide = 32; // texels of a group along x and y: depth_histogram.glsl

constexpr std::array kTypes{VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                            VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};

std::uint32_t groupsFor(std::int32_t texels, std::int32_t step)
{
    const std::uint32_t sampled =
        (static_cast<std::uint32_t>(texels) + static_cast<std::uint32_t>(step) - 1) / static_cast<std::uint32_t>(step);
    return (sampled + kGroupSide - 1) / kGroupSide;
}

} // namespace

LayerRelaxation::LayerRelaxation(Device& device, const FilterOptions& filter, VkPipelineCache cache) : device_(device)
{
    makeHistogram();
    makeLayouts();
    makePool();
    count_ = makePipeline(filter.moments.samples > 1 ? spirv::depth_layers_histogram_samples_comp
                                                     : spirv::depth_layers_histogram_comp,
                          count_layout_.get(), cache);
    place_ = makePipeline(spirv::depth_layers_place_comp, place_layout_.get(), cache);
}

void LayerRelaxation::makeHistogram()
{
    constexpr const char* kPurpose = "histogram of depths";
    VkBufferCreateInfo create{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    create.size = kHistogramBytes;
    create.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    VkBuffer buffer = VK_NULL_HANDLE;
    check(device_.vk.CreateBuffer(device_.handle(), &create, nullptr, &buffer), "create a buffer");
    histogram_ = {device_, buffer};
    device_.name(VK_OBJECT_TYPE_BUFFER, handleBits(buffer), kPurpose);
    VkMemoryRequirements needs{};
    device_.vk.GetBufferMemoryRequirements(device_.handle(), buffer, &needs);
    histogram_memory_ = Memory(device_, needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, kPurpose);
    const MemoryBlock& block = histogram_memory_.block();
    check(device_.vk.BindBufferMemory(device_.handle(), buffer, block.memory, block.offset), "bind buffer memory");
}

void LayerRelaxation::makeLayouts()
{
    std::array<VkDescriptorSetLayoutBinding, kTypes.size()> bindings{};
    for (std::uint32_t i = 0; i < bindings.size(); ++i) {
        bindings[i].binding = i;
        bindings[i].descriptorType = kTypes[i];
        bindings[i].descriptorCount = 1;
        bindings[i].stageFlags = VK_SHADER_STAGE_COMPUTE_BIT;
    }
    const VkDescriptorSetLayoutCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO, nullptr, 0,
                                               bindings.size(), bindings.data()};
    VkDescriptorSetLayout layout = VK_NULL_HANDLE;
    check(device_.vk.CreateDescriptorSetLayout(device_.handle(), &info, nullptr, &layout),
          "create a descriptor set layout");
    set_layout_ = {device_, layout};
    count_layout_ = makeLayout(sizeof(shared::GpuHistogramPush));
    place_layout_ = makeLayout(sizeof(shared::GpuPlacePush));
}

PipelineLayout LayerRelaxation::makeLayout(std::uint32_t push_bytes)
{
    const VkDescriptorSetLayout set_layout = set_layout_.get();
    const VkPushConstantRange push{VK_SHADER_STAGE_COMPUTE_BIT, 0, push_bytes};
    const VkPipelineLayoutCreateInfo info{
        VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO, nullptr, 0, 1, &set_layout, 1, &push};
    VkPipelineLayout layout = VK_NULL_HANDLE;
    check(device_.vk.CreatePipelineLayout(device_.handle(), &info, nullptr, &layout), "create a pipeline layout");
    return {device_, layout};
}

Pipeline LayerRelaxation::makePipeline(std::span<const std::uint32_t> spirv, VkPipelineLayout layout,
                                       VkPipelineCache cache)
{
    const ShaderModule module = makeShader(device_, spirv);
    VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = module.get();
    info.stage.pName = "main";
    info.layout = layout;
    VkPipeline pipeline = VK_NULL_HANDLE;
    check(device_.vk.CreateComputePipelines(device_.handle(), cache, 1, &info, nullptr, &pipeline),
          "create the pipeline that places layers of depth");
    return {device_, pipeline};
}

void LayerRelaxation::makePool()
{
    const std::array<VkDescriptorPoolSize, 2> sizes{
        {{VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, 1}, {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 2}}};
    VkDescriptorPoolCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    info.maxSets = 1;
    info.poolSizeCount = sizes.size();
    info.pPoolSizes = sizes.data();
    VkDescriptorPool pool = VK_NULL_HANDLE;
    check(device_.vk.CreateDescriptorPool(device_.handle(), &info, nullptr, &pool), "create a descriptor pool");
    pool_ = {device_, pool};
    const VkDescriptorSetLayout layout = set_layout_.get();
    const VkDescriptorSetAllocateInfo wish{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO, nullptr, pool, 1, &layout};
    check(device_.vk.AllocateDescriptorSets(device_.handle(), &wish, &set_), "allocate a descriptor set");
    device_.name(VK_OBJECT_TYPE_DESCRIPTOR_SET, handleBits(set_), "depth layers");
}

void LayerRelaxation::forget()
{
    depth_ = VK_NULL_HANDLE;
    layers_ = VK_NULL_HANDLE;
}

void LayerRelaxation::updateSet(const Job& job)
{
    if (depth_ == job.depth && layers_ == job.layers) {
        return;
    }
    const VkDescriptorImageInfo image{VK_NULL_HANDLE, job.depth, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    const std::array<VkDescriptorBufferInfo, 2> buffers{
        {{histogram_.get(), 0, VK_WHOLE_SIZE}, {job.layers, 0, VK_WHOLE_SIZE}}};
    std::array<VkWriteDescriptorSet, kTypes.size()> writes{};
    for (std::uint32_t i = 0; i < writes.size(); ++i) {
        writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        writes[i].dstSet = set_;
        writes[i].dstBinding = i;
        writes[i].descriptorCount = 1;
        writes[i].descriptorType = kTypes[i];
        writes[i].pImageInfo = i == 0 ? &image : nullptr;
        writes[i].pBufferInfo = i == 0 ? nullptr : &buffers[i - 1];
    }
    device_.vk.UpdateDescriptorSets(device_.handle(), writes.size(), writes.data(), 0, nullptr);
    depth_ = job.depth;
    layers_ = job.layers;
}

void LayerRelaxation::record(VkCommandBuffer commands, const Job& job)
{
    constexpr VkPipelineStageFlags2 kCompute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    constexpr VkPipelineStageFlags2 kClear = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
    constexpr VkAccessFlags2 kRead = VK_ACCESS_2_SHADER_STORAGE_READ_BIT;
    constexpr VkAccessFlags2 kReadWrite = kRead | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
    const auto wait = [&](const MemoryBarrier& barrier) {
        recordBarrier(device_, commands, barrier);
    };
    updateSet(job);
    // The view before is done with the histogram, and the last frame with this view's layers.
    wait({kCompute | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT, kClear | kCompute,
          VK_ACCESS_2_TRANSFER_WRITE_BIT | kReadWrite});
    device_.vk.CmdFillBuffer(commands, histogram_.get(), 0, kHistogramBytes, 0);
    wait({kClear, VK_ACCESS_2_TRANSFER_WRITE_BIT, kCompute, kReadWrite});

    device_.vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, count_.get());
    device_.vk.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, count_layout_.get(), 0, 1, &set_, 0,
                                     nullptr);
    device_.vk.CmdPushConstants(commands, count_layout_.get(), VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof job.histogram,
                                &job.histogram);
    device_.vk.CmdDispatch(commands, groupsFor(job.histogram.tile.z, job.histogram.more.x),
                           groupsFor(job.histogram.tile.w, job.histogram.more.x), 1);
    wait({kCompute, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT, kCompute, kRead});

    device_.vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, place_.get());
    device_.vk.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, place_layout_.get(), 0, 1, &set_, 0,
                                     nullptr);
    device_.vk.CmdPushConstants(commands, place_layout_.get(), VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof job.place,
                                &job.place);
    device_.vk.CmdDispatch(commands, 1, 1, 1);
    wait({kCompute, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
          kCompute | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_2_HOST_BIT,
          kRead | VK_ACCESS_2_HOST_READ_BIT});
}

} // namespace gnomon::vulkan
