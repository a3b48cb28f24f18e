// SPDX-License-Identifier: Apache-2.0
// A frame's drawing as a list of commands. Any graphics API can carry them out: an executor makes images and buffers,
// writes, copies, clears, draws and dispatches, and knows nothing of shadows. The OpenGL backend is one (gl/src), the
// web package another. Modules are those of the kit (docs/kit.md).
//
// Commands run in order, each after the writes of those before it.
#pragma once

#include <gnomon/export.h>
#include <gnomon/pack/filter_rule.h>
#include <gnomon/pack/map_notes.h>
#include <gnomon/plan.h>

#include <glm/vec2.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

namespace gnomon::pack {

/// An image that commands name.
enum class ImageName : std::uint8_t {
    // One each for the maps of one of Plan::options.
    maps,         // what filters read: an array
    kept_depths,  // of maps of still casters: an array
    kept_colours, // the same, where maps have a colour format: an array
    depths,       // where a map's depths are drawn that is no depth image itself
    strips,       // a filterable map on its way through the blur: an array
    blocks,       // of the maps' depths (gnomon/shared/map_blocks.h): an array, level L is mip level L - 1
    // One each for the frame.
    mask,          // an array
    blurred,       // the mask's layer, blurred once: an array of one
    blurred_twice, // the same, blurred twice: an array of one
    no_ids,        // stands in for objects' ids: R32UI, of one texel
    no_blocks,     // stands in for blocks: R32UI, an array of one texel
    // The host's own.
    camera_depth,  // MaskInputs
    camera_normal, // MaskInputs::normals
    camera_smooth, // MaskInputs::smooth
    camera_ids,    // MaskInputs::ids
};
/// A buffer that commands name.
enum class BufferName : std::uint8_t {
    // One each for the maps of one of Plan::options.
    layers,      // GpuDepthLayers, by depthLayersSlot()
    layer_sums,  // numbers on the way to layers
    kernel,      // BlurKernel
    blocks_left, // flags of the blur's blocks
    blur_counts, // BlurCounts
    // One each for the frame.
    constants, // GpuConstants by options, RecorderTraits::uniform_alignment apart
    lights,    // GpuLight
    views,     // GpuView
    pages,     // fillPageTable()
    points,    // of the disc of soften=blur, two to a vector
};
/// An image of one of the plan's options, or of the frame (options 0).
struct ImageRef {
    ImageName name = ImageName::maps; // the kind of image
    std::uint32_t options = 0;        // index into Plan::options
    bool operator==(const ImageRef&) const = default;
};
/// A buffer of one of the plan's options, or of the frame (options 0).
struct BufferRef {
    BufferName name = BufferName::lights; // the kind of buffer
    std::uint32_t options = 0;            // index into Plan::options
    bool operator==(const BufferRef&) const = default;
};

/// The shape of an image.
struct ImageShape {
    std::optional<MapFormat> format; // nothing: R32UI
    glm::uvec2 size_px{0};           // texels; 0: there is no image
    std::uint32_t layers = 0;        // of an array; 0: no array
    std::uint32_t levels = 1;        // mip levels
    std::uint32_t samples = 1;       // of each texel
    bool operator==(const ImageShape&) const = default;
};
/// Elements of a list of the CommandList.
struct CommandRange {
    std::uint32_t first = 0; // the first of them
    std::uint32_t count = 0; // how many
    bool operator==(const CommandRange&) const = default;
};

/// The images and buffers of these options are used no more.
struct DropOptions {
    std::uint32_t options = 0; // index into Plan::options
};
/// Makes an image, cleared to zeros, or to 1 where it has a depth format, in place of one of this name.
struct MakeImage {
    ImageRef image;     // the image
    ImageShape shape;   // its shape
    bool keeps = false; // all texels of the old one, which is no larger, go on in it, as far as it has their levels
};
/// Makes a buffer, in place of one of this name. Its contents are undefined.
struct MakeBuffer {
    BufferRef buffer;         // the buffer
    std::uint64_t bytes = 0;  // its size; a multiple of 16
    std::uint64_t copies = 0; // bytes that the old one hands on, from its beginning
};
/// Writes to a buffer. No list writes the same bytes twice, or after they were read.
struct WriteBuffer {
    BufferRef buffer;         // the buffer
    std::uint64_t offset = 0; // bytes
    CommandRange data;        // CommandList::words
    bool alone = false;       // the buffer's other bytes are read no more
};
/// Sets a buffer to zeros.
struct ZeroBuffer {
    BufferRef buffer; // the buffer
};
/// Copies a rectangle of a layer to a layer of another image of the same format.
struct CopyTexels {
    ImageRef from; // the source
    Tile area;     // the rectangle
    ImageRef to;   // the destination
    Tile place;    // of the same size
};

/// The images that are drawn to, and the part of them.
struct CommandTarget {
    std::optional<ImageRef> colour; // nothing: no colours
    std::uint32_t colour_layer = 0; // its layer
    std::optional<ImageRef> depth;  // nothing: no depths
    std::uint32_t depth_layer = 0;  // its layer
    Tile viewport;                  // texels; its layer is not used
    Tile scissor;                   // the part that may change
    std::uint32_t channels = 0xF;   // bit i: channel i of colour is written
};
/// Sets colours, the channels that are written, to 1 and depths to 1, inside of the scissor.
struct ClearTarget {
    CommandTarget target; // what is cleared
};
/// The host draws casters, with a depth test of less or equal, as door 3 of docs/integrating.md says.
struct DrawMapCasters {
    CommandTarget target;                 // where
    std::uint32_t view = 0;               // index into Plan::views
    CasterShare share = CasterShare::all; // castersOf()
};

/// The kind of a binding.
enum class BindingKind : std::uint8_t { texture, storage_image, uniform, storage };
/// An image or a buffer, as a module reads or writes it. A module may have fewer than a command binds.
struct CommandBinding {
    std::uint32_t binding = 0;               // number in set 0 of the SPIR-V module
    BindingKind kind = BindingKind::texture; // the kind
    ImageRef image;                          // texture, storage_image
    std::uint32_t level = kNoIndex;          // its mip level; kNoIndex: a texture of all levels
    bool linear = false;                     // texture: linear within and between levels; else the nearest; clamps
    BufferRef buffer;                        // uniform, storage
    std::uint64_t offset = 0;                // uniform: bytes
    std::uint64_t bytes = 0;                 // uniform: of the block; 0: the whole buffer
};
/// Draws three vertices without a vertex buffer: a triangle over the viewport. No depth test.
struct DrawTriangle {
    CommandTarget target;      // where
    std::string_view vertex;   // module: "mask.vert"
    std::string_view fragment; // module: "mask_pcf.frag"
    CommandRange constants;    // CommandList::words: specialization constants, by their ids from 0 on
    CommandRange push;         // CommandList::words: push constants
    CommandRange bindings;     // CommandList::bindings
    bool least = false;        // the lesser of the old and the new value stays: blending MIN
};
/// Runs a compute module.
struct RunCompute {
    std::string_view module;               // "moments.comp"
    CommandRange constants;                // as DrawTriangle
    CommandRange push;                     // as DrawTriangle
    CommandRange bindings;                 // as DrawTriangle
    std::array<std::uint32_t, 3> groups{}; // along x, y, z
};

/// One command.
using Command = std::variant<DropOptions, MakeImage, MakeBuffer, WriteBuffer, ZeroBuffer, CopyTexels, ClearTarget,
                             DrawMapCasters, DrawTriangle, RunCompute>;
/// Commands, in order, and the lists that they point into.
struct CommandList {
    std::vector<Command> commands;        // run one after the other
    std::vector<CommandBinding> bindings; // of draws and dispatches
    std::vector<std::uint32_t> words;     // constants, push constants, data of buffers

