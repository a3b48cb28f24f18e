// SPDX-License-Identifier: Apache-2.0
// Makes a visibility mask from a Plan: records shadow-map passes and the mask pass into the caller's command buffer.
// Never submits, never waits, never owns the device.
#pragma once

#include <gnomon/export.h>
#include <gnomon/frame.h>
#include <gnomon/options.h>
#include <gnomon/pack/compact_mask.h>
#include <gnomon/pack/depth_layers.h>
#include <gnomon/plan.h>
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

class Classics;     // <gnomon/vulkan/classics.h>
struct ClassicPass; // <gnomon/vulkan/classic_pass.h>

/// The images that MaskInputs has besides the camera's depth.
struct MaskShape {
    bool normals = false; // MaskInputs::normal is given
    bool ids = false;     // MaskInputs::object_id is given
    bool smooth = false;  // MaskInputs::smooth is given

    bool operator==(const MaskShape&) const = default;
};

inline constexpr std::uint32_t kMostFrames = 64; // most frames in flight

/// How a ShadowRenderer is made.
struct ShadowRendererOptions {
    /// The shape of the inputs to come. With it prepare() makes the mask's pipelines. Nothing: the first recordMask()
    /// makes those that it needs, which takes as long as the driver compiles.
    std::optional<MaskShape> mask_shape;
    std::uint32_t frames_in_flight = 2;              // 1 .. kMostFrames
    VkPipelineCache pipeline_cache = VK_NULL_HANDLE; // may be null
    /// Does the object with this index of the plan's lists draw blended casters, which tint light instead of blocking
    /// it? Views with such casters get a map of tints beside their map, and the mask holds the luminance of the light
    /// that arrives, or its colour as well (ShadowOptions::translucent). prepare() calls this for each caster of a
    /// plan. Null: nothing is blended, and there are no maps of tints.
    std::function<bool(std::uint32_t object)> is_blended;
    /// With channels 4 or 8 the mask is compact: one or two layers of RGBA8, however many lights there are. maskTiles()
    /// says which light is in which channel of a tile of the screen. Suns that move in steps, lights whose frames
    /// converge, lights with filter volumes, those whose mask is blurred and lights in colour are refused (Error from
    /// prepare()), and so are more than 65,535 lights.
    pack::CompactMaskRule compact;
    /// Shows the cost of rays: the mask of lights with filter raymarch holds, instead of visibility, 0.25 where blocks
    /// decided without a ray, 0.5 where all wanted rays were marched, 0.75 where there were fewer or some ended early
    /// (lib/raymarch.glsl), and a value between them where a pixel reads two cascades. Pixels that face away from the
    /// light are 0 as usual, and pixels in no map 1.
    bool shows_rays = false;
    /// Classic techniques, by makeClassics() of the library gnomon::vulkan_classics. Null: prepare() refuses plans with
    /// options that name one (<gnomon/vulkan/classics.h> lists them).
    std::shared_ptr<const Classics> classics;
};

/// The host's inputs of the mask. Images have the usage SAMPLED, are in VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL
/// (depth: also DEPTH_READ_ONLY_OPTIMAL, by `depth_layout`) and their writes are made visible to FRAGMENT_SHADER reads
/// by the host.
struct MaskInputs {
    VkExtent2D extent{};                // size of the mask, and of each image here: no larger ones
    VkImageView depth = VK_NULL_HANDLE; // the camera's depth (aspect DEPTH of a format with stencil), or R32F
    /// The format of `depth`: the automatic bias allows for its rounding. D16, D24 or D32F, with stencil or without;
    /// any other counts as floats. With 16 bits the bias is metres where the view reaches far.
    VkFormat depth_format = VK_FORMAT_D32_SFLOAT;
    VkImageLayout depth_layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL; // or DEPTH_READ_ONLY_OPTIMAL
    /// Geometric world-space normals, octahedral in RG (snorm or float; gnomon/shared/octahedral.h), or
    /// VK_NULL_HANDLE: then taken from depth.
    VkImageView normal = VK_NULL_HANDLE;
    /// The format of `normal`: the automatic bias allows for its rounding. RG of 8 or 16 bits (snorm), or of 16 or 32
    /// (sfloat); any other counts as 8 bits.
    VkFormat normal_format = VK_FORMAT_R16G16_SNORM;
    /// For smooth-shaded meshes: the result of gnomonSmoothEncode() (shaders/include/gnomon/smooth_surface.glsl), in
    /// RGB of 16 bits (snorm or float). Then the interpolated normal decides whether a surface faces a light, and the
    /// terminator has no steps. VK_NULL_HANDLE: the geometric normal decides.
    VkImageView smooth = VK_NULL_HANDLE;
    /// Index of the object in Frame::objects + 1, in R32_UINT, 0 where a receiver wants no shadow at all;
    /// VK_NULL_HANDLE: everything receives. Filters id and depth-id need it, and read only its lower 20 bits, which are
    /// enough for kMostIdObjects objects.
    VkImageView object_id = VK_NULL_HANDLE;
    /// The upper 12 bits of `object_id` are the piece of the object, counted from 0 (pixelObject()), the same as for
    /// casters. Lights with IdOf::face need it.
    bool object_pieces = false;
    /// Names the contents of all these images; 0: unknown. The number of the last recordMask() says that the images, or
    /// others in their place, hold the same texels as then; a camera that moves needs another number. Where maps,
    /// lights and options are the same too, which recordMask() compares by itself, it records nothing and leaves the
    /// mask as it is. So mask() has to stay as it was left, in content and layout, and a recorded frame has to be
    /// submitted, or reset() called.
    ContentNumber content = 0;
};

