// SPDX-License-Identifier: Apache-2.0
// A world's vertices, places, images and materials on the device, and the draws of its surfaces.
import sceneText from './scene.wgsl';
import type { Vec3 } from './vectors.ts';
import { kVertexBytes, unpackVertices, type Mesh, type World } from './world.ts';

const kMaterialBytes = 256; // what offsets of uniforms are multiples of

const kVertexLayout: GPUVertexBufferLayout = {
  arrayStride: kVertexBytes,
  attributes: [
    { shaderLocation: 0, offset: 0, format: 'float32x3' },
    { shaderLocation: 1, offset: 12, format: 'snorm8x4' },
    { shaderLocation: 2, offset: 16, format: 'unorm8x4' },
    { shaderLocation: 3, offset: 20, format: 'float16x2' },
  ],
};
const kPlaceLayout: GPUVertexBufferLayout = {
  arrayStride: 48, stepMode: 'instance',
  attributes: [4, 5, 6].map((shaderLocation, row) => ({ shaderLocation, offset: 16 * row, format: 'float32x4' }) as const),
};

export interface Bounds {
  min: Vec3;
  max: Vec3;
}

export class SceneOnGpu {
  readonly vertices: GPUBuffer;
  readonly indices: GPUBuffer;
  readonly places: GPUBuffer;
  /** Texture coordinates of all vertices, float32x2. */
  readonly uvs: GPUBuffer;
  readonly images: GPUTexture;
  /** Bounds of each place, in the world. */
  readonly bounds: Bounds[];
  /** Half the diagonal of everything, metres. */
  readonly radius: number;
  private readonly materials: GPUBuffer;
  private readonly bindings: GPUBindGroup;
  private readonly pipelines: GPURenderPipeline[]; // by kind, below

  constructor(private readonly device: GPUDevice, readonly world: World, frame: GPUBuffer, sampler: GPUSampler, colours: GPUTextureFormat[],
              depth: GPUTextureFormat) {
    this.vertices = this.upload(world.vertexBytes, GPUBufferUsage.VERTEX);
    this.indices = this.upload(world.indexValues, GPUBufferUsage.INDEX);
    this.places = this.upload(world.placeValues, GPUBufferUsage.VERTEX);
    const unpacked = unpackVertices(world);
    this.uvs = this.upload(unpacked.uvs, GPUBufferUsage.VERTEX);
    this.images = this.uploadImages();
    this.materials = this.uploadMaterials();
    this.bounds = boundsOf(world, unpacked.positions);
    const all = unionOf(this.bounds);
    this.radius = 0.5 * Math.hypot(...all.max.map((one, k) => one - all.min[k]));
    const layout = this.layout();
    const entries = [{ buffer: frame }, this.images.createView({ dimension: '2d-array' }), sampler, { buffer: this.materials, size: 32 }];
    this.bindings = device.createBindGroup({ layout, entries: entries.map((resource, binding) => ({ binding, resource })) });
    const module = device.createShaderModule({ code: sceneText });
    this.pipelines = [0, 1, 2].map((kind) => device.createRenderPipeline({
      layout: device.createPipelineLayout({ bindGroupLayouts: [layout] }),
      vertex: { module, entryPoint: 'vertex', buffers: [kVertexLayout, kPlaceLayout] },
      primitive: { cullMode: kind === 0 ? 'back' : 'none' },
      fragment: { module, entryPoint: kind === 2 ? 'masked' : 'opaque', targets: colours.map((format) => ({ format })) },
      depthStencil: { format: depth, depthCompare: 'greater', depthWriteEnabled: true },
    }));
  }

  destroy(): void {
    [this.vertices, this.indices, this.places, this.uvs, this.materials, this.images].forEach((one) => one.destroy());
  }

  /** How a mesh is drawn: 0 one side, 1 both sides, 2 with holes. */
  kindOf(mesh: Mesh): number {
    const material = this.world.materials[mesh.material];
    return material?.cutoff > 0 ? 2 : material?.double_sided ? 1 : 0;
  }

  draw(pass: GPURenderPassEncoder): void {
    pass.setVertexBuffer(0, this.vertices);
    pass.setVertexBuffer(1, this.places);
    pass.setIndexBuffer(this.indices, 'uint32');
    for (let kind = 0; kind < this.pipelines.length; ++kind) {
      pass.setPipeline(this.pipelines[kind]);
      for (const mesh of this.world.meshes.filter((one) => this.kindOf(one) === kind)) {
        pass.setBindGroup(0, this.bindings, [kMaterialBytes * (mesh.material + 1)]);
        pass.drawIndexed(mesh.indices, mesh.places, mesh.first_index, mesh.first_vertex, mesh.first_place);
      }
    }
  }

