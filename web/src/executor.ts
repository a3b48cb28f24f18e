// SPDX-License-Identifier: Apache-2.0
// Carries out the commands of a frame by WebGPU. It knows nothing of shadows.
import type {Binding, BufferRef, Command, DrawTriangle, ImageRef, RunCompute, Target, Tile} from './commands.js';
import {Pipelines, PUSH_BYTES, viewDimension, type Layouts, type TargetState, type TextureKind} from './pipelines.js';
import type {Plan} from './planner.js';
import type {View} from './layouts.js';
import {keyOf, Resources, type Image} from './resources.js';
import type {Shaders} from './shaders.js';
import {Uploads} from './uploads.js';
import {GnomonError} from './wasm.js';

/** One map to draw, given to the host's callback. Its pass is begun and cleared, viewport and scissor are set. */
export interface CasterPass {
    /** Draw with it, and do not end it. */
    encoder: GPURenderPassEncoder;
    plan: Plan;
    view: View;
    /** Its place in `Plan.views`, for `Planner.writeCasterRows()`. */
    viewIndex: number;
    /** Object indices to draw. */
    casters: Uint32Array;
    /** Null: depth only. Else the fragment shader writes gnomonCasterTexel() (gnomon/caster.glsl). */
    colourFormat: GPUTextureFormat | null;
    depthFormat: GPUTextureFormat;
    samples: number;
    /** GPUColorWrite flags: the channels that the map has of its texels. */
    colourWriteMask: GPUColorWriteFlags;
    /** Depth only: the fragment shader writes the metric as depth; with several samples at each. */
    writesFragDepth: boolean;
    /** `unclippedDepth` of the pipeline: casters before the near plane are clamped onto it. */
    clampsDepth: boolean;
}
/** Draws one map's casters: all triangles, with a depth test of "less-equal" that writes depth. */
export type DrawCasters = (pass: CasterPass) => void;

// Copies a rectangle of depths, which WebGPU copies as wholes alone; and sets a rectangle to 1.
const COPY = (type: string, index: string) => `
@group(0) @binding(0) var source: ${type};
@group(0) @binding(1) var<uniform> offset: vec4<i32>;
@vertex fn triangle(@builtin(vertex_index) i: u32) -> @builtin(position) vec4<f32> {
    return vec4<f32>(f32((i << 1u) & 2u) * 2.0 - 1.0, f32(i & 2u) * 2.0 - 1.0, 1.0, 1.0);
}
@fragment fn depth_alone(@builtin(position) p: vec4<f32>${index === '0' ? '' : ', @builtin(sample_index) i: u32'}) -> @builtin(frag_depth) f32 {
    return textureLoad(source, vec2<i32>(p.xy) + offset.xy, ${index}).x;
}`;
const CLEAR = `
@vertex fn triangle(@builtin(vertex_index) i: u32) -> @builtin(position) vec4<f32> {
    return vec4<f32>(f32((i << 1u) & 2u) * 2.0 - 1.0, f32(i & 2u) * 2.0 - 1.0, 1.0, 1.0);
}
@fragment fn depth_alone() {}
@fragment fn with_colour() -> @location(0) vec4<f32> { return vec4<f32>(1.0); }`;
const OF_FRAME = new Set(['mask', 'blurred', 'blurredTwice', 'noIds', 'noBlocks', 'cameraDepth', 'cameraNormal', 'cameraSmooth', 'cameraIds',
                          'constants', 'lights', 'views', 'pages', 'points']);

export class Executor {
    private readonly device: GPUDevice;
    private readonly resources: Resources;
    private readonly pipelines: Pipelines;
    private readonly uploads: Uploads;
    private readonly nearest: GPUSampler;
    private readonly linear: GPUSampler;
    private readonly groups = new Map<string, GPUBindGroup>();
    private readonly retired: (() => void)[] = []; // gives back what commands read that have yet to be submitted
    private encoder: GPUCommandEncoder | null = null;
    private pass: {key: string, encoder: GPURenderPassEncoder} | null = null;
    private clear: {key: string, target: Target} | null = null; // of a whole image, until something is drawn there

