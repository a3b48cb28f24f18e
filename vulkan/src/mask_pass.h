// SPDX-License-Identifier: Apache-2.0
// The pass that turns maps and the camera's depth into the visibility mask.
#pragma once

#include "cascade_fitter.h"
#include "classics.h"
#include "converge_pass.h"
#include "map_class.h"
#include "mask_marks.h"
#include "mask_pipelines.h"
#include "mask_source.h"
#include "mask_spread.h"
#include "soften_pass.h"

#include <gnomon/pack/mask_draws.h>
#include <gnomon/pack/shading_buffers.h>

#include <optional>

namespace gnomon::vulkan {

/// Stages that read the sets and the push constants of the pass that draws the mask.
inline constexpr VkShaderStageFlags kMaskStages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

/// Push constants of mask.frag, of which mask.vert reads the first.
struct MaskPush {
    std::uint32_t first_light; // for a compact mask the layer
    std::uint32_t channels;    // for a compact mask the options
};

/// Throws Error for one that is wrong.
const pack::CompactMaskRule& checkedRule(const pack::CompactMaskRule& rule);

/// By options; null where no light has named them.
using MapClasses = std::vector<std::unique_ptr<MapClass>>;

/// ShadowRenderer::placeTints(), of a plan that was prepared.
void placeTints(const Plan& plan, const MapClasses& maps, std::span<shared::GpuView> views);
/// The format of the mask itself, by maskChannelCount().
[[nodiscard]] VkFormat maskFormat(std::uint32_t channels);
/// Prepares all layers to be drawn to, whoever has read them. Their contents are not needed.
void toAttachment(const Device& device, VkCommandBuffer commands, const Image& image);
void toReadable(const Device& device, VkCommandBuffer commands, const Image& image);
/// Are lights drawn to ConvergePass::target(), and not to another pass before it?
[[nodiscard]] bool drawsToConverge(const Plan& plan);
/// Do frames that converge count by FilterTraits::weighs_frames?
[[nodiscard]] bool weighsFrames(const ResolvedOptions& options);

class MaskPassRecorder {
public:
    MaskPassRecorder(Device& device, const ShadowRendererOptions& options);

    void warmUp(const ResolvedOptions& options, const WarmUp& what);
    /// Makes the mask image if size, format or layers changed; true when it did. Makes the pipelines, too, that this
    /// plan needs for inputs of the options' shape; without one, for inputs as record() was given last. Only a first
    /// record() whose shape nobody told makes its own.
    bool prepare(const Plan& plan, VkExtent2D screen, const MapClasses& maps);
    /// Finds what this frame's mask is drawn from: before all below. `map_changes`: pack::MapNotes::changes().
    void describe(const Plan& plan, const MaskInputs& inputs, const MapClasses& maps, std::uint64_t map_changes);
    /// Is the mask that was described the one that mask() has?
    [[nodiscard]] bool holds() const { return now_.inputs != 0 && drawn_is_known_ && now_ == drawn_; }
    /// Instead of record() and recordSoften(), where it is.
    void keep(std::uint32_t slot);
    /// Draws what was described.
    void record(VkCommandBuffer commands, std::uint32_t slot, const Plan& plan, const MaskInputs& inputs,
                const MapClasses& maps, CascadeFitter& fitter);
    /// Blurs what record() left, for a plan that wants it.
    void recordSoften(VkCommandBuffer commands, std::uint32_t slot, const Plan& plan, const MaskInputs& inputs);
    /// Did prepare() make what recordSoften() needs for this plan?
    [[nodiscard]] bool holdsSoften(const Plan& plan) const { return soften_ && soften_->holds(mask_.info(), plan); }
    /// Did it make what record() needs for lights that pack::halvesMask()?
    [[nodiscard]] bool holdsSpread(const Plan& plan) const { return spread_ && spread_->holds(drawnInfo(plan)); }
    /// Did it make what tells pixels that are done from those that are left, if this plan's filters leave any?
    [[nodiscard]] bool holdsMarks(const Plan& plan) const;
    [[nodiscard]] const Image& mask() const { return mask_; }
    /// Was the last prepare() for a plan with shadow volumes?
    [[nodiscard]] bool countsVolumes() const { return counts_volumes_; }
    /// ShadowRenderer::maskTiles().
    [[nodiscard]] BufferRef tiles(std::uint32_t slot) const;

private:
    struct Slot {
        HostBuffer constants;              // GpuConstants by options, then lights and views
        HostBuffer tiles;                  // for a compact mask, or for pages
        std::uint64_t tiles_of = 0;        // which mask's they are: drawings_
        HostBuffer objects;                // pack::fillObjects(); of plans without ids none
        std::vector<VkDescriptorSet> sets; // by options
    };
    // The room in a slot's buffer.
    struct Room {
        std::uint32_t options = 0;
        std::uint32_t lights = 0;
        std::uint32_t views = 0;
        std::size_t objects = 0;           // vectors
        VkDeviceSize constants_stride = 0; // bytes
        VkDeviceSize lights_at = 0;
        VkDeviceSize views_at = 0;
    };

