// SPDX-License-Identifier: Apache-2.0
// A built-in world, as data/write_world.cpp writes it.
import type { Vec3 } from './vectors.ts';

export interface Material {
  name: string;
  /** Linear, alpha is coverage. */
  colour: [number, number, number, number];
  /** The layer of its image, or -1. */
  image: number;
  /** Alpha below which it has a hole; 0: it has none. */
  cutoff: number;
  double_sided: boolean;
}

/** Triangles of one material, at one or several places. */
export interface Mesh {
  first_vertex: number;
  first_index: number;
  indices: number;
  first_place: number;
  places: number;
  material: number;
  casts: boolean;
}

interface Header {
  name: string;
  summary: string;
  meshes: Mesh[];
  materials: Material[];
  views: { name: string; eye: Vec3; target: Vec3; fov_y_rad: number }[];
  sun: { direction: Vec3; colour: Vec3 };
  sky: { zenith: Vec3; horizon: Vec3; ground: Vec3; ambient: number; exposure: number };
  vertices: number;
  indices: number;
  places: number;
  images: number;
  image_side: number;
}

export interface World extends Header {
  /** kVertexBytes for each: position 3 x float, normal 4 x snorm8, colour 4 x unorm8 whose squares are linear, uv 2 x half. */
  vertexBytes: Uint8Array<ArrayBuffer>;
  /** Within a mesh, from its first vertex. */
  indexValues: Uint32Array<ArrayBuffer>;
  /** world_from_object, 12 for each place: three rows of four. */
  placeValues: Float32Array<ArrayBuffer>;
  /** RGBA8, all images one after the other; sRGB-encoded. */
  imageBytes: Uint8Array<ArrayBuffer>;
}

export const kVertexBytes = 24;

/** Throws an Error where the bytes are no world. */
export function readWorld(bytes: ArrayBuffer): World {
  const words = new Uint32Array(bytes, 0, 2);
  if (words[0] !== 0x31574e47) {
    throw new Error('The world’s file does not begin as such files do; build the page again');
  }
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 8, words[1]))) as Header;
  let at = 8 + words[1];
  const take = (length: number): number => {
    at += length;
    return at - length;
  };
  return {
    ...header,
    vertexBytes: new Uint8Array(bytes, take(header.vertices * kVertexBytes), header.vertices * kVertexBytes),
    indexValues: new Uint32Array(bytes, take(header.indices * 4), header.indices),
    placeValues: new Float32Array(bytes, take(header.places * 48), header.places * 12),
    imageBytes: new Uint8Array(bytes, take(header.images * header.image_side ** 2 * 4), header.images * header.image_side ** 2 * 4),
  };
}

/** Throws an Error where the file cannot be had. */
export async function fetchWorld(name: string): Promise<ArrayBuffer> {
  const answer = await fetch(`worlds/${name}.world.gz`);
  if (!answer.ok || !answer.body) {
    throw new Error(`The world ${name} could not be loaded (${answer.status}); reload the page`);
  }
  const packed = new Uint8Array(await answer.arrayBuffer());
  // A server may say that the file is compressed; the browser has unpacked it then.
  if (packed[0] !== 0x1f || packed[1] !== 0x8b) {
    return packed.buffer;
  }
  return new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream('gzip'))).arrayBuffer();
}

/** A half of IEEE 754, as a number. */
function half(bits: number): number {
  const exponent = (bits >> 10) & 31;
  const fraction = bits & 1023;
  const size = exponent === 0 ? fraction * 2 ** -24 : (1 + fraction / 1024) * 2 ** (exponent - 15);
  return bits & 0x8000 ? -size : size;
}

/** Positions (3 each), alphas and texture coordinates (2 each) of all vertices. */
export function unpackVertices(world: World): { positions: Float32Array; alphas: Float32Array; uvs: Float32Array<ArrayBuffer> } {
  const view = new DataView(world.vertexBytes.buffer, world.vertexBytes.byteOffset, world.vertexBytes.byteLength);
  const positions = new Float32Array(world.vertices * 3);
  const alphas = new Float32Array(world.vertices);
  const uvs = new Float32Array(world.vertices * 2);
  for (let i = 0; i < world.vertices; ++i) {
    const at = i * kVertexBytes;
    for (let k = 0; k < 3; ++k) {
      positions[3 * i + k] = view.getFloat32(at + 4 * k, true);
    }
    alphas[i] = (view.getUint8(at + 19) / 255) ** 2;
    uvs[2 * i] = half(view.getUint16(at + 20, true));
    uvs[2 * i + 1] = half(view.getUint16(at + 22, true));
  }
  return { positions, alphas, uvs };
}
