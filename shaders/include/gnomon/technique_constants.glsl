// SPDX-License-Identifier: Apache-2.0
// GLSL only: for a pass that is made for one technique. The technique's options become specialization constants, whose
// values pack::techniqueConstants() gives, so that a driver compiles only the code that the technique needs. Include it
// before visibility.glsl.
//
// Define beforehand, if the default does not suit:
//   GNOMON_CONSTANT_ID  the first of nine constant_ids (0)
// It adds a binding to those of visibility.glsl: GNOMON_BINDING + 8, a uniform buffer with the first kFewViews of the
// GpuViews. Where a frame has one light and few views, the pass reads them from there: pack::fewViewsOf().
#ifndef GNOMON_TECHNIQUE_CONSTANTS_GLSL
#define GNOMON_TECHNIQUE_CONSTANTS_GLSL
#ifndef GNOMON_CONSTANT_ID
#define GNOMON_CONSTANT_ID 0
#endif

// In the order of pack::TechniqueConstants.
layout(constant_id = GNOMON_CONSTANT_ID) const int gnomon_kernel_width = 3; // see FilterInput
layout(constant_id = GNOMON_CONSTANT_ID + 1) const int gnomon_disc_taps = 16; // points of the disc
layout(constant_id = GNOMON_CONSTANT_ID + 2) const bool gnomon_automatic_bias = true; // bias=auto
layout(constant_id = GNOMON_CONSTANT_ID + 3) const int gnomon_moment_flags = 0;    // see MomentRule
layout(constant_id = GNOMON_CONSTANT_ID + 4) const int gnomon_moment_sampling = 0; // gnomon::MapSampling
layout(constant_id = GNOMON_CONSTANT_ID + 5) const int gnomon_moment_layers = 2;   // layers of lvsm
layout(constant_id = GNOMON_CONSTANT_ID + 6) const int gnomon_depth_holding = 0;   // see gnomon/shared/paired_depth.h
layout(constant_id = GNOMON_CONSTANT_ID + 7) const uint gnomon_few_view_count = 0; // how many views its one light has; 0: any number of lights and views

layout(constant_id = GNOMON_CONSTANT_ID + 8) const int gnomon_filter = 1; // a number of filter_numbers.h; not read with
                                                                          // GNOMON_FILTER

#define GNOMON_FILTER_NUMBER gnomon_filter
#define GNOMON_KERNEL_WIDTH gnomon_kernel_width
#define GNOMON_DISC_TAPS gnomon_disc_taps
#define GNOMON_AUTOMATIC_BIAS gnomon_automatic_bias
#define GNOMON_MOMENT_FLAGS gnomon_moment_flags
#define GNOMON_MOMENT_SAMPLING gnomon_moment_sampling
#define GNOMON_MOMENT_LAYERS gnomon_moment_layers
#define GNOMON_DEPTH_HOLDING gnomon_depth_holding
#define GNOMON_FEW_VIEWS gnomon_few_view_count

#endif
