#version 460
// SPDX-License-Identifier: Apache-2.0
#extension GL_GOOGLE_include_directive : require
#define GN_SOURCE sampler2DMS
#define GN_SAMPLES
#include "../lib/moments_pass.glsl"
