// SPDX-License-Identifier: Apache-2.0
// Gnomon in the page: what the state asks for becomes options and a frame, and its plan becomes a mask.
import {
  CasterPipelines, flipY, loadGnomon, loadShaders, ShadowRenderer, type CasterMesh, type Gnomon, type ObjectSet, type Option, type Plan, type Planner,
  type Shaders,
} from 'gnomon-shadows';
import { kDefaults, partsOf, type PageState } from './address.ts';
import type { Choice } from './controls.ts';
import type { SceneOnGpu } from './scene_on_gpu.ts';
import { clipFromWorld, radians, type Camera, type Vec3 } from './vectors.ts';
import { kVertexBytes } from './world.ts';

export interface ShadowFrame {
  state: PageState;
  camera: Camera;
  /** The way light travels, unit. */
  sun: Vec3;
  /** y up, as WebGPU has it. */
  clip_from_world: Float64Array;
  width: number;
  height: number;
  depth: GPUTexture;
  /** Geometric normals, octahedral. */
  normal: GPUTexture;
}

/** The shadows that the last record() drew: none while shaders are compiled, then the stand-in's shadows, then those that are asked for. */
export type Drawn = 'nothing' | 'stand-in' | 'shadows';
/** Whose shadows are shown until those that are asked for have been compiled: its shaders compile soonest, and are the same for all worlds. */
export const kStandIn = 'hard+single+uniform';
const kDirectional = 0; // GnomonLightType
const kPlanned = 0; // GnomonOutcome
const kSoftwareTexels = 2 ** 20; // of maps whose size the planner chooses, where a processor draws them

export class Shadows {
  /** Maps of the last plan, and texels of these. */
  readonly counts = { maps: 0, texels: 0 };
  drawn: Drawn = 'nothing';
  /** Called when shaders have been compiled: record() draws others then. */
  compiled: () => void = () => undefined;
  private readonly ready = new Map<string, boolean>(); // are an option set's shaders compiled? False: they are being
  private readonly planner: Planner;
  private readonly renderer: ShadowRenderer;
  private readonly casters: CasterPipelines;
  private readonly applied = new Map<string, string>(); // options that are not the defaults
  private readonly lit: GPUTextureView; // where there are no shadows
  private objects: ObjectSet | undefined;
  private meshes: CasterMesh[][] = []; // by place
  private scene: SceneOnGpu | undefined;
  private frames = 0;
  private hasMask = false;

  private constructor(private readonly device: GPUDevice, private readonly gnomon: Gnomon, shaders: Shaders, private readonly choices: readonly Choice[],
                      private readonly software: boolean) {
    this.planner = gnomon.makePlanner();
    this.renderer = new ShadowRenderer(device, gnomon, this.planner, { shaders });
    this.casters = new CasterPipelines(device, this.planner, shaders);
    const texture = device.createTexture({ size: [1, 1], format: 'r8unorm', usage: GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST });
    device.queue.writeTexture({ texture }, Uint8Array.of(255), {}, [1, 1]);
    this.lit = texture.createView();
    this.begin();
  }

  /** Begins to compile the stand-in's shaders, which are the same in any world: of a box, while the world is loaded. */
  private begin(): void {
    const camera: Camera = { eye: [0, 2, 8], target: [0, 0, 0], fov: 45 };
    const input = (format: GPUTextureFormat): GPUTexture => this.device.createTexture({ size: [8, 8], format, usage: GPUTextureUsage.TEXTURE_BINDING });
    this.objects = this.gnomon.makeObjects();
    this.objects.add({ min: [-2, -2, -2], max: [2, 2, 2] });
    const state = { ...kDefaults, technique: kStandIn };
    this.isReady(this.optionsOf(state), {
      state, camera, sun: [0.6, -0.8, 0], clip_from_world: clipFromWorld(camera, 1, 0.1), width: 8, height: 8, depth: input('depth32float'), normal: input('rg16float'),
    });
  }

  /** Loads the library and its shaders. */
  static async make(device: GPUDevice, choices: readonly Choice[], software: boolean): Promise<Shadows> {
    const [gnomon, shaders] = await Promise.all([loadGnomon(), loadShaders()]);
    return new Shadows(device, gnomon, shaders, choices, software);
  }

  /** All options of the library. */
  options(): Option[] {
    return this.gnomon.options();
  }

