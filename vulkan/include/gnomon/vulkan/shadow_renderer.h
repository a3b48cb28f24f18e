// SPDX-License-Identifier: Apache-2.0
// From a Plan to a visibility mask: records shadow-map passes and the mask pass into the caller's command buffer.
// Never submits, never waits, never owns the device.
#pragma once

#include <gnomon/export.h>
#include <gnomon/frame.h>
#include <gnomon/options.h>
#include <gnomon/pack/compact_mask.h>
#include <gnomon/pack/depth_layers.h>
#include <gnomon/plan.h>
#include <gnomon/vulkan/classic_pass.h>
#include <gnomon/vulkan/device_view.h>
#include <gnomon/vulkan/profiler.h>

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace gnomon::shared {
struct GpuView;
}
namespace gnomon::vulkan {

/// What MaskInputs has besides the camera's depth.
struct MaskShape {
    bool normals = false; // MaskInputs::normal is given
    bool ids = false;     // of objects
    bool smooth = false;  // MaskInputs::smooth is given

    bool operator==(const MaskShape&) const = default;
};

inline constexpr std::uint32_t kMostFrames = 64; // in flight

/// How a ShadowRenderer is made.
struct ShadowRendererOptions {
    /// Of the inputs to come: then prepare() makes the mask's pipelines, and no recordMask() has to. Nothing: the first
    /// recordMask() makes those that it needs, which takes as long as the driver compiles.
    std::optional<MaskShape> mask_shape;
    std::uint32_t frames_in_flight = 2;              // 1 .. kMostFrames
    VkPipelineCache pipeline_cache = VK_NULL_HANDLE; // may be null
    /// Does the object with this index of the plan's lists draw blended casters, which tint light instead of blocking
    /// it? Then views that have such casters get a map of tints beside their map, and the mask holds the luminance of
    /// what arrives, or its colour as well, as ShadowOptions::translucent says. prepare() asks for each caster of a
    /// plan. Null: nothing is blended, and nothing is spent on maps of tints.
    std::function<bool(std::uint32_t object)> is_blended;
    /// With channels 4 or 8 the mask is compact: one or two layers of RGBA8, however many lights there are. Which light
    /// of a tile of the screen is in which channel maskTiles() says. Suns that move in steps, lights whose frames
    /// converge, lights with filter volumes, those whose mask is blurred and lights in colour are refused (Error from
    /// prepare()), and so are more than 65,535 lights.
    pack::CompactMaskRule compact;
    /// To look for what rays cost: the mask of lights with filter raymarch says, instead of visibility, how their rays
    /// fared: 0.25 where blocks decided without a ray, 0.5 where there were as many as wanted, 0.75 where there were
    /// fewer or some ended early (lib/raymarch.glsl); between them where a pixel reads two cascades. Pixels that face
    /// away from the light or are in no map have 0 and 1 as ever.
    bool shows_rays = false;
    /// The callback that draws casters also draws fins (ClassicFormats::fins; FinDrawer is such a callback). False:
    /// prepare() refuses lights with filter smoothies.
    bool draws_fins = false;
};

/// One light's shadow volumes to draw (pack::VolumeDraw), given to the host's callback. Rendering has begun, and the
/// camera's depth is in the depth buffer; viewport, scissor and, with FeatureUses::depth_bounds, depth bounds are set.
/// The callback binds its pipelines and draws; it must not end rendering. Its pipelines clamp depth, test it and do not
/// write it: GREATER with `reversed_z`, else LESS. Where the test fails they add 1 to the stencil for faces that turn
/// away from the eye and take 1 away for those that turn to it, wrapping. They write no colour.
struct VolumePass {
    VkCommandBuffer commands = VK_NULL_HANDLE;             // to record into
    VkFormat colour = VK_FORMAT_UNDEFINED;                 // of the one colour attachment
    VkFormat depth_stencil = VK_FORMAT_D32_SFLOAT_S8_UINT; // of that attachment, or D24_UNORM_S8_UINT
    bool reversed_z = true;                                // the camera's depth is 1 at the near plane
    const Plan* plan = nullptr;                            // never null
    std::uint32_t light = 0;                               // of the plan
    std::span<const std::uint32_t> casters;                // object indices: all of them must be drawn
    glm::mat4 clip_from_eye{1.0F};                         // the camera's, of points relative to the eye
    glm::dvec3 eye_ws{0.0};                                // metres, world space
    glm::vec4 place{0.0F}; // w = 0: xyz is the unit direction to the light; w = 1: its eye-relative position
};
/// Draws one light's volumes.
using DrawVolumes = std::function<void(const VolumePass&)>;

/// What the host gives for the mask. Images have the usage SAMPLED, are in VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL
/// (depth: also DEPTH_READ_ONLY_OPTIMAL, by `depth_layout`) and their writes are made visible to FRAGMENT_SHADER reads
/// by the host.
struct MaskInputs {
    VkExtent2D extent{};                // of the mask, and of each image here: no larger ones
    VkImageView depth = VK_NULL_HANDLE; // the camera's depth, of a format with stencil the aspect DEPTH, or R32F
    /// Of `depth`: the automatic bias allows for what it rounds away. D16, D24 or D32F, with stencil or without; any
    /// other counts as floats. With 16 bits the bias is metres where the view reaches far.
    VkFormat depth_format = VK_FORMAT_D32_SFLOAT;
    VkImageLayout depth_layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL; // or DEPTH_READ_ONLY_OPTIMAL
    /// Geometric world-space normals, octahedral in RG (snorm or float; gnomon/shared/octahedral.h), or
    /// VK_NULL_HANDLE: then taken from depth.
    VkImageView normal = VK_NULL_HANDLE;
    /// Of `normal`: the automatic bias allows for what it rounds away. RG of 8 or 16 bits (snorm), of 16 or 32
    /// (sfloat); any other counts as 8 bits.
    VkFormat normal_format = VK_FORMAT_R16G16_SNORM;
    /// Of smooth-shaded meshes, in RGB of 16 bits (snorm or float): what gnomonSmoothEncode() gives
    /// (shaders/include/gnomon/smooth_surface.glsl). Then the interpolated normal says whether a surface faces a light,
    /// and its terminator has no steps. VK_NULL_HANDLE: the geometric one says it.
    VkImageView smooth = VK_NULL_HANDLE;
    /// Index of the object in Frame::objects + 1, in R32_UINT, 0 where a receiver wants no shadow at all;
    /// VK_NULL_HANDLE: everything receives. Filters id and depth-id need it, and of more than kMostIdObjects objects
    /// they read the lower 20 bits alone.
    VkImageView object_id = VK_NULL_HANDLE;
    /// The upper 12 bits of `object_id` are the piece of the object, counted from 0 (pixelObject()), as casters have
    /// it. Lights with IdOf::face need it.
    bool object_pieces = false;
    /// Names what all these images show; 0: nobody knows. With the number that the recordMask() before was given, the
    /// host says that they hold what they held then, texel by texel, be they other images or not; a camera that moves
    /// makes another number. recordMask() then leaves the mask as it is, and records nothing, where all else that it is
    /// drawn from is as it was, too: maps, lights and options it compares by itself. So mask() has to stay as it was
    /// left, in content and layout, and a frame that was recorded has to be submitted, or reset() called.
    ContentNumber content = 0;
    /// Draws shadow volumes (VolumeDrawer is such a callback). Needed where the plan has lights with filter volumes.
    DrawVolumes volumes;
};

/// What the host's caster pipelines must be made for.
struct MapPassFormats {
    /// UNDEFINED: depth only. Else fragment shaders write gnomonCasterTexel() to it (gnomon/caster.glsl).
    VkFormat colour = VK_FORMAT_UNDEFINED;
    VkFormat depth = VK_FORMAT_D32_SFLOAT;                 // of the depth attachment
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT; // of both attachments
    /// View not orthographic, into a depth-only map: gl_FragDepth = metric (caster.glsl). With more than one sample,
    /// each has its own: give the metric's input the qualifier `sample` and the pipeline sampleShadingEnable with
    /// minSampleShading 1. A depth that is one for all samples of a texel is wrong where surfaces slope.
    bool write_frag_depth = false;
    /// A map of tints: blended casters alone, and no others. Red, green and blue multiply what is there, and of
    /// alpha, which is the metric, the lesser one stays. Depth is tested and not written; gl_FragDepth = metric.
    bool blended = false;

