// SPDX-License-Identifier: Apache-2.0
// Command buffers that are waited for, barriers, and copies through a staging buffer.
#pragma once

#include "memory.h"

#include <span>

namespace gnomon::host {

/// One command buffer and its fence; reused for ever. Waits when it is destroyed.
class Commands {
public:
    /// Throws Error.
    Commands(const Gpu& gpu, const DebugNames& names, const char* name);
    ~Commands();
    Commands(const Commands&) = delete;
    Commands& operator=(const Commands&) = delete;

    /// Precondition: wait() was called for the last submission.
    VkCommandBuffer begin();
    /// Submits the commands, which begin once all of `waits` are signalled and signal `signals` at their end. Throws
    /// Error (lost device).
    void submit(std::span<const VkSemaphoreSubmitInfo> waits = {}, std::span<const VkSemaphoreSubmitInfo> signals = {});
    /// Waits until the GPU has finished the submission; returns at once when there is none. Throws as waitFor().
    void wait();
    /// wait() for destructors: see settle() in wait.h.
    void settle() noexcept;
    /// submit() and wait().
    void finish();

private:
    const Gpu& gpu_;
    OwnedCommandPool pool_;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    OwnedFence fence_;
    bool pending_ = false;
};

/// One side of a barrier.
struct Access {
    VkPipelineStageFlags2 stages = VK_PIPELINE_STAGE_2_NONE;
    VkAccessFlags2 access = VK_ACCESS_2_NONE;
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED; // images only
};
inline constexpr Access kDiscard{}; // for an image that was never used
/// The access before an image's content is discarded: waits for the last `read` and for copies.
constexpr Access discardAfter(const Access& read)
{
    return {read.stages | VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_NONE, VK_IMAGE_LAYOUT_UNDEFINED};
}
inline constexpr Access kColourWrite{VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                                     VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT,
                                     VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
inline constexpr Access kDepthWrite{
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT,
    VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL};
inline constexpr Access kDepthRead{VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT |
                                       VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT |
                                       VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                                   VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
                                   VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL};
inline constexpr Access kSampled{VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
                                 VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
inline constexpr Access kCopySource{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT,
                                    VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};
inline constexpr Access kCopyTarget{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                                    VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL};

void barrier(VkCommandBuffer commands, VkImage image, VkImageAspectFlags aspect, const Access& from, const Access& to,
             std::uint32_t first_mip = 0, std::uint32_t mips = VK_REMAINING_MIP_LEVELS);
inline void barrier(VkCommandBuffer commands, const Image& image, const Access& from, const Access& to)
{
    barrier(commands, image.handle,
            image.format == VK_FORMAT_D32_SFLOAT ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT, from, to);
}
void memoryBarrier(VkCommandBuffer commands, const Access& from, const Access& to);

/// Fills device memory from the host through one staging buffer, so the host's copy is never doubled.
class Uploader {
public:
    /// Throws Error, as all that uploads does.
    Uploader(const Gpu& gpu, Memory& memory);
    ~Uploader();
    Uploader(const Uploader&) = delete;
    Uploader& operator=(const Uploader&) = delete;

    void toBuffer(const Buffer& target, VkDeviceSize offset, const void* bytes, VkDeviceSize size);
    /// Fills mip 0 of a layer with tightly packed rows.
    void toImage(const Image& target, std::uint32_t layer, const void* texels, std::uint32_t texel_bytes);
    /// Makes the smaller mips of a one-layer image by halving, and all of it readable by shaders.
    void finishImage(const Image& image);
    /// Submits the remaining uploads. All that is submitted afterwards sees them; nothing else may be uploaded.
    void submit();
    /// Waits until all uploads have arrived. Throws as waitFor().
    void wait() { commands_.wait(); }

private:
    void flush();
    char* stage(VkDeviceSize size); // at used_ - size after the call; flushes when full
    Memory& memory_;
    Buffer staging_;
    VkDeviceSize used_ = 0;
    Commands commands_;
    VkCommandBuffer recording_ = VK_NULL_HANDLE;
};

} // namespace gnomon::host
