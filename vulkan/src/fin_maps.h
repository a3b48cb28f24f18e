// SPDX-License-Identifier: Apache-2.0
// Fins beside their maps (gnomon/shared/smoothie_fins.h): an image beside that of the maps, into which the host draws
// casters' silhouettes wherever a map was drawn.
#pragma once

#include "barriers.h"
#include "descriptors.h"
#include "map_recorder.h"

namespace gnomon::vulkan {

inline constexpr VkFormat kFinFormat = VK_FORMAT_R32_UINT;
inline constexpr VkFormat kFinOrderFormat = VK_FORMAT_D32_SFLOAT; // format of the order that decides which fin a texel
                                                                  // keeps

class FinMaps {
public:
    /// Precondition: options.hasFins().
    FinMaps(Device& device, const ResolvedOptions& options);

    /// For these maps, an image that has just been made; all maps are to be drawn again.
    void setMaps(const Image& maps);
    /// Those of the maps that the job has drawn. The maps are readable.
    void record(const MapJob& job);

    /// In GENERAL once recorded.
    [[nodiscard]] const Image& image() const { return image_; }

private:
    void begin(VkCommandBuffer commands);
    void awaitMap(VkCommandBuffer commands) const;
    void recordMap(const MapJob& job, std::uint32_t view) const;

    Device& device_;
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
