// SPDX-License-Identifier: Apache-2.0
// The numbers by which cells of a picture are looked at for partition virtual (passes/seen_cells.comp), for both sides.
#ifndef GNOMON_SEEN_CELLS_H
#define GNOMON_SEEN_CELLS_H

#ifdef __cplusplus
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
namespace gnomon::shared {
using SeenIVec4 = glm::ivec4;
using SeenVec4 = glm::vec4;
using SeenMat4 = glm::mat4;
inline constexpr int kSeenCell = 8;
inline constexpr int kSeenGroup = 8;
inline constexpr int kSeenNormals = 1;
inline constexpr int kSeenFar = 2;
inline constexpr int kSeenSoft = 4;
#else
#define SeenIVec4 ivec4
#define SeenVec4 vec4
#define SeenMat4 mat4
const int kSeenCell = 8;    // pixels on a side of a cell
const int kSeenGroup = 8;   // cells on a side of a shader's group
const int kSeenNormals = 1; // there are normals
const int kSeenFar = 2;     // the background's depth is 1, and not 0
const int kSeenSoft = 4;    // edges are as soft as the light is large, and not as texels are
#endif

struct SeenNumbers {
    SeenIVec4 size;  // xy: of the picture, pixels; zw: columns and rows of cells
    SeenIVec4 light; // x: its first cell, y: its layer of the mask, z: its channel, w: kSeenNormals and so on
    SeenVec4 toward; // xyz: the way to the light, w: 0; or of a light with a place its eye-relative place and its reach
    SeenMat4 eye_from_ndc; // (x, y, depth, 1) to eye-relative homogeneous
};

#ifdef __cplusplus
static_assert(sizeof(SeenNumbers) == 112);
} // namespace gnomon::shared
#endif
#endif
