// SPDX-License-Identifier: Apache-2.0
// The images and buffers that commands name.
import type {BufferRef, ImageRef, ImageShape} from './commands.js';
import {GnomonError} from './wasm.js';

/** WebGPU's names of gnomon::MapFormat. */
const FORMATS: Record<string, GPUTextureFormat> = {
    d16: 'depth16unorm', d24: 'depth24plus', d32f: 'depth32float', r8: 'r8unorm', r16f: 'r16float', r32f: 'r32float', rg8: 'rg8unorm',
    rg16f: 'rg16float', rg32f: 'rg32float', rgba8: 'rgba8unorm', rgba16f: 'rgba16float', rgba32f: 'rgba32float', r32ui: 'r32uint',
    r16: 'r16unorm' as GPUTextureFormat, rg16: 'rg16unorm' as GPUTextureFormat, rgba16: 'rgba16unorm' as GPUTextureFormat,
};
/** Formats that a feature brings, and formats in their place. */
const TIER1: Record<string, string> = {r16: 'r32f', rg16: 'rg32f', rgba16: 'rgba32f'};
/** Formats that a shader may store to. */
const STORED = new Set(['r32f', 'rg32f', 'rgba16f', 'rgba32f', 'r32ui']);

/** An image: one texture, or one for each layer where WebGPU has no arrays (several samples). */
export interface Image {
    shape: ImageShape;
    format: GPUTextureFormat;
    textures: GPUTexture[];
    isDepth: boolean;
    /** Tells images apart, for keys of what is made once. */
    number: number;
}

export function keyOf(one: ImageRef | BufferRef): string {
    return `${one.kind} ${one.options}`;
}

export class Resources {
    private readonly device: GPUDevice;
    private readonly images = new Map<string, Image>();
    private readonly buffers = new Map<string, GPUBuffer>();
    private readonly views = new Map<string, GPUTextureView>();
    private count = 0;

    constructor(device: GPUDevice) {
        this.device = device;
    }

    image(ref: ImageRef): Image {
        const found = this.images.get(keyOf(ref));
        if (!found) {
            throw new GnomonError('draw shadows', `there is no image ${keyOf(ref)}`, 'call prepare() before drawing, and give all inputs');
        }
        return found;
    }
    find(ref: ImageRef): Image | null {
        return this.images.get(keyOf(ref)) ?? null;
    }
    buffer(ref: BufferRef): GPUBuffer {
        const found = this.buffers.get(keyOf(ref));
        if (!found) {
            throw new GnomonError('draw shadows', `there is no buffer ${keyOf(ref)}`, 'call prepare() before drawing');
        }
        return found;
    }

