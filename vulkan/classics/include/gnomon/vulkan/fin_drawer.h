// SPDX-License-Identifier: Apache-2.0
// Draws fins of smoothies for hosts with ordinary meshes: a ready-made DrawFins callback. Silhouettes are found on the
// GPU, from the positions at the time of drawing, so skinned and morphed meshes need nothing more. Based on: E. Chan,
// F. Durand, "Rendering Fake Soft Shadows with Smoothies", EGSR 2003.
#pragma once

#include <gnomon/export.h>
#include <gnomon/vulkan/volume_drawer.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <span>

namespace gnomon::vulkan {

/// One map's fins to draw, given to the host's callback once the map is drawn. The callback draws fins along the
/// silhouettes of `map.casters` (gnomon/shared/smoothie_fins.h), and not the casters, into an image beside the map,
/// R32_UINT, packed as in smoothies.h. gl_FragDepth = finOrder(); depth is tested, LESS_OR_EQUAL, and written. Casters
/// without fins keep the shadow of the map. Rendering has begun, viewport and scissor are set.
struct FinPass {
    MapPass map; // with the formats of these images
    /// A set with one COMBINED_IMAGE_SAMPLER at binding 0, FRAGMENT stage, with the maps: a 2D array whose layer is in
    /// ViewPlace::tile.
    VkDescriptorSet maps = VK_NULL_HANDLE;
    float quantum = 0.0F; // largest error of the maps, in depths of the map
};
/// Draws one map's fins.
using DrawFins = std::function<void(const FinPass&)>;

/// How a FinDrawer is made.
struct FinDrawerOptions {
    std::uint32_t frames_in_flight = 2;              // 1 .. kMostFrames
    VkPipelineCache pipeline_cache = VK_NULL_HANDLE; // may be null
};

/// The effect of a wrong call, in every build:
///   a slot beyond frames_in_flight, frames_in_flight 0 or more than kMostFrames     Error
///   fewer transforms than objects, null buffers, or larger than a device binds      Error
///   draw() before beginFrame(), or of a null pass                                   Error
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
    std::uint32_t draw(const FinPass& pass);

private:
    struct GNOMON_LOCAL Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace gnomon::vulkan
