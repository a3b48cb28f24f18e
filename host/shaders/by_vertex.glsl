// SPDX-License-Identifier: Apache-2.0
// Numbers that are the same for all fragments of a draw, from the vertex shader in software
// [drivers: uniforms]. Other devices read uniforms.
#ifndef HOST_BY_VERTEX_GLSL
#define HOST_BY_VERTEX_GLSL

layout(constant_id = 20) const bool kInSoftware = false;
layout(constant_id = 21) const bool kDrawsSky = false; // for screen.vert

// The numbers from scene.vert, from location 5 on.
const int kSceneRayX = 0;
const int kSceneRayY = 1;
const int kSceneRay0 = 2;
const int kSceneBase = 3;    // MaterialData::base_colour
const int kSceneNumbers = 4; // ::numbers
const int kSceneModel = 5;   // ::model
const int kScenePlaceU = 6;  // ::places[0]
const int kScenePlaceV = 7;
const int kSceneNumberCount = 8;

// The numbers from screen.vert, from location 0 on.
const int kScreenRayX = 0;
const int kScreenRayY = 1;
const int kScreenRay0 = 2;
const int kScreenDepth = 3;
const int kScreenSky = 4;    // FrameData::skylight, or for the pass that draws the sky FrameData::sky
const int kScreenPlace = 11; // the place of the first light
const int kScreenColour = 12;
const int kScreenRight = 13;
const int kScreenNumberCount = 14;
const int kScreenPixel = 14; // location of a pixel's place in the picture: 0 .. 1
const int kScreenShare = kScreenPixel + 1; // location of what a surface leaves to the sky behind it: 0 .. 1

#endif
