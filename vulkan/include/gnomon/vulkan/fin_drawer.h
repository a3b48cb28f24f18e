// SPDX-License-Identifier: Apache-2.0
// Draws fins of smoothies for hosts with ordinary meshes, where DrawCasters is called for them (ClassicFormats::fins).
// Silhouettes are found on the GPU, from the positions at the time of drawing, so skinned and morphed meshes need
// nothing more.
// Based on: E. Chan, F. Durand, "Rendering Fake Soft Shadows with Smoothies", EGSR 2003.
#pragma once

#include <gnomon/export.h>
#include <gnomon/vulkan/volume_drawer.h>

#include <cstdint>
#include <memory>
#include <span>

namespace gnomon::vulkan {

/// How a FinDrawer is made.
struct FinDrawerOptions {
    std::uint32_t frames_in_flight = 2;              // 1 .. kMostFrames
    VkPipelineCache pipeline_cache = VK_NULL_HANDLE; // may be null
};

/// The effect of a wrong call, in every build:
///   a slot beyond frames_in_flight, frames_in_flight 0 or more than kMostFrames     Error
///   fewer transforms than objects, null buffers, or larger than a device binds      Error
///   draw() before beginFrame(), of a null pass, or of one without fins              Error
///   draw() after setScene(), or after a beginFrame() that threw                     Error, until beginFrame()
///   an object of the plan that setScene() was not given                             draws nothing
///
/// Not thread-safe. After a call that threw, beginFrame() again.
class GNOMON_API FinDrawer {
public:
    /// Makes its pipelines. Throws Error when a function is missing or memory runs out.
    FinDrawer(const DeviceView& device, const FinDrawerOptions& options);
    /// Does not wait: destroy it when the GPU has finished what it recorded.
    ~FinDrawer();
    FinDrawer(const FinDrawer&) = delete;
    FinDrawer& operator=(const FinDrawer&) = delete;

    /// Sets the edges of each object, open ones too, by object index of the plans. Give none for masked, blended or cut
    /// objects, whose outline is not that of their mesh. May allocate.
    void setScene(std::span<const VolumeMesh> objects);
    /// Before recordMaps() of a frame with filter smoothies. Only elements that are edges have fins.
    /// `world_from_object` is indexed by object index and read until the frame is recorded. Allocates nothing.
    void beginFrame(std::uint32_t slot, const VolumeGeometry& geometry, std::span<const Rows3x4> world_from_object);
    /// Draws one map's fins. Returns the number of draws, for Profiler::addDraws.
    std::uint32_t draw(const MapPass& pass);

private:
    struct GNOMON_LOCAL Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace gnomon::vulkan