  setScene(scene: SceneOnGpu): void {
    this.objects?.free();
    this.objects = this.gnomon.makeObjects();
    this.scene = scene;
    const { world } = scene;
    const uvs = scene.uvs;
    this.meshes = [];
    for (const mesh of world.meshes) {
      const material = world.materials[mesh.material];
      const caster: CasterMesh = {
        positions: scene.vertices, stride: kVertexBytes, indices: scene.indices, indexFormat: 'uint32', firstIndex: mesh.first_index, indexCount: mesh.indices,
        baseVertex: mesh.first_vertex,
      };
      if (material?.cutoff > 0) {
        const texture = scene.images.createView({ dimension: '2d', baseArrayLayer: Math.max(0, material.image), arrayLayerCount: 1, mipLevelCount: 1 });
        caster.holes = { uvs, texture, cutoff: material.cutoff };
      }
      const list = [caster];
      for (let place = mesh.first_place; place < mesh.first_place + mesh.places; ++place) {
        this.meshes[place] = list;
      }
    }
    // Objects are added in the order of places, so that an object's index is its place.
    const casts = world.meshes.flatMap((mesh) => Array.from({ length: mesh.places }, () => mesh.casts));
    scene.bounds.forEach(({ min, max }, place) => this.objects!.add({ min, max }, { casts: casts[place] }));
  }

  /** The options that a state asks for. */
  private optionsOf(state: PageState): Map<string, string> {
    const wanted = new Map(Object.entries({ ...partsOf(state.technique, this.choices), ...state.options }));
    if (state.map > 0) {
      wanted.set('map-size', String(state.map));
    } else if (this.software) {
      wanted.set('texels', String(kSoftwareTexels));
    }
    return wanted;
  }

  /** Gives them to the planner. Throws with a sentence where one cannot be had. */
  private apply(wanted: Map<string, string>): void {
    for (const key of new Set([...this.applied.keys(), ...wanted.keys()])) {
      const value = wanted.get(key) ?? '';
      if ((this.applied.get(key) ?? '') !== value) {
        this.planner.set(key, value);
        this.applied.set(key, value);
      }
    }
    this.planner.check(kDirectional);
  }

  /** A plan with these options, whose images are there. Throws as apply() does. */
  private plan(options: Map<string, string>, frame: ShadowFrame): Plan {
    this.apply(options);
    const plan = this.planner.plan({
      index: ++this.frames, widthPx: frame.width, heightPx: frame.height, objects: this.objects!, clampsDepth: this.renderer.clampsDepth,
      camera: { eyeWs: frame.camera.eye, clipFromWorld: flipY(frame.clip_from_world), reversedZ: true },
      lights: [{ key: 1, type: kDirectional, directionWs: frame.sun, angularDiameterRad: radians(frame.state.light) }],
    });
    this.renderer.prepare(plan, [frame.width, frame.height]);
    return plan;
  }

  /** Have the shaders of these options been compiled? Else that begins. Throws where the options cannot be had. */
  private isReady(options: Map<string, string>, frame: ShadowFrame): boolean {
    const key = JSON.stringify([...options].sort());
    if (!this.ready.has(key)) {
      const begun = this.renderer.warmUp(this.plan(options, frame), { depth: frame.depth, normal: frame.normal });
      this.ready.set(key, false);
      const done = (): unknown => this.ready.set(key, true); // what is wrong, if anything is, record() says
      void begun.then(done, done).then(() => this.compiled());
    }
    return this.ready.get(key)!;
  }

  /** Records maps and mask. The text that it returns is for the visitor: why the shadows are not as asked, or nothing. */
  record(encoder: GPUCommandEncoder, frame: ShadowFrame): string {
    const last = this.drawn;
    this.hasMask = false;
    this.drawn = 'nothing';
    if (!this.objects || !this.scene) {
      return '';
    }
    try {
      const standIn = this.optionsOf({ ...frame.state, technique: kStandIn, options: {} });
      if (!this.isReady(standIn, frame)) {
        return '';
      }
      const asked = this.optionsOf(frame.state);
      // Others' shaders are compiled once the stand-in's shadows are seen: they would take processors from it.
      const isReady = last !== 'nothing' && this.isReady(asked, frame);
      const plan = this.plan(isReady ? asked : standIn, frame);
      const places = this.scene.world.placeValues;
      this.renderer.draw(encoder, plan, { depth: frame.depth, normal: frame.normal }, (pass) =>
        this.casters.draw(pass, (object) => this.meshes[object], (object) => places.subarray(12 * object, 12 * object + 12)));
      this.hasMask = true;
      this.drawn = isReady ? 'shadows' : 'stand-in';
      if (last === 'nothing') { // it is submitted first
        setTimeout(() => void this.device.queue.onSubmittedWorkDone().then(() => this.compiled()));
      }
      return this.outcome(plan);
    } catch (error) {
      this.drawn = 'shadows'; // that there are none is said
      return `${error instanceof Error ? error.message : error}.`;
    }
  }

  private outcome(plan: Plan): string {
    this.counts.maps = plan.views.length;
    this.counts.texels = plan.views.reduce((sum, view) => sum + view.tileWidth * view.tileHeight, 0);
    const light = plan.lights[0];
    return light.outcome === kPlanned ? '' : light.reason;
  }

  /** The mask of the last record(); light everywhere if there is none. */
  mask(): GPUTextureView {
    return this.hasMask ? this.renderer.mask.createView({ dimension: '2d', baseArrayLayer: 0, arrayLayerCount: 1 }) : this.lit;
  }
}