    constructor(device: GPUDevice, shaders: Shaders) {
        this.device = device;
        this.resources = new Resources(device);
        this.pipelines = new Pipelines(device, shaders);
        this.uploads = new Uploads(device);
        this.nearest = device.createSampler({label: 'gnomon nearest'});
        this.linear = device.createSampler({label: 'gnomon linear', magFilter: 'linear', minFilter: 'linear', mipmapFilter: 'linear'});
    }

    /** The frame before has been submitted: its room for data is free. */
    begin(): void {
        this.uploads.begin();
    }
    setInputs(inputs: {depth: GPUTexture, normal?: GPUTexture, smooth?: GPUTexture, objectId?: GPUTexture}): void {
        this.resources.setInput('cameraDepth', inputs.depth);
        this.resources.setInput('cameraNormal', inputs.normal);
        this.resources.setInput('cameraSmooth', inputs.smooth);
        this.resources.setInput('cameraIds', inputs.objectId);
    }
    texture(ref: ImageRef): GPUTexture | null {
        return this.resources.find(ref)?.textures[0] ?? null;
    }
    /** Runs commands that draw no casters, at once. */
    submit(list: Command[]): void {
        if (list.length > 0) {
            const encoder = this.device.createCommandEncoder({label: 'gnomon prepare'});
            this.run(list, encoder, null, () => undefined);
            this.device.queue.submit([encoder.finish()]);
        }
        this.retired.splice(0).forEach(giveBack => giveBack());
    }
    /** Compiles what commands draw with, in the background, and draws nothing. Images have to be there. */
    compile(list: Command[]): Promise<void> {
        this.submit(list.filter(one => one.kind === 'makeBuffer' || one.kind === 'makeImage' || one.kind === 'dropOptions'));
        return this.pipelines.compileAhead(() => list.forEach(
            one => one.kind === 'drawTriangle' ? this.triangleOf(one) : one.kind === 'runCompute' ? this.computeOf(one) : null));
    }
    run(list: Command[], encoder: GPUCommandEncoder, plan: Plan | null, drawCasters: DrawCasters): void {
        this.encoder = encoder;
        try {
            for (const command of list) {
                this.carryOut(command, plan, drawCasters);
            }
        } finally {
            this.endPass();
            this.encoder = null;
        }
        this.uploads.flush();
    }
    destroy(): void {
        this.groups.clear();
        this.resources.destroy();
        this.uploads.destroy();
    }

    private carryOut(command: Command, plan: Plan | null, drawCasters: DrawCasters): void {
        switch (command.kind) {
        case 'dropOptions':
            this.resources.dropOptions(command.options, kind => OF_FRAME.has(kind));
            this.groups.clear();
            break;
        case 'makeImage':
            this.makeImage(command);
            break;
        case 'makeBuffer':
            this.makeBuffer(command.buffer, command.bytes, command.copies);
            break;
        case 'writeBuffer': // no list writes what its commands have read before
            this.device.queue.writeBuffer(this.resources.buffer(command.buffer), command.offset, command.data);
            break;
        case 'zeroBuffer':
            this.endPass();
            this.encoder!.clearBuffer(this.resources.buffer(command.buffer));
            break;
        case 'copyTexels':
            this.copyTexels(this.resources.image(command.from), command.area, this.resources.image(command.to), command.place, 0);
            break;
        case 'clearTarget':
            this.clearTarget(command.target);
            break;
        case 'drawCasters':
            this.drawCasters(command.target, command.view, command.casters, plan!, drawCasters);
            break;
        case 'drawTriangle':
            this.drawTriangle(command);
            break;
        case 'runCompute':
            this.runCompute(command);
            break;
        }
    }

    // ---- Images and buffers

