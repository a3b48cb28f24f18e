// SPDX-License-Identifier: Apache-2.0
// GLSL only: what is the same for all of the mask's pixels and may come to them from the vertex shader
// [drivers: uniforms].
#ifndef GNOMON_MASK_NUMBERS_GLSL
#define GNOMON_MASK_NUMBERS_GLSL

// DO(place, member of GpuScreen).
#define GNOMON_SCREEN_NUMBERS(DO)                                                                                      \
    DO(0, eye_x)                                                                                                       \
    DO(1, eye_y)                                                                                                       \
    DO(2, eye_z)                                                                                                       \
    DO(3, eye_w)                                                                                                       \
    DO(4, fade)                                                                                                        \
    DO(5, size)
const int kDrawLayer = 6; // x: of the images, which is the draw's first instance
const int kScreenNumbers = 7;

// DO(place, member of GpuConstants). At most 15 places: any device has 64 components, and four are the position.
#define GNOMON_MASK_NUMBERS(DO)                                                                                        \
    DO(0, screen.eye_x)                                                                                                \
    DO(1, screen.eye_y)                                                                                                \
    DO(2, screen.eye_z)                                                                                                \
    DO(3, screen.eye_w)                                                                                                \
    DO(4, screen.fade)                                                                                                 \
    DO(5, screen.size)                                                                                                 \
    DO(6, rule.bias)                                                                                                   \
    DO(7, rule.bias_more)                                                                                              \
    DO(8, rule.kernel)                                                                                                 \
    DO(9, rule.disc)                                                                                                   \
    DO(10, rule.moment_warp)                                                                                           \
    DO(11, rule.moment_variance)                                                                                       \
    DO(12, rule.moment_shape)
const int kLightPlace = 13; // in a draw with few views (light_visibility.glsl)

// The numbers of the only view of a draw that is made for one (GNOMON_ONE_VIEW): DO(place, member of GpuView). Some
// devices do not have that many outputs, so such a draw is for software alone. Other members are not read: the view
// serves all of its map, and an orthographic one is read as one in perspective whose w is 1 everywhere.
#ifdef GNOMON_ONE_VIEW
#define GNOMON_VIEW_NUMBERS(DO)                                                                                        \
    DO(14, x)                                                                                                          \
    DO(15, y)                                                                                                          \
    DO(16, w)                                                                                                          \
    DO(17, metric)                                                                                                     \
    DO(18, tile)                                                                                                       \
    DO(19, scale)                                                                                                      \
    DO(20, whole)                                                                                                      \
    DO(21, more)
// The second view of a draw with two positions of the sun (kPaired) has its numbers kLaterNumbers after those of the
// first. It is orthographic, so GpuLight::steps has the place of its w.
const int kLaterNumbers = 8;
const int kStepsPlace = 16 + kLaterNumbers;
const int kMaskNumbers = 30;
#else
const int kMaskNumbers = 14;
#endif

#endif
