// SPDX-License-Identifier: Apache-2.0
// A frame's drawing as a list of commands that a host carries out with its own graphics API and the modules of the kit
// (docs/kit.md): gnomon/pack/frame_commands.h for hosts in C. gnomon.h includes this and says what holds for all of it.
#ifndef GNOMON_GNOMON_COMMANDS_H
#define GNOMON_GNOMON_COMMANDS_H

#include <gnomon/gnomon_data.h>

#include <stdint.h>

// NOLINTBEGIN(modernize-use-using): C has no other name for a struct.

/// An image that commands name (pack::ImageName, which says more). Each is drawn to, sampled and copied as its format
/// allows; strips, blocks and the maps of filterable filters are stored to. Row 0 is where clip space's y is -1. The
/// host's have the mask's size.
typedef enum GnomonImageName {
    GNOMON_IMAGE_MAPS = 0,           // of one of the planner's options: what filters read
    GNOMON_IMAGE_KEPT_DEPTHS = 1,    // of the options: maps of still casters
    GNOMON_IMAGE_KEPT_COLOURS = 2,   // of the options: the same, where maps have a colour format
    GNOMON_IMAGE_DEPTHS = 3,         // of the options: where depths are drawn, beside a map that is no depth image
    GNOMON_IMAGE_STRIPS = 4,         // of the options: a filterable map on its way through the blur
    GNOMON_IMAGE_BLOCKS = 5,         // of the options: blocks of the maps' depths
    GNOMON_IMAGE_MASK = 6,           // of the frame
    GNOMON_IMAGE_BLURRED = 7,        // of the frame: a layer of the mask, blurred once
    GNOMON_IMAGE_BLURRED_TWICE = 8,  // of the frame: blurred twice
    GNOMON_IMAGE_NO_IDS = 9,         // of the frame: stands in for ids of objects
    GNOMON_IMAGE_NO_BLOCKS = 10,     // of the frame: stands in for blocks
    GNOMON_IMAGE_CAMERA_DEPTH = 11,  // the host's: depths of its camera
    GNOMON_IMAGE_CAMERA_NORMAL = 12, // the host's: GNOMON_HAS_NORMALS
    GNOMON_IMAGE_CAMERA_SMOOTH = 13, // the host's: GNOMON_HAS_SMOOTH
    GNOMON_IMAGE_CAMERA_IDS = 14,    // the host's: GNOMON_HAS_IDS
} GnomonImageName;
/// A buffer that commands name (pack::BufferName).
typedef enum GnomonBufferName {
    GNOMON_OF_LAYERS = 0,      // of one of the planner's options: layers of lvsm
    GNOMON_OF_LAYER_SUMS = 1,  // of the options: numbers on the way to layers
    GNOMON_OF_KERNEL = 2,      // of the options: weights of the blur
    GNOMON_OF_BLOCKS_LEFT = 3, // of the options: flags of the blur's blocks
    GNOMON_OF_BLUR_COUNTS = 4, // of the options: counts of the blur
    GNOMON_OF_CONSTANTS = 5,   // of the frame: GpuConstants by options
    GNOMON_OF_LIGHTS = 6,      // of the frame: GpuLight
    GNOMON_OF_VIEWS = 7,       // of the frame: GpuView
    GNOMON_OF_PAGES = 8,       // of the frame: the table of pages
    GNOMON_OF_POINTS = 9,      // of the frame: the points of the blur on the screen
} GnomonBufferName;

/// The kind of a command; the members of GnomonCommand that it has are named beside it. The target is colour,
/// colour_layer, depth, depth_layer, viewport, scissor and channels. Viewports have depths 0 to 1, nothing is culled.
typedef enum GnomonCommandKind {
    GNOMON_DROP_OPTIONS = 0,  // options: the commands that follow use its images and buffers no more
    GNOMON_MAKE_IMAGE = 1,    // image, format, size_px, layers, levels, samples, keeps; it starts as 0, depths as 1
    GNOMON_MAKE_BUFFER = 2,   // buffer, bytes, copies; the rest is undefined
    GNOMON_WRITE_BUFFER = 3,  // buffer, offset, data, alone; no list writes bytes twice, or after they were read
    GNOMON_ZERO_BUFFER = 4,   // buffer: all of it
    GNOMON_COPY_TEXELS = 5,   // image, area, to, place: of one format and one size
    GNOMON_CLEAR_TARGET = 6,  // the target: in its scissor depths and the channels that are written become 1
    GNOMON_DRAW_CASTERS = 7,  // the target, view, casters, caster_count, share; depth test less or equal, written
    GNOMON_DRAW_TRIANGLE = 8, // the target, vertex, module, constants, push, bindings, least; 3 vertices, no depth test
    GNOMON_RUN_COMPUTE = 9,   // module, constants, push, bindings, groups
} GnomonCommandKind;
/// Which of a view's casters.
typedef enum GnomonCasterShare { GNOMON_ALL = 0, GNOMON_STILL = 1, GNOMON_MOVING = 2 } GnomonCasterShare;

