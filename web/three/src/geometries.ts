// SPDX-License-Identifier: Apache-2.0
// Triangles of three.js' geometries as casters: three.js' own buffers where they are floats, else copies.
import type {CasterMesh} from 'gnomon-shadows';
import type {BufferAttribute, BufferGeometry, InterleavedBufferAttribute, Material, Mesh, Texture, WebGPURenderer} from 'three/webgpu';
import {backendOf, bufferOf, isPlain, textureOf} from './backend.js';

type Attribute = BufferAttribute | InterleavedBufferAttribute;
type Holed = Material & {map?: Texture | null, alphaMap?: Texture | null};

interface Copy {buffer: GPUBuffer, version: number}

/** Counts a change of an attribute, interleaved or not. */
export function versionOf(attribute: Attribute): number {
    return 'isInterleavedBufferAttribute' in attribute ? attribute.data.version : (attribute as BufferAttribute).version;
}

export class Geometries {
    private readonly renderer: WebGPURenderer;
    private readonly note: (text: string) => void;
    private readonly copies = new WeakMap<Attribute, Copy>();
    private counting: {buffer: GPUBuffer, count: number} | null = null; // indices 0, 1, 2 and so on

    constructor(renderer: WebGPURenderer, note: (text: string) => void) {
        this.renderer = renderer;
        this.note = note;
    }

    /** The triangles of a mesh, one for each of its materials that casts. */
    meshesOf(mesh: Mesh): CasterMesh[] {
        const {geometry} = mesh;
        const position = geometry.getAttribute('position');
        if (!position || position.count === 0) {
            return [];
        }
        const [indices, indexFormat, count] = this.indicesOf(geometry, position.count);
        const positions = this.vertices(position, 3);
        const materials = Array.isArray(mesh.material) ? mesh.material : [mesh.material];
        const groups = Array.isArray(mesh.material) && geometry.groups.length > 0 ? geometry.groups : [{start: 0, count: Infinity, materialIndex: 0}];
        const {start: first, count: range} = geometry.drawRange;
        const found: CasterMesh[] = [];
        for (const group of groups) {
            const material = materials[group.materialIndex ?? 0];
            const begin = Math.max(group.start, first);
            const end = Math.min(count, group.start + group.count, first + range);
            if (material?.visible && end > begin) {
                found.push({positions, indices, indexFormat, firstIndex: begin, indexCount: end - begin, ...this.holesOf(geometry, material)});
            }
        }
        return found;
    }

    private holesOf(geometry: BufferGeometry, material: Holed): Pick<CasterMesh, 'holes'> {
        const uv = geometry.getAttribute('uv');
        const map = material.map;
        if (!(material.alphaTest > 0) || !map || !uv) {
            return {};
        }
        const texture = textureOf(this.renderer, map);
        if (!texture) {
            this.note('a material with alphaTest casts a shadow without holes until its texture was drawn once');
            return {};
        }
        return {holes: {uvs: this.vertices(uv, 2), texture: texture.createView(), cutoff: material.alphaTest}};
    }

    private indicesOf(geometry: BufferGeometry, vertices: number): [GPUBuffer, GPUIndexFormat, number] {
        const index = geometry.getIndex();
        if (index) {
            const wide = index.array instanceof Uint32Array;
            return [bufferOf(this.renderer, index, true), wide ? 'uint32' : 'uint16', index.count];
        }
        if (!this.counting || this.counting.count < vertices) {
            const numbers = Uint32Array.from({length: vertices}, (_, i) => i);
            this.counting = {buffer: this.upload(numbers, GPUBufferUsage.INDEX), count: vertices};
        }
        return [this.counting.buffer, 'uint32', vertices];
    }

    private vertices(attribute: Attribute, size: number): GPUBuffer {
        if (isPlain(attribute, size)) {
            return bufferOf(this.renderer, attribute, false);
        }
        const version = versionOf(attribute);
        let copy = this.copies.get(attribute);
        if (!copy || copy.version !== version) {
            copy?.buffer.destroy();
            const numbers = new Float32Array(size * attribute.count);
            for (let i = 0; i < attribute.count; ++i) {
                for (let k = 0; k < size; ++k) {
                    numbers[size * i + k] = attribute.getComponent(i, k);
                }
            }
            copy = {buffer: this.upload(numbers, GPUBufferUsage.VERTEX), version};
            this.copies.set(attribute, copy);
        }
        return copy.buffer;
    }

    private upload(numbers: Float32Array<ArrayBuffer> | Uint32Array<ArrayBuffer>, usage: number): GPUBuffer {
        const {device} = backendOf(this.renderer);
        const buffer = device.createBuffer({label: 'gnomon geometry', size: numbers.byteLength, usage: usage | GPUBufferUsage.COPY_DST});
        device.queue.writeBuffer(buffer, 0, numbers);
        return buffer;
    }
}
