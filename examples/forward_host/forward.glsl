// SPDX-License-Identifier: Apache-2.0
// Declarations that the forward host's shaders share.
layout(push_constant) uniform Draw
{
    mat4 clip_from; // casters: world space; shading: relative to the eye
    vec4 more;      // casters: MapPass::metric_ws; shading: the thing's colour, w: 1 with holes
    vec4 centre;    // casters: world space; shading: relative to the eye
    vec4 half_size;
} draw;

// Stands for an alpha-masked texture: bars with gaps between them.
bool isHole(vec3 point)
{
    return fract(2.5 * point.x + 0.25) < 0.5;
}
