// SPDX-License-Identifier: Apache-2.0
// Makes a visibility mask from a plan by WebGPU. Never submits a frame's commands, never waits for the GPU, reads nothing back.
import {Executor, type CasterPass, type DrawCasters} from './executor.js';
import type {Gnomon, Plan, Planner} from './planner.js';
import {Recorder} from './recorder.js';
import type {Shaders} from './shaders.js';
import {GnomonError} from './wasm.js';

export type {CasterPass, DrawCasters};

/** The host's inputs of the mask: 2D textures of the size that `prepare()` was given, with usage TEXTURE_BINDING. */
export interface MaskInputs {
    /** The camera's depth: a depth format, or r32float. */
    depth: GPUTexture;
    /** Geometric world-space normals, octahedral in two channels of -1 to 1 (rg16float, rg32float, rg8snorm). Else taken from depth. */
    normal?: GPUTexture;
    /** By how much a channel of `normal` is off at most, where it was coarser than the texture is. Default: by the texture's format. */
    normalRounding?: number;
    /** For smooth-shaded meshes: the result of gnomonSmoothEncode() in rgba16float. */
    smooth?: GPUTexture;
    /** Index of the object in the set + 1, in r32uint, 0 where a receiver wants no shadow at all. */
    objectId?: GPUTexture;
}

/** How a ShadowRenderer is made. */
export interface ShadowRendererOptions {
    /** The package's shaders: `await loadShaders()`. */
    shaders: Shaders;
    /** Sub-pixel bits with which the device places vertices, 4 to 24; WebGPU does not tell. Default: 4, the least that there is. */
    subPixelBits?: number;
}

/** The maps that the last `drawMaps()` drew, and those that it did not have to. */
export interface MapReuse {drawn: number, keptDrawn: number, restored: number, held: number}

/** Features that a device should be asked for, as far as the adapter has them. None is required. */
export function wantedFeatures(adapter: GPUAdapter): GPUFeatureName[] {
    const wanted = ['depth-clip-control', 'float32-filterable', 'texture-formats-tier1'] as GPUFeatureName[];
    return wanted.filter(one => adapter.features.has(one));
}

/**
 * Draws plans of one planner on one device.
 *
 * In each frame call `prepare()`, then `draw()` (or `drawMaps()` and `drawMask()`), and submit the encoder before the next
 * `prepare()`. Throws GnomonError from `prepare()` for what it does not draw, with a sentence, and for what the device lacks.
 * After an error all maps are drawn again.
 */
export class ShadowRenderer {
    /** Does the device clamp casters onto near planes? Give it to the planner as `Frame.clampsDepth`. */
    readonly clampsDepth: boolean;
    private readonly planner: Planner;
    private readonly recorder: Recorder;
    private readonly executor: Executor;

    constructor(device: GPUDevice, gnomon: Gnomon, planner: Planner, options: ShadowRendererOptions) {
        if (planner.wasm !== gnomon.wasm) {
            throw new GnomonError('make a renderer', 'the planner is of another Gnomon', 'give the Gnomon that made it');
        }
        this.clampsDepth = device.features.has('depth-clip-control');
        this.planner = planner;
        this.recorder = new Recorder(planner, {mostLayers: device.limits.maxTextureArrayLayers,
                                               uniformAlignment: device.limits.minUniformBufferOffsetAlignment}, options.subPixelBits ?? 4);
        this.executor = new Executor(device, options.shaders);
    }

    /**
     * Makes images and buffers for the planner's last plan, and a mask of this size; none for size 0, for a host that shades from the
     * maps. Larger images take over what maps held, by commands that it submits. True where `mask` or `maps()` is another texture.
     */
    prepare(plan: Plan, sizePx: readonly [number, number]): boolean {
        this.requireLast(plan);
        if (!this.clampsDepth && plan.views.some(view => view.clampNear !== 0)) {
            throw new GnomonError('prepare shadow maps', 'the plan clamps casters onto near planes, and the device lacks depth-clip-control',
                                  'ask for the feature, or plan with clampsDepth: renderer.clampsDepth');
        }
        return this.guarded(() => {
            const list = this.recorder.prepare(sizePx);
            this.executor.begin();
            this.executor.submit(list);
            return this.recorder.changed;
        });
    }

    /**
     * Compiles in the background the modules that `draw()` of this plan runs. Call it after `prepare()`. It draws nothing, and the maps
     * are lost: call `prepare()` again before `draw()`. Pipelines of casters are the host's. Rejects with GnomonError or GPUPipelineError.
     */
    async warmUp(plan: Plan, inputs: MaskInputs): Promise<void> {
        this.requireLast(plan);
        const begun = this.guarded(() => {
            this.executor.setInputs(inputs);
            return this.executor.compile([...this.recorder.drawMaps(), ...this.recorder.drawMask(inputs, plan.reversedZ)]);
        });
        this.recorder.lose(true);
        await begun;
    }
    /** Records `drawMaps()` and `drawMask()`. */
    draw(encoder: GPUCommandEncoder, plan: Plan, inputs: MaskInputs, drawCasters: DrawCasters): void {
        this.drawMaps(encoder, plan, drawCasters);
        this.drawMask(encoder, plan, inputs);
    }
    /** Records the maps that are out of date. `drawCasters` is called once for each. */
    drawMaps(encoder: GPUCommandEncoder, plan: Plan, drawCasters: DrawCasters): void {
        this.requireLast(plan);
        this.guarded(() => this.executor.run(this.recorder.drawMaps(), encoder, plan, drawCasters));
    }
    /** Records the mask: every layer, every channel, 1 = fully lit. */
    drawMask(encoder: GPUCommandEncoder, plan: Plan, inputs: MaskInputs): void {
        this.requireLast(plan);
        this.guarded(() => {
            this.executor.setInputs(inputs);
            this.executor.run(this.recorder.drawMask(inputs, plan.reversedZ), encoder, plan, () => undefined);
        });
    }
    /** The contents of maps are lost: the next `drawMaps()` draws all of them again. */
    reset(): void {
        this.recorder.lose(false);
    }

    /**
     * r8unorm for one light, else rgba8unorm: a 2D array, one layer per four lights and one for each coloured light
     * (`LightPlan.maskLayer`, `maskChannel`). Holds until the next `prepare()`.
     */
    get mask(): GPUTexture {
        const found = this.executor.texture({kind: 'mask', options: 0});
        if (!found) {
            throw new GnomonError('give the mask', 'there is none', 'call prepare() with a size first');
        }
        return found;
    }
    /** The maps of one of the planner's options, a 2D array; null where no light names them. */
    maps(options = 0): GPUTexture | null {
        return this.executor.texture({kind: 'maps', options});
    }
    /** By the last `drawMaps()`. */
    get reuse(): MapReuse {
        return this.recorder.reuse;
    }
    /** Gives all textures and buffers back. */
    destroy(): void {
        this.executor.destroy();
        this.recorder.free();
    }

    private requireLast(plan: Plan): void {
        if (plan !== this.planner.last) {
            throw new GnomonError('draw a plan', 'it is not the planner\'s last', 'draw each plan before the next one is made');
        }
    }
    private guarded<T>(body: () => T): T {
        try {
            return body();
        } catch (error) {
            this.recorder.lose(true);
            throw error;
        }
    }
}
