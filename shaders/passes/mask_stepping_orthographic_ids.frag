#version 460
// SPDX-License-Identifier: Apache-2.0
#extension GL_GOOGLE_include_directive : require
#define GNOMON_ORTHOGRAPHIC_ONLY
#define GNOMON_OBJECT_IDS
#define GNOMON_STEPPING
#include "../lib/mask_fragment.glsl"
