// SPDX-License-Identifier: Apache-2.0
// Draws a world by WebGPU: its surfaces, Gnomon's mask, and the lit picture with the truth beside it.
import { kViews, type PageState } from './address.ts';
import shadeText from './shade.wgsl';
import { Shadows, type Drawn } from './shadows.ts';
import smoothText from './smooth.wgsl';
import type { Choice } from './controls.ts';
import { readTexels, Screen } from './screen.ts';
import { SceneOnGpu } from './scene_on_gpu.ts';
import { clipFromWorld, inverseOfMatrix, radians, scale, type Camera, type Vec3 } from './vectors.ts';
import type { World } from './world.ts';

export interface Sight {
  camera: Camera;
  /** The way light travels, unit. */
  sun: Vec3;
}

export const kNear_m = 0.1;
const kClearest_m = 500; // haze begins to hide things no nearer
const kFrameFloats = 60;
const kFormats = { albedo: 'rgba8unorm', normal: 'rgb10a2unorm', geometric: 'rg16float', depth: 'depth32float', lit: 'rgba8unorm' } as const;

interface Targets {
  albedo: GPUTexture;
  normal: GPUTexture;
  geometric: GPUTexture;
  depth: GPUTexture;
  lit: GPUTexture;
  truth: GPUTexture;
}

export class Renderer {
  /** Called when a picture is on the canvas, with these shadows. */
  shown: (what: Drawn) => void = () => undefined;
  private readonly screen: Screen;
  private readonly frame: GPUBuffer;
  private readonly sampler: GPUSampler;
  private readonly shading: GPURenderPipeline;
  private readonly smoothing: GPURenderPipeline;
  private readonly copying: GPURenderPipeline;
  private readonly reading: GPURenderPipeline;
  private said = '';
  private scene: SceneOnGpu | undefined;
  private targets: Targets | undefined;

  /** Throws an Error where the device cannot make what it needs. */
  static async make(device: GPUDevice, canvas: HTMLCanvasElement, choices: readonly Choice[], software: boolean): Promise<Renderer> {
    return new Renderer(device, canvas, await Shadows.make(device, choices, software), software);
  }

  private constructor(private readonly device: GPUDevice, private readonly canvas: HTMLCanvasElement, readonly shadows: Shadows, software: boolean) {
    this.screen = new Screen(device, canvas, software, (what) => this.shown(what));
    const { screen } = this;
    this.frame = device.createBuffer({ size: 4 * kFrameFloats, usage: GPUBufferUsage.UNIFORM | GPUBufferUsage.COPY_DST });
    this.sampler = device.createSampler({ magFilter: 'linear', minFilter: 'linear', mipmapFilter: 'linear', addressModeU: 'repeat', addressModeV: 'repeat' });
    this.shading = this.screenPipeline(shadeText, 'shade', kFormats.lit);
    this.smoothing = this.screenPipeline(smoothText, 'smoothed', screen.format);
    this.copying = this.screenPipeline(smoothText, 'copied', screen.format);
    this.reading = this.screenPipeline(smoothText, 'first', 'r8unorm');
  }

  private screenPipeline(text: string, fragment: string, format: GPUTextureFormat): GPURenderPipeline {
    const module = this.device.createShaderModule({ code: text });
    return this.device.createRenderPipeline({
      layout: 'auto', vertex: { module, entryPoint: 'whole' },
      fragment: { module, entryPoint: fragment, targets: [{ format }] },
    });
  }

  setWorld(world: World): void {
    this.scene?.destroy();
    this.scene = new SceneOnGpu(this.device, world, this.frame, this.sampler, [kFormats.albedo, kFormats.normal, kFormats.geometric], kFormats.depth);
    this.shadows.setScene(this.scene);
  }

  private targetsOf(width: number, height: number): Targets {
    if (this.targets && this.targets.depth.width === width && this.targets.depth.height === height) {
      return this.targets;
    }
    Object.values(this.targets ?? {}).forEach((texture: GPUTexture) => texture.destroy());
    const usage = GPUTextureUsage.RENDER_ATTACHMENT | GPUTextureUsage.TEXTURE_BINDING;
    const make = (format: GPUTextureFormat, more = 0): GPUTexture => this.device.createTexture({ size: [width, height], format, usage: usage | more });
    this.targets = {
      albedo: make(kFormats.albedo), normal: make(kFormats.normal), geometric: make(kFormats.geometric), depth: make(kFormats.depth), lit: make(kFormats.lit),
      truth: make('r8unorm', GPUTextureUsage.COPY_DST),
    };
    return this.targets;
  }

