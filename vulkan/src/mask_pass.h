// SPDX-License-Identifier: Apache-2.0
// The pass that turns maps and the camera's depth into the visibility mask.
#pragma once

#include "device.h"
#include "layer_placer.h"

#include <array>

namespace gnomon::vulkan {

class MaskPassRecorder {
public:
    MaskPassRecorder(Device& device, const ShadowRendererOptions& options, float quantum);

    /// Makes the mask image if size, format or layers changed; true when it did.
    bool prepare(const Plan& plan, VkExtent2D screen);
    /// The maps or the buffer of the layers of depth were made anew: descriptors that name them are out of date.
    void forgetMaps();
    void record(VkCommandBuffer commands, std::uint32_t slot, const Frame& frame, const Plan& plan,
                const MaskInputs& inputs, const Image& maps, const LayerPlacer& placer);
    [[nodiscard]] const Image& mask() const { return mask_; }

private:
    struct Slot {
        HostBuffer constants; // one GpuMaskLayer a layer, at constants_stride_
        VkDescriptorSet set = VK_NULL_HANDLE;
        // What the set holds now.
        VkImageView maps = VK_NULL_HANDLE;
        VkBuffer layers = VK_NULL_HANDLE;
        VkImageView depth = VK_NULL_HANDLE;
        VkImageLayout depth_layout = VK_IMAGE_LAYOUT_UNDEFINED;
        VkImageView normal = VK_NULL_HANDLE;
        VkImageView object_id = VK_NULL_HANDLE;
    };
    struct Variant {
        std::uint32_t lights = 1; // 1 .. 4
        bool many_views = false;
        bool orthographic = false;
        bool normals = false;
        bool ids = false;
        [[nodiscard]] std::size_t index() const
        {
            return (orthographic ? 1U : 0U) | (normals ? 2U : 0U) | (ids ? 4U : 0U) | (many_views ? 8U : 0U) |
                   (lights - 1) << 4;
        }
    };

    void makeLayouts();
    void makeSlots();
    void updateSet(Slot& slot, const MaskInputs& inputs, VkImageView maps, VkBuffer layers);
    [[nodiscard]] VkPipeline pipeline(Variant variant);
    [[nodiscard]] Pipeline makePipeline(Variant variant);
    void recordLayer(VkCommandBuffer commands, const Slot& slot, std::uint32_t layer, VkPipeline pipeline);
    void toAttachment(VkCommandBuffer commands);
    void toReadable(VkCommandBuffer commands);

    Device& device_;
    ShadowRendererOptions options_;
    float quantum_;
    Image mask_;
    SetLayout set_layout_;
    PipelineLayout layout_;
    Sampler sampler_;     // of what is read texel by texel
    Sampler map_sampler_; // of the maps
    DescriptorPool pool_;
    std::vector<Slot> slots_;
    VkDeviceSize constants_stride_ = 0;
    ShaderModule vertex_;
    std::array<ShaderModule, 4> fragments_; // by orthographic, ids
    std::array<Pipeline, 64> pipelines_;    // by Variant::index(), made when first needed
};

} // namespace gnomon::vulkan
