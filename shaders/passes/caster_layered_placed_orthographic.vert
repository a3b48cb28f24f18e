#version 460
// SPDX-License-Identifier: Apache-2.0
#extension GL_GOOGLE_include_directive : require
#define LAYERED
#define PLACED
#include "../lib/caster_vertex.glsl"