/// The formats that the host's caster pipelines must be made for.
struct MapPassFormats {
    /// UNDEFINED: depth only. Else fragment shaders write gnomonCasterTexel() to it (gnomon/caster.glsl).
    VkFormat colour = VK_FORMAT_UNDEFINED;
    VkFormat depth = VK_FORMAT_D32_SFLOAT;                 // format of the depth attachment
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT; // samples of both attachments
    /// View not orthographic, into a depth-only map: gl_FragDepth = metric (caster.glsl). With more than one sample,
    /// each has its own: give the metric's input the qualifier `sample` and the pipeline sampleShadingEnable with
    /// minSampleShading 1. One depth for all samples of a texel is wrong where surfaces slope.
    bool write_frag_depth = false;
    /// A map of tints, with blended casters alone. Red, green and blue multiply the attachment's; alpha, which is the
    /// metric, keeps the lesser value. Depth is tested and not written; gl_FragDepth = metric.
    bool blended = false;

    bool operator==(const MapPassFormats&) const = default;
};

/// One map to draw, given to the host's callback. With MapPassFormats::blended draw only the blended ones of `casters`,
/// else only the others. Rendering has begun, viewport and scissor are set. The callback binds its pipelines (made for
/// `formats`) and draws the casters; it must not end rendering.
struct MapPass {
    VkCommandBuffer commands = VK_NULL_HANDLE; // to record into
    MapPassFormats formats;                    // mapFormats() of the light's options and ViewProjection::orthographic
    /// Null, unless options have CasterFaces, CasterCull or a classic technique that asks for more.
    const ClassicPass* classic = nullptr;
    const Plan* plan = nullptr;   // never null
    const View* view = nullptr;   // the first one that is drawn; never null
    std::uint32_t view_index = 0; // its place in Plan::views
    /// The channels of the colour attachment that the pipeline must write; 0 for depth-only maps. All channels unless
    /// two maps share one target (ResolvedOptions::paired_maps): then both halves of a texel get the same value and
    /// `colour_mask` keeps one of them.
    VkColorComponentFlags colour_mask = 0;
    /// Object indices: all that must be drawn; for a map that is kept in two parts either the still ones or the moving
    /// ones. In a filterable map these include receivers of the light's groups, whether or not they cast
    /// (ObjectFlags::casts): without them there would be bright rims around the shadows that they receive.
    std::span<const std::uint32_t> casters;
    glm::mat4 clip_from_world{1.0F}; // the view's, for vertices in world space
    /// d' = dot(metric_ws, (p, 1)); see gnomonCasterMetric() in gnomon/caster.glsl. For a paraboloid only w counts.
    glm::vec4 metric_ws{0.0F};
    /// A view with ViewProjection::gpu_cascade: clip_from_world is its base map's, and a vec4 at this offset, which the
    /// GPU has written, gives the part of it that the view shows: gnomonCasterPlaced() in gnomon/caster.glsl. A vertex
    /// buffer (to be bound with stride 0, at the rate of instances) and a storage buffer. VK_NULL_HANDLE: none.
    VkBuffer placement = VK_NULL_HANDLE;
    VkDeviceSize placement_offset = 0; // bytes
    /// How many views this pass draws: 1, or with CascadePass::layered several, from view_index on. Then draw the
    /// casters of each view i, castersOf(i), to layer i (gl_Layer) with that view's own clip_from_world and metric from
    /// `plan`; casters, clip_from_world, metric_ws and `view` are those of the first. With ViewProjection::gpu_cascade
    /// each has a placement of its own, kPlacementStride bytes after the one before it.
    std::uint32_t view_count = 1;

