// SPDX-License-Identifier: Apache-2.0
// For fragment shaders behind scene.vert: numbers of the frame and the material, by vertex or not. Included after
// frame.glsl and before material.glsl.
#ifndef HOST_SCENE_NUMBERS_GLSL
#define HOST_SCENE_NUMBERS_GLSL
#include "by_vertex.glsl"

layout(location = 5) flat in vec4 numbers_in[kSceneNumberCount];
#define SCENE_NUMBER(PLACE, VALUE) (kInSoftware ? numbers_in[PLACE] : VALUE)
#define FRAME_RAY_X SCENE_NUMBER(kSceneRayX, frame.ray_x)
#define FRAME_RAY_Y SCENE_NUMBER(kSceneRayY, frame.ray_y)
#define FRAME_RAY_0 SCENE_NUMBER(kSceneRay0, frame.ray_0)
#define MATERIAL_BASE SCENE_NUMBER(kSceneBase, material.base_colour)
#define MATERIAL_NUMBERS SCENE_NUMBER(kSceneNumbers, material.numbers)
#define MATERIAL_MODEL SCENE_NUMBER(kSceneModel, material.model)
#define MATERIAL_PLACE_U SCENE_NUMBER(kScenePlaceU, material.places[0].u)
#define MATERIAL_PLACE_V SCENE_NUMBER(kScenePlaceV, material.places[0].v)

#endif
