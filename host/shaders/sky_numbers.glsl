// SPDX-License-Identifier: Apache-2.0
// FrameData::sky, of either sky. Included after screen_numbers.glsl.
#ifndef HOST_SKY_NUMBERS_GLSL
#define HOST_SKY_NUMBERS_GLSL

// The plain one.
#define SKY_ZENITH FRAME_SKY(0).rgb
#define SKY_HORIZON FRAME_SKY(1).rgb
#define SKY_GROUND FRAME_SKY(2).rgb // the ground of both skies
// The physical one, for each body: the way to it, and times what its tables hold; its disc, and the cosine of its radius.
#define SKY_BODY(I) FRAME_SKY(3 * (I))
#define SKY_DISC(I) FRAME_SKY(3 * (I) + 1)
#define SKY_STARS FRAME_SKY(2).w
#define SKY_NIGHT FRAME_SKY(5).rgb // without sun and moon
#define SKY_TIMES(I) ((I) == 0 ? FRAME_SKY(6).xxx : FRAME_SKY(6).yzw)

#endif