    /// The casters of view i of several.
    [[nodiscard]] std::span<const std::uint32_t> castersOf(std::uint32_t i) const
    {
        const View& one = plan->views[view_index + i];
        return std::span(plan->casters).subspan(one.casters.first, one.casters.count);
    }
};
inline constexpr VkDeviceSize kPlacementStride = 48; // bytes
/// Draws one map's casters.
using DrawCasters = std::function<void(const MapPass&)>;

/// The formats that views with these options are drawn in. `orthographic`: ViewProjection::orthographic.
/// classicFormats() has what ClassicPass adds.
[[nodiscard]] GNOMON_API MapPassFormats mapFormats(const ResolvedOptions& options, bool orthographic);

/// An image of the renderer's. Holds until the next prepare() that says it made others.
struct ImageRef {
    VkImage image = VK_NULL_HANDLE;                   // null: there is none
    VkImageView view = VK_NULL_HANDLE;                // all layers, 2D array
    VkFormat format = VK_FORMAT_UNDEFINED;            // format of image and view
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

/// The cost of making maps filterable, counted by the GPU while it works. Zeros for filters whose maps are not blurred.
struct FilterCost {
    /// Texels made by both passes: along x each texel of the maps, along y those within reach of a caster.
    std::uint64_t texels = 0;
    /// Reads of images for these texels, with blur radius r. A block of 32 texels in a row shares reads: along x (32 +
    /// 2 r) / 32 depths of each sample for a texel, and along y by compute as many texels. Fragment shaders read 1 + 2
    /// ceil(r / 2) times, two texels at a time, or in log space 2 r + 1 times.
    std::uint64_t taps = 0;
    std::uint64_t bytes_moved = 0; // read from and written to images; a filtered read counts all its texels
    /// The least that could be moved: depths read once, the map written once, and the input of the pass along y written
    /// once and read once.
    std::uint64_t bytes_minimum = 0;
    BlurPath path = BlurPath::compute; // which shaders blurred
};

/// The maps that one recordMaps() drew, and those that it did not have to.
struct MapReuse {
    std::uint32_t drawn = 0;           // maps drawn at once
    std::uint32_t together = 0;        // maps of these in passes of several (CascadePass::layered)
    std::uint32_t kept_drawn = 0;      // maps of still casters, drawn into their kept layers
    std::uint32_t restored = 0;        // maps restored from a kept layer, with moving casters drawn over it
    std::uint32_t held = 0;            // maps left as they were
    std::uint64_t restored_texels = 0; // texels copied for that
    std::uint32_t casters_at_once = 0; // in the maps drawn at once; one caster in two maps counts twice
    std::uint32_t still_casters = 0;   // casters drawn into kept layers
    std::uint32_t moving_casters = 0;  // casters drawn over restored maps
};

/// The uses that warmUp() makes pipelines for. Uses that never come cost time and nothing else.
struct WarmUp {
    MaskShape inputs;             // the shape of the mask's inputs to come
    bool perspective = true;      // there may be spots, or warps
    bool several_lights = true;   // there may be several lights, and not only one
    bool several_options = false; // lights with other options beside them
};

/// The effect of a wrong call, in every build; nothing is recorded before it is found:
///   a plan without options, or whose numbers point beyond its own lists or pages    Error
///   a plan recorded that needs other images than the last prepare() made            Error
///   views asked to have tints placed that are fewer than the plan's                 Error
///   a plan that a compact mask cannot hold, a CompactMaskRule that is wrong         Error
///   what an OptionalPart that the device lacks is for                               Error
///   a classic technique without ShadowRendererOptions::classics                     Error
///   a slot beyond frames_in_flight, frames_in_flight 0 or more than kMostFrames     Error
///   a null command buffer, depth, buffer of views or callback                       Error
///   recordMask() of lights with filter id or depth-id without MaskInputs::object_id  Error
///   of such with IdOf::face without MaskInputs::object_pieces                        Error
///   recordMask() without a mask, of another extent, of a frame with other lights    Error
///   recordMaps(), recordMask() of views with gpu_cascade before recordBounds()      Error
///   questions with a slot, options or a view that there is not                      zeros, or empty
/// Not checked, because only the driver knows: handles of another device, images in another layout, of another format
/// or smaller than given, and a slot whose last frame has not finished. A frame without recordMaps() is not found
/// either: its mask reads the old contents of memory.
///
/// Draws a plan by the options that the plan carries (Plan::options). It has no options of its own: another technique,
/// or one for each light, takes only another plan. Not thread-safe.
///
/// A call that throws (Error, std::bad_alloc, or an exception of a DrawCasters) leaves nothing behind except what
/// frames in flight may use. The commands of its frame must not be submitted. The next prepare() or warmUp() then
/// begins as a new renderer does: all maps are drawn again, all pipelines made again. After Error with
/// ErrorKind::device_lost only the destructor may be called: it destroys everything, and neither waits nor throws.
class GNOMON_API ShadowRenderer {
public:
    /// Throws Error when a handle of the device or a function is missing or memory runs out.
    explicit ShadowRenderer(const DeviceView& device, const ShadowRendererOptions& options = {});
    /// Does not wait: destroy it when the GPU has finished what it recorded.
    ~ShadowRenderer();
    ShadowRenderer(const ShadowRenderer&) = delete;
    ShadowRenderer& operator=(const ShadowRenderer&) = delete;