    bool operator==(const MapPassFormats&) const = default;
};

/// One map to draw, given to the host's callback. With MapPassFormats::blended those of `casters` are to be drawn that
/// are blended, else those that are not. Rendering has begun, viewport and scissor are set. The callback binds its
/// pipelines (made for `formats`) and draws the casters; it must not end rendering.
struct MapPass {
    VkCommandBuffer commands = VK_NULL_HANDLE; // to record into
    MapPassFormats formats;                    // mapFormats() of the light's options and ViewProjection::orthographic
    ClassicPass classic;                       // of use where options ask for a technique that it names
    const Plan* plan = nullptr;                // never null
    const View* view = nullptr;                // the first one that is drawn; never null
    std::uint32_t view_index = 0;              // its place in Plan::views
    /// What the pipeline must write of the colour attachment; 0 for depth-only maps. All of it unless two maps share
    /// one target (ResolvedOptions::paired_maps): then the two halves of a texel get the same value and a part of them
    /// is kept.
    VkColorComponentFlags colour_mask = 0;
    /// Object indices: all that must be drawn; of a map that is kept in two parts those that stand still, or those that
    /// move. In a filterable map these are receivers of the light's groups, too, whether or not they cast
    /// (ObjectFlags::casts): a host that left them out would find bright rims around shadows on them.
    std::span<const std::uint32_t> casters;
    glm::mat4 clip_from_world{1.0F}; // the view's, for vertices in world space
    /// d' = dot(metric_ws, (p, 1)); see gnomonCasterMetric() in gnomon/caster.glsl. Of a paraboloid w alone counts.
    glm::vec4 metric_ws{0.0F};
    /// A view with ViewProjection::gpu_cascade: clip_from_world is its base map's, and a vec4 at this offset, which the
    /// GPU has written, says which part of it the view shows: gnomonCasterPlaced() in gnomon/caster.glsl. A vertex
    /// buffer (to be bound with stride 0, at the rate of instances) and a storage buffer. VK_NULL_HANDLE: none.
    VkBuffer placement = VK_NULL_HANDLE;
    VkDeviceSize placement_offset = 0; // bytes
    /// How many views this pass draws: 1, or with CascadePass::layered several, from view_index on. Then what casts in
    /// view i of them, castersOf(i), is to be drawn to layer i (gl_Layer) with that view's own clip_from_world and
    /// metric from `plan`; casters, clip_from_world, metric_ws and `view` are those of the first. With
    /// ViewProjection::gpu_cascade each has a placement of its own, kPlacementStride bytes after the one before it.
    std::uint32_t view_count = 1;

