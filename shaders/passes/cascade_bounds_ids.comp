#version 460
// SPDX-License-Identifier: Apache-2.0
#extension GL_GOOGLE_include_directive : require
#define GNOMON_OBJECT_IDS
#include "../lib/cascade_bounds.glsl"
