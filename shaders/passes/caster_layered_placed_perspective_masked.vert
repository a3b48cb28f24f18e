#version 460
// SPDX-License-Identifier: Apache-2.0
#extension GL_GOOGLE_include_directive : require
#define LAYERED
#define PLACED
#define PERSPECTIVE
#define METRIC
#define MASKED
#include "../lib/caster_vertex.glsl"