    [[nodiscard]] bool isCompact() const { return compact_.channels != 0; }
    /// Throws Error for a plan that a compact mask cannot hold.
    void checkCompact(const Plan& plan) const;
    [[nodiscard]] std::uint32_t layersFor(const Plan& plan) const;
    [[nodiscard]] std::uint32_t channelsFor(const Plan& plan) const;
    [[nodiscard]] std::uint32_t lightRoomFor(const Plan& plan) const;
    void describeTiles(const Plan& plan, glm::uvec2 size_px);
    void describeConstants(const Plan& plan, glm::uvec2 screen_px, const pack::DrawPrecision& precision,
                           const MapClasses& maps);
    void makeRoomForTiles(Slot& slot);
    void fillTiles(Slot& slot);

    void makeLayouts();
    void makeSets(std::uint32_t options);
    void makeObjects(const Plan& plan);
    void makePageTables(const Plan& plan);
    void makeBuffers(const Plan& plan);
    void makeMask(const Plan& plan, VkExtent2D screen);
    void makeAlternate();
    void makeConverge();
    void makeSoften();
    void prepareSoften(const Plan& plan);
    void makeSpread();
    void prepareSpread(const Plan& plan);
    void warmUpSpread(const ResolvedOptions& options, const WarmUp& what);
    /// The image that lights are drawn to, before frames are joined.
    [[nodiscard]] ImageInfo drawnInfo(const Plan& plan) const;
    void makeVolumes();
    void prepareVolumes(const Plan& plan);
    void prepareHistories(const Plan& plan);
    void prepareMarks(const Plan& plan);
    /// Are there draws of this layer that begin so?
    [[nodiscard]] bool hasDraws(const Plan& plan, std::uint32_t layer, DrawnAs first) const;
    void recordLayers(VkCommandBuffer commands, const Plan& plan, const Slot& slot, const Image& target);
    void recordHalved(VkCommandBuffer commands, std::uint32_t slot, const Plan& plan, const MaskInputs& inputs,
                      const Image& target);
    void makePipelines(const Plan& plan, MaskShape shape);
    void warmUpDraws(const ResolvedOptions& options, const WarmUp& what, bool to_converge);
    // In every frame, and not only where a handle is another one: a view that was made after its predecessor was
    // destroyed may have the same handle.
    void writeSet(const Slot& slot, std::uint32_t options, const MaskInputs& inputs, const MapClass& maps);
    [[nodiscard]] VkPipeline pipeline(const Plan& plan, const pack::MaskDraw& draw, MaskShape shape, DrawnAs as);
    void fill(Slot& slot, const Plan& plan, const MaskInputs& inputs, const MapClasses& maps);
    void recordLayer(VkCommandBuffer commands, const Plan& plan, const Slot& slot, const Image& target,
                     std::uint32_t layer, DrawnAs as);
    /// Records this part of the layer's draws that begin as `first`.
    void recordDraws(VkCommandBuffer commands, const Plan& plan, const Slot& slot, std::uint32_t layer, DrawnAs first,
                     DrawnAs as);
    void recordSettled(VkCommandBuffer commands, const Plan& plan, const Slot& slot, const Image& target,
                       std::uint32_t layer);
    void recordDraw(VkCommandBuffer commands, const Plan& plan, const Slot& slot, const pack::MaskDraw& draw,
                    DrawnAs as);

    Device& device_;
    std::uint32_t slot_count_;
    VkPipelineCache cache_;
    const Classics* classics_; // not null where options need them
    pack::CompactMaskRule compact_;
    Image mask_;
    MaskMarks marks_;    // for what blocks settle, and for MaskSpread
    StandIn no_numbers_; // bound where there are no ids of objects, or no blocks
    DescriptorSets sets_;
    PipelineLayout layout_;
    Sampler nearest_; // for images that are read texel by texel
    Sampler linear_;  // for filterable maps
    MaskPipelines pipelines_;
    std::vector<Slot> slots_;
    Room room_;
    MaskSource now_;   // for the frame that is being recorded
    MaskSource drawn_; // the source that mask_ was drawn from
    bool drawn_is_known_ = false;
    std::uint64_t drawings_ = 0;             // number of drawn masks
    std::vector<pack::MapImage> map_images_; // for the frame that is being recorded, by options
    std::vector<std::uint8_t> tinted_;       // by options: some view has a map of tints
    pack::LightLists lists_;                 // for a compact mask
    pack::CompactMask tiles_;                // for a compact mask
    // Each is made when a plan first needs it.
    std::unique_ptr<FrameJoiner> alternate_;
    std::optional<ConvergePass> converge_;
    std::optional<SoftenPass> soften_;
    std::optional<MaskSpread> spread_;
    std::unique_ptr<MaskStep> volumes_;
    bool counts_volumes_ = false;
    std::optional<MaskShape> shape_; // shape of the inputs, as far as it is known
};

} // namespace gnomon::vulkan
