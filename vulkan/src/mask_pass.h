// SPDX-License-Identifier: Apache-2.0
// The pass that turns maps and the camera's depth into the visibility mask.
#pragma once

#include "alternate_pass.h"
#include "cascade_fitter.h"
#include "layer_placer.h"
#include "mask_regions.h"

#include <array>
#include <optional>

namespace gnomon::vulkan {

class MaskPassRecorder {
public:
    MaskPassRecorder(Device& device, const ShadowRendererOptions& options, float quantum);

    /// Makes the mask image if size, format or layers changed; true when it did.
    bool prepare(const Plan& plan, VkExtent2D screen);
    /// The maps or the buffer of the layers of depth were made anew: descriptors that name them are out of date.
    void forgetMaps();
    void record(VkCommandBuffer commands, std::uint32_t slot, const Frame& frame, const Plan& plan,
                const MaskInputs& inputs, const Image& maps, const LayerPlacer& placer, CascadeFitter& fitter);
    [[nodiscard]] const Image& mask() const { return mask_; }

private:
    struct Slot {
        HostBuffer constants; // one GpuMaskLayer for each region of each layer, at constants_stride_
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
        std::uint32_t paired = 0; // MaskLayerShape::paired
        [[nodiscard]] std::size_t index() const
        {
            return (orthographic ? 1U : 0U) | (normals ? 2U : 0U) | (ids ? 4U : 0U) | (many_views ? 8U : 0U) |
                   (lights - 1) << 4 | paired << 6;
        }
    };

    void makeLayouts();
    void makeSlots();
    void writeConstants(Slot& slot) const;
    void updateSet(Slot& slot, const MaskInputs& inputs, VkImageView maps, VkBuffer layers);
    [[nodiscard]] VkPipeline pipeline(Variant variant);
    [[nodiscard]] Pipeline makePipeline(Variant variant);
    // What one record() is given.
    struct Job {
        VkCommandBuffer commands = VK_NULL_HANDLE;
        Slot& slot;
        const Frame& frame;
        const Plan& plan;
        const MaskInputs& inputs;
        const Image& maps;
        const LayerPlacer& placer;
    };
    void makeConstants(std::uint32_t layers, std::uint32_t regions);
    void recordLayer(const Job& job, const Image& target, std::uint32_t layer);
    void recordRegion(const Job& job, std::uint32_t layer, const MaskRegion& region, std::uint32_t place);

    Device& device_;
    ShadowRendererOptions options_;
    float quantum_;
    Image mask_;
    DescriptorSets sets_;
    PipelineLayout layout_;
    Sampler sampler_;     // of what is read texel by texel
    Sampler map_sampler_; // of the maps
    std::vector<Slot> slots_;
    std::optional<AlternatePass> alternate_; // made when a plan first needs it
    VkDeviceSize constants_stride_ = 0;
    std::uint32_t regions_ = 1; // of each layer that there is room for in the constants
    ShaderModule vertex_;
    std::array<ShaderModule, 8> fragments_; // by orthographic, ids, paired
    std::array<Pipeline, 1024> pipelines_;  // by Variant::index(), made when first needed
};

} // namespace gnomon::vulkan
