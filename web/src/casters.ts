// SPDX-License-Identifier: Apache-2.0
// Draws casters for hosts with ordinary meshes: a ready-made `DrawCasters` callback. Hosts with vertex formats of their own write
// their callback and shaders instead (docs/integrating.md).
import type {CasterPass} from './executor.js';
import type {Plan, Planner} from './planner.js';
import type {Shaders} from './shaders.js';

/** A mesh's triangles, in its own space. Counter-clockwise ones face front; all of them cast. */
export interface CasterMesh {
    /** Positions: float32x3, with usage VERTEX. */
    positions: GPUBuffer;
    /** Bytes from a position to the next; default: 12. */
    stride?: number;
    /** With usage INDEX. */
    indices: GPUBuffer;
    indexFormat: GPUIndexFormat;
    firstIndex?: number;
    indexCount: number;
    baseVertex?: number;
    /** Has holes where the alpha of a texture is below `cutoff` (default: 0.5). `uvs`: float32x2, `stride` bytes apart (default: 8). */
    holes?: {uvs: GPUBuffer, stride?: number, texture: GPUTextureView, cutoff?: number};
}

const BYTES_OF_ROW = 16;
const HOLDS_BYTES = 2; // kDepthBytes of gnomon/shared/paired_depth.h
// Inputs of caster.vert: rows of the instance first, then texture coordinates; the rest is others', and nobody reads it.
const UNUSED: [location: number, format: GPUVertexFormat][] = [[7, 'float32x4'], [8, 'float32x4'], [9, 'float32x2'], [10, 'uint32'], [11, 'float32x4']];

export class CasterPipelines {
    private readonly device: GPUDevice;
    private readonly planner: Planner;
    private readonly shaders: Shaders;
    private readonly pipelines = new Map<string, GPURenderPipeline>();
    private readonly modules = new Map<string, GPUShaderModule>();
    private readonly groups = new Map<GPUTextureView, GPUBindGroup>();
    private readonly sampler: GPUSampler;
    private readonly pushLayout: GPUBindGroupLayout;
    private readonly holesLayout: GPUBindGroupLayout;
    private readonly materials = new Map<number, GPUBindGroup>(); // by cutoff
    private rows: GPUBuffer | null = null;
    private used = 0;
    private plan: Plan | null = null;

    constructor(device: GPUDevice, planner: Planner, shaders: Shaders) {
        this.device = device;
        this.planner = planner;
        this.shaders = shaders;
        this.sampler = device.createSampler({magFilter: 'linear', minFilter: 'linear', addressModeU: 'repeat', addressModeV: 'repeat'});
        const both = GPUShaderStage.VERTEX | GPUShaderStage.FRAGMENT;
        this.pushLayout = device.createBindGroupLayout({entries: [{binding: 0, visibility: both, buffer: {type: 'uniform'}}]});
        this.holesLayout = device.createBindGroupLayout({entries: [
            {binding: 0, visibility: GPUShaderStage.FRAGMENT, texture: {}}, {binding: 16, visibility: GPUShaderStage.FRAGMENT, sampler: {}}]});
    }

    /**
     * Draws a pass's casters. `meshesOf`: of an object by its index; none: it casts nothing. `transformOf`: three rows of four numbers,
     * p_ws[i] = dot(row i, (p, 1)). Neighbours in the set that get the same list of meshes are drawn
     * together. Data goes by the queue: submit the encoder before the next plan is made.
     */
    draw(pass: CasterPass, meshesOf: (object: number) => readonly CasterMesh[], transformOf: (object: number) => ArrayLike<number>): void {
        if (pass.casters.length === 0) {
            return;
        }
        const transforms = new Float32Array(12 * pass.casters.length);
        pass.casters.forEach((object, i) => transforms.set(transformOf(object), 12 * i));
        const offset = this.upload(pass.plan, this.planner.writeCasterRows(pass.viewIndex, transforms));
        pass.encoder.setVertexBuffer(1, this.rows!, offset);
        for (let first = 0, next = 0; first < pass.casters.length; first = next) {
            const meshes = meshesOf(pass.casters[first]!);
            for (next = first + 1; next < pass.casters.length && meshesOf(pass.casters[next]!) === meshes;) {
                ++next;
            }
            meshes.forEach(mesh => this.drawMesh(pass, mesh, first, next - first));
        }
    }

    private drawMesh(pass: CasterPass, mesh: CasterMesh, instance: number, instances: number): void {
        const {encoder} = pass;
        encoder.setPipeline(this.pipeline(pass, mesh));
        encoder.setVertexBuffer(0, mesh.positions);
        encoder.setIndexBuffer(mesh.indices, mesh.indexFormat);
        encoder.setBindGroup(3, this.material(mesh.holes?.cutoff ?? 0.5));
        if (mesh.holes) {
            encoder.setVertexBuffer(2, mesh.holes.uvs);
            encoder.setBindGroup(0, this.texture(mesh.holes.texture));
        }
        encoder.drawIndexed(mesh.indexCount, instances, mesh.firstIndex ?? 0, mesh.baseVertex ?? 0, instance);
    }