    /// Of view i of several.
    [[nodiscard]] std::span<const std::uint32_t> castersOf(std::uint32_t i) const
    {
        const View& one = plan->views[view_index + i];
        return std::span(plan->casters).subspan(one.casters.first, one.casters.count);
    }
};
inline constexpr VkDeviceSize kPlacementStride = 48; // bytes
/// Draws one map's casters.
using DrawCasters = std::function<void(const MapPass&)>;

/// What views of such options are drawn in: of ViewProjection::orthographic or not. classicFormats() says the rest.
[[nodiscard]] GNOMON_API MapPassFormats mapFormats(const ResolvedOptions& options, bool orthographic);

/// An image of the renderer's. Holds until the next prepare() that says it made others.
struct ImageRef {
    VkImage image = VK_NULL_HANDLE;                   // null: there is none
    VkImageView view = VK_NULL_HANDLE;                // all layers, 2D array
    VkFormat format = VK_FORMAT_UNDEFINED;            // of image and view
    VkExtent2D extent{};                              // texels
    std::uint32_t layers = 0;                         // array layers
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED; // after the recording that makes it
    std::uint32_t levels = 1;                         // mip levels
};

/// A storage buffer, all of it.
struct BufferRef {
    VkBuffer buffer = VK_NULL_HANDLE; // null: there is none
    VkDeviceSize bytes = 0;           // its size
};

/// Memory that one purpose takes.
struct MemoryUse {
    const char* purpose = ""; // static
    VkDeviceSize bytes = 0;   // as allocated
};

/// What making maps filterable took: counted by the GPU while it worked. Zeros for filters whose maps are not blurred.
struct FilterCost {
    /// Made by both passes: along x each texel of the maps, along y those within reach of a caster.
    std::uint64_t texels = 0;
    /// Reads of images for that, radius r. A block of 32 texels in a row shares them: along x (32 + 2 r) / 32 depths of
    /// each sample for a texel, along y by compute as many texels; by fragment shaders 1 + 2 ceil(r / 2), two texels at
    /// a time, in log space 2 r + 1.
    std::uint64_t taps = 0;
    std::uint64_t bytes_moved = 0; // read from and written to images; a filtered read is of its texels
    /// Depths read once and the map written once, and what the pass along y needs written once and read once between.
    std::uint64_t bytes_minimum = 0;
    BlurPath path = BlurPath::compute; // which shaders blurred
};

/// What one recordMaps() drew and what it did not have to.
struct MapReuse {
    std::uint32_t drawn = 0;           // maps drawn at once
    std::uint32_t together = 0;        // of these, in passes of several (CascadePass::layered)
    std::uint32_t kept_drawn = 0;      // maps of what stands still, drawn into their kept layers
    std::uint32_t restored = 0;        // maps restored from a kept layer, and what moves drawn over that
    std::uint32_t held = 0;            // maps left as they were
    std::uint64_t restored_texels = 0; // copied for that
    std::uint32_t casters_at_once = 0; // in the maps drawn at once; one caster in two maps counts twice
    std::uint32_t still_casters = 0;   // into kept layers
    std::uint32_t moving_casters = 0;  // over what was restored
};

/// What warmUp() makes pipelines for. More than will come costs time and nothing else.
struct WarmUp {
    MaskShape inputs;             // of the mask to come
    bool perspective = true;      // there may be spots, or warps
    bool several_lights = true;   // and not only one
    bool several_options = false; // lights of other options beside them
};

/// What becomes of a wrong call, in every build; nothing is recorded before it is found out:
///   a plan without options, or whose numbers point beyond its own lists or pages    Error
///   a plan recorded that needs other images than the last prepare() made            Error
///   views asked to have tints placed that are fewer than the plan's                 Error
///   a plan that a compact mask cannot hold, a CompactMaskRule that is wrong         Error
///   what an OptionalPart that the device lacks is for                               Error
///   filter smoothies without ShadowRendererOptions::draws_fins                      Error
///   a slot beyond frames_in_flight, frames_in_flight 0 or more than kMostFrames     Error
///   a null command buffer, depth, buffer of views or callback                       Error
///   recordMask() of lights with filter id or depth-id without MaskInputs::object_id  Error
///   of such with IdOf::face without MaskInputs::object_pieces                        Error
///   recordMask() without a mask, of another extent, of a frame with other lights    Error
///   recordMaps(), recordMask() of views with gpu_cascade before recordBounds()      Error
///   questions with a slot, options or a view that there is not                      zeros, or empty
/// Not found out, because only the driver knows: handles of another device, images in another layout, of another format
/// or smaller than said, and a slot whose last frame has not finished.
/// Not found out either: a frame without recordMaps(). Its mask reads what memory held before.
///
/// Draws what a plan says by the options that the plan carries (Plan::options): it has none of its own, so another
/// technique, or another for each light, is another plan. Not thread-safe.
///
/// A call that throws (Error, std::bad_alloc, or what a DrawCasters threw) leaves nothing behind but what frames in
/// flight may use. What was recorded of its frame is not to be submitted. The next prepare() or warmUp() then begins as
/// a new renderer does: all maps are drawn again, all pipelines made again. After Error with ErrorKind::device_lost
/// only the destructor is of use: it destroys what there is, and neither waits nor throws.
class GNOMON_API ShadowRenderer {
public:
    /// Throws Error when a handle of the device or a function is missing or memory runs out.
    explicit ShadowRenderer(const DeviceView& device, const ShadowRendererOptions& options = {});
    /// Does not wait: destroy it when the GPU has finished what it recorded.
    ~ShadowRenderer();
    ShadowRenderer(const ShadowRenderer&) = delete;
    ShadowRenderer& operator=(const ShadowRenderer&) = delete;

