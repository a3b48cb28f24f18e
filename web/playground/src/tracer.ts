// SPDX-License-Identifier: Apache-2.0
// Finds where rays meet a world: a tree of places over trees of triangles. It knows nothing of shadow maps.
// Based on: T. Möller, B. Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997.
import { buildBvh, type Bvh } from './bvh.ts';
import { unpackVertices, type Material, type Mesh, type World } from './world.ts';

/** One mesh's triangles in the order of its tree: nine floats each, and its corners' numbers. */
interface Shape {
  mesh: Mesh;
  material: Material;
  tree: Bvh;
  corners: Float32Array;
  vertices: Uint32Array;
}

const kStack = 128;
const kPlain: Material = { name: '', colour: [1, 1, 1, 1], image: -1, cutoff: 0, double_sided: false };

/** The inverse of rows of three by four, as such rows. */
function inverseOf(m: Float32Array, at: number, out: Float64Array, to: number): void {
  const [a, b, c, x, d, e, f, y, g, h, i, z] = m.subarray(at, at + 12);
  const determinant = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g);
  const rows = [e * i - f * h, c * h - b * i, b * f - c * e, f * g - d * i, a * i - c * g, c * d - a * f, d * h - e * g, b * g - a * h, a * e - b * d];
  for (let k = 0; k < 3; ++k) {
    const [p, q, r] = [rows[3 * k] / determinant, rows[3 * k + 1] / determinant, rows[3 * k + 2] / determinant];
    out.set([p, q, r, -(p * x + q * y + r * z)], to + 4 * k);
  }
}

export class Tracer {
  /** The last hit: distance in lengths of the ray's direction, and the triangle's unit normal, which faces the ray's start. */
  t = 0;
  readonly normal = new Float64Array(3);

  private readonly shapes: Shape[] = [];
  private readonly shapeOf: Uint32Array; // by place
  private readonly objectFromWorld: Float64Array;
  private readonly top: Bvh;
  private readonly alphas: Float32Array;
  private readonly uvs: Float32Array;
  private readonly stack = new Int32Array(kStack);
  private readonly topStack = new Int32Array(kStack);
  private hitPlace = -1;
  private hitTriangle = -1;

  constructor(private readonly world: World) {
    const { positions, alphas, uvs } = unpackVertices(world);
    this.alphas = alphas;
    this.uvs = uvs;
    this.shapeOf = new Uint32Array(world.places);
    this.objectFromWorld = new Float64Array(12 * world.places);
    const boxes = new Float32Array(6 * world.places);
    for (const mesh of world.meshes) {
      this.addShape(mesh, positions);
      for (let place = mesh.first_place; place < mesh.first_place + mesh.places; ++place) {
        this.shapeOf[place] = this.shapes.length - 1;
        inverseOf(world.placeValues, 12 * place, this.objectFromWorld, 12 * place);
        this.boxOf(place, this.shapes[this.shapes.length - 1], boxes);
      }
    }
    this.top = buildBvh(boxes);
  }

  private addShape(mesh: Mesh, positions: Float32Array): void {
    const count = mesh.indices / 3;
    const boxes = new Float32Array(6 * count);
    const at = (triangle: number, corner: number, axis: number): number =>
      positions[3 * (mesh.first_vertex + this.world.indexValues[mesh.first_index + 3 * triangle + corner]) + axis];
    for (let i = 0; i < count; ++i) {
      for (let k = 0; k < 3; ++k) {
        boxes[6 * i + k] = Math.min(at(i, 0, k), at(i, 1, k), at(i, 2, k));
        boxes[6 * i + k + 3] = Math.max(at(i, 0, k), at(i, 1, k), at(i, 2, k));
      }
    }
    const tree = buildBvh(boxes);
    const corners = new Float32Array(9 * count);
    const vertices = new Uint32Array(3 * count);
    tree.order.forEach((triangle, i) => {
      for (let corner = 0; corner < 3; ++corner) {
        vertices[3 * i + corner] = mesh.first_vertex + this.world.indexValues[mesh.first_index + 3 * triangle + corner];
        for (let k = 0; k < 3; ++k) {
          corners[9 * i + 3 * corner + k] = at(triangle, corner, k);
        }
      }
    });
    this.shapes.push({ mesh, material: this.world.materials[mesh.material] ?? kPlain, tree, corners, vertices });
  }

  /** A place's box in the world, from its shape's box. */
  private boxOf(place: number, shape: Shape, boxes: Float32Array): void {
    const m = this.world.placeValues;
    for (let k = 0; k < 3; ++k) {
      const row = 12 * place + 4 * k;
      let low = m[row + 3];
      let high = low;
      for (let j = 0; j < 3; ++j) {
        const a = m[row + j] * shape.tree.bounds[j];
        const b = m[row + j] * shape.tree.bounds[j + 3];
        low += Math.min(a, b);
        high += Math.max(a, b);
      }
      const room = 1e-5 * (1 + Math.abs(low) + Math.abs(high)); // floats are rounded
      boxes[6 * place + k] = low - room;
      boxes[6 * place + k + 3] = high + room;
    }
  }

