// SPDX-License-Identifier: Apache-2.0
// The data of the C interface: gnomon.h includes this and says what holds for all of it. No struct has gaps.
#ifndef GNOMON_GNOMON_DATA_H
#define GNOMON_GNOMON_DATA_H

#include <stdint.h>

/// The interface that this header describes. A library takes programs of its own number and of all before it.
#define GNOMON_INTERFACE 1U
/// Stands for no index at all.
#define GNOMON_NO_INDEX 0xFFFFFFFFU

// NOLINTBEGIN(modernize-use-using): C has no other name for a struct.

/// The outcome of a call.
typedef enum GnomonStatus {
    GNOMON_OK = 0,            // done
    GNOMON_REFUSED = 1,       // a wrong call, which has changed nothing
    GNOMON_OUT_OF_MEMORY = 2, // the heap is exhausted
} GnomonStatus;

/// A call that failed. The texts are one line each.
typedef struct GnomonError {
    GnomonStatus status; // GNOMON_OK: none has failed yet, and the texts are empty
    uint32_t reserved;   // 0
    const char* message; // all of it
    const char* tried;   // the step that was tried
    const char* found;   // the finding that made it fail
    const char* todo;    // the advice what to do about it; may be empty
} GnomonError;

// ---- Objects (gnomon/object_set.h)

/// A set of objects.
typedef struct GnomonObjects GnomonObjects;
/// Names an object for as long as it lives.
typedef struct GnomonObjectId {
    uint32_t index;      // its place in plans and in the host's arrays: the smallest that is free
    uint32_t generation; // 0: names nothing
} GnomonObjectId;
/// A box along the axes of the world. One that is empty or not finite is nowhere: it casts and receives nothing.
typedef struct GnomonBounds {
    float min[3]; // the corner of least x, y and z, metres
    float max[3]; // the corner of greatest x, y and z, metres
} GnomonBounds;
/// How an object takes part in shadows (ObjectFlags).
typedef struct GnomonObjectFlags {
    uint32_t size;     // bytes of this struct
    uint32_t casts;    // 0: it throws no shadow anyway; filterable maps draw it where it is seen
    uint32_t receives; // 0: no map is fitted to it
    uint32_t dynamic;  // a hint: expected to move
    uint32_t closed;   // filter volumes: a closed body
    uint32_t joined;   // its surface continues in others without an edge, as floor tiles do
    uint32_t pieces;   // filters of ids: its pieces that shade each other, 1 .. 4096; 0: not given
    uint32_t groups;   // the groups that it casts in, a bit each; 0: it casts for no light
} GnomonObjectFlags;

// ---- The frame (gnomon/frame.h)

/// The type of a light.
typedef enum GnomonLightType { GNOMON_DIRECTIONAL = 0, GNOMON_SPOT = 1, GNOMON_POINT = 2 } GnomonLightType;
/// The range of z in a camera's clip space.
typedef enum GnomonClipDepth {
    GNOMON_ZERO_TO_ONE = 0,      // Vulkan, Direct3D, Metal
    GNOMON_MINUS_ONE_TO_ONE = 1, // OpenGL
} GnomonClipDepth;
/// The origin of rates of a device.
typedef enum GnomonRateSource { GNOMON_GPU = 0, GNOMON_SOFTWARE = 1, GNOMON_MEASURED = 2 } GnomonRateSource;