    private makeImage({image: ref, shape, keeps}: Extract<Command, {kind: 'makeImage'}>): void {
        this.endPass();
        const {made, old} = this.resources.makeImage(ref, shape);
        this.groups.clear();
        if (made.isDepth) {
            for (let layer = 0; layer < Math.max(shape.layers, 1); ++layer) {
                const whole = {x: 0, y: 0, width: shape.width, height: shape.height};
                this.clearTarget({colour: null, colourLayer: 0, depth: ref, depthLayer: layer, viewport: whole, scissor: whole, channels: 0xF});
            }
            this.endPass();
        }
        if (!old) {
            return;
        }
        for (let level = 0; keeps && level < Math.min(shape.levels, old.shape.levels); ++level) {
            const area = {x: 0, y: 0, width: Math.max(old.shape.width >> level, 1), height: Math.max(old.shape.height >> level, 1)};
            for (let layer = 0; layer < Math.max(old.shape.layers, 1); ++layer) {
                this.copyTexels(old, {...area, layer}, made, {...area, layer}, level);
            }
        }
        this.endPass();
        this.retired.push(() => this.resources.drop(old));
    }

    private makeBuffer(ref: BufferRef, bytes: number, copies: number): void {
        this.endPass();
        const {made, old} = this.resources.makeBuffer(ref, bytes);
        this.groups.clear();
        if (old && copies > 0) {
            this.encoder!.copyBufferToBuffer(old, 0, made, 0, copies);
        }
        if (old) {
            this.retired.push(() => old.destroy());
        }
    }

    private copyTexels(from: Image, area: Tile, to: Image, place: Tile, level: number): void {
        this.endPass();
        if (!from.isDepth) {
            this.encoder!.copyTextureToTexture(
                {texture: from.textures[0]!, mipLevel: level, origin: [area.x, area.y, area.layer]},
                {texture: to.textures[0]!, mipLevel: level, origin: [place.x, place.y, place.layer]}, [area.width, area.height]);
            return;
        }
        const several = from.shape.samples > 1;
        const state = {colour: null, depth: to.format, samples: to.shape.samples, channels: 0xF};
        const group = this.device.createBindGroupLayout({entries: [
            {binding: 0, visibility: GPUShaderStage.FRAGMENT, texture: {sampleType: 'unfilterable-float', viewDimension: '2d', multisampled: several}},
            {binding: 1, visibility: GPUShaderStage.FRAGMENT, buffer: {type: 'uniform'}}]});
        const layout = this.device.createPipelineLayout({bindGroupLayouts: [group]});
        const name = several ? 'copy of samples' : 'copy';
        const code = several ? COPY('texture_multisampled_2d<f32>', 'i') : COPY('texture_2d<f32>', '0');
        const {buffer, offset} = this.uploads.put(Int32Array.of(area.x - place.x, area.y - place.y, 0, 0));
        const pass = this.encoder!.beginRenderPass({colorAttachments: [], depthStencilAttachment: {
            view: this.resources.view(to, '2d', 0, place.layer), depthLoadOp: 'load', depthStoreOp: 'store'}});
        pass.setPipeline(this.pipelines.own(name, code, layout, state));
        pass.setBindGroup(0, this.device.createBindGroup({layout: group, entries: [
            {binding: 0, resource: this.resources.view(from, '2d', 0, area.layer)}, {binding: 1, resource: {buffer, offset, size: 16}}]}));
        pass.setScissorRect(place.x, place.y, place.width, place.height);
        pass.draw(3);
        pass.end();
    }

    // ---- Drawing

    private stateOf(target: Target): TargetState {
        const colour = target.colour ? this.resources.image(target.colour) : null;
        const depth = target.depth ? this.resources.image(target.depth) : null;
        return {colour: colour?.format ?? null, depth: depth?.format ?? null, samples: (colour ?? depth)!.shape.samples, channels: target.channels};
    }
    private isWhole(target: Target): boolean {
        const {scissor: s, channels} = target;
        return channels === 0xF && [target.colour, target.depth].every(ref => {
            const shape = ref && this.resources.image(ref).shape;
            return !shape || (s.x === 0 && s.y === 0 && s.width >= shape.width && s.height >= shape.height);
        });
    }