  private layout(): GPUBindGroupLayout {
    const both = GPUShaderStage.VERTEX | GPUShaderStage.FRAGMENT;
    return this.device.createBindGroupLayout({
      entries: [
        { binding: 0, visibility: both, buffer: {} },
        { binding: 1, visibility: GPUShaderStage.FRAGMENT, texture: { viewDimension: '2d-array' } },
        { binding: 2, visibility: GPUShaderStage.FRAGMENT, sampler: {} },
        { binding: 3, visibility: GPUShaderStage.FRAGMENT, buffer: { hasDynamicOffset: true } },
      ],
    });
  }

  private upload(data: Uint8Array<ArrayBuffer> | Uint32Array<ArrayBuffer> | Float32Array<ArrayBuffer>, usage: GPUBufferUsageFlags): GPUBuffer {
    const buffer = this.device.createBuffer({ size: Math.max(4, data.byteLength), usage: usage | GPUBufferUsage.COPY_DST });
    this.device.queue.writeBuffer(buffer, 0, data);
    return buffer;
  }

  /** Row 0 is the plain material, for meshes that have none. */
  private uploadMaterials(): GPUBuffer {
    const floats = new Float32Array((kMaterialBytes / 4) * (this.world.materials.length + 1));
    const integers = new Int32Array(floats.buffer);
    floats.set([1, 1, 1, 1]);
    integers[4] = -1;
    this.world.materials.forEach((material, i) => {
      const at = (kMaterialBytes / 4) * (i + 1);
      floats.set(material.colour, at);
      integers[at + 4] = material.image;
      floats[at + 5] = material.cutoff;
    });
    return this.upload(floats, GPUBufferUsage.UNIFORM);
  }

  /** All images with their mip levels, as layers of one texture. */
  private uploadImages(): GPUTexture {
    const { image_side: side, images: layers, imageBytes } = this.world;
    const levels = Math.log2(side) + 1;
    const texture = this.device.createTexture({
      size: [side, side, Math.max(layers, 2)], format: 'rgba8unorm-srgb', mipLevelCount: levels,
      usage: GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST,
    });
    for (let layer = 0; layer < layers; ++layer) {
      let texels = imageBytes.subarray(layer * side * side * 4, (layer + 1) * side * side * 4);
      for (let level = 0; level < levels; ++level) {
        const width = side >> level;
        this.device.queue.writeTexture({ texture, mipLevel: level, origin: [0, 0, layer] }, texels, { bytesPerRow: width * 4 }, [width, width]);
        texels = halved(texels, width);
      }
    }
    return texture;
  }
}

/** A square image at half the size: means of 2 x 2 texels. */
function halved(texels: Uint8Array<ArrayBuffer>, side: number): Uint8Array<ArrayBuffer> {
  const half = side >> 1;
  const out = new Uint8Array(half * half * 4);
  for (let i = 0; i < out.length; ++i) {
    const at = (Math.floor(i / 4 / half) * 2 * side + ((i >> 2) % half) * 2) * 4 + (i & 3);
    out[i] = (texels[at] + texels[at + 4] + texels[at + 4 * side] + texels[at + 4 * side + 4] + 2) >> 2;
  }
  return out;
}

function unionOf(all: Bounds[]): Bounds {
  const out: Bounds = { min: [Infinity, Infinity, Infinity], max: [-Infinity, -Infinity, -Infinity] };
  for (const one of all) {
    for (let k = 0; k < 3; ++k) {
      out.min[k] = Math.min(out.min[k], one.min[k]);
      out.max[k] = Math.max(out.max[k], one.max[k]);
    }
  }
  return out;
}

function boundsOf(world: World, positions: Float32Array): Bounds[] {
  const out: Bounds[] = [];
  for (const mesh of world.meshes) {
    const own: Bounds = { min: [Infinity, Infinity, Infinity], max: [-Infinity, -Infinity, -Infinity] };
    for (let i = mesh.first_index; i < mesh.first_index + mesh.indices; ++i) {
      const at = 3 * (mesh.first_vertex + world.indexValues[i]);
      for (let k = 0; k < 3; ++k) {
        own.min[k] = Math.min(own.min[k], positions[at + k]);
        own.max[k] = Math.max(own.max[k], positions[at + k]);
      }
    }
    for (let place = mesh.first_place; place < mesh.first_place + mesh.places; ++place) {
      const box: Bounds = { min: [0, 0, 0], max: [0, 0, 0] };
      for (let k = 0; k < 3; ++k) {
        const row = world.placeValues.subarray(12 * place + 4 * k, 12 * place + 4 * k + 4);
        box.min[k] = row[3] + [0, 1, 2].reduce((sum, j) => sum + Math.min(row[j] * own.min[j], row[j] * own.max[j]), 0);
        box.max[k] = row[3] + [0, 1, 2].reduce((sum, j) => sum + Math.max(row[j] * own.min[j], row[j] * own.max[j]), 0);
      }
      out[place] = box;
    }
  }
  return out;
}