/// One light that may cast (Light).
typedef struct GnomonLight {
    uint32_t size;               // bytes of this struct; the same for all lights of a frame
    uint32_t key;                // the same from frame to frame, as long as it is the same light
    uint32_t type;               // GnomonLightType
    uint32_t casts_shadow;       // 0: no map; its mask channel reads 1
    double position_ws[3];       // spot, point
    double direction_ws[3];      // directional, spot: unit, the way light travels
    double outer_half_angle_rad; // spot: (0, pi / 2], from the axis
    double range_m;              // spot, point: reach; 0: as far as the scene goes
    double near_m;               // spot, point: nothing nearer casts; 0: found
    double angular_diameter_rad; // directional: width in the sky, 0 .. pi / 2
    double radius_m;             // spot, point: of the sphere that shines; 0: hard shadows
    double brightness;           // relative to the other lights; >= 0
    uint32_t options;            // index of the planner's options
    uint32_t map_size;           // texels on a side of its maps, 16 ..; 0: as its options say
    uint32_t groups;             // the groups of casters that it makes shadows of, a bit each
    uint32_t reserved;           // 0
} GnomonLight;

/// The viewer (Camera).
typedef struct GnomonCamera {
    double eye_ws[3];           // world space
    double clip_from_world[16]; // y is -1 in row 0 of the picture
    double jitter_px[2];        // how far the matrix moves the picture for anti-aliasing, y down
    uint32_t reversed_z;        // 1: depth is 1 near and 0 far, the default
    uint32_t clip_depth;        // GnomonClipDepth
} GnomonCamera;

/// A layer of the world (WorldLayer); low_m < high_m.
typedef struct GnomonWorldLayer {
    double low_m;  // -1e6 .. 1e6
    double high_m; // -1e6 .. 1e6
} GnomonWorldLayer;

/// Times of a device that partition and map size auto weigh error by (DeviceRates): finite, >= 0; only their ratios
/// count.
typedef struct GnomonDeviceRates {
    double rest_ns;         // a pixel of a frame without shadows
    double caster_ns;       // a caster that is drawn into a map
    double texel_ns;        // a texel of a map that compares depths
    double block_texel_ns;  // as much more with pcss and raymarch
    double moment_texel_ns; // as much more of a filterable map
    double compare_ns;      // a pixel of the mask by a filter of a few texels, or by a filterable one
    double search_ns;       // a pixel of the mask of pcss
    double ray_ns;          // a pixel of the mask of raymarch
    uint32_t source;        // GnomonRateSource
    uint32_t reserved;      // 0
} GnomonDeviceRates;

/// A cell of an earlier picture (SeenCell).
typedef struct GnomonSeenCell {
    float place_px[2]; // one of its points, from the picture's top left corner
    float depth;       // as the depth buffer holds it there
    float edge;        // how much a finer map is worth to it; less than 0: nothing is to be seen in it
} GnomonSeenCell;

/// The cells of an earlier picture for one light, for partition virtual (PageRequests).
typedef struct GnomonPageRequests {
    uint32_t size;               // bytes of this struct; the same for all requests of a frame
    uint32_t light_key;          // GnomonLight::key
    double clip_from_world[16];  // of the camera of that picture, z in [0, w]
    uint32_t width_px;           // of that picture
    uint32_t height_px;          // of that picture
    uint64_t cell_count;         // how many cells
    const GnomonSeenCell* cells; // in any order
} GnomonPageRequests;

/// All that planning asks of a host (Frame).
typedef struct GnomonFrame {
    uint32_t size;                      // bytes of this struct
    uint32_t cut;                       // the picture does not continue the last one
    uint64_t index;                     // counted by the host; the plan has it as well
    double time_s;                      // on any clock that does not run back
    GnomonCamera camera;                // the camera that looks at the scene
    uint32_t width_px;                  // the picture's size; >= 1
    uint32_t height_px;                 // the picture's size; >= 1
    const GnomonObjects* objects;       // null: all lights are degenerate
    const GnomonLight* lights;          // in any order
    const GnomonPageRequests* requests; // partition virtual: at most one for each light
    const GnomonWorldLayer* layers;     // from low to high, for options with layers.placement=world
    uint32_t light_count;               // how many lights
    uint32_t request_count;             // how many requests
    uint32_t layer_count;               // how many layers
    uint32_t clamps_depth;              // the host clamps casters onto near planes (depthClamp)
    double draw_ms_per_texel;           // measured time of drawing a texel of a map; 0: not known
    GnomonDeviceRates rates;            // the device's
} GnomonFrame;

