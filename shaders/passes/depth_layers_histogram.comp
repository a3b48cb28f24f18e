#version 460
// SPDX-License-Identifier: Apache-2.0
#extension GL_GOOGLE_include_directive : require
#define GN_SOURCE texture2D
#include "../lib/depth_histogram.glsl"
