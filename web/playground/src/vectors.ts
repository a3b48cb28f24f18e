// SPDX-License-Identifier: Apache-2.0
// Vectors and matrices. Matrices are 16 numbers in columns; vectors are columns.

export type Vec3 = [number, number, number];

export const add = (a: Vec3, b: Vec3): Vec3 => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const subtract = (a: Vec3, b: Vec3): Vec3 => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scale = (a: Vec3, by: number): Vec3 => [a[0] * by, a[1] * by, a[2] * by];
export const dot = (a: Vec3, b: Vec3): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a: Vec3, b: Vec3): Vec3 => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const lengthOf = (a: Vec3): number => Math.hypot(a[0], a[1], a[2]);
export const normalize = (a: Vec3): Vec3 => scale(a, 1 / (lengthOf(a) || 1));
export const clamp = (value: number, low: number, high: number): number => Math.min(high, Math.max(low, value));
export const radians = (degrees: number): number => (degrees * Math.PI) / 180;
export const degrees = (rad: number): number => (rad * 180) / Math.PI;

/** A camera that looks from a point at another, with +y up. */
export interface Camera {
  eye: Vec3;
  target: Vec3;
  /** Vertical field of view, degrees. */
  fov: number;
}

/** Unit vectors of a camera's picture: to its right, up and ahead. */
export function axesOf(camera: Camera): { right: Vec3; up: Vec3; ahead: Vec3 } {
  const ahead = normalize(subtract(camera.target, camera.eye));
  const right = normalize(cross(ahead, [0, 1, 0]));
  return { right, up: cross(right, ahead), ahead };
}

/** clip_from_world with y up, as WebGPU has it; depth is reversed, 1 at `near` metres and 0 without end. */
export function clipFromWorld(camera: Camera, aspect: number, near: number): Float64Array {
  const { right, up, ahead } = axesOf(camera);
  const focal = 1 / Math.tan(radians(camera.fov) / 2);
  const x = scale(right, focal / aspect);
  const y = scale(up, focal);
  const m = new Float64Array(16);
  for (let i = 0; i < 3; ++i) {
    m.set([x[i], y[i], 0, ahead[i]], 4 * i);
  }
  m.set([-dot(x, camera.eye), -dot(y, camera.eye), near, -dot(ahead, camera.eye)], 12);
  return m;
}

/** The inverse of a matrix that has one, by Gauss and Jordan. */
export function inverseOfMatrix(m: Float64Array): Float64Array {
  const a = Float64Array.from(m);
  const out = new Float64Array(16);
  for (let i = 0; i < 4; ++i) {
    out[5 * i] = 1;
  }
  for (let column = 0; column < 4; ++column) {
    let pivot = column;
    for (let row = column + 1; row < 4; ++row) {
      pivot = Math.abs(a[4 * row + column]) > Math.abs(a[4 * pivot + column]) ? row : pivot;
    }
    for (let k = 0; k < 4; ++k) {
      [a[4 * column + k], a[4 * pivot + k]] = [a[4 * pivot + k], a[4 * column + k]];
      [out[4 * column + k], out[4 * pivot + k]] = [out[4 * pivot + k], out[4 * column + k]];
    }
    const by = a[5 * column];
    for (let k = 0; k < 4; ++k) {
      a[4 * column + k] /= by;
      out[4 * column + k] /= by;
    }
    for (let row = 0; row < 4; ++row) {
      const times = row === column ? 0 : a[4 * row + column];
      for (let k = 0; k < 4; ++k) {
        a[4 * row + k] -= times * a[4 * column + k];
        out[4 * row + k] -= times * out[4 * column + k];
      }
    }
  }
  return out;
}

/** The way light travels, from the sun's azimuth (degrees from -z, clockwise from above) and height (degrees). */
export function sunDirection(azimuth: number, height: number): Vec3 {
  const a = radians(azimuth);
  const h = radians(height);
  return [-Math.sin(a) * Math.cos(h), -Math.sin(h), Math.cos(a) * Math.cos(h)];
}

/** The inverse of sunDirection(). */
export function sunPlace(direction: Vec3): [number, number] {
  const d = normalize(direction);
  return [(degrees(Math.atan2(-d[0], d[2])) + 360) % 360, degrees(Math.asin(clamp(-d[1], -1, 1)))];
}

/** The camera after a drag: turned about its target by angles in degrees. */
export function orbit(camera: Camera, across: number, upwards: number): Camera {
  const from = subtract(camera.eye, camera.target);
  const distance = lengthOf(from);
  const turn = Math.atan2(from[0], from[2]) - radians(across);
  const height = clamp(Math.asin(clamp(from[1] / distance, -1, 1)) + radians(upwards), radians(1), radians(88));
  const flat = distance * Math.cos(height);
  return { ...camera, eye: add(camera.target, [flat * Math.sin(turn), distance * Math.sin(height), flat * Math.cos(turn)]) };
}

/** The camera nearer to its target or farther from it, between bounds in metres. */
export function dolly(camera: Camera, by: number, low: number, high: number): Camera {
  const from = subtract(camera.eye, camera.target);
  const distance = lengthOf(from);
  return { ...camera, eye: add(camera.target, scale(from, clamp(distance * by, low, high) / distance)) };
}

/** Eye and target moved in the picture's plane, by shares of its height. */
export function pan(camera: Camera, right: number, up: number): Camera {
  const axes = axesOf(camera);
  const height = 2 * lengthOf(subtract(camera.eye, camera.target)) * Math.tan(radians(camera.fov) / 2);
  const move = add(scale(axes.right, right * height), scale(axes.up, up * height));
  return { ...camera, eye: add(camera.eye, move), target: add(camera.target, move) };
}