// ---- Options (gnomon/option_table.h)

/// Keeps maps and their contents from frame to frame. It has one or several options, which lights name by their index.
typedef struct GnomonPlanner GnomonPlanner;
/// Describes an option. It holds as long as the program.
typedef struct GnomonOption {
    const char* key;           // "pcf.taps"
    const char* doc;           // one line
    const char* form;          // how its value is written: "N"
    const char* unit;          // empty: none
    const char* default_value; // as gnomonSetOption() takes it; may be empty
    const char* choices;       // the names that it takes, with spaces between; empty: numbers, or 0 and 1
    double min;                // least value of each number
    double max;                // largest value of each number
} GnomonOption;

// ---- The plan (gnomon/plan.h, gnomon/view.h)

/// The outcome of planning a light.
typedef enum GnomonOutcome {
    GNOMON_PLANNED = 0,          // as asked
    GNOMON_FALLBACK = 1,         // drawn, but not as asked
    GNOMON_NO_SHADOW_WANTED = 2, // GnomonLight::casts_shadow is 0
    GNOMON_NO_RECEIVER = 3,      // nothing that the camera sees is in its reach
    GNOMON_NO_CASTER = 4,        // nothing can throw a shadow on what the camera sees
    GNOMON_DEGENERATE = 5,       // the numbers do not describe a light or a view
    GNOMON_OPTIONS_REFUSED = 6,  // its options cannot be had
    GNOMON_ATLAS_FULL = 7,       // no room for its maps
} GnomonOutcome;
/// Which of a stepping sun's two positions a view belongs to (SunPosition).
typedef enum GnomonSunPosition { GNOMON_ONLY = 0, GNOMON_EARLIER = 1, GNOMON_LATER = 2 } GnomonSunPosition;
/// Which half of a texel's bits holds a map (TexelPart).
typedef enum GnomonTexelPart { GNOMON_WHOLE = 0, GNOMON_FIRST = 1, GNOMON_SECOND = 2 } GnomonTexelPart;

/// The drawing that one frame needs, and the sizes of its lists.
typedef struct GnomonPlan {
    uint64_t frame;             // GnomonFrame::index
    uint64_t number;            // of this plan among its planner's, from 1 on
    uint64_t planner;           // names its planner; differs after options have changed
    uint32_t cut;               // it goes on from no plan
    uint32_t light_count;       // lights, as in the frame
    uint32_t view_count;        // views, light after light
    uint32_t options_count;     // the planner's options, with pages of maps each
    uint32_t pass_count;        // passes, in their order
    uint32_t map_count;         // one past the largest map_index
    uint32_t mask_layers;       // layers of the mask image
    uint32_t mask_channels;     // channels of each layer: 1 or 4
    uint32_t caster_count;      // of `casters`
    uint32_t receiver_count;    // of `receivers`
    uint32_t object_id_count;   // of `object_ids`
    uint32_t moved_count;       // of `moved`
    const uint32_t* casters;    // object indices, view after view; with filter volumes light after light
    const uint32_t* receivers;  // object indices that the camera sees, ascending
    const uint16_t* object_ids; // filters of ids: one for each object, light after light
    const GnomonBounds* moved;  // soften=converge: around all that came, went or changed since the plan before
} GnomonPlan;