    /** Makes an image and returns the one that had its name, which the caller gives back by `drop()`. */
    makeImage(ref: ImageRef, shape: ImageShape): {made: Image, old: Image | null} {
        const old = this.find(ref);
        const made = this.newImage(ref, shape);
        this.images.set(keyOf(ref), made);
        return {made, old};
    }
    private newImage(ref: ImageRef, shape: ImageShape): Image {
        const {device} = this;
        const most = device.limits.maxTextureDimension2D;
        if (shape.width > most || shape.height > most || shape.layers > device.limits.maxTextureArrayLayers) {
            throw new GnomonError('make an image for shadows', `it has ${shape.width} x ${shape.height} texels and ${shape.layers} layers, and the ` +
                `device takes ${most} and ${device.limits.maxTextureArrayLayers}`, 'set fewer texels or a smaller map-size, or ask for higher limits');
        }
        if (shape.format in TIER1 && !device.features.has('texture-formats-tier1' as GPUFeatureName)) {
            throw new GnomonError('make shadow maps', `the device has no maps of format ${shape.format}`,
                                  `set map-format=${TIER1[shape.format]}, or ask for the feature texture-formats-tier1`);
        }
        const format = FORMATS[shape.format]!;
        const isDepth = shape.format.startsWith('d');
        const {TEXTURE_BINDING, RENDER_ATTACHMENT, COPY_SRC, COPY_DST, STORAGE_BINDING} = GPUTextureUsage;
        const usage = TEXTURE_BINDING | RENDER_ATTACHMENT | (shape.samples > 1 ? 0 : COPY_SRC | COPY_DST) |
            (STORED.has(shape.format) && shape.samples === 1 ? STORAGE_BINDING : 0);
        const layers = Math.max(shape.layers, 1);
        const alone = shape.samples > 1;
        const textures = Array.from({length: alone ? layers : 1}, () => device.createTexture({
            label: `gnomon ${ref.kind}`, format, usage, sampleCount: shape.samples, mipLevelCount: shape.levels,
            size: [shape.width, shape.height, alone ? 1 : layers]}));
        return {shape, format, textures, isDepth, number: ++this.count};
    }
    /** Names a texture of the host's. */
    setInput(kind: string, texture: GPUTexture | undefined): void {
        const key = keyOf({kind, options: 0});
        if (this.images.get(key)?.textures[0] === texture) {
            return;
        }
        if (!texture) {
            this.images.delete(key);
            return;
        }
        const shape = {format: texture.format, width: texture.width, height: texture.height, layers: 0, levels: 1, samples: texture.sampleCount};
        this.images.set(key, {shape, format: texture.format, textures: [texture], isDepth: texture.format.startsWith('depth'), number: ++this.count});
    }
    drop(image: Image): void {
        image.textures.forEach(one => one.destroy());
        for (const key of this.views.keys()) {
            if (key.startsWith(`${image.number} `)) {
                this.views.delete(key);
            }
        }
    }

    /** A view of all layers, or of one as a 2D texture. `level` null: all levels. */
    view(image: Image, dimension: GPUTextureViewDimension, level: number | null, layer: number | null): GPUTextureView {
        const key = `${image.number} ${dimension} ${level} ${layer}`;
        let view = this.views.get(key);
        if (!view) {
            const alone = image.textures.length > 1;
            view = image.textures[alone ? layer ?? 0 : 0]!.createView({
                dimension, aspect: image.isDepth ? 'depth-only' : 'all',
                ...(level === null ? {} : {baseMipLevel: level, mipLevelCount: 1}),
                ...(layer === null || alone ? {} : {baseArrayLayer: layer, arrayLayerCount: 1})});
            this.views.set(key, view);
        }
        return view;
    }

    /** Makes a buffer and returns the one that had its name. */
    makeBuffer(ref: BufferRef, bytes: number): {made: GPUBuffer, old: GPUBuffer | null} {
        const {STORAGE, UNIFORM, COPY_DST, COPY_SRC} = GPUBufferUsage;
        const old = this.buffers.get(keyOf(ref)) ?? null;
        if (bytes > this.device.limits.maxStorageBufferBindingSize) {
            throw new GnomonError('make a buffer for shadows', `it has ${bytes} bytes, and the device takes ` +
                `${this.device.limits.maxStorageBufferBindingSize}`, 'ask for a higher maxStorageBufferBindingSize');
        }
        const made = this.device.createBuffer({label: `gnomon ${ref.kind}`, size: Math.max(bytes, 16), usage: STORAGE | UNIFORM | COPY_DST | COPY_SRC});
        this.buffers.set(keyOf(ref), made);
        return {made, old};
    }
    /** The images and buffers of these options are used no more. */
    dropOptions(options: number, ofFrame: (kind: string) => boolean): void {
        for (const [key, image] of this.images) {
            const [kind, index] = key.split(' ');
            if (Number(index) === options && !ofFrame(kind!)) {
                this.drop(image);
                this.images.delete(key);
            }
        }
        for (const [key, buffer] of this.buffers) {
            const [kind, index] = key.split(' ');
            if (Number(index) === options && !ofFrame(kind!)) {
                buffer.destroy();
                this.buffers.delete(key);
            }
        }
    }
    destroy(): void {
        for (const [key, image] of this.images) {
            if (!key.startsWith('camera')) {
                this.drop(image);
            }
        }
        this.buffers.forEach(one => one.destroy());
        this.images.clear();
        this.buffers.clear();
    }
}