  /** Is anything that casts met before `farthest` lengths of the direction? */
  blocked(ox: number, oy: number, oz: number, dx: number, dy: number, dz: number, farthest: number): boolean {
    return this.walk(ox, oy, oz, dx, dy, dz, farthest, true);
  }

  /** Finds what the ray meets first, as a camera sees it: `t` and `normal`. */
  meets(ox: number, oy: number, oz: number, dx: number, dy: number, dz: number): boolean {
    if (!this.walk(ox, oy, oz, dx, dy, dz, Infinity, false)) {
      return false;
    }
    const shape = this.shapes[this.shapeOf[this.hitPlace]];
    const c = shape.corners.subarray(9 * this.hitTriangle, 9 * this.hitTriangle + 9);
    const [ax, ay, az, bx, by, bz] = [c[3] - c[0], c[4] - c[1], c[5] - c[2], c[6] - c[0], c[7] - c[1], c[8] - c[2]];
    const n = [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx];
    const m = this.objectFromWorld;
    const at = 12 * this.hitPlace;
    for (let k = 0; k < 3; ++k) {
      this.normal[k] = m[at + k] * n[0] + m[at + 4 + k] * n[1] + m[at + 8 + k] * n[2];
    }
    const length = Math.hypot(...this.normal) * (this.normal[0] * dx + this.normal[1] * dy + this.normal[2] * dz > 0 ? -1 : 1);
    for (let k = 0; k < 3; ++k) {
      this.normal[k] /= length;
    }
    return true;
  }