/// The plan of one light (LightPlan).
typedef struct GnomonLightPlan {
    uint32_t outcome;         // GnomonOutcome
    uint32_t has_map;         // its mask channel comes from maps, or with filter volumes from counts; else it reads 1
    const char* outcome_name; // the outcome in one word
    const char* reason;       // a sentence; empty for GNOMON_PLANNED
    uint32_t first_view;      // its first view
    uint32_t view_count;      // how many views; 0: it has no map
    uint32_t mask_layer;      // layer of the mask
    uint32_t mask_channel;    // its channel there
    uint32_t mask_coloured;   // red, green and blue of its layer are the shares that arrive
    uint32_t options;         // GnomonLight::options
    uint32_t halved;          // how many times the side of its maps was halved for want of room
    uint32_t waited;          // frames for which its maps have been out of date; 0: nothing waits
    uint32_t first_object_id; // filters of ids: where its ids begin in GnomonPlan::object_ids
    uint32_t first_volume;    // filter volumes: its first object in GnomonPlan::casters
    uint32_t volume_count;    // filter volumes: how many objects
    uint32_t left_out;        // filter volumes: casters that are not closed

    uint32_t steps_stepping;        // a sun that moves in steps (SunSteps); 0: none of `steps` counts
    uint32_t steps_paired;          // it has views of two positions
    uint32_t steps_smooth;          // the weight is a cubic of the share
    uint32_t steps_alternate;       // this frame draws and reads only the maps of `steps_read`
    uint32_t steps_read;            // GnomonSunPosition
    uint32_t sample_joined;         // soften=converge (LightSample); 0: none of `sample` counts
    double steps_earlier_ws[3];     // unit, the way light travels
    double steps_later_ws[3];       // unit
    double steps_share;             // how far the sun has moved from one to the other: 0 .. 1
    double steps_band;              // width, share of the picture's
    double steps_edge;              // the band's right end
    double sample_position_ws[3];   // spot, point: the point of the light that shines
    double sample_direction_ws[3];  // unit, the way light travels
    uint32_t sample_number;         // frames since the last cut, modulo 1024
    uint32_t choice_made;           // auto has chosen (AutoChoice); 0: none of `choice` counts
    const char* choice_partition;   // the partition that was chosen
    const char* choice_rates;       // the origin of the rates that it was chosen by
    const char* choice_reason;      // a sentence
    double choice_texels_per_pixel; // predicted
    double choice_error;            // predicted share of wrong pixels
    double choice_other_error;      // the same of the partition that was not taken
    double choice_time_ms;          // predicted
    uint32_t choice_halvings;       // how many times the side of its maps was halved
    uint32_t reserved;              // 0
} GnomonLightPlan;