    /** The pass that draws to this target, which is begun where another one is open. */
    private passOf(target: Target): GPURenderPassEncoder {
        const key = attachmentsOf(target);
        if (this.pass?.key !== key) {
            const cleared = this.clear?.key === key;
            if (cleared) {
                this.clear = null;
            }
            this.endPass();
            const load = cleared ? 'clear' : 'load';
            const colour = target.colour && this.resources.view(this.resources.image(target.colour), '2d', 0, target.colourLayer);
            const depth = target.depth && this.resources.view(this.resources.image(target.depth), '2d', 0, target.depthLayer);
            const encoder = this.encoder!.beginRenderPass({
                label: 'gnomon',
                colorAttachments: colour ? [{view: colour, clearValue: [1, 1, 1, 1], loadOp: load, storeOp: 'store'}] : [],
                ...(depth ? {depthStencilAttachment: {view: depth, depthClearValue: 1, depthLoadOp: load, depthStoreOp: 'store'}} : {})});
            this.pass = {key, encoder};
        }
        const {viewport: v, scissor: s} = target;
        this.pass!.encoder.setViewport(v.x, v.y, v.width, v.height, 0, 1);
        this.pass!.encoder.setScissorRect(s.x, s.y, s.width, s.height);
        return this.pass!.encoder;
    }
    private endPass(): void {
        this.pass?.encoder.end();
        this.pass = null;
        if (this.clear) {
            this.passOf(this.clear.target).end();
            this.pass = null;
        }
    }

    private clearTarget(target: Target): void {
        if (this.isWhole(target)) {
            this.endPass();
            this.clear = {key: attachmentsOf(target), target};
            return;
        }
        const pass = this.passOf(target);
        const layout = this.device.createPipelineLayout({bindGroupLayouts: []});
        pass.setPipeline(this.pipelines.own('clear', CLEAR, layout, this.stateOf(target)));
        pass.draw(3);
    }

    private drawCasters(target: Target, index: number, casters: Uint32Array, plan: Plan, drawCasters: DrawCasters): void {
        const view = plan.views[index]!;
        const {colour, depth, samples} = this.stateOf(target);
        drawCasters({encoder: this.passOf(target), plan, view, viewIndex: index, casters,
                     colourFormat: colour, depthFormat: depth!, samples, colourWriteMask: target.channels, writesFragDepth: view.writeDepth !== 0,
                     clampsDepth: view.clampNear !== 0});
        // Pipelines of the host's must not be taken for ours, nor its bind groups.
        const keep = this.pass;
        this.pass = keep && {...keep, key: ''};
    }

    private triangleOf(command: DrawTriangle): {pipeline: GPURenderPipeline | null, group: GPUBindGroup} {
        // Software rasterisers read the lights in the vertex shader; WGSL does without.
        const vertex = command.vertex === 'mask_numbers.vert' ? 'mask.vert' : command.vertex;
        const {layouts, group} = this.bind(command.fragment, command.bindings);
        return {group, pipeline: this.pipelines.triangle(vertex, command.fragment, command.constants, layouts, this.stateOf(command.target), command.least)};
    }
    private drawTriangle(command: DrawTriangle): void {
        const {pipeline, group} = this.triangleOf(command);
        const pass = this.passOf(command.target);
        pass.setPipeline(pipeline!);
        pass.setBindGroup(0, group);
        this.setPush(pass, command.push);
        pass.draw(3);
    }
    private computeOf(command: RunCompute): {pipeline: GPUComputePipeline | null, group: GPUBindGroup} {
        const stores = this.storesOf(command.module, command.bindings);
        const {layouts, group} = this.bind(command.module, command.bindings);
        return {group, pipeline: this.pipelines.compute(command.module, command.constants, layouts, stores?.shape.format ?? 'any')};
    }
    private runCompute(command: RunCompute): void {
        this.endPass();
        const {pipeline, group} = this.computeOf(command);
        const pass = this.encoder!.beginComputePass({label: `gnomon ${command.module}`});
        pass.setPipeline(pipeline!);
        pass.setBindGroup(0, group);
        this.setPush(pass, command.push);
        pass.dispatchWorkgroups(...command.groups);
        pass.end();
    }
    private setPush(pass: GPURenderPassEncoder | GPUComputePassEncoder, words: Uint32Array): void {
        const {buffer, offset} = this.uploads.put(words);
        const key = `push ${this.uploads.number}`;
        let group = this.groups.get(key);
        if (!group) {
            group = this.device.createBindGroup({layout: this.pipelines.push, entries: [{binding: 0, resource: {buffer, size: PUSH_BYTES}}]});
            this.groups.set(key, group);
        }
        pass.setBindGroup(3, group, [offset]);
    }