  /** The traced visibility, a byte for each pixel of the canvas. */
  setTruth(visibility: Uint8Array<ArrayBuffer>): void {
    const { width, height } = this.canvas;
    if (visibility.length === width * height) {
      this.device.queue.writeTexture({ texture: this.targetsOf(width, height).truth }, visibility, { bytesPerRow: width }, [width, height]);
    }
  }

  private writeFrame(state: PageState, sight: Sight, world: World): Float64Array {
    const { width, height } = this.canvas;
    const clip = clipFromWorld(sight.camera, width / height, kNear_m);
    const data = new Float32Array(kFrameFloats);
    data.set(clip);
    data.set(inverseOfMatrix(clip), 16);
    data.set([...sight.camera.eye, Math.max(kClearest_m, 9 * this.radius)], 32);
    data.set([...scale(sight.sun, -1), Math.cos(Math.max(radians(state.light) / 2, 0.004))], 36);
    data.set([...world.sun.colour, 1.15 * world.sky.exposure], 40);
    data.set([...world.sky.zenith, 2.2 * world.sky.ambient], 44);
    data.set([...world.sky.horizon, 0], 48);
    data.set([...world.sky.ground, 0], 52);
    data.set([width, height, splitColumn(state, width), state.view === 'truth' ? 1 : kViews.indexOf(state.view)], 56);
    this.device.queue.writeBuffer(this.frame, 0, data);
    return clip;
  }

  /** The radius of what there is, metres. */
  get radius(): number {
    return this.scene?.radius ?? 1;
  }

  /** Draws a frame. `anew`: with other surfaces and shadows than the last frame's. The text that it returns is for the
   * visitor: why shadows are not as asked, or nothing. */
  draw(state: PageState, sight: Sight, anew: boolean): string {
    if (!this.scene) {
      return '';
    }
    const { width, height } = this.canvas;
    const targets = this.targetsOf(width, height);
    let said = this.said;
    const clip = this.writeFrame(state, sight, this.scene.world);
    const encoder = this.device.createCommandEncoder();
    if (anew) {
      const pass = encoder.beginRenderPass({
        colorAttachments: [targets.albedo, targets.normal, targets.geometric].map((texture) => ({ view: texture.createView(), loadOp: 'clear', storeOp: 'store' }) as const),
        depthStencilAttachment: { view: targets.depth.createView(), depthClearValue: 0, depthLoadOp: 'clear', depthStoreOp: 'store' },
      });
      this.scene.draw(pass);
      pass.end();
      said = this.shadows.record(encoder, { state, ...sight, clip_from_world: clip, width, height, depth: targets.depth, normal: targets.geometric });
    }
    const resources: GPUBindingResource[] = [
      { buffer: this.frame }, targets.depth.createView(), targets.albedo.createView(), targets.normal.createView(), this.shadows.mask(),
      targets.truth.createView(),
    ];
    this.fill(encoder, this.shading, targets.lit.createView(), resources);
    const last = state.view === 'shaded' ? this.smoothing : this.copying;
    this.fill(encoder, last, this.screen.view(), [targets.lit.createView(), this.sampler]);
    this.device.queue.submit([encoder.finish()]);
    this.screen.show(this.shadows.drawn);
    this.said = said;
    return said;
  }

  /** The mask of the last frame, a byte for each pixel. */
  async readMask(): Promise<Uint8Array> {
    const { width, height } = this.canvas;
    const usage = GPUTextureUsage.RENDER_ATTACHMENT | GPUTextureUsage.COPY_SRC;
    const copy = this.device.createTexture({ size: [width, height], format: 'r8unorm', usage });
    const encoder = this.device.createCommandEncoder();
    this.fill(encoder, this.reading, copy.createView(), [this.shadows.mask()]);
    this.device.queue.submit([encoder.finish()]);
    const out = await readTexels(this.device, copy, 1);
    copy.destroy();
    return out;
  }

  private fill(encoder: GPUCommandEncoder, pipeline: GPURenderPipeline, view: GPUTextureView, resources: GPUBindingResource[]): void {
    const pass = encoder.beginRenderPass({ colorAttachments: [{ view, loadOp: 'clear', storeOp: 'store' }] });
    pass.setPipeline(pipeline);
    const entries = resources.map((resource, binding) => ({ binding, resource }));
    pass.setBindGroup(0, this.device.createBindGroup({ layout: pipeline.getBindGroupLayout(0), entries }));
    pass.draw(3);
    pass.end();
  }
}

/** The first column that shows the truth. */
export function splitColumn(state: PageState, width: number): number {
  return state.view === 'truth' ? 0 : Math.round(state.split * width);
}
