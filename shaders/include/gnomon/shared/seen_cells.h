// SPDX-License-Identifier: Apache-2.0
// The numbers by which cells of a picture are looked at for partition virtual (passes/seen_cells.comp), for both sides.
#ifndef GNOMON_SEEN_CELLS_H
#define GNOMON_SEEN_CELLS_H

#ifdef __cplusplus
#include <glm/vec4.hpp>
namespace gnomon::shared {
using SeenIVec4 = glm::ivec4;
using SeenVec4 = glm::vec4;
inline constexpr int kSeenCell = 8;
inline constexpr int kSeenGroup = 8;
#else
#define SeenIVec4 ivec4
#define SeenVec4 vec4
const int kSeenCell = 8;  // pixels on a side of a cell
const int kSeenGroup = 8; // cells on a side of a shader's group
#endif

struct SeenNumbers {
    SeenIVec4 size;  // xy: of the picture, pixels; zw: columns and rows of cells
    SeenIVec4 light; // x: its first cell, y: its layer of the mask, z: its channel, w: 1: there are normals
    SeenVec4 toward; // xyz: the way to the light, w: the background's depth
};

#ifdef __cplusplus
static_assert(sizeof(SeenNumbers) == 48);
} // namespace gnomon::shared
#endif
#endif
