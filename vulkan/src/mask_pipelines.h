// SPDX-License-Identifier: Apache-2.0
// The mask pass's pipelines, by what sets them apart. They stay once they are made: options that come back find theirs.
#pragma once

#include "device.h"

#include <gnomon/pack/mask_draws.h>
#include <gnomon/pack/technique_constants.h>

#include <array>
#include <vector>

namespace gnomon::vulkan {

/// The constant_ids of mask.frag, four bytes each, in their order.
struct MaskConstants {
    pack::TechniqueConstants technique; // few_views: pack::MaskDraw::few_views
    VkBool32 has_normals = VK_FALSE;
    VkBool32 in_software = VK_FALSE; // numbers that all pixels share come from the vertex shader; see mask.frag
    VkBool32 has_smooth = VK_FALSE;
    VkBool32 tints = VK_FALSE;       // views of the draw's options have maps of tints
    VkBool32 shows_rays = VK_FALSE;  // ShadowRendererOptions::shows_rays
    VkBool32 confidence = VK_FALSE;  // for the pass that joins frames: FilterTraits::weighs_frames
    VkBool32 coloured = VK_FALSE;    // pack::MaskDraw::coloured
    std::uint32_t tile_channels = 0; // CompactMaskRule::channels
    VkBool32 takes_away = VK_FALSE;  // for a compact mask, a draw that shares: it draws the light that is lost
    VkBool32 paraboloid = VK_FALSE;  // views may be ViewProjection::paraboloid
    VkBool32 has_ids = VK_FALSE;
    VkBool32 slices_alone = VK_FALSE;   // by MaskPipelineKey::told_apart
    VkBool32 paired = VK_FALSE;         // pack::MaskDraw::paired; of modules for one view alone
    std::uint32_t pixels_per_texel = 1; // DrawnAs::half: 2
    VkBool32 layered = VK_FALSE;        // views may be ViewServes::layered
    VkBool32 orthographic = VK_FALSE;   // pack::MaskDraw::orthographic
    VkBool32 settles = VK_FALSE;        // DrawnAs::settled
    VkBool32 pages = VK_FALSE;          // a point's view is found by pack::fillPageTable()

    bool operator==(const MaskConstants&) const = default;
};

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
    MaskConstants constants;
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
