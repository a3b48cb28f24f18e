// SPDX-License-Identifier: Apache-2.0
// The receivers of a finished frame: read-back is one, a window another.
#pragma once

#include "host/gpu.h"
#include "image/image.h"

#include <gnomon/plan.h>
#include <gnomon/vulkan/shadow_renderer.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace gnomon::host {

/// The images of a frame once all its passes are recorded. A reader must wait for their writes. By its `layout` the
/// picture is read by copies, all others by shaders. They hold until the next frame is recorded.
struct FinishedFrame {
    VkExtent2D drawn{};         // size of all images except picture and glow; twice `shown` a side with supersampling
    VkExtent2D shown{};         // the picture's size
    vulkan::ImageRef picture;   // sRGB-encoded, RGBA8
    vulkan::ImageRef light;     // radiance before the tone curve, RGBA16F; null where shading applied the tone curve
                                // (RenderOptions::keeps_light)
    vulkan::ImageRef glow;      // sum of the levels of bloom; null without it
    vulkan::ImageRef depth;     // reversed z
    vulkan::ImageRef normals;   // geometric, octahedral; null of a frame shaded forward
    vulkan::ImageRef ids;       // object + 1 in the last channel, anything where nothing is drawn; null of a frame
                                // shaded forward
    vulkan::ImageRef masks;     // null where everything is lit
    bool compact_masks = false; // `masks` has RenderOptions::compact_mask
    std::size_t light_count = 0;
    const Plan* plan = nullptr; // says where in `masks` a light's is; null: light i has layer i / 4, channel i % 4
};

/// FrameRenderer::submit() calls it with each frame.
class Present {
public:
    virtual ~Present() = default;
    /// Records commands after the frame's last pass, into the same command buffer. Images are left in the layouts that
    /// they came in.
    virtual void record(VkCommandBuffer commands, const FinishedFrame& frame) = 0;
};

/// A frame read back.
struct Picture {
    Image8 colour;                     // RGB, sRGB-encoded, tone-mapped
    ImageF linear;                     // RGB, linear radiance before the tone curve; only if asked for
    ImageF glow;                       // RGB, half the size: sum of the levels of bloom; only if asked for and on
    std::vector<ImageF> masks;         // one 1-channel image per light, in the order of the lights given
    ImageF depth;                      // camera depth, reversed z
    ImageOf<std::uint32_t> object_ids; // index into State::objects + 1; 0 background
    ImageF normals;                    // geometric, world space, xyz
};
struct WantedImages {
    bool colour = true;
    bool linear = false;
    bool glow = false;
    bool masks = false;
    bool geometry = false; // depth, ids, normals
};

/// Copies what is wanted of a frame to memory.
class ReadBack : public Present {
public:
    ReadBack(const Gpu& gpu, const WantedImages& wanted);
    ~ReadBack() override;
    ReadBack(const ReadBack&) = delete;
    ReadBack& operator=(const ReadBack&) = delete;

    /// May be used again once the GPU has finished the frame before. Throws Error when memory runs out.
    void record(VkCommandBuffer commands, const FinishedFrame& frame) override;
    /// Precondition: the GPU has finished the frame that was recorded last (FrameRenderer::finish()).
    [[nodiscard]] Picture picture() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace gnomon::host
