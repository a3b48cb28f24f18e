// SPDX-License-Identifier: Apache-2.0
// The Vulkan functions that the backend calls. One line here is all that a further one needs.
#pragma once

#include <gnomon/vulkan/device_view.h>

// clang-format off
#define GNOMON_INSTANCE_FUNCTIONS(X) \
    X(GetDeviceProcAddr) X(GetPhysicalDeviceProperties) X(GetPhysicalDeviceMemoryProperties) \
    X(GetPhysicalDeviceFormatProperties) X(GetPhysicalDeviceFeatures2)

#define GNOMON_DEVICE_FUNCTIONS(X) \
    X(AllocateMemory) X(FreeMemory) X(MapMemory) X(BindImageMemory) X(BindBufferMemory) \
    X(CreateImage) X(DestroyImage) X(GetImageMemoryRequirements2) X(CreateImageView) X(DestroyImageView) \
    X(CreateBuffer) X(DestroyBuffer) X(GetBufferMemoryRequirements2) X(CreateSampler) X(DestroySampler) \
    X(CreateShaderModule) X(DestroyShaderModule) X(CreatePipelineLayout) X(DestroyPipelineLayout) \
    X(CreateGraphicsPipelines) X(CreateComputePipelines) X(DestroyPipeline) X(CreateDescriptorSetLayout) X(DestroyDescriptorSetLayout) \
    X(CreateDescriptorPool) X(DestroyDescriptorPool) X(AllocateDescriptorSets) X(UpdateDescriptorSets) \
    X(CreateQueryPool) X(DestroyQueryPool) X(GetQueryPoolResults) X(ResetQueryPool) \
    X(CmdPipelineBarrier2) X(CmdBeginRendering) X(CmdEndRendering) X(CmdBindPipeline) X(CmdBindDescriptorSets) \
    X(CmdBindVertexBuffers) X(CmdBindIndexBuffer) X(CmdPushConstants) X(CmdSetViewport) X(CmdSetScissor) X(CmdSetBlendConstants) X(CmdSetDepthBounds) X(CmdClearAttachments) \
    X(CmdDispatch) X(CmdFillBuffer) X(CmdUpdateBuffer) X(CmdClearColorImage) X(CmdCopyImage) X(CmdCopyBuffer) X(CmdDraw) X(CmdDrawIndexed) X(CmdDrawIndexedIndirect) X(CmdBeginQuery) X(CmdEndQuery) X(CmdWriteTimestamp2)

#define GNOMON_DEBUG_FUNCTIONS(X) \
    X(SetDebugUtilsObjectNameEXT) X(CmdBeginDebugUtilsLabelEXT) X(CmdEndDebugUtilsLabelEXT)
// clang-format on

namespace gnomon::vulkan {

struct Functions {
#define GNOMON_MEMBER(name) PFN_vk##name name = nullptr;
    GNOMON_INSTANCE_FUNCTIONS(GNOMON_MEMBER)
    GNOMON_DEVICE_FUNCTIONS(GNOMON_MEMBER)
    GNOMON_DEBUG_FUNCTIONS(GNOMON_MEMBER) // null unless DeviceView::debug_labels
#undef GNOMON_MEMBER
};

/// Throws Error naming the first function that the view does not have.
[[nodiscard]] Functions loadFunctions(const DeviceView& view);

} // namespace gnomon::vulkan