    /// Makes the pipelines of maps and masks with these options at a moment in which a hitch does not matter, so that
    /// no prepare() has to. Throws the same Errors as prepare().
    void warmUp(const ResolvedOptions& options, const WarmUp& what);

    /// Makes images, buffers and pipelines for this plan and screen size where the existing ones do not fit; no mask
    /// for size 0, for a host that has none drawn. To be called before a frame's recordings, not between them. Frames
    /// in flight need not be waited for: replaced objects are kept until every slot that may use them has begun another
    /// frame, and the next recordMaps() copies the contents of maps into larger images. Returns true when maps(),
    /// tints() or mask() is another image than before: a host must then rewrite its own descriptors of them, whatever
    /// the handles are. Throws Error for sizes beyond the device's limits or memory, for a map format that the device
    /// does not support, and for CascadePass::layered on a device without it (FeatureUses::layered).
    bool prepare(const Plan& plan, VkExtent2D screen);

    /// Call it where the last recording is never submitted: the next prepare() begins as a new renderer does.
    void reset();

    /// To be called before recordMaps() for a plan that has views with ViewProjection::gpu_cascade (Error there); does
    /// nothing for others. Fits these views to the camera's depth buffer. It reads depth and, if given, object ids of
    /// `inputs`, whose writes the host has made visible to COMPUTE_SHADER reads too. Nothing waits for the CPU.
    void recordBounds(VkCommandBuffer commands, std::uint32_t slot, const Plan& plan, const MaskInputs& inputs,
                      Profiler* profiler = nullptr);
    /// Records the maps that are out of date: the parts in ViewContents::redraw and ViewContents::dirty, and all of a
    /// map whose contents are not ViewContents::presumes, for example because a frame was planned and not recorded.
    /// `slot` in [0, frames_in_flight): the caller knows that the GPU has finished the last frame recorded with it.
    void recordMaps(VkCommandBuffer commands, std::uint32_t slot, const Plan& plan, const DrawCasters& draw,
                    Profiler* profiler = nullptr);
    /// Records the mask: every layer, every channel. 1 = fully lit; background 1; lights without a map 1; a surface
    /// that faces away from a light 0. A pixel is at most the share of the light's disc above its surface's horizon; a
    /// light without a size, and any light with filter volumes, has a step there at 0.11 degrees. Pixels outside of a
    /// spot or point light's reach (pack::screenBounds()) are 1, whichever way their surface faces, because the light
    /// is not drawn there. Without Frame::objects only a light with a range has such pixels. Afterwards mask() is
    /// readable by FRAGMENT_SHADER, COMPUTE_SHADER and TRANSFER. Nothing is recorded where mask() is up to date
    /// (MaskInputs::content). It is always recorded for lights whose frames converge, suns with step-alternate and
    /// views with ViewProjection::gpu_cascade.
    void recordMask(VkCommandBuffer commands, std::uint32_t slot, const Plan& plan, const MaskInputs& inputs,
                    Profiler* profiler = nullptr);