/// A command (pack::Command). Images and buffers are named by two numbers: GnomonImageName or GnomonBufferName, and
/// the index of the planner's options, 0 for those of the frame. Rectangles are layer, x, y, width, height in texels.
/// Ranges are the first element and how many, of a list of GnomonCommandList.
typedef struct GnomonCommand {
    uint32_t kind;           // GnomonCommandKind
    uint32_t options;        // index of the planner's options
    uint32_t image[2];       // made, or copied from
    uint32_t to[2];          // copied to
    uint32_t buffer[2];      // made, written or set to zeros
    uint32_t size_px[2];     // of an image, texels
    uint32_t layers;         // of an array of images; 0: no array
    uint32_t levels;         // mip levels
    uint32_t samples;        // of each texel
    uint32_t keeps;          // the old image's texels go on in the new one's place
    uint64_t bytes;          // of a buffer
    uint64_t copies;         // bytes that the old buffer hands on, from its beginning
    uint64_t offset;         // where a buffer is written, bytes
    uint32_t data[2];        // range of words: what is written
    uint32_t alone;          // the buffer's other bytes are read no more
    uint32_t area[5];        // rectangle to copy
    uint32_t place[5];       // rectangle to copy to
    uint32_t colour[2];      // of the target; GNOMON_NO_INDEX: no colours
    uint32_t colour_layer;   // its layer
    uint32_t depth[2];       // of the target; GNOMON_NO_INDEX: no depths
    uint32_t depth_layer;    // its layer
    uint32_t viewport[4];    // x, y, width, height
    uint32_t scissor[4];     // x, y, width, height
    uint32_t channels;       // bit i: channel i of colour is written
    uint32_t view;           // index of a view
    uint32_t share;          // GnomonCasterShare
    uint32_t caster_count;   // how many casters
    uint32_t least;          // the lesser of the old and the new value stays: blending MIN
    uint32_t constants[2];   // range of words: specialization constants by id, from 0 on; modules lack some
    uint32_t push[2];        // range of words: push constants of both stages, at most 128 bytes
    uint32_t bindings[2];    // range of bindings
    uint32_t groups[3];      // of a compute module, along x, y, z
    uint32_t reserved;       // 0
    const uint32_t* casters; // indices of objects
    const char* format;      // of an image: a value of the option map-format, or "r32ui"
    const char* vertex;      // module: "mask.vert"; for "mask_numbers.vert" take "mask.vert" unless in SPIR-V
    const char* module;      // fragment or compute module: "mask_pcf.frag"
} GnomonCommand;

/// The kind of a binding (pack::BindingKind).
typedef enum GnomonBindingKind {
    GNOMON_TEXTURE = 0,       // image, level, linear
    GNOMON_STORAGE_IMAGE = 1, // image, level
    GNOMON_UNIFORM = 2,       // buffer, offset, bytes
    GNOMON_STORAGE = 3,       // buffer
} GnomonBindingKind;
/// An image or a buffer, as a module reads or writes it (pack::CommandBinding).
typedef struct GnomonBinding {
    uint32_t binding;   // number in set 0 of the SPIR-V module, which may lack it
    uint32_t kind;      // GnomonBindingKind
    uint32_t image[2];  // as in GnomonCommand
    uint32_t buffer[2]; // as in GnomonCommand
    uint32_t level;     // mip level; GNOMON_NO_INDEX: all
    uint32_t linear;    // linear within and between levels; else the nearest texel. Both clamp to the edge
    uint64_t offset;    // of a uniform block, bytes
    uint64_t bytes;     // of the block; 0: the whole buffer
} GnomonBinding;
/// Commands, in order, and the lists that they point into.
typedef struct GnomonCommandList {
    const GnomonCommand* commands; // run one after the other, each after the writes of those before it
    const GnomonBinding* bindings; // of draws and dispatches
    const uint32_t* words;         // constants, push constants, data of buffers
    uint32_t command_count;        // how many
    uint32_t binding_count;        // how many
    uint32_t word_count;           // how many
    uint32_t changed;              // after gnomonRecordImages(): maps or mask are other images than before
    uint32_t maps_drawn;           // after gnomonRecordMaps(): maps drawn at once
    uint32_t maps_kept_drawn;      // maps of still casters, drawn into their kept layers
    uint32_t maps_restored;        // maps restored from a kept layer, with moving casters drawn over it
    uint32_t maps_held;            // maps left as they were
} GnomonCommandList;

/// Records commands for one executor (pack::FrameRecorder).
typedef struct GnomonRecorder GnomonRecorder;
/// The host's images for a mask, besides the camera's depth (pack::RecorderInputs).
typedef enum GnomonHas {
    GNOMON_HAS_NORMALS = 1, // world-space normals, octahedral
    GNOMON_HAS_SMOOTH = 2,  // smooth surfaces
    GNOMON_HAS_IDS = 4,     // ids of objects: index of the object + 1
} GnomonHas;

// NOLINTEND(modernize-use-using)

#endif
