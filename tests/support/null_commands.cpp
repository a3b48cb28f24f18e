// SPDX-License-Identifier: Apache-2.0
// The null driver's functions that record commands.
#include "null_state.h"

#include <cstring>

namespace gnomon::test {
namespace {

using Kind = NullEvent::Kind;

VKAPI_ATTR void VKAPI_CALL cmdBarrier(VkCommandBuffer commands, const VkDependencyInfo* info)
{
    NullDriver::Impl& driver = driverOf(commands);
    for (const auto& barrier : std::span(info->pImageMemoryBarriers, info->imageMemoryBarrierCount)) {
        driver.use(objectOf(barrier.image));
        driver.log({.layer = barrier.subresourceRange.baseArrayLayer,
                    .old_layout = barrier.oldLayout,
                    .new_layout = barrier.newLayout});
    }
    for (const auto& barrier : std::span(info->pMemoryBarriers, info->memoryBarrierCount)) {
        driver.log({.kind = Kind::memory_barrier,
                    .target_stages = barrier.dstStageMask,
                    .target_access = barrier.dstAccessMask});
    }
}

VKAPI_ATTR void VKAPI_CALL cmdBegin(VkCommandBuffer commands, const VkRenderingInfo* info)
{
    NullDriver::Impl& driver = driverOf(commands);
    for (const auto& colour : std::span(info->pColorAttachments, info->colorAttachmentCount)) {
        driver.use(objectOf(colour.imageView));
    }
    if (info->pDepthAttachment != nullptr) {
        driver.use(objectOf(info->pDepthAttachment->imageView));
    }
    NullEvent event;
    event.kind = Kind::begin_rendering;
    event.area = info->renderArea;
    event.count = info->layerCount;
    driver.log(event);
}

template <Kind kKind, class... Rest>
VKAPI_ATTR void VKAPI_CALL cmdLogged(VkCommandBuffer commands, Rest...)
{
    NullEvent event;
    event.kind = kKind;
    driverOf(commands).log(event);
}

template <class... Rest>
VKAPI_ATTR void VKAPI_CALL cmdIgnored(VkCommandBuffer, Rest...)
{
}

VKAPI_ATTR void VKAPI_CALL cmdBindPipeline(VkCommandBuffer commands, VkPipelineBindPoint, VkPipeline pipeline)
{
    driverOf(commands).use(objectOf(pipeline));
    cmdLogged<Kind::bind_pipeline>(commands);
}

VKAPI_ATTR void VKAPI_CALL cmdBindSets(VkCommandBuffer commands, VkPipelineBindPoint, VkPipelineLayout, std::uint32_t,
                                       std::uint32_t count, const VkDescriptorSet* sets, std::uint32_t,
                                       const std::uint32_t*)
{
    for (const VkDescriptorSet set : std::span(sets, count)) {
        driverOf(commands).use(objectOf(set));
    }
}

VKAPI_ATTR void VKAPI_CALL cmdBindVertices(VkCommandBuffer commands, std::uint32_t, std::uint32_t count,
                                           const VkBuffer* buffers, const VkDeviceSize*)
{
    for (const VkBuffer buffer : std::span(buffers, count)) {
        driverOf(commands).use(objectOf(buffer));
    }
}

VKAPI_ATTR void VKAPI_CALL cmdBindIndices(VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize, VkIndexType)
{
    driverOf(commands).use(objectOf(buffer));
}

VKAPI_ATTR void VKAPI_CALL cmdFill(VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize, VkDeviceSize, std::uint32_t)
{
    driverOf(commands).use(objectOf(buffer));
}

VKAPI_ATTR void VKAPI_CALL cmdUpdate(VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize, VkDeviceSize, const void*)
{
    driverOf(commands).use(objectOf(buffer));
}

VKAPI_ATTR void VKAPI_CALL cmdClear(VkCommandBuffer commands, VkImage image, VkImageLayout, const VkClearColorValue*,
                                    std::uint32_t, const VkImageSubresourceRange*)
{
    driverOf(commands).use(objectOf(image));
}

VKAPI_ATTR void VKAPI_CALL cmdCopyImage(VkCommandBuffer commands, VkImage from, VkImageLayout, VkImage to,
                                        VkImageLayout, std::uint32_t, const VkImageCopy*)
{
    driverOf(commands).use(objectOf(from));
    driverOf(commands).use(objectOf(to));
    cmdLogged<Kind::copy_image>(commands);
}

VKAPI_ATTR void VKAPI_CALL cmdCopyBuffer(VkCommandBuffer commands, VkBuffer from, VkBuffer to, std::uint32_t,
                                         const VkBufferCopy*)
{
    driverOf(commands).use(objectOf(from));
    driverOf(commands).use(objectOf(to));
    cmdLogged<Kind::copy_buffer>(commands);
}

VKAPI_ATTR void VKAPI_CALL cmdDraw(VkCommandBuffer commands, std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t)
{
    ++driverOf(commands).counts.draws;
    cmdLogged<Kind::draw>(commands);
}

VKAPI_ATTR void VKAPI_CALL cmdDispatch(VkCommandBuffer commands, std::uint32_t x, std::uint32_t y, std::uint32_t z)
{
    ++driverOf(commands).counts.dispatches;
    NullEvent event;
    event.kind = Kind::dispatch;
    event.count = x * y * z;
    driverOf(commands).log(event);
}

VKAPI_ATTR void VKAPI_CALL cmdDrawIndexed(VkCommandBuffer commands, std::uint32_t indices, std::uint32_t instances,
                                          std::uint32_t, std::int32_t, std::uint32_t)
{
    NullDriver::Impl& driver = driverOf(commands);
    driver.counts.instances += instances;
    driver.counts.indices += std::uint64_t{instances} * indices;
    cmdLogged<Kind::draw>(commands);
}

// Reads the commands, as a GPU would.
VKAPI_ATTR void VKAPI_CALL cmdDrawIndirect(VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize offset,
                                           std::uint32_t count, std::uint32_t stride)
{
    NullDriver::Impl& driver = driverOf(commands);
    NullObject& source = *objectOf(buffer);
    driver.use(&source);
    for (std::uint32_t i = 0; i < count; ++i) {
        VkDrawIndexedIndirectCommand command{};
        std::memcpy(&command,
                    static_cast<const char*>(source.memory->mapped) + source.offset + offset + std::size_t{i} * stride,
                    sizeof command);
        driver.lackIf(command.firstInstance != 0 && driver.limits.lacks.drawIndirectFirstInstance != VK_FALSE);
        driver.counts.instances += command.instanceCount;
        driver.counts.indices += std::uint64_t{command.instanceCount} * command.indexCount;
    }
    driver.lackIf(count > 1 && driver.limits.lacks.multiDrawIndirect != VK_FALSE);
    driver.counts.indirect_draws += count;
    NullEvent event;
    event.kind = Kind::draw_indirect;
    event.count = count;
    driver.log(event);
}

const NullEntry kEntries[] = {
    GNOMON_NULL(CmdPipelineBarrier2, cmdBarrier),
    GNOMON_NULL(CmdBeginRendering, cmdBegin),
    GNOMON_NULL(CmdEndRendering, cmdLogged<Kind::end_rendering>),
    GNOMON_NULL(CmdBindPipeline, cmdBindPipeline),
    GNOMON_NULL(CmdBindDescriptorSets, cmdBindSets),
    GNOMON_NULL(CmdBindVertexBuffers, cmdBindVertices),
    GNOMON_NULL(CmdBindIndexBuffer, cmdBindIndices),
    GNOMON_NULL(CmdPushConstants, cmdIgnored),
    GNOMON_NULL(CmdSetViewport, cmdIgnored),
    GNOMON_NULL(CmdSetScissor, cmdIgnored),
    GNOMON_NULL(CmdSetBlendConstants, cmdIgnored),
    GNOMON_NULL(CmdSetDepthBounds, cmdIgnored),
    GNOMON_NULL(CmdClearAttachments, cmdIgnored),
    GNOMON_NULL(CmdDispatch, cmdDispatch),
    GNOMON_NULL(CmdFillBuffer, cmdFill),
    GNOMON_NULL(CmdUpdateBuffer, cmdUpdate),
    GNOMON_NULL(CmdClearColorImage, cmdClear),
    GNOMON_NULL(CmdCopyImage, cmdCopyImage),
    GNOMON_NULL(CmdCopyBuffer, cmdCopyBuffer),
    GNOMON_NULL(CmdDraw, cmdDraw),
    GNOMON_NULL(CmdDrawIndexed, cmdDrawIndexed),
    GNOMON_NULL(CmdDrawIndexedIndirect, cmdDrawIndirect),
    GNOMON_NULL(CmdBeginQuery, cmdLogged<Kind::begin_query>),
    GNOMON_NULL(CmdEndQuery, cmdLogged<Kind::end_query>),
    GNOMON_NULL(CmdWriteTimestamp2, cmdLogged<Kind::timestamp>),
};

} // namespace

std::span<const NullEntry> nullCommandEntries()
{
    return kEntries;
}

} // namespace gnomon::test