/// One map to draw: a frustum of one light (View).
typedef struct GnomonView {
    uint32_t light;         // index into the frame's lights
    uint32_t options;       // the light's options
    uint32_t first_caster;  // its first caster in GnomonPlan::casters
    uint32_t caster_count;  // how many objects are drawn into it
    uint32_t still_casters; // with a kept layer: the first ones, which stand still
    uint32_t caster_rows;   // rows of gnomonWriteCasterRows() for an object: 3 or 5

    // How the world lies on the map (ViewProjection). Texts in docs/c.md say what precision the floats have.
    uint32_t orthographic;       // neither a lamp's nor warped: the rasteriser's z is the stored depth
    uint32_t clamp_near;         // casters before the near plane are to be clamped onto it, not cut
    uint32_t parallel;           // the rays are parallel; else they come from light_place_ws
    uint32_t paraboloid;         // the map is a paraboloid
    uint32_t gpu_cascade;        // partition sdsm: this cascade of its light; GNOMON_NO_INDEX: none
    uint32_t reserved;           // 0
    double clip_from_world[16];  // z in [0, w] beyond the near plane
    float clip_from_world_f[16]; // the same, rounded: for scenes near the world's origin
    float clip_from_eye_f[16];   // for points relative to the camera's eye, in the world's axes
    double metric_ws[4];         // dot(metric_ws, (p, 1)) is the depth that the map stores: 0 near, 1 far
    float metric_ws_f[4];        // the same, rounded
    float metric_eye_f[4];       // for points relative to the camera's eye
    double near_m;               // where depth is 0
    double far_m;                // where depth is 1
    double light_place_ws[3];    // the point that depths are measured from
    double texel_m;              // the longer side of a texel, metres, or metres at 1 m from a lamp
    double texel_xy_m[2];        // both sides
    double light_reach;          // room on all sides for the rays to the rest of the light
    double grid_move_texels[2];  // with gpu_cascade: how far the fitted view has yet to be moved

    // Where the map is (ViewPlace).
    uint32_t map_index;      // which map it is: less than GnomonPlan::map_count
    uint32_t map_generation; // tells maps of the same index apart
    uint32_t tile_layer;     // page
    uint32_t tile_x;         // its first texel, from the left
    uint32_t tile_y;         // its first texel, from the top
    uint32_t tile_width;     // texels
    uint32_t tile_height;    // texels
    uint32_t tile_part;      // GnomonTexelPart

    // The map's contents, and the drawing that it needs (ViewContents). Draw all of the tile where the contents that
    // were noted for map_index are not `presumes`, else `dirty` if `redraw`; then note `makes`, unless it is 0.
    uint64_t presumes;            // the contents that `dirty` goes on from
    uint64_t makes;               // the contents afterwards; 0: leave the map
    uint64_t kept_presumes;       // as presumes, of the kept layer
    uint64_t kept_makes;          // as makes, of the kept layer
    uint64_t ids_key;             // filters of ids: names the ids that casters are drawn with
    uint64_t texels_to_draw;      // texels in its tile and its kept layer
    uint32_t redraw;              // something is to be drawn
    uint32_t redraw_kept;         // draw the still casters into the kept layer first
    uint32_t kept_layer;          // page of the kept maps; GNOMON_NO_INDEX: the map is drawn all at once
    uint32_t kept_map_index;      // as map_index, of the kept layer
    uint32_t kept_map_generation; // as map_generation, of the kept layer
    uint32_t dirty_x;             // with a kept layer: the texels to restore and draw over, from the tile's left
    uint32_t dirty_y;             // from the tile's top
    uint32_t dirty_width;         // texels; 0: none
    uint32_t dirty_height;        // texels; 0: none
    uint32_t waited;              // frames for which the map has been out of date

    // The points that it serves (ViewServes): a pixel reads the first of its light's views that holds its point.
    uint32_t serves_sun;     // GnomonSunPosition
    uint32_t serves_layered; // views overlap, finest first
    uint32_t slice_across;   // the slice is measured along the map
    uint32_t reserved_too;   // 0
    double slice_axis[4];    // the slice is dot(axis, (p, 1)) / dot(over, (p, 1)), from begin_m to end_m
    double slice_over[4];    // 0, 0, 0, 1 mostly
    double slice_begin_m;    // -infinity: it has no beginning
    double slice_end_m;      // infinity: it has no end
    double slice_blend_m;    // the view before fades over into it from begin_m to begin_m + blend_m
    double sector_x[4];      // the sector is |dot(x, (p, 1))| and |dot(y, (p, 1))| at most dot(w, (p, 1))
    double sector_y[4];      // the other row across
    double sector_w[4];      // the row that bounds both
    double serves_faded_in;  // how far it has faded in over the views before it: 0 .. 1
    double serves_rim;       // layered: share of half its sector over which it fades out
    double layers[8][2];     // layers of the world in its depths, from near to far; zeros: none

    // How good the fit is (FitReport).
    double fit_strength;      // 1: no warp
    double finest_texel[2];   // sides of a warped map's finest texel, as texel_xy_m
    double coarsest_texel[2]; // sides of its coarsest texel

    // The attachments that its casters are drawn to (pack::MapAttachments).
    const char* depth_format;      // of the depth attachment: "d32f", "d24" or "d16"
    const char* colour_format;     // of the colour attachment; empty: none
    float clear_depth;             // before casters are drawn
    float clear_colour;            // the same, of every channel
    uint32_t samples;              // of both attachments
    uint32_t write_depth;          // a fragment shader writes gnomonCasterDepth() as depth
    uint32_t need_fragment_shader; // casters without holes need one: for depth, or for the colour attachment
    uint32_t channels;             // channels of the colour attachment that the map has: bit i for channel i
} GnomonView;

