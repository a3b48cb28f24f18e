// SPDX-License-Identifier: Apache-2.0
#include "commands.h"

#include "wait.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace gnomon::host {

namespace {
constexpr VkDeviceSize kStagingBytes = 8ULL << 20;
}

Commands::Commands(const Gpu& gpu, const DebugNames& names, const char* name) : gpu_(gpu)
{
    VkDevice device = gpu.view().device;
    VkCommandPoolCreateInfo pool_info{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    pool_info.queueFamilyIndex = gpu.queueFamily();
    VkCommandPool pool = VK_NULL_HANDLE;
    check(vkCreateCommandPool(device, &pool_info, nullptr, &pool), "making a command pool");
    pool_ = {gpu, pool};
    VkCommandBufferAllocateInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    info.commandPool = pool;
    info.commandBufferCount = 1;
    check(vkAllocateCommandBuffers(device, &info, &commands_), "making a command buffer");
    const VkFenceCreateInfo fence_info{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    VkFence fence = VK_NULL_HANDLE;
    check(vkCreateFence(device, &fence_info, nullptr, &fence), "making a fence");
    fence_ = {gpu, fence};
    names.name(VK_OBJECT_TYPE_COMMAND_POOL, pool, name);
    names.name(VK_OBJECT_TYPE_COMMAND_BUFFER, commands_, name);
    names.name(VK_OBJECT_TYPE_FENCE, fence, name);
}

Commands::~Commands()
{
    settle();
}

VkCommandBuffer Commands::begin()
{
    check(vkResetCommandPool(gpu_.view().device, pool_.get(), 0), "resetting a command pool");
    VkCommandBufferBeginInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vkBeginCommandBuffer(commands_, &info), "beginning a command buffer");
    return commands_;
}

void Commands::submit(std::span<const VkSemaphoreSubmitInfo> waits, std::span<const VkSemaphoreSubmitInfo> signals)
{
    check(vkEndCommandBuffer(commands_), "ending a command buffer");
    VkCommandBufferSubmitInfo buffer{VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO};
    buffer.commandBuffer = commands_;
    VkSubmitInfo2 info{VK_STRUCTURE_TYPE_SUBMIT_INFO_2};
    info.commandBufferInfoCount = 1;
    info.pCommandBufferInfos = &buffer;
    info.waitSemaphoreInfoCount = static_cast<std::uint32_t>(waits.size());
    info.pWaitSemaphoreInfos = waits.data();
    info.signalSemaphoreInfoCount = static_cast<std::uint32_t>(signals.size());
    info.pSignalSemaphoreInfos = signals.data();
    VkFence fence = fence_.get();
    check(vkResetFences(gpu_.view().device, 1, &fence), "resetting a fence");
    check(vkQueueSubmit2(gpu_.queue(), 1, &info, fence), "handing work to the GPU");
    pending_ = true;
}

void Commands::wait()
{
    if (std::exchange(pending_, false)) { // after it, whether it throws or not, nothing is left to wait for
        waitFor(gpu_, fence_.get());
    }
}

void Commands::settle() noexcept
{
    if (std::exchange(pending_, false)) {
        host::settle(gpu_, fence_.get());
    }
}

void Commands::finish()
{
    submit();
    wait();
}

void barrier(VkCommandBuffer commands, VkImage image, VkImageAspectFlags aspect, const Access& from, const Access& to,
             std::uint32_t first_mip, std::uint32_t mips)
{
    VkImageMemoryBarrier2 one{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
    one.srcStageMask = from.stages;
    one.srcAccessMask = from.access;
    one.dstStageMask = to.stages;
    one.dstAccessMask = to.access;
    one.oldLayout = from.layout;
    one.newLayout = to.layout;
    one.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    one.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    one.image = image;
    one.subresourceRange = {aspect, first_mip, mips, 0, VK_REMAINING_ARRAY_LAYERS};
    VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    info.imageMemoryBarrierCount = 1;
    info.pImageMemoryBarriers = &one;
    vkCmdPipelineBarrier2(commands, &info);
}

void memoryBarrier(VkCommandBuffer commands, const Access& from, const Access& to)
{
    VkMemoryBarrier2 one{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
    one.srcStageMask = from.stages;
    one.srcAccessMask = from.access;
    one.dstStageMask = to.stages;
    one.dstAccessMask = to.access;
    VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    info.memoryBarrierCount = 1;
    info.pMemoryBarriers = &one;
    vkCmdPipelineBarrier2(commands, &info);
}

Uploader::Uploader(const Gpu& gpu, Memory& memory)
    : memory_(memory), staging_(memory.buffer("staging", kStagingBytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, Place::host)),
      commands_(gpu, memory.names(), "upload")
{
    recording_ = commands_.begin();
}

Uploader::~Uploader()
{
    commands_.settle();
    memory_.release(staging_);
}

char* Uploader::stage(VkDeviceSize size)
{
    used_ = (used_ + 15) / 16 * 16;
    if (used_ + size > kStagingBytes) {
        flush();
    }
    used_ += size;
    return static_cast<char*>(staging_.mapped) + used_ - size;
}

void Uploader::toBuffer(const Buffer& target, VkDeviceSize offset, const void* bytes, VkDeviceSize size)
{
    for (VkDeviceSize done = 0; done < size;) {
        const VkDeviceSize part = std::min(size - done, kStagingBytes / 2);
        std::memcpy(stage(part), static_cast<const char*>(bytes) + done, part);
        const VkBufferCopy copy{used_ - part, offset + done, part};
        vkCmdCopyBuffer(recording_, staging_.handle, target.handle, 1, &copy);
        done += part;
    }
}

void Uploader::toImage(const Image& target, std::uint32_t layer, const void* texels, std::uint32_t texel_bytes)
{
    if (layer == 0) {
        barrier(recording_, target, kDiscard, kCopyTarget);
    }
    const VkDeviceSize row = VkDeviceSize{target.extent.width} * texel_bytes;
    const auto rows_at_once = static_cast<std::uint32_t>(std::max<VkDeviceSize>(kStagingBytes / 2 / row, 1));
    for (std::uint32_t y = 0; y < target.extent.height;) {
        const std::uint32_t rows = std::min(rows_at_once, target.extent.height - y);
        std::memcpy(stage(row * rows), static_cast<const char*>(texels) + row * y, row * rows);
        VkBufferImageCopy copy{};
        copy.bufferOffset = used_ - row * rows;
        copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, layer, 1};
        copy.imageOffset = {0, static_cast<std::int32_t>(y), 0};
        copy.imageExtent = {target.extent.width, rows, 1};
        vkCmdCopyBufferToImage(recording_, staging_.handle, target.handle, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1,
                               &copy);
        y += rows;
    }
}

void Uploader::finishImage(const Image& image)
{
    auto width = static_cast<std::int32_t>(image.extent.width);
    auto height = static_cast<std::int32_t>(image.extent.height);
    for (std::uint32_t mip = 1; mip < image.mips; ++mip) {
        barrier(recording_, image.handle, VK_IMAGE_ASPECT_COLOR_BIT, kCopyTarget, kCopySource, mip - 1, 1);
        VkImageBlit2 blit{VK_STRUCTURE_TYPE_IMAGE_BLIT_2};
        blit.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, mip - 1, 0, 1};
        blit.srcOffsets[1] = {width, height, 1};
        width = std::max(width / 2, 1);
        height = std::max(height / 2, 1);
        blit.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, mip, 0, 1};
        blit.dstOffsets[1] = {width, height, 1};
        VkBlitImageInfo2 info{VK_STRUCTURE_TYPE_BLIT_IMAGE_INFO_2};
        info.srcImage = image.handle;
        info.srcImageLayout = kCopySource.layout;
        info.dstImage = image.handle;
        info.dstImageLayout = kCopyTarget.layout;
        info.regionCount = 1;
        info.pRegions = &blit;
        info.filter = VK_FILTER_LINEAR;
        vkCmdBlitImage2(recording_, &info);
        barrier(recording_, image.handle, VK_IMAGE_ASPECT_COLOR_BIT, kCopySource, kSampled, mip - 1, 1);
    }
    barrier(recording_, image.handle, VK_IMAGE_ASPECT_COLOR_BIT, kCopyTarget, kSampled, image.mips - 1, 1);
}

void Uploader::submit()
{
    const Access all{VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_READ_BIT};
    memoryBarrier(recording_, kCopyTarget, all);
    commands_.submit();
}

void Uploader::flush()
{
    commands_.finish();
    used_ = 0;
    recording_ = commands_.begin();
}

} // namespace gnomon::host