    /// Makes the pipelines of maps and masks by these options, so that no prepare() has to: for a moment in which a
    /// hitch does not matter. Throws Error as prepare().
    void warmUp(const ResolvedOptions& options, const WarmUp& what);

    /// Makes images, buffers and pipelines for this plan and screen size where those that are there do not fit; of size
    /// 0 no mask: for a host that has none drawn. To be called before a frame's recordings, not between them. Frames in
    /// flight need not be waited for: what is replaced is kept until every slot that may use it has begun another
    /// frame, and what maps hold is copied into larger images by the next recordMaps(). Returns true when maps(),
    /// tints() or mask() is another image than before: a host that has them in descriptors of its own writes those
    /// anew, whatever the handles are. Throws Error for sizes beyond the device's limits or memory, for a map format
    /// that the device has not what it takes for, and for CascadePass::layered on a device without it
    /// (FeatureUses::layered).
    bool prepare(const Plan& plan, VkExtent2D screen);

    /// What was recorded last is never submitted: the next prepare() begins as a new renderer does.
    void reset();

    /// To be called before recordMaps() for a plan that has views with ViewProjection::gpu_cascade (Error there); does
    /// nothing for others. Fits these views to the camera's depth buffer: of `inputs` depth and, if given, object ids,
    /// whose writes the host has made visible to COMPUTE_SHADER reads too. Nothing waits for the CPU.
    void recordBounds(VkCommandBuffer commands, std::uint32_t slot, const Plan& plan, const MaskInputs& inputs,
                      Profiler* profiler = nullptr);
    /// Records the maps that do not hold what their views want: what ViewContents::redraw and ViewContents::dirty say,
    /// and all of those whose texels are not what ViewContents::presumes says, because a frame was planned and not
    /// recorded, say. `slot` in [0, frames_in_flight): the caller knows that the GPU has finished the last frame
    /// recorded with it.
    void recordMaps(VkCommandBuffer commands, std::uint32_t slot, const Plan& plan, const DrawCasters& draw,
                    Profiler* profiler = nullptr);
    /// Records the mask: every layer, every channel. 1 = fully lit; background 1; lights without a map 1; a surface
    /// that faces away from a light 0. A pixel is at most the share of the light's disc that is over its surface's
    /// horizon; a light without a size, and any light with filter volumes, has a step there at 0.11 degrees. Pixels at
    /// which nothing can be in a spot or point light's reach (pack::screenBounds()) are 1, whichever way their surface
    /// faces: it is not drawn there. Without Frame::objects only a light with a range has such pixels. Afterwards
    /// mask() is readable by FRAGMENT_SHADER, COMPUTE_SHADER and TRANSFER. Nothing is recorded where mask() holds all
    /// this already (MaskInputs::content); of lights whose frames converge, of suns with step-alternate and of views
    /// with ViewProjection::gpu_cascade that is not known.
    void recordMask(VkCommandBuffer commands, std::uint32_t slot, const Plan& plan, const MaskInputs& inputs,
                    Profiler* profiler = nullptr);

