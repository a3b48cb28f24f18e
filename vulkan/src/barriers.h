// SPDX-License-Identifier: Apache-2.0
// Barriers that belong together go to the driver in one command.
#pragma once

#include "device.h"

#include <array>

namespace gnomon::vulkan {

/// A barrier of all levels of an image.
struct ImageBarrier {
    VkImage image = VK_NULL_HANDLE;
    VkImageAspectFlags aspect = VK_IMAGE_ASPECT_COLOR_BIT;
    std::uint32_t first_layer = 0;
    std::uint32_t layer_count = 1;
    VkImageLayout old_layout = VK_IMAGE_LAYOUT_UNDEFINED;
    VkImageLayout new_layout = VK_IMAGE_LAYOUT_UNDEFINED;
    VkPipelineStageFlags2 source_stages = 0;
    VkAccessFlags2 source_access = 0;
    VkPipelineStageFlags2 target_stages = 0;
    VkAccessFlags2 target_access = 0;
};

/// For all memory.
struct MemoryBarrier {
    VkPipelineStageFlags2 source_stages = 0;
    VkAccessFlags2 source_access = 0;
    VkPipelineStageFlags2 target_stages = 0;
    VkAccessFlags2 target_access = 0;
};

/// Gathers barriers that need not come one after the other, and records them as one command: when it is told to, when
/// it is full, and at the end of its life. Allocates nothing.
class BarrierBatch {
public:
    BarrierBatch(const Device& device, VkCommandBuffer commands) : device_(device), commands_(commands) {}
    ~BarrierBatch() { record(); }
    BarrierBatch(const BarrierBatch&) = delete;
    BarrierBatch& operator=(const BarrierBatch&) = delete;

    void add(const ImageBarrier& barrier);
    void add(const MemoryBarrier& barrier);
    void record();

private:
    static constexpr std::uint32_t kMost = 32; // most barriers of each kind

    const Device& device_;
    VkCommandBuffer commands_;
    std::array<VkImageMemoryBarrier2, kMost> images_;
    std::array<VkMemoryBarrier2, kMost> memory_;
    std::uint32_t image_count_ = 0;
    std::uint32_t memory_count_ = 0;
};

/// One alone.
template <class Barrier>
void recordBarrier(const Device& device, VkCommandBuffer commands, const Barrier& barrier)
{
    BarrierBatch(device, commands).add(barrier);
}

} // namespace gnomon::vulkan
