#version 460
// SPDX-License-Identifier: Apache-2.0
#extension GL_GOOGLE_include_directive : require
#define WRITE_DEPTH
#define PER_SAMPLE
#include "../lib/caster_fragment.glsl"
