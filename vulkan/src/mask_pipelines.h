// SPDX-License-Identifier: Apache-2.0
// The mask pass's pipelines, by what sets them apart. They stay once they are made: options that come back find theirs.
#pragma once

#include "device.h"

#include <gnomon/pack/mask_draws.h>
#include <gnomon/pack/technique_constants.h>

#include <array>
#include <vector>

namespace gnomon::vulkan {

/// The part of a mask's draw that is drawn, and its target.
enum class DrawnAs : std::uint8_t {
    whole,   // all pixels, to the mask
    settled, // the pixels that blocks settle, to the mask
    half,    // one pixel of each 2 x 2, to MaskSpread::half()
    left     // after settled or MaskSpread, the pixels that it left, to the mask
};
/// The first part to be drawn with these options.
[[nodiscard]] DrawnAs drawnFirst(const ResolvedOptions& options);

struct MaskPipelineKey {
    Filter module = Filter::pcf; // pack::filterModule()
    pack::MaskConstants constants;
    VkFormat format = VK_FORMAT_UNDEFINED; // the mask's format
    pack::ToldApart told_apart = pack::ToldApart::tests;
    bool shares = false; // pack::MaskDraw::shares: channels of other draws stay as they are
    DrawnAs as = DrawnAs::whole;

    bool operator==(const MaskPipelineKey&) const = default;
};
/// The key of a draw with these options; format, device and the draw's own members are left to be filled in.
[[nodiscard]] MaskPipelineKey maskPipelineKey(const ResolvedOptions& options, MaskShape shape);

/// The key for this part of the mask; `key` is for DrawnAs::whole.
[[nodiscard]] MaskPipelineKey drawnAs(MaskPipelineKey key, DrawnAs as);

/// The module that has a filter, and the one for a single view of any kind, whose numbers come from the vertex shader;
/// empty where there is none.
struct MaskCode {
    std::span<const std::uint32_t> any;
    std::span<const std::uint32_t> alone;
};

class MaskPipelines {
public:
    MaskPipelines(Device& device, const ShadowRendererOptions& options);

    /// Makes it where it is not there.
    [[nodiscard]] VkPipeline get(MaskPipelineKey key, VkPipelineLayout layout);

private:
    struct Made {
        MaskPipelineKey key;
        Pipeline pipeline;
    };

    [[nodiscard]] Pipeline make(const MaskPipelineKey& key, VkPipelineLayout layout);
    [[nodiscard]] const MaskCode& codesOf(const MaskPipelineKey& key) const
    {
        return codes_.at(static_cast<std::size_t>(key.module));
    }

    Device& device_;
    VkPipelineCache cache_;
    bool shows_rays_;
    std::array<MaskCode, GNOMON_FILTER_COUNT> codes_; // by module: draws ask in every frame
    ShaderModule vertex_;
    ShaderModule vertex_one_; // for a draw with one view: where the device allows that many outputs
    std::vector<Made> made_;
};

} // namespace gnomon::vulkan
