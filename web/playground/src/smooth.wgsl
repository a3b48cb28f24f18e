// SPDX-License-Identifier: Apache-2.0
// Smooths the picture's edges by blurring along them.
// Based on: T. Lottes, "FXAA", NVIDIA 2009, its console form.
@group(0) @binding(0) var picture: texture_2d<f32>;
@group(0) @binding(1) var smooth_sampler: sampler;

@vertex fn whole(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
  return vec4f(f32(i & 1u) * 4.0 - 1.0, f32(i >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

fn at(uv: vec2f) -> vec3f { return textureSampleLevel(picture, smooth_sampler, uv, 0.0).rgb; }
fn luma(colour: vec3f) -> f32 { return dot(colour, vec3f(0.299, 0.587, 0.114)); }

@fragment fn smoothed(@builtin(position) position: vec4f) -> @location(0) vec4f {
  let texel = 1.0 / vec2f(textureDimensions(picture));
  let uv = position.xy * texel;
  let middle = at(uv);
  let nw = luma(at(uv + vec2f(-0.5, -0.5) * texel));
  let ne = luma(at(uv + vec2f(0.5, -0.5) * texel));
  let sw = luma(at(uv + vec2f(-0.5, 0.5) * texel));
  let se = luma(at(uv + vec2f(0.5, 0.5) * texel));
  let m = luma(middle);
  let low = min(m, min(min(nw, ne), min(sw, se)));
  let high = max(m, max(max(nw, ne), max(sw, se)));
  if (high - low < max(0.04, 0.125 * high)) {
    return vec4f(middle, 1.0);
  }
  let across = vec2f((sw + se) - (nw + ne), (nw + sw) - (ne + se));
  let along = clamp(across / (min(abs(across.x), abs(across.y)) + max(0.03125 * (nw + ne + sw + se), 0.0078)), vec2f(-8.0), vec2f(8.0)) * texel;
  let near = 0.5 * (at(uv - along / 6.0) + at(uv + along / 6.0));
  let wide = 0.5 * near + 0.25 * (at(uv - 0.5 * along) + at(uv + 0.5 * along));
  return vec4f(select(wide, near, luma(wide) < low || luma(wide) > high), 1.0);
}

@fragment fn copied(@builtin(position) position: vec4f) -> @location(0) vec4f {
  return vec4f(at(position.xy / vec2f(textureDimensions(picture))), 1.0);
}

@fragment fn first(@builtin(position) position: vec4f) -> @location(0) vec4f { return textureLoad(picture, vec2i(position.xy), 0); }
