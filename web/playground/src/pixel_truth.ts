// SPDX-License-Identifier: Apache-2.0
// The share of the sun's disc that each pixel's surface sees, by rays: more of them make it more exact.
// As docs/truth.md has it, without its smooth surfaces: the same disc, the same start of rays, the same facing.
import type { Tracer } from './tracer.ts';
import { axesOf, cross, normalize, radians, scale, type Camera, type Vec3 } from './vectors.ts';

export interface TruthView {
  width: number;
  height: number;
  camera: Camera;
  /** The way light travels, unit. */
  sun: Vec3;
  /** The sun's angular diameter, degrees. */
  light: number;
}

/** Side of the squares that a first, coarse answer has, pixels. */
export const kCoarse = 4;

/** A number in [0, 1) for a pixel: a hash of 32 bits. */
function hashed(value: number): number {
  let h = Math.imul(value ^ 0x9e3779b9, 0x85ebca6b);
  h = Math.imul(h ^ (h >>> 13), 0xc2b2ae35);
  return ((h ^ (h >>> 16)) >>> 0) / 2 ** 32;
}

// M. Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018: R2.
const kStepU = 0.7548776662466927;
const kStepV = 0.5698402909980532;

/** Traces some of a picture's pixels: those that the caller asks for. */
export class PixelTruth {
  private readonly axes;
  private readonly toSun: Vec3;
  private readonly across: [Vec3, Vec3];
  private readonly points: Float64Array; // by pixel: where a ray starts, and the normal there
  private readonly known: Uint8Array; // 0: not looked for, 1: a surface, 2: none
  /** Rays that reached the sun, by pixel. */
  readonly sums: Uint16Array;

  constructor(private readonly tracer: Tracer, readonly view: TruthView) {
    this.axes = axesOf(view.camera);
    this.toSun = normalize(scale(view.sun, -1));
    const right = normalize(cross(this.toSun, Math.abs(this.toSun[1]) < 0.9 ? [0, 1, 0] : [1, 0, 0]));
    const radius = Math.tan(radians(view.light) / 2);
    this.across = [scale(right, radius), scale(cross(right, this.toSun), radius)];
    this.points = new Float64Array(6 * view.width * view.height);
    this.known = new Uint8Array(view.width * view.height);
    this.sums = new Uint16Array(view.width * view.height);
  }

  /** Does the pixel show a surface? */
  surface(pixel: number): boolean {
    if (this.known[pixel] === 0) {
      this.known[pixel] = this.look(pixel) ? 1 : 2;
    }
    return this.known[pixel] === 1;
  }

  private look(pixel: number): boolean {
    const { width, height, camera } = this.view;
    const tall = Math.tan(radians(camera.fov) / 2);
    const x = ((2 * ((pixel % width) + 0.5)) / width - 1) * tall * (width / height);
    const y = (1 - (2 * (Math.floor(pixel / width) + 0.5)) / height) * tall;
    const { right, up, ahead } = this.axes;
    const d = [0, 1, 2].map((k) => ahead[k] + x * right[k] + y * up[k]);
    const [ex, ey, ez] = camera.eye;
    if (!this.tracer.meets(ex, ey, ez, d[0], d[1], d[2])) {
      return false;
    }
    const { t, normal } = this.tracer;
    const at = [ex + t * d[0], ey + t * d[1], ez + t * d[2]];
    const off = Math.max(1, ...at.map(Math.abs)) * 2 ** -17;
    this.points.set([at[0] + off * normal[0], at[1] + off * normal[1], at[2] + off * normal[2], ...normal], 6 * pixel);
    return true;
  }

  /** Adds the ray of number `sample` to a pixel that shows a surface. */
  addRay(pixel: number, sample: number): void {
    if (this.reaches(pixel, sample)) {
      ++this.sums[pixel];
    }
  }

  /** Does the ray of number `sample` reach the sun? */
  reaches(pixel: number, sample: number): boolean {
    const p = this.points;
    const at = 6 * pixel;
    const [nx, ny, nz] = [p[at + 3], p[at + 4], p[at + 5]];
    const [cx, cy, cz] = this.toSun;
    if (nx * cx + ny * cy + nz * cz <= 0) {
      return false;
    }
    const u = (hashed(2 * pixel) + sample * kStepU) % 1;
    const v = (hashed(2 * pixel + 1) + sample * kStepV) % 1;
    const radius = Math.sqrt(u);
    const i = radius * Math.cos(2 * Math.PI * v);
    const j = radius * Math.sin(2 * Math.PI * v);
    const [a, b] = this.across;
    const dx = cx + i * a[0] + j * b[0];
    const dy = cy + i * a[1] + j * b[1];
    const dz = cz + i * a[2] + j * b[2];
    return nx * dx + ny * dy + nz * dz > 0 && !this.tracer.blocked(p[at], p[at + 1], p[at + 2], dx, dy, dz, Infinity);
  }
}