/// The images that hold the maps of one of the planner's options (MapPages), and how they are read. They have exactly
/// this size. No number falls while a map is in use; an image that grows is copied into the larger one.
typedef struct GnomonPages {
    uint32_t width;          // texels; 0: no maps
    uint32_t height;         // texels
    uint32_t layers;         // pages: an array of images
    uint32_t kept_layers;    // pages of an image beside it, with maps of still casters alone
    uint32_t levels;         // mip levels, at least 1
    uint32_t waiting_lights; // lights whose turn has not come
    uint32_t waiting_maps;   // their maps
    uint32_t longest_wait;   // frames
    uint64_t wanted_texels;  // texels that the maps of all lights want
    uint64_t given_texels;   // texels that they have
    uint64_t drawn_texels;   // texels that this plan draws
    double margin_texels;    // a view serves only receivers at least so far inside of its tile
    double reach_texels;     // how far from a receiver's place the filter reads
    double fade_begin_m;     // receivers farther from the eye begin to be lit
    double fade_end_m;       // they are lit from here on; 0: nothing fades
    const char* filter;      // the filter that is used, never auto: "raymarch"
    const char* format;      // the format of a texel: "d32f"
    uint32_t blocks_size;    // filters pcss and raymarch: texels on a side of the image of blocks; else 0
    uint32_t blocks_levels;  // mip levels of that image
} GnomonPages;

// ---- Further needs of a backend (gnomon/pack)

/// The kind of a pass (pack::FramePassKind).
typedef enum GnomonPassKind {
    GNOMON_PASS_BOUNDS = 0,   // fit views with gpu_cascade to the camera's depth
    GNOMON_PASS_MAPS = 1,     // draw the maps of `options`
    GNOMON_PASS_MASK = 2,     // read maps for each pixel
    GNOMON_PASS_SPREAD = 3,   // spread a mask of half the size
    GNOMON_PASS_VOLUMES = 4,  // count shadow volumes
    GNOMON_PASS_HISTORY = 5,  // join the mask with that of the frame before
    GNOMON_PASS_CONVERGE = 6, // join the mask with the mean of all frames before
    GNOMON_PASS_BLUR = 7,     // blur the mask on the screen
} GnomonPassKind;
/// A pass of the frame.
typedef struct GnomonPass {
    uint32_t kind;    // GnomonPassKind
    uint32_t options; // the planner's options; for maps
    const char* name; // "maps"
} GnomonPass;

/// The buffers that shaders/include/gnomon/visibility.glsl reads (pack/shading_buffers.h, pack/page_table.h).
typedef enum GnomonBuffer {
    GNOMON_BUFFER_CONSTANTS = 0, // GpuConstants: a uniform block, of one of the planner's options
    GNOMON_BUFFER_LIGHTS = 1,    // GpuLight, one for each light
    GNOMON_BUFFER_VIEWS = 2,     // GpuView, one for each view, and at least 6
    GNOMON_BUFFER_OBJECTS = 3,   // filters of ids; else it has no bytes
    GNOMON_BUFFER_PAGES = 4,     // partition virtual; else it has no bytes
} GnomonBuffer;
/// How exactly casters are drawn and receivers are known, which the automatic bias covers (pack::DrawPrecision).
typedef struct GnomonPrecision {
    uint32_t size;                 // bytes of this struct
    uint32_t sub_pixel_bits;       // with which the device places vertices, 4 to 24
    uint32_t receivers_from_depth; // receivers' points come from a depth buffer or gl_FragCoord.z
    float depth_rounding;          // half a step of that depth buffer, 0 to 0.01
    float normal_error_rad;        // bound on the error of receivers' normals, 0 to 0.2
} GnomonPrecision;

// NOLINTEND(modernize-use-using)

#endif
