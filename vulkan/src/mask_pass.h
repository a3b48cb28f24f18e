// SPDX-License-Identifier: Apache-2.0
// The pass that turns maps and the camera's depth into the visibility mask.
#pragma once

#include "alternate_pass.h"
#include "cascade_fitter.h"
#include "layer_placer.h"
#include "mask_constants.h"

#include <array>
#include <optional>

namespace gnomon::vulkan {

/// Push constants of mask.frag.
struct MaskPush {
    std::uint32_t first_light;
    std::uint32_t channels;
};

class MaskPassRecorder {
public:
    MaskPassRecorder(Device& device, const ShadowRendererOptions& options, float quantum);

    /// Makes the mask image if size, format or layers changed; true when it did. Makes the pipelines, too, that this
    /// plan needs for inputs of the options' shape; without one, for inputs as record() was given last. Only a first
    /// record() whose shape nobody told makes its own.
    bool prepare(const Plan& plan, VkExtent2D screen);
    void record(VkCommandBuffer commands, std::uint32_t slot, const Frame& frame, const Plan& plan,
                const MaskInputs& inputs, const Image& maps, const LayerPlacer& placer, CascadeFitter& fitter);
    [[nodiscard]] const Image& mask() const { return mask_; }

private:
    struct Slot {
        HostBuffer constants; // a GpuConstants, then lights and views
        VkDescriptorSet set = VK_NULL_HANDLE;
    };
    // Of a slot's buffer.
    struct Room {
        std::uint32_t lights = 0;
        std::uint32_t views = 0;
        VkDeviceSize lights_at = 0; // bytes
        VkDeviceSize views_at = 0;
    };
    struct Variant {
        bool orthographic = false;
        bool normals = false;
        bool ids = false;
        std::uint32_t few_views = 0; // MaskDraw::few_views
        static constexpr std::size_t kCount = 8 * (1 + shared::kFewViews);
        [[nodiscard]] std::size_t index() const
        {
            return (orthographic ? 1U : 0U) | (normals ? 2U : 0U) | (ids ? 4U : 0U) | few_views * 8;
        }
    };

    void makeLayouts();
    void makeSlots();
    void makeBuffers(const Plan& plan);
    // Always, and not only where a handle is another one: a view that was made after its predecessor was destroyed may
    // have the same handle.
    void writeSet(Slot& slot, const MaskInputs& inputs, VkImageView maps, VkBuffer layers);
    [[nodiscard]] VkPipeline pipeline(Variant variant);
    void makePipelines(const Plan& plan, MaskShape shape);
    [[nodiscard]] Pipeline makePipeline(Variant variant);
    void fill(Slot& slot, const Frame& frame, const Plan& plan, const MaskSurroundings& around);
    void recordLayer(VkCommandBuffer commands, const MaskInputs& inputs, const Image& target, std::uint32_t layer);
    void recordDraw(VkCommandBuffer commands, const MaskDraw& draw, const MaskInputs& inputs);

    Device& device_;
    ShadowRendererOptions options_;
    float quantum_;
    Image mask_;
    DescriptorSets sets_;
    PipelineLayout layout_;
    Sampler sampler_;     // of what is read texel by texel
    Sampler map_sampler_; // of the maps
    std::vector<Slot> slots_;
    Room room_;
    std::vector<MaskDraw> draws_;            // of the frame that is being recorded
    std::optional<AlternatePass> alternate_; // made when a plan first needs it
    ShaderModule vertex_;
    std::array<Pipeline, Variant::kCount> pipelines_; // by Variant::index()
    std::optional<MaskShape> shape_;                  // of the inputs, as far as it is known
};

} // namespace gnomon::vulkan
