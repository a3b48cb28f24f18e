// SPDX-License-Identifier: Apache-2.0
// Pipelines and their layouts, made once for each module, constants, formats and kinds of bindings.
import type {ShaderModule, Shaders} from './shaders.js';
import {GnomonError} from './wasm.js';

/** A pipeline's bindings: group 0, and push data in group 3, which is the same for all. */
export interface Layouts {group0: GPUBindGroupLayout, all: GPUPipelineLayout}
/** The kind of a bound texture, which is part of a pipeline's layout. */
export type TextureKind = 'float' | 'unfilterable-float' | 'uint';

/** Bytes of push data that a module may have. */
export const PUSH_BYTES = 256;

export class Pipelines {
    private readonly device: GPUDevice;
    private readonly shaders: Shaders;
    private readonly made = new Map<string, unknown>();
    private readonly begun = new Map<string, Promise<unknown>>(); // pipelines that were compiled in the background, or are being
    private ahead: Promise<unknown>[] | null = null; // of the compileAhead() that runs
    private readonly empty: GPUBindGroupLayout;
    /** The layout of push data. */
    readonly push: GPUBindGroupLayout;

    constructor(device: GPUDevice, shaders: Shaders) {
        this.device = device;
        this.shaders = shaders;
        this.empty = device.createBindGroupLayout({entries: []});
        const {VERTEX, FRAGMENT, COMPUTE} = GPUShaderStage;
        this.push = device.createBindGroupLayout({label: 'gnomon push data', entries: [
            {binding: 0, visibility: VERTEX | FRAGMENT | COMPUTE, buffer: {type: 'uniform', hasDynamicOffset: true}}]});
    }

    module(name: string): ShaderModule {
        return this.shaders.get(name);
    }

    private once<T>(key: string, make: () => T): T {
        let found = this.made.get(key) as T | undefined;
        if (found === undefined) {
            found = make();
            this.made.set(key, found);
        }
        return found;
    }

    /** Pipelines that `body` asks for are compiled in the background, and it gets none. Done when all of them are there. */
    async compileAhead(body: () => void): Promise<void> {
        const all = this.ahead = [] as Promise<unknown>[];
        try {
            body();
        } finally {
            this.ahead = null;
        }
        await Promise.all(all);
    }
    private pipeline<T>(key: string, make: () => T, begin: () => Promise<T>): T | null {
        if (!this.ahead || this.made.has(key)) {
            return this.once(key, make);
        }
        const made = this.begun.get(key) ?? begin().then(one => this.made.set(key, one));
        this.begun.set(key, made);
        this.ahead.push(made);
        return null;
    }

    private code(name: string, form: string): GPUShaderModule {
        return this.once(`module ${name} ${form}`, () => {
            const files = this.module(name).files;
            const code = files['any'] ?? files[form];
            if (code === undefined) {
                throw new GnomonError(`run ${name}`, `WebGPU does not store to maps of ${form}`,
                                      `choose another map format: ${Object.keys(files).join(', ')}`);
            }
            return this.device.createShaderModule({label: `gnomon ${name}`, code});
        });
    }

    /** Specialization constants by id, of the words that a command has from id 0 on. */
    private constants(name: string, form: string, words: Uint32Array): Record<string, number> {
        const module = this.module(name);
        const code = module.files['any'] ?? module.files[form] ?? '';
        const view = new DataView(words.buffer, words.byteOffset, words.byteLength);
        const found: Record<string, number> = {};
        for (const [id, type] of Object.entries(module.constants)) {
            const at = 4 * Number(id);
            if (at < words.byteLength && code.includes(`@id(${id})`)) {
                found[id] = type === 'float' ? view.getFloat32(at, true) : type === 'int' ? view.getInt32(at, true) : view.getUint32(at, true);
            }
        }
        return found;
    }

