// SPDX-License-Identifier: Apache-2.0
// Draws a world's surfaces: what they reflect, and their normals.
struct Frame {
  clip_from_world: mat4x4f,
  world_from_clip: mat4x4f,
  eye: vec4f,         // w: farthest that haze leaves clear, metres
  to_sun: vec4f,      // unit; w: cosine of the angle from the disc's middle to its rim
  sun: vec4f,         // colour; w: exposure
  zenith: vec4f,      // w: share of the sky's light that reaches surfaces
  horizon: vec4f,
  ground: vec4f,
  picture: vec4f,     // width, height, first column that truth has, view
}
struct Material {
  colour: vec4f,
  image: i32, // -1: none
  cutoff: f32,
}
@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var images: texture_2d_array<f32>;
@group(0) @binding(2) var smooth_sampler: sampler;
@group(0) @binding(3) var<uniform> material: Material;

struct Vertex {
  @location(0) position: vec3f,
  @location(1) normal: vec4f,
  @location(2) colour: vec4f,
  @location(3) uv: vec2f,
  @location(4) x: vec4f, // rows of world_from_object
  @location(5) y: vec4f,
  @location(6) z: vec4f,
}
struct Varying {
  @builtin(position) clip: vec4f,
  @location(0) normal: vec3f,
  @location(1) colour: vec4f,
  @location(2) uv: vec2f,
  @location(3) from_eye: vec3f,
}

@vertex fn vertex(v: Vertex) -> Varying {
  let p = vec4f(v.position, 1.0);
  let world = vec3f(dot(v.x, p), dot(v.y, p), dot(v.z, p));
  // The matrix of cofactors turns normals, whatever the scale.
  let turned = vec3f(dot(cross(v.y.xyz, v.z.xyz), v.normal.xyz), dot(cross(v.z.xyz, v.x.xyz), v.normal.xyz), dot(cross(v.x.xyz, v.y.xyz), v.normal.xyz));
  var out: Varying;
  out.clip = frame.clip_from_world * vec4f(world, 1.0);
  out.from_eye = world - frame.eye.xyz;
  out.normal = turned;
  out.colour = v.colour * v.colour;
  out.uv = v.uv;
  return out;
}

struct Surface {
  @location(0) albedo: vec4f, // square roots
  @location(1) normal: vec4f, // world space, 0 to 1
  @location(2) geometric: vec2f, // world space, octahedral; it faces the eye
}

// Based on: Z. Cigolle and others, "A Survey of Efficient Representations for Independent Unit Vectors", 2014.
fn octahedral(n: vec3f) -> vec2f {
  let p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
  return select((1.0 - abs(p.yx)) * select(vec2f(-1.0), vec2f(1.0), p >= vec2f(0.0)), p, n.z >= 0.0);
}

fn surface(v: Varying, front: bool, masked: bool) -> Surface {
  let across = normalize(cross(dpdx(v.from_eye), dpdy(v.from_eye)));
  var colour = v.colour * material.colour;
  let layer = max(material.image, 0);
  let texel = textureSample(images, smooth_sampler, v.uv, layer).rgb;
  let solid = textureSampleLevel(images, smooth_sampler, v.uv, layer, 0.0);
  if (material.image >= 0) {
    colour = vec4f(colour.rgb * select(texel, solid.rgb, masked), colour.a * solid.a);
  }
  if (masked && colour.a < material.cutoff) {
    discard;
  }
  let n = normalize(v.normal) * select(-1.0, 1.0, front);
  return Surface(vec4f(sqrt(colour.rgb), 1.0), vec4f(0.5 * n + 0.5, 1.0), octahedral(across * select(1.0, -1.0, dot(across, v.from_eye) > 0.0)));
}

@fragment fn opaque(v: Varying, @builtin(front_facing) front: bool) -> Surface { return surface(v, front, false); }
@fragment fn masked(v: Varying, @builtin(front_facing) front: bool) -> Surface { return surface(v, front, true); }