    /// Keeps its memory.
    void clear()
    {
        commands.clear();
        bindings.clear();
        words.clear();
    }
};

/// Limits of an executor's device.
struct RecorderTraits {
    std::uint32_t most_layers = 256;       // of an array of images
    std::uint32_t uniform_alignment = 256; // of offsets in uniform buffers, bytes
    bool in_software = false;              // a software rasteriser draws: modules do otherwise then
    bool one_view = false;                 // there are the modules mask_FILTER_one.frag and mask_numbers_one.vert
};
/// The host's images for a mask, besides the camera's depth. All have the size that prepare() was given.
struct RecorderInputs {
    bool normals = false;    // there are world-space normals, octahedral
    bool smooth = false;     // there are smooth surfaces (gnomon/smooth_surface.glsl)
    bool ids = false;        // there are objects' ids: index in Frame::objects + 1
    DrawPrecision precision; // of casters, depth and normals
};
/// The maps that drawMaps() drew, and those that it did not have to.
struct RecordedMaps {
    std::uint32_t drawn = 0;      // maps drawn at once
    std::uint32_t kept_drawn = 0; // maps of still casters, drawn into their kept layers
    std::uint32_t restored = 0;   // maps restored from a kept layer, with moving casters drawn over it
    std::uint32_t held = 0;       // maps left as they were
};

/// Records the commands of plan after plan, for one executor. It knows what images there are and what they hold. Not
/// thread-safe. Each call appends to `out`; what it appends runs before what the next call appends. Names of modules
/// hold as long as the recorder.
///
/// Throws Error from prepare() for what it does not record, with a sentence: partition sdsm and paraboloid, classic
/// filters (id, depth-id, smoothies, volumes), soften smoothies and converge, motion step-alternate, caster-faces
/// midpoint, cascades.pass=layered, mask-size=half and blur-path=fragment; and for a plan whose numbers point beyond
/// its own lists.
class GNOMON_API FrameRecorder {
public:
    /// For an executor with these limits.
    explicit FrameRecorder(const RecorderTraits& traits);
    ~FrameRecorder();
    FrameRecorder(const FrameRecorder&) = delete;
    FrameRecorder& operator=(const FrameRecorder&) = delete;

    /// Images and buffers for this plan, and a mask of this size; no mask for size 0. True where maps or mask are other
    /// images than before.
    bool prepare(const Plan& plan, glm::uvec2 size_px, CommandList& out);
    /// The maps that are out of date. Throws Error for a plan that needs other images than the last prepare() made.
    void drawMaps(const Plan& plan, CommandList& out);
    /// The mask: every layer, every channel, 1 = fully lit. Throws Error as drawMaps(), and where prepare() made no
    /// mask.
    void drawMask(const Plan& plan, const RecorderInputs& inputs, CommandList& out);
    /// The contents of maps are lost, because an executor failed or its device lost them: all are drawn again.
    void lose();
    /// All images and buffers are gone. The next call must be prepare().
    void loseImages();

    /// The shape of an image; size 0: there is none.
    [[nodiscard]] ImageShape shapeOf(const ImageRef& image) const;
    /// By the last drawMaps().
    [[nodiscard]] RecordedMaps recorded() const;

private:
    struct GNOMON_LOCAL Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace gnomon::pack