    /** `kinds`: by binding, of each texture; `stores`: format of the storage images. */
    layouts(name: string, kinds: Map<number, TextureKind>, filters: Map<number, boolean>, stores: GPUTextureFormat | null): Layouts {
        const module = this.module(name);
        const key = `layout ${name} ${[...kinds].join()} ${[...filters].join()} ${stores}`;
        return this.once(key, () => {
            const visibility = name.endsWith('.comp') ? GPUShaderStage.COMPUTE : GPUShaderStage.FRAGMENT;
            const entries: GPUBindGroupLayoutEntry[] = [];
            for (const one of module.inputs) {
                const entry = {binding: one.binding, visibility};
                if (one.kind === 'uniform') {
                    entries.push({...entry, buffer: {type: 'uniform'}});
                } else if (one.kind === 'storage') {
                    entries.push({...entry, buffer: {type: one.access === 'read' ? 'read-only-storage' : 'storage'}});
                } else if (one.kind === 'texture') {
                    const multisampled = one.dimension === '2d_multisampled';
                    entries.push({...entry, texture: {sampleType: kinds.get(one.binding) ?? 'unfilterable-float',
                                                      viewDimension: viewDimension(one.dimension), multisampled}});
                    if (one.sampled) {
                        entries.push({binding: one.binding + 16, visibility,
                                      sampler: {type: filters.get(one.binding) ? 'filtering' : 'non-filtering'}});
                    }
                } else if (one.kind === 'storage_image') {
                    const access = one.access === 'read' ? 'read-only' : one.access === 'write' ? 'write-only' : 'read-write';
                    entries.push({...entry, storageTexture: {access, format: stores ?? 'r32uint', viewDimension: viewDimension(one.dimension)}});
                }
            }
            const group0 = this.device.createBindGroupLayout({label: `gnomon ${name}`, entries});
            const all = this.device.createPipelineLayout({bindGroupLayouts: [group0, this.empty, this.empty, this.push]});
            return {group0, all};
        });
    }

    compute(name: string, words: Uint32Array, layouts: Layouts, stores: string): GPUComputePipeline | null {
        const descriptor = () => ({
            label: `gnomon ${name}`, layout: layouts.all,
            compute: {module: this.code(name, stores), entryPoint: 'main', constants: this.constants(name, stores, words)}});
        return this.pipeline(`compute ${name} ${words.join()} ${stores} ${this.numberOf(layouts)}`,
                             () => this.device.createComputePipeline(descriptor()), () => this.device.createComputePipelineAsync(descriptor()));
    }

    /** A triangle over the target. Null, as of compute(): it is compiled ahead. */
    triangle(vertex: string, fragment: string, words: Uint32Array, layouts: Layouts, target: TargetState, least: boolean): GPURenderPipeline | null {
        const key = `draw ${vertex} ${fragment} ${words.join()} ${this.numberOf(layouts)} ${Object.values(target).join()} ${least}`;
        const descriptor = (): GPURenderPipelineDescriptor => ({
            label: `gnomon ${fragment}`, layout: layouts.all, primitive: {topology: 'triangle-list'},
            vertex: {module: this.code(vertex, 'any'), entryPoint: 'main'},
            fragment: {module: this.code(fragment, 'any'), entryPoint: 'main', constants: this.constants(fragment, 'any', words),
                       targets: colourTargets(target, least)},
            ...stateOf(target)});
        return this.pipeline(key, () => this.device.createRenderPipeline(descriptor()), () => this.device.createRenderPipelineAsync(descriptor()));
    }

    /** Triangles of the executor's own, which a layout of its own binds. */
    own(name: string, code: string, layout: GPUPipelineLayout, target: TargetState): GPURenderPipeline {
        return this.once(`own ${name} ${Object.values(target).join()}`, () => {
            const module = this.once(`own ${name}`, () => this.device.createShaderModule({label: `gnomon ${name}`, code}));
            return this.device.createRenderPipeline({
                label: `gnomon ${name}`, layout, primitive: {topology: 'triangle-list'},
                vertex: {module, entryPoint: 'triangle'},
                fragment: {module, entryPoint: target.colour ? 'with_colour' : 'depth_alone', targets: colourTargets(target, false)},
                ...stateOf(target)});
        });
    }

    private readonly numbers = new Map<Layouts, number>();
    private numberOf(layouts: Layouts): number {
        const number = this.numbers.get(layouts) ?? this.numbers.size;
        this.numbers.set(layouts, number);
        return number;
    }
}

/** Formats and samples of the images that are drawn to. */
export interface TargetState {
    colour: GPUTextureFormat | null;
    depth: GPUTextureFormat | null;
    samples: number;
    channels: number;
}

function stateOf(target: TargetState): Pick<GPURenderPipelineDescriptor, 'depthStencil' | 'multisample'> {
    return {multisample: {count: target.samples},
            ...(target.depth ? {depthStencil: {format: target.depth, depthWriteEnabled: true, depthCompare: 'always'}} : {})};
}

function colourTargets(target: TargetState, least: boolean): GPUColorTargetState[] {
    const min = {operation: 'min', srcFactor: 'one', dstFactor: 'one'} as const;
    return target.colour ? [{format: target.colour, writeMask: target.channels, ...(least ? {blend: {color: min, alpha: min}} : {})}] : [];
}

export function viewDimension(dimension: string): GPUTextureViewDimension {
    return dimension === '2d_array' ? '2d-array' : '2d';
}
