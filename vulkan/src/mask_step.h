// SPDX-License-Identifier: Apache-2.0
// Interfaces of passes over the mask, with images of their own.
#pragma once

#include "device.h"
#include "stand_in.h"

namespace gnomon::vulkan {

/// The inputs of one recording.
struct MaskJob {
    VkCommandBuffer commands = VK_NULL_HANDLE;
    std::uint32_t slot = 0;
    const Plan& plan;
    const MaskInputs& inputs;
    VkBuffer constants = VK_NULL_HANDLE; // begins with GpuConstants by options
    VkDeviceSize constants_stride = 0;   // bytes from one to the next
    const StandIn& no_numbers;           // in place of MaskInputs::object_id where there is none
};

/// A mask that pipelines are made for.
struct MaskKind {
    VkFormat format = VK_FORMAT_UNDEFINED;
    std::uint32_t channels = 0; // those of one light: bits, as maskChannelsOf()
    MaskShape shape;            // of the inputs
};

class MaskStep {
public:
    MaskStep() = default;
    virtual ~MaskStep() = default;
    MaskStep(const MaskStep&) = delete;
    MaskStep& operator=(const MaskStep&) = delete;

    /// Makes the pipelines for such masks where they are not there.
    virtual void warmUp(const MaskKind& mask) = 0;
    /// Makes images for a mask like this one if those that are there do not fit, and pipelines for the plan. `shape`:
    /// of the inputs.
    virtual void prepare(const Plan& plan, const ImageInfo& mask, const MaskShape& shape) = 0;
    /// Draws to all layers of the mask, which is in COLOR_ATTACHMENT_OPTIMAL.
    virtual void record(const MaskJob& job, const Image& mask) = 0;
};

/// Joins this frame's visibility with that of frames before.
class FrameJoiner : public MaskStep {
public:
    /// Where the visibility of this frame alone is to be drawn; afterwards it is to be readable by fragment shaders.
    [[nodiscard]] virtual const Image& target() const = 0;
    /// The next frame has no frame before it.
    virtual void forget() = 0;
};

} // namespace gnomon::vulkan
