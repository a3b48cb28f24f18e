// SPDX-License-Identifier: Apache-2.0
// GPU time and pipeline statistics per named pass. Used by the backend and by hosts alike.
#pragma once

#include <gnomon/export.h>
#include <gnomon/vulkan/device_view.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

namespace gnomon::vulkan {

/// The cost of one pass.
struct PassRecord {
    const char* name = "";                  // static
    std::optional<double> milliseconds;     // by GPU timestamps; none where the queue has none
    bool has_statistics = false;            // the next four hold: FeatureUses::statistics is on
    std::uint64_t vertex_invocations = 0;   // vertex shaders run
    std::uint64_t primitives = 0;           // primitives that reached rasterisation (clipping output)
    std::uint64_t fragment_invocations = 0; // fragment shaders run
    std::uint64_t compute_invocations = 0;  // compute shaders run
    std::uint32_t draws = 0;                // as counted by addDraws
};

/// Measures only what the device supports: timestamps by DeviceView::queue_family, counts by FeatureUses::statistics.
/// Draws are always counted. The time of a pass that is too long for the timestamps' bits (a minute and more) wraps
/// around.
///
/// Not thread-safe. Error for no or too many frames (kMostFrames in shadow_renderer.h), no passes, a slot beyond them,
/// and passes that nest or come before beginFrame(). An endPass() without its beginPass() does nothing. Passes beyond
/// `max_passes` are not measured.
class GNOMON_API Profiler {
public:
    /// Throws Error when a function is missing or memory runs out.
    Profiler(const DeviceView& device, std::uint32_t frames_in_flight, std::uint32_t max_passes);
    /// Does not wait: destroy it when the GPU has finished what it recorded.
    ~Profiler();
    Profiler(const Profiler&) = delete;
    Profiler& operator=(const Profiler&) = delete;

    /// First call of a frame, outside rendering. `slot` as in ShadowRenderer.
    void beginFrame(VkCommandBuffer commands, std::uint32_t slot);
    void beginPass(VkCommandBuffer commands, const char* name); // outside rendering; static string
    /// Counts draws of the pass that is open.
    void addDraws(std::uint32_t count);
    /// Ends the pass that is open; outside rendering.
    void endPass(VkCommandBuffer commands);
    /// Reads back the passes of a slot whose frame has finished. Valid until the slot's next beginFrame. Empty for a
    /// slot that does not exist. Throws Error (lost device, memory).
    [[nodiscard]] std::span<const PassRecord> results(std::uint32_t slot);

private:
    struct GNOMON_LOCAL Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace gnomon::vulkan
