// SPDX-License-Identifier: Apache-2.0
// Lights the surfaces by sun and sky, with Gnomon's visibility in the picture's left part and the traced one in its right part.
struct Frame {
  clip_from_world: mat4x4f,
  world_from_clip: mat4x4f,
  eye: vec4f,
  to_sun: vec4f,
  sun: vec4f,
  zenith: vec4f,
  horizon: vec4f,
  ground: vec4f,
  picture: vec4f,
}
@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var depth: texture_depth_2d;
@group(0) @binding(2) var albedo: texture_2d<f32>;
@group(0) @binding(3) var normals: texture_2d<f32>;
@group(0) @binding(4) var mask: texture_2d<f32>;
@group(0) @binding(5) var truth: texture_2d<f32>;

const kShaded = 0.0;
const kDifference = 2.0;

@vertex fn whole(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
  return vec4f(f32(i & 1u) * 4.0 - 1.0, f32(i >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

fn sky(direction: vec3f) -> vec3f {
  let base = 0.8 * mix(frame.horizon.rgb, frame.zenith.rgb, pow(clamp(direction.y, 0.0, 1.0), 0.4));
  let near = dot(direction, frame.to_sun.xyz);
  let glow = frame.sun.rgb * (0.05 * pow(max(near, 0.0), 24.0) + 0.25 * pow(max(near, 0.0), 900.0));
  return base + glow + frame.sun.rgb * 3.0 * smoothstep(frame.to_sun.w - 2e-5, frame.to_sun.w + 2e-5, near);
}

// K. Narkowicz, "ACES Filmic Tone Mapping Curve", 2015; then sRGB.
fn shown(light: vec3f) -> vec3f {
  let x = light * frame.sun.w;
  let y = clamp((x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14), vec3f(0.0), vec3f(1.0));
  return select(1.055 * pow(y, vec3f(1.0 / 2.4)) - 0.055, 12.92 * y, y < vec3f(0.0031308));
}

@fragment fn shade(@builtin(position) at: vec4f) -> @location(0) vec4f {
  let pixel = vec2i(at.xy);
  let z = textureLoad(depth, pixel, 0);
  let ndc = vec2f(2.0 * at.x / frame.picture.x - 1.0, 1.0 - 2.0 * at.y / frame.picture.y);
  let far = frame.world_from_clip * vec4f(ndc, max(z, 1e-7), 1.0);
  let position = far.xyz / far.w;
  let sight = normalize(position - frame.eye.xyz);
  let view = frame.picture.w;
  if (z == 0.0) {
    return vec4f(select(vec3f(0.5), shown(sky(sight)), view == kShaded), 1.0);
  }
  let gnomon = textureLoad(mask, pixel, 0).r;
  let traced = textureLoad(truth, pixel, 0).r;
  if (view == kDifference) {
    let more = gnomon - traced; // orange: too light; blue: too dark
    return vec4f(mix(vec3f(0.93), select(vec3f(0.0, 0.3, 0.75), vec3f(0.85, 0.33, 0.0), more > 0.0), min(1.0, 1.6 * abs(more))), 1.0);
  }
  let visibility = select(gnomon, traced, at.x >= frame.picture.z);
  if (view != kShaded) {
    return vec4f(vec3f(visibility), 1.0);
  }
  let root = textureLoad(albedo, pixel, 0).rgb;
  let n = normalize(2.0 * textureLoad(normals, pixel, 0).xyz - 1.0);
  let facing = max(dot(n, frame.to_sun.xyz), 0.0);
  let above = mix(frame.horizon.rgb, frame.zenith.rgb, 0.6);
  let around = mix(frame.ground.rgb, above, 0.5 * n.y + 0.5) * frame.zenith.w;
  // A little of the sun's light comes back from the ground.
  let bounced = frame.ground.rgb * frame.sun.rgb * max(frame.to_sun.y, 0.0) * (0.06 - 0.05 * n.y);
  let light = root * root * (frame.sun.rgb * (facing * visibility / 3.14159) + around + bounced);
  let haze = 1.0 - exp(-pow(distance(position, frame.eye.xyz) / frame.eye.w, 1.5));
  return vec4f(shown(mix(light, sky(vec3f(sight.x, max(sight.y, 0.0), sight.z)), haze)), 1.0);
}