    // ---- Bindings

    private storesOf(module: string, bindings: Binding[]): Image | null {
        const input = this.pipelines.module(module).inputs.find(one => one.kind === 'storage_image' && one.access !== 'read');
        const bound = input && bindings.find(one => one.binding === input.binding);
        return bound?.image ? this.resources.image(bound.image) : null;
    }

    private bind(module: string, bindings: Binding[]): {layouts: Layouts, group: GPUBindGroup} {
        const kinds = new Map<number, TextureKind>();
        const filters = new Map<number, boolean>();
        const entries: GPUBindGroupEntry[] = [];
        const keys: string[] = [];
        const stored = new Set<string>();
        for (const input of this.pipelines.module(module).inputs) {
            if (input.kind === 'push') {
                continue;
            }
            const one = bindings.find(bound => bound.binding === input.binding);
            if (!one) {
                throw new GnomonError(`run ${module}`, `nothing is bound to ${input.binding}`, 'report this');
            }
            if (one.image) {
                let image = this.resources.image(one.image);
                let level = one.level;
                if (input.kind === 'storage_image' && input.access !== 'read') {
                    // A module that has nothing to store is bound to what it stores already, which WebGPU forbids.
                    const key = `${image.number} ${level}`;
                    if (stored.has(key)) {
                        image = this.resources.image({kind: 'noBlocks', options: 0});
                        level = 0;
                    }
                    stored.add(key);
                }
                const linear = one.linear && input.sampled;
                if (linear && /32float/.test(image.format) && !this.device.features.has('float32-filterable')) {
                    throw new GnomonError('read shadow maps', `the device does not filter maps of format ${image.shape.format}`,
                                          'set map-format=rgba16f, or ask for the feature float32-filterable');
                }
                kinds.set(input.binding, input.of === 'uint' ? 'uint' : linear ? 'float' : 'unfilterable-float');
                entries.push({binding: input.binding, resource: this.resources.view(image, viewDimension(input.dimension), level, null)});
                if (input.sampled) {
                    filters.set(input.binding, linear);
                    entries.push({binding: input.binding + 16, resource: linear ? this.linear : this.nearest});
                }
                keys.push(`${image.number} ${level} ${linear}`);
            } else {
                const buffer = this.resources.buffer(one.buffer!);
                entries.push({binding: input.binding, resource: {buffer, offset: one.offset, ...(one.bytes > 0 ? {size: one.bytes} : {})}});
                keys.push(`${keyOf(one.buffer!)} ${one.offset} ${one.bytes}`);
            }
        }
        const layouts = this.pipelines.layouts(module, kinds, filters, this.storesOf(module, bindings)?.format ?? null);
        const key = `${module} ${keys.join()}`;
        let group = this.groups.get(key);
        if (!group) {
            group = this.device.createBindGroup({label: `gnomon ${module}`, layout: layouts.group0, entries});
            this.groups.set(key, group);
        }
        return {layouts, group};
    }
}

function attachmentsOf(target: Target): string {
    return `${target.colour ? keyOf(target.colour) : ''} ${target.colourLayer} ${target.depth ? keyOf(target.depth) : ''} ${target.depthLayer}`;
}
