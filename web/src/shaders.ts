// SPDX-License-Identifier: Apache-2.0
// The kit's WGSL (docs/kit.md), as the package has it: one compressed file.
import {GnomonError, readPackageFile} from './wasm.js';

/** An input of a module, as passes.json of the kit has it. */
export interface ModuleInput {
    kind: 'uniform' | 'storage' | 'texture' | 'storage_image' | 'push';
    /** Number in set 0, and in group 0 of WGSL; a texture's sampler lies 16 above. */
    binding: number;
    /** texture, storage_image: "2d", "2d_array", "2d_multisampled". */
    dimension: string;
    /** texture, storage_image: "float", "uint". */
    of: string;
    /** texture: is there a sampler? */
    sampled: boolean;
    /** storage, storage_image: "read", "write", "read_write". */
    access: string;
    /** uniform, push: bytes. */
    size: number;
}
/** A module of the kit. */
export interface ShaderModule {
    name: string;
    inputs: ModuleInput[];
    /** Constants by id, with their types: "bool", "int", "uint", "float". */
    constants: Record<string, string>;
    /** WGSL by form: "any", "sample", or the format that it stores to. */
    files: Record<string, string>;
}

/** All modules, for `ShadowRendererOptions.shaders`. */
export class Shaders {
    private readonly modules: Map<string, ShaderModule>;
    /** @internal */
    constructor(modules: ShaderModule[]) {
        this.modules = new Map(modules.map(one => [one.name, one]));
    }
    /** A module. Throws GnomonError where there is none. */
    get(name: string): ShaderModule {
        const found = this.modules.get(name);
        if (!found) {
            throw new GnomonError(`take the shader module ${name}`, 'the package does not have it', 'choose another option');
        }
        return found;
    }
}

/** Reads the shaders, from the file beside this one or from its bytes. */
export async function loadShaders(compressed?: ArrayBuffer): Promise<Shaders> {
    const bytes = compressed ?? await readPackageFile('shaders.json.gz');
    // A server may say that the file is compressed, and then fetch() has undone it.
    const isCompressed = new Uint8Array(bytes)[0] === 0x1F;
    const stream = new Blob([bytes]).stream();
    const text = await new Response(isCompressed ? stream.pipeThrough(new DecompressionStream('gzip')) : stream).text();
    return new Shaders(JSON.parse(text) as ShaderModule[]);
}