  private walk(ox: number, oy: number, oz: number, dx: number, dy: number, dz: number, farthest: number, any: boolean): boolean {
    const { bounds, links, order } = this.top;
    const stack = this.topStack;
    const [ix, iy, iz] = [1 / dx, 1 / dy, 1 / dz];
    this.t = farthest;
    let found = false;
    let depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
      const node = stack[--depth];
      const count = links[2 * node + 1];
      if (count === 0) {
        const child = links[2 * node];
        const first = entry(bounds, 6 * child, ox, oy, oz, ix, iy, iz, this.t);
        const second = entry(bounds, 6 * child + 6, ox, oy, oz, ix, iy, iz, this.t);
        const swap = second < first ? 1 : 0; // the nearer one is walked first
        if (Math.max(first, second) < Infinity) {
          stack[depth++] = child + 1 - swap;
        }
        if (Math.min(first, second) < Infinity) {
          stack[depth++] = child + swap;
        }
        continue;
      }
      for (let i = 0; i < count; ++i) {
        const place = order[links[2 * node] + i];
        const shape = this.shapes[this.shapeOf[place]];
        if (any && !shape.mesh.casts) {
          continue;
        }
        const m = this.objectFromWorld;
        const at = 12 * place;
        const met = this.walkShape(
          shape,
          m[at] * ox + m[at + 1] * oy + m[at + 2] * oz + m[at + 3],
          m[at + 4] * ox + m[at + 5] * oy + m[at + 6] * oz + m[at + 7],
          m[at + 8] * ox + m[at + 9] * oy + m[at + 10] * oz + m[at + 11],
          m[at] * dx + m[at + 1] * dy + m[at + 2] * dz,
          m[at + 4] * dx + m[at + 5] * dy + m[at + 6] * dz,
          m[at + 8] * dx + m[at + 9] * dy + m[at + 10] * dz,
          any,
        );
        if (met) {
          if (any) {
            return true;
          }
          this.hitPlace = place;
          found = true;
        }
      }
    }
    return found;
  }

  /** The same within one shape, in its own space. */
  private walkShape(shape: Shape, ox: number, oy: number, oz: number, dx: number, dy: number, dz: number, any: boolean): boolean {
    const { bounds, links } = shape.tree;
    const stack = this.stack;
    const [ix, iy, iz] = [1 / dx, 1 / dy, 1 / dz];
    let found = false;
    let depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
      const node = stack[--depth];
      const count = links[2 * node + 1];
      if (count === 0) {
        const child = links[2 * node];
        const first = entry(bounds, 6 * child, ox, oy, oz, ix, iy, iz, this.t);
        const second = entry(bounds, 6 * child + 6, ox, oy, oz, ix, iy, iz, this.t);
        const swap = second < first ? 1 : 0; // the nearer one is walked first
        if (Math.max(first, second) < Infinity) {
          stack[depth++] = child + 1 - swap;
        }
        if (Math.min(first, second) < Infinity) {
          stack[depth++] = child + swap;
        }
        continue;
      }
      for (let i = links[2 * node]; i < links[2 * node] + count; ++i) {
        if (this.meetsTriangle(shape, i, ox, oy, oz, dx, dy, dz, any)) {
          if (any) {
            return true;
          }
          this.hitTriangle = i;
          found = true;
        }
      }
    }
    return found;
  }

  private meetsTriangle(shape: Shape, triangle: number, ox: number, oy: number, oz: number, dx: number, dy: number, dz: number, any: boolean): boolean {
    const c = shape.corners;
    const at = 9 * triangle;
    const [ax, ay, az] = [c[at], c[at + 1], c[at + 2]];
    const [bx, by, bz] = [c[at + 3] - ax, c[at + 4] - ay, c[at + 5] - az];
    const [cx, cy, cz] = [c[at + 6] - ax, c[at + 7] - ay, c[at + 8] - az];
    const [px, py, pz] = [dy * cz - dz * cy, dz * cx - dx * cz, dx * cy - dy * cx];
    const determinant = bx * px + by * py + bz * pz;
    // Positive: the triangle's front is met. Surfaces with one side are seen from their front, and cast from both.
    if (determinant === 0 || (!any && determinant < 0 && !shape.material.double_sided && shape.material.cutoff === 0)) {
      return false;
    }
    const [sx, sy, sz] = [ox - ax, oy - ay, oz - az];
    const u = (sx * px + sy * py + sz * pz) / determinant;
    if (u < 0 || u > 1) {
      return false;
    }
    const [qx, qy, qz] = [sy * bz - sz * by, sz * bx - sx * bz, sx * by - sy * bx];
    const v = (dx * qx + dy * qy + dz * qz) / determinant;
    if (v < 0 || u + v > 1) {
      return false;
    }
    const t = (cx * qx + cy * qy + cz * qz) / determinant;
    if (t <= 0 || t >= this.t || (shape.material.cutoff > 0 && !this.solid(shape, triangle, u, v))) {
      return false;
    }
    this.t = t;
    return true;
  }

  /** Is a surface with holes solid there? Its image is read at its finest level, linearly. */
  private solid(shape: Shape, triangle: number, u: number, v: number): boolean {
    const [a, b, c] = shape.vertices.subarray(3 * triangle, 3 * triangle + 3);
    const w = 1 - u - v;
    const alpha = shape.material.colour[3] * (w * this.alphas[a] + u * this.alphas[b] + v * this.alphas[c]);
    const x = w * this.uvs[2 * a] + u * this.uvs[2 * b] + v * this.uvs[2 * c];
    const y = w * this.uvs[2 * a + 1] + u * this.uvs[2 * b + 1] + v * this.uvs[2 * c + 1];
    return alpha * this.imageAlpha(shape.material.image, x, y) >= shape.material.cutoff;
  }

  private imageAlpha(image: number, u: number, v: number): number {
    if (image < 0) {
      return 1;
    }
    const side = this.world.image_side;
    const x = u * side - 0.5;
    const y = v * side - 0.5;
    const [left, top] = [Math.floor(x), Math.floor(y)];
    const texel = (i: number, j: number): number => {
      const column = ((i % side) + side) % side;
      const row = ((j % side) + side) % side;
      return this.world.imageBytes[((image * side + row) * side + column) * 4 + 3];
    };
    const upper = texel(left, top) + (x - left) * (texel(left + 1, top) - texel(left, top));
    const lower = texel(left, top + 1) + (x - left) * (texel(left + 1, top + 1) - texel(left, top + 1));
    return (upper + (y - top) * (lower - upper)) / 255;
  }
}

/** Where a ray enters a box, in lengths of its direction; infinite where it misses it. */
function entry(b: Float32Array, at: number, ox: number, oy: number, oz: number, ix: number, iy: number, iz: number, farthest: number): number {
  const x0 = (b[at] - ox) * ix;
  const x1 = (b[at + 3] - ox) * ix;
  const y0 = (b[at + 1] - oy) * iy;
  const y1 = (b[at + 4] - oy) * iy;
  const z0 = (b[at + 2] - oz) * iz;
  const z1 = (b[at + 5] - oz) * iz;
  const enter = Math.max(x0 < x1 ? x0 : x1, y0 < y1 ? y0 : y1, z0 < z1 ? z0 : z1, 0);
  const leave = Math.min(x0 > x1 ? x0 : x1, y0 > y1 ? y0 : y1, z0 > z1 ? z0 : z1, farthest);
  return enter > leave ? Infinity : enter || 0; // NaN, of a ray inside a flat box, must not hide what is there
}
