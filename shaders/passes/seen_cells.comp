#version 460
// SPDX-License-Identifier: Apache-2.0
// For partition virtual: of each cell of the picture one point, and how much of the cell is the edge of one light's
// shadows, from depth and mask. The next frames' pages are planned by it (gnomon::SeenCell).
#extension GL_GOOGLE_include_directive : require
#include "gnomon/shared/octahedral.h"
#include "gnomon/shared/seen_cells.h"
layout(local_size_x = kSeenGroup, local_size_y = kSeenGroup) in;

layout(set = 0, binding = 0) uniform sampler2D depths;
layout(set = 0, binding = 1) uniform sampler2DArray mask;
layout(set = 0, binding = 2) uniform sampler2D normals;
layout(set = 0, binding = 3, std430) writeonly buffer Cells
{
    vec4 cells[]; // place in pixels, depth, edge
};
layout(push_constant) uniform Numbers
{
    SeenNumbers numbers;
};

// Depths of neighbours on one surface seen at a flat angle differ by no more, as shares of each other.
const float kOneSurface = 0.95;

struct Pixel {
    float near; // what its depth is off the background's; 0: nothing is there
    float visibility;
};

// From a pixel to the light.
vec3 towardLight(ivec2 place)
{
    if (numbers.toward.w == 0.0) {
        return numbers.toward.xyz;
    }
    vec2 ndc = (vec2(place) + 0.5) / vec2(numbers.size.xy) * 2.0 - 1.0;
    vec4 h = numbers.eye_from_ndc * vec4(ndc, texelFetch(depths, place, 0).r, 1.0);
    return numbers.toward.xyz - h.xyz / h.w;
}

// A surface that faces away is dark whatever its map says, and one out of reach has no shadow.
Pixel pixelAt(ivec2 place, vec3 toward)
{
    Pixel pixel;
    pixel.near = abs(texelFetch(depths, place, 0).r - ((numbers.light.w & kSeenFar) != 0 ? 1.0 : 0.0));
    pixel.visibility = texelFetch(mask, ivec3(place, numbers.light.y), 0)[numbers.light.z];
    bool faces_away = (numbers.light.w & kSeenNormals) != 0 &&
                      dot(octahedralDecode(texelFetch(normals, place, 0).rg), toward) <= 0.0;
    if (faces_away || (numbers.toward.w > 0.0 && length(toward) > numbers.toward.w)) {
        pixel.visibility = -1.0;
    }
    return pixel;
}

// By how much visibility changes to the next pixel on the same surface, for which the way to the light is the same.
float changeTo(ivec2 place, Pixel pixel, vec3 toward)
{
    Pixel next = pixelAt(min(place, numbers.size.xy - 1), toward);
    bool is_one = min(next.near, pixel.near) > kOneSurface * max(next.near, pixel.near);
    return is_one && min(next.visibility, pixel.visibility) >= 0.0 ? next.visibility - pixel.visibility : 0.0;
}

void main()
{
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(cell, numbers.size.zw))) {
        return;
    }
    ivec2 begin = cell * kSeenCell;
    ivec2 end = min(begin + kSeenCell, numbers.size.xy);
    ivec2 middle = (begin + end) / 2;
    vec4 found = vec4(vec2(middle), 0.0, -1.0);
    float edge = 0.0;
    float steepest = -1.0;
    for (int y = begin.y; y < end.y; ++y) {
        for (int x = begin.x; x < end.x; ++x) {
            ivec2 place = ivec2(x, y);
            vec3 toward = towardLight(place);
            Pixel pixel = pixelAt(place, toward);
            if (pixel.near > 0.0 && pixel.visibility >= 0.0) {
                vec2 change = vec2(changeTo(place + ivec2(1, 0), pixel, toward), changeTo(place + ivec2(0, 1), pixel, toward));
                float here = (numbers.light.w & kSeenSoft) != 0 ? dot(change, change) : length(change);
                edge += here;
                // Of a cell without an edge its middle.
                if (here > steepest || (place == middle && steepest == 0.0)) {
                    steepest = here;
                    found = vec4(vec2(place) + 0.5, texelFetch(depths, place, 0).r, 0.0);
                }
            }
        }
    }
    found.w = steepest >= 0.0 ? edge : -1.0;
    cells[numbers.light.x + cell.y * numbers.size.z + cell.x] = found;
}