    /// Which lights a tile of the mask has and where (shaders/include/gnomon/compact_mask.glsl), of the last
    /// recordMask() with this slot: its buffer may be another one each time, so write descriptors after that. Lights
    /// without a map are listed, too. Empty where the mask is not compact, or there is no such slot.
    [[nodiscard]] BufferRef maskTiles(std::uint32_t slot) const;
    /// With ShadowRendererOptions::compact RGBA8 with a layer for every four channels. Else
    /// R8 for one light, else RGBA8, one layer per four lights and one for each coloured light (LightPlan::mask_layer),
    /// with which a single light's is RGBA8 too; a 2D array in either case.
    [[nodiscard]] ImageRef mask() const;
    /// Of one of the plan's options; an empty one where no light of the plan names
    /// them. After recordMaps() its writes are
    /// visible to FRAGMENT_SHADER and COMPUTE_SHADER reads.
    [[nodiscard]] ImageRef maps(std::uint32_t options = 0) const;
    /// The blocks of those maps (gnomon/shared/map_blocks.h), visible likewise, or with filter or soften smoothies
    /// what gnomon/shared/smoothies.h says. Of other filters than pcss and raymarch, and where maps() is empty, an
    /// empty one.
    [[nodiscard]] ImageRef blocks(std::uint32_t options = 0) const;
    /// The maps of tints beside those maps, for GNOMON_TINTS (shaders/include/gnomon/visibility.glsl), visible
    /// likewise. Empty where no view of the prepared plan with these options has blended casters.
    [[nodiscard]] ImageRef tints(std::uint32_t options = 0) const;
    /// Says in views that pack::fillViews() wrote where in tints() theirs are: GpuView::more.w, which is 0 before.
    /// Throws Error where there are fewer views than the plan's, or the plan needs other images than the last prepare()
    /// made.
    void placeTints(const Plan& plan, std::span<shared::GpuView> views) const;
    /// GpuDepthLayers by pack::depthLayersSlot(), visible likewise. Of other filters than lvsm one that nobody reads.
    /// Empty where maps() is.
    [[nodiscard]] BufferRef depthLayersBuffer(std::uint32_t options = 0) const;
    /// Completes views with ViewProjection::gpu_cascade that pack::fillViews() wrote to a storage buffer of the host's,
    /// all of the plan's from `offset` on: after recordBounds(), and once with a slot. Afterwards they are visible to
    /// FRAGMENT_SHADER and COMPUTE_SHADER reads. Nothing for plans without such views.
    void recordViews(VkCommandBuffer commands, std::uint32_t slot, const Plan& plan, VkBuffer views,
                     VkDeviceSize offset = 0);
    /// What it has allocated, by purpose; valid until it allocates again.
    [[nodiscard]] std::span<const MemoryUse> memory() const;
    /// Of the last recordMaps() that was given this slot, once the GPU has finished it. What that counted is made
    /// visible to the host by recordMaps().
    [[nodiscard]] FilterCost filterCost(std::uint32_t slot) const;
    /// Did the last recordMask() that was given this slot leave the mask as it was?
    [[nodiscard]] bool maskKept(std::uint32_t slot) const;
    /// Of the last recordMaps() that was given this slot.
    [[nodiscard]] MapReuse reuse(std::uint32_t slot) const;
    /// lvsm: the layers of a view of the plan that was recorded last, nearest first, once the GPU has finished
    /// recordMaps(); else empty.
    [[nodiscard]] std::vector<pack::DepthLayer> depthLayers(const Plan& plan, std::uint32_t view) const;
    /// What the last recordBounds() that was given this slot found, by view of its plan, once the GPU has finished it;
    /// of use for views with ViewProjection::gpu_cascade alone (viewAsFitted()). For reports: nothing is drawn from it.
    /// Empty when the plan has no such views.
    [[nodiscard]] std::vector<FittedView> fittedViews(std::uint32_t slot) const;

private:
    struct GNOMON_LOCAL Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace gnomon::vulkan
