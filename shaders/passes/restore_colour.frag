#version 460
// SPDX-License-Identifier: Apache-2.0
#extension GL_GOOGLE_include_directive : require
#define WRITE_COLOUR
#include "../lib/restore_fragment.glsl"