    private upload(plan: Plan, rows: Float32Array<ArrayBuffer>): number {
        if (plan !== this.plan) {
            this.plan = plan;
            this.used = 0;
        }
        if (!this.rows || this.used + rows.byteLength > this.rows.size) {
            // Recorded draws may read the old one, so that it is left to the garbage collector.
            const size = 2 ** Math.ceil(Math.log2(Math.max(1 << 14, 2 * rows.byteLength, 2 * (this.rows?.size ?? 0))));
            this.rows = this.device.createBuffer({label: 'gnomon casters', size, usage: GPUBufferUsage.VERTEX | GPUBufferUsage.COPY_DST});
            this.used = 0;
        }
        const offset = this.used;
        this.device.queue.writeBuffer(this.rows, offset, rows);
        this.used += rows.byteLength;
        return offset;
    }

    private material(cutoff: number): GPUBindGroup {
        let group = this.materials.get(cutoff);
        if (!group) {
            const limit = cutoff - Math.min(1 / 65536, cutoff / 2); // alphaLimit() of gnomon/shared/alpha_cutoff.h
            const data = Float32Array.of(1, 0, 0, 0, 0, 1, 0, 0, limit, 0, 0, 0); // Material of caster.vert
            const buffer = this.device.createBuffer({label: 'gnomon material', size: data.byteLength,
                                                     usage: GPUBufferUsage.UNIFORM | GPUBufferUsage.COPY_DST});
            this.device.queue.writeBuffer(buffer, 0, data);
            group = this.device.createBindGroup({layout: this.pushLayout, entries: [{binding: 0, resource: {buffer}}]});
            this.materials.set(cutoff, group);
        }
        return group;
    }
    private texture(view: GPUTextureView): GPUBindGroup {
        let group = this.groups.get(view);
        if (!group) {
            group = this.device.createBindGroup({layout: this.holesLayout, entries: [{binding: 0, resource: view}, {binding: 16, resource: this.sampler}]});
            this.groups.set(view, group);
        }
        return group;
    }

    private pipeline(pass: CasterPass, mesh: CasterMesh): GPURenderPipeline {
        const perspective = pass.view.orthographic === 0;
        const key = [pass.colourFormat, pass.colourWriteMask, pass.depthFormat, pass.samples, pass.writesFragDepth, pass.clampsDepth, perspective, mesh.stride,
                     mesh.holes ? mesh.holes.stride ?? 8 : 0].join();
        let made = this.pipelines.get(key);
        if (!made) {
            made = this.make(pass, mesh, perspective);
            this.pipelines.set(key, made);
        }
        return made;
    }

    private make(pass: CasterPass, mesh: CasterMesh, perspective: boolean): GPURenderPipeline {
        const kind = pass.colourFormat ? 'colour' : pass.writesFragDepth ? pass.samples > 1 ? 'depth_samples' : 'depth' : '';
        const fragment = kind || mesh.holes ? `caster${kind && `_${kind}`}${mesh.holes ? '_masked' : ''}.frag` : '';
        const vertex = this.module('caster.vert', kind === 'depth_samples' ? 'sample' : 'any');
        const rows = perspective ? 5 : 3;
        const row = (location: number): GPUVertexAttribute => ({shaderLocation: location, format: 'float32x4',
                                                                offset: location <= rows ? BYTES_OF_ROW * (location - 1) : 0});
        const instance = [...[1, 2, 3, 4, 5].map(row), ...UNUSED.map(([location, format]) => ({shaderLocation: location, format, offset: 0}))];
        const uv: GPUVertexAttribute = {shaderLocation: 6, format: 'float32x2', offset: 0};
        const empty = this.device.createBindGroupLayout({entries: []});
        return this.device.createRenderPipeline({
            label: `gnomon ${fragment || 'caster'}`,
            layout: this.device.createPipelineLayout({bindGroupLayouts: [mesh.holes ? this.holesLayout : empty, empty, empty, this.pushLayout]}),
            vertex: {
                module: vertex, entryPoint: 'main', constants: this.constants('caster.vert', {3: mesh.holes ? 1 : 0, 4: perspective ? 1 : 0, 5: fragment ? 1 : 0}),
                buffers: [{arrayStride: mesh.stride ?? 12, attributes: [{shaderLocation: 0, format: 'float32x3', offset: 0}]},
                          {arrayStride: BYTES_OF_ROW * rows, stepMode: 'instance', attributes: mesh.holes ? instance : [...instance, uv]},
                          ...(mesh.holes ? [{arrayStride: mesh.holes.stride ?? 8, attributes: [uv]}] : [])],
            },
            ...(fragment ? {fragment: {
                module: this.module(fragment, 'any'), entryPoint: 'main',
                constants: this.constants(fragment, {0: pass.colourFormat === 'rgba8unorm' ? HOLDS_BYTES : 0}),
                targets: pass.colourFormat ? [{format: pass.colourFormat, writeMask: pass.colourWriteMask}] : []}} : {}),
            primitive: {topology: 'triangle-list', unclippedDepth: pass.clampsDepth},
            depthStencil: {format: pass.depthFormat, depthWriteEnabled: true, depthCompare: 'less-equal'},
            multisample: {count: pass.samples},
        });
    }
    private module(name: string, form: string): GPUShaderModule {
        const key = `${name} ${form}`;
        let module = this.modules.get(key);
        if (!module) {
            const files = this.shaders.get(name).files;
            module = this.device.createShaderModule({label: `gnomon ${name}`, code: files[form] ?? files['any']!});
            this.modules.set(key, module);
        }
        return module;
    }
    private constants(name: string, wanted: Record<number, number>): Record<string, number> {
        const code = this.shaders.get(name).files['any'] ?? '';
        return Object.fromEntries(Object.entries(wanted).filter(([id]) => code.includes(`@id(${id})`)));
    }
}
