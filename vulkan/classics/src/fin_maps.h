// SPDX-License-Identifier: Apache-2.0
// Fins beside their maps (gnomon/shared/smoothie_fins.h): an image beside that of the maps, into which the host draws
// casters' silhouettes wherever a map was drawn.
#pragma once

#include "barriers.h"
#include "descriptors.h"
#include "map_step.h"

#include <gnomon/vulkan/fin_drawer.h>

namespace gnomon::vulkan {

inline constexpr VkFormat kFinFormat = VK_FORMAT_R32_UINT;
inline constexpr VkFormat kFinOrderFormat = VK_FORMAT_D32_SFLOAT; // format of the order that decides which fin a texel
                                                                  // keeps

class FinMaps final : public MapStep {
public:
    /// Precondition: options.hasFins(). `draw` has to live longer.
    FinMaps(Device& device, const ResolvedOptions& options, const DrawFins& draw);

    [[nodiscard]] const char* passName() const override { return "shadow filter"; }
    [[nodiscard]] bool needsDrawnMaps() const override { return true; } // its image is not copied
    void setMaps(const Image& maps) override;
    void record(const MapJob& job) override;
    [[nodiscard]] const Image& image() const override { return image_; }

private:
    void begin(VkCommandBuffer commands);
    void awaitMap(VkCommandBuffer commands) const;
    void recordMap(const MapJob& job, std::uint32_t view) const;

    Device& device_;
    const DrawFins& draw_;
    std::int32_t reach_;
    float quantum_;
    Sampler nearest_;
    DescriptorSets sets_;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
    Image image_;
    Image depth_; // says which fin a texel keeps, then is forgotten
    bool has_layout_ = false;
};

} // namespace gnomon::vulkan