    /// The lights of each tile of the mask and their channels (shaders/include/gnomon/compact_mask.glsl), for the last
    /// recordMask() with this slot. The buffer may be another one each time, so write descriptors after that call.
    /// Lights without a map are listed, too. Empty where the mask is not compact, or there is no such slot.
    [[nodiscard]] BufferRef maskTiles(std::uint32_t slot) const;
    /// With ShadowRendererOptions::compact RGBA8 with a layer for every four channels. Else
    /// R8 for one light, else RGBA8, one layer per four lights and one for each coloured light (LightPlan::mask_layer),
    /// with which a single light's is RGBA8 too; a 2D array in either case.
    [[nodiscard]] ImageRef mask() const;
    /// The maps of one of the plan's options; empty where no light of the plan names them. After recordMaps() its
    /// writes are visible to FRAGMENT_SHADER and COMPUTE_SHADER reads.
    [[nodiscard]] ImageRef maps(std::uint32_t options = 0) const;
    /// The blocks of the maps of `options` (gnomon/shared/map_blocks.h), or with filter or soften smoothies the image
    /// of gnomon/shared/smoothies.h. It is visible to the same reads as maps(). Empty for other filters than pcss and
    /// raymarch, and where maps() is empty.
    [[nodiscard]] ImageRef blocks(std::uint32_t options = 0) const;
    /// The maps of tints beside maps(), for GNOMON_TINTS (shaders/include/gnomon/visibility.glsl), visible to the same
    /// reads. Empty where no view of the prepared plan with these options has blended casters.
    [[nodiscard]] ImageRef tints(std::uint32_t options = 0) const;
    /// Writes the place in tints() to views that pack::fillViews() wrote: GpuView::more.w, which is 0 before. Throws
    /// Error where there are fewer views than the plan's, or the plan needs other images than the last prepare() made.
    void placeTints(const Plan& plan, std::span<shared::GpuView> views) const;
    /// GpuDepthLayers by pack::depthLayersSlot(), visible to the same reads as maps(). For other filters than lvsm it
    /// is a buffer that nobody reads. Empty where maps() is.
    [[nodiscard]] BufferRef depthLayersBuffer(std::uint32_t options = 0) const;
    /// Completes views with ViewProjection::gpu_cascade that pack::fillViews() wrote to a storage buffer of the host's,
    /// all of the plan's from `offset` on. Call it after recordBounds(), once with a slot. Afterwards they are visible
    /// to FRAGMENT_SHADER and COMPUTE_SHADER reads. Does nothing for plans without such views.
    void recordViews(VkCommandBuffer commands, std::uint32_t slot, const Plan& plan, VkBuffer views,
                     VkDeviceSize offset = 0);
    /// Its allocated memory, by purpose; valid until it allocates again.
    [[nodiscard]] std::span<const MemoryUse> memory() const;
    /// The cost of the last recordMaps() with this slot, once the GPU has finished it. recordMaps() makes the counts
    /// visible to the host.
    [[nodiscard]] FilterCost filterCost(std::uint32_t slot) const;
    /// Did the last recordMask() with this slot leave the mask as it was?
    [[nodiscard]] bool maskKept(std::uint32_t slot) const;
    /// For Frame::requests: what the last recordMask() with this slot has shown of lights of partition virtual, once
    /// the GPU has finished it. They hold until the next recordMask() with it, or prepare(). Empty without such lights,
    /// and where the mask is compact.
    [[nodiscard]] std::span<const PageRequests> pageRequests(std::uint32_t slot) const;
    /// The maps that the last recordMaps() with this slot drew and kept.
    [[nodiscard]] MapReuse reuse(std::uint32_t slot) const;
    /// lvsm: the layers of a view of the plan that was recorded last, nearest first, once the GPU has finished
    /// recordMaps(); else empty.
    [[nodiscard]] std::vector<pack::DepthLayer> depthLayers(const Plan& plan, std::uint32_t view) const;
    /// The fits that the last recordBounds() with this slot found, by view of its plan, once the GPU has finished it;
    /// valid only for views with ViewProjection::gpu_cascade (viewAsFitted()). For reports: nothing is drawn from it.
    /// Empty when the plan has no such views.
    [[nodiscard]] std::vector<FittedView> fittedViews(std::uint32_t slot) const;

private:
    struct GNOMON_LOCAL Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace gnomon::vulkan
