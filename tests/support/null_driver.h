// SPDX-License-Identifier: Apache-2.0
// A Vulkan driver that only counts: it tests recording in milliseconds, without a GPU, and can run out of memory at
// will. It has only the functions that this library calls. It also knows which objects the commands of a frame in
// flight use, and counts objects that are freed or changed too early.
#pragma once

#include <gnomon/vulkan/device_view.h>

#include <cstdint>
#include <memory>
#include <span>

namespace gnomon::test {

struct NullCounts {
    std::uint64_t created = 0; // objects, command buffers and descriptor sets apart
    std::uint64_t destroyed = 0;
    std::uint64_t pipelines = 0;   // created, of either kind
    std::uint64_t allocations = 0; // vkAllocateMemory
    std::uint64_t frees = 0;
    std::uint64_t bytes = 0;              // allocated now
    std::uint64_t descriptor_updates = 0; // vkUpdateDescriptorSets
    std::uint64_t draws = 0;              // vkCmdDraw
    std::uint64_t dispatches = 0;         // vkCmdDispatch
    std::uint64_t indirect_draws = 0;     // draw count of vkCmdDrawIndexedIndirect
    std::uint64_t instances = 0;          // of the indirect draws
    std::uint64_t indices = 0;            // of the indirect draws, over all instances
    /// Mistakes. Objects, their memory included, that were destroyed while commands of a slot that has not come round
    /// again use them; descriptor sets written while they are in such use; and commands that name destroyed objects.
    std::uint64_t freed_in_use = 0;
    std::uint64_t written_in_use = 0;
    std::uint64_t used_after_free = 0;
    std::uint64_t lacking = 0; // things made or recorded that need a part that the device lacks (null_lacks.cpp)
};

struct NullEvent {
    enum class Kind : std::uint8_t {
        barrier, // of an image
        memory_barrier,
        begin_rendering,
        end_rendering,
        bind_pipeline,
        dispatch,
        copy_image,
        copy_buffer,
        draw,
        draw_indirect,
        timestamp,
        begin_query,
        end_query
    };
    Kind kind = Kind::barrier;
    VkRect2D area{};                                      // begin_rendering
    std::uint32_t layer = 0;                              // barrier: the first layer
    VkImageLayout old_layout = VK_IMAGE_LAYOUT_UNDEFINED; // barrier
    VkImageLayout new_layout = VK_IMAGE_LAYOUT_UNDEFINED; // barrier
    std::uint32_t count = 0;                 // draw_indirect: commands; dispatch: groups; begin_rendering: layers
    VkPipelineStageFlags2 target_stages = 0; // memory_barrier
    VkAccessFlags2 target_access = 0;        // memory_barrier
};

struct NullLimits {
    std::uint32_t max_image_size = 16384;
    std::uint32_t max_image_layers = 2048;
    /// Allocations beyond these many bytes fail with VK_ERROR_OUT_OF_DEVICE_MEMORY.
    std::uint64_t memory_bytes = std::uint64_t{1} << 40;
    std::uint32_t timestamp_bits = 64;
    std::span<const std::uint64_t> query_results; // the first results of reading queries back; zeros follow
    VkPhysicalDeviceFeatures lacks{};             // features that it has not, of those that are true here
    bool lacks_output_layer = false;              // lacks shaderOutputLayer
    VkFormat lacks_format = VK_FORMAT_UNDEFINED;  // can be used for nothing
    std::uint32_t group_threads = 1024;           // maxComputeWorkGroupInvocations
    std::uint32_t storage_buffers = 4;            // maxPerStageDescriptorStorageBuffers; 4 are promised
    std::span<const VkMemoryType> memory_types;   // empty: one, for all
    std::span<const VkDeviceSize> heap_bytes;     // of each heap; empty: endless
};

/// Its view() and commands() are good for as long as it lives. Not thread-safe.
class NullDriver {
public:
    explicit NullDriver(const NullLimits& limits = {});
    ~NullDriver();
    NullDriver(const NullDriver&) = delete;
    NullDriver& operator=(const NullDriver&) = delete;

    [[nodiscard]] vulkan::DeviceView view();
    [[nodiscard]] VkCommandBuffer commands(); // the only one
    [[nodiscard]] VkBuffer makeBuffer();      // some handle to bind; not counted
    [[nodiscard]] VkImageView makeView();     // some handle; not counted
    /// Destroys a view of makeView() and makes another one that has the same handle, as a driver may.
    void remakeView(VkImageView view);

    /// Ends the frame that was recorded with this slot, and begins a new one, which is pending until the next call with
    /// the same slot. Slots are below 32. The first is slot 0.
    void beginSlot(std::uint32_t slot);
    /// All frames have finished, the current one too.
    void finishAll();

    [[nodiscard]] const NullCounts& counts() const;
    /// The first 65536 events since the last clearEvents(); keeping them allocates nothing.
    [[nodiscard]] std::span<const NullEvent> events() const;
    void clearEvents();
    void setMemory(std::uint64_t bytes);
    /// From now on every format lacks these features.
    void hideFormatFeatures(VkFormatFeatureFlags features);
    /// From now on this function is missing (nullptr: none is). The name must outlive the driver.
    void hideFunction(const char* name);

    /// Calls that may fail, since its construction, without those of the debug functions, which it lacks.
    [[nodiscard]] std::uint64_t fallibleCalls() const;
    /// The n-th such call from now on, counted from 1, fails with this result and does nothing; with
    /// VK_ERROR_DEVICE_LOST all later ones fail too. 0: none.
    void failCall(std::uint64_t nth, VkResult result);

    /// From now on view() says that all optional features are on, whatever the device lacks.
    void claimAll();

    /// Sets the physical device's API version; VK_API_VERSION_1_3 at first.
    void setApiVersion(std::uint32_t version);

    struct Impl;

private:
    std::unique_ptr<Impl> impl_;
};

} // namespace gnomon::test
