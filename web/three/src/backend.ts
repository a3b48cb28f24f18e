// SPDX-License-Identifier: Apache-2.0
// The things that three.js has of a scene on the GPU. WebGPURenderer's backend has no types of its own for this.
import type {BufferAttribute, InterleavedBufferAttribute, Texture, WebGPURenderer} from 'three/webgpu';

interface Backend {
    readonly isWebGPUBackend?: boolean;
    readonly device: GPUDevice;
    get(object: object): {buffer?: GPUBuffer, texture?: GPUTexture};
    createAttribute(attribute: BufferAttribute): void;
    createIndexAttribute(attribute: BufferAttribute): void;
}

/** The renderer's backend; throws an Error where it is not WebGPU's, as where it fell back to WebGL. */
export function backendOf(renderer: WebGPURenderer): Backend {
    const backend = renderer.backend as unknown as Backend;
    if (!backend.isWebGPUBackend || !backend.device) {
        throw new Error('cannot make Gnomon\'s shadows: the renderer draws by WebGL; use them where navigator.gpu is, and after renderer.init()');
    }
    return backend;
}

/** The texture that three.js has uploaded; undefined before it was drawn with. */
export function textureOf(renderer: WebGPURenderer, texture: Texture): GPUTexture | undefined {
    return backendOf(renderer).get(texture).texture;
}

/** Three.js' own buffer of a vertex attribute, or of an index. It is made where no picture has needed it yet. */
export function bufferOf(renderer: WebGPURenderer, attribute: BufferAttribute, isIndex: boolean): GPUBuffer {
    const backend = backendOf(renderer);
    if (!backend.get(attribute).buffer) {
        if (isIndex) {
            backend.createIndexAttribute(attribute);
        } else {
            backend.createAttribute(attribute);
        }
    }
    return backend.get(attribute).buffer!;
}

/** Can the package's shaders read three.js' own buffer of this attribute: floats without gaps, as many as `size`? */
export function isPlain(attribute: BufferAttribute | InterleavedBufferAttribute, size: number): attribute is BufferAttribute {
    return !('isInterleavedBufferAttribute' in attribute) && attribute.array instanceof Float32Array && attribute.itemSize === size;
}
