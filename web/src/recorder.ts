// SPDX-License-Identifier: Apache-2.0
// The commands of the planner's last plan (pack::FrameRecorder), read from WebAssembly's memory.
import type {Binding, BufferRef, Command, ImageRef, Rectangle, Target, Tile} from './commands.js';
import {BindingKind, BufferName, CommandKind, Has, ImageName, INTERFACE, NO_INDEX, type Binding as RawBinding, type Command as RawCommand,
        type CommandList} from './layouts.js';
import type {Planner} from './planner.js';
import type {MapReuse, MaskInputs} from './renderer.js';
import {sizeOf, type Pointer, type Wasm} from './wasm.js';

/** Limits of the device. */
export interface Traits {mostLayers: number, uniformAlignment: number}

const IMAGES = namesOf(ImageName);
const BUFFERS = namesOf(BufferName);
/** By how much a number of -1 to 1 is off at most in a format of normals. */
const ROUNDING: Record<string, number> = {rg32float: 0, rgba32float: 0, rg16float: 2 ** -11, rgba16float: 2 ** -11, rg16snorm: 2 ** -16};

type Raw = RawCommand & {casters: Pointer};
type List = CommandList & Record<'commands' | 'bindings' | 'words', Pointer>;

export class Recorder {
    /** After `prepare()`: maps or mask are other images than before. */
    changed = false;
    /** After `drawMaps()`. */
    reuse: MapReuse = {drawn: 0, keptDrawn: 0, restored: 0, held: 0};
    private readonly planner: Planner;
    private readonly wasm: Wasm;
    private readonly subPixelBits: number;
    private at: Pointer;

    constructor(planner: Planner, traits: Traits, subPixelBits: number) {
        this.planner = planner;
        this.wasm = planner.wasm;
        this.subPixelBits = subPixelBits;
        this.at = this.wasm.pointer('gnomonMakeRecorder', INTERFACE, traits.mostLayers, traits.uniformAlignment, 0);
    }

    prepare(sizePx: readonly [number, number]): Command[] {
        const {list, commands} = this.read(this.wasm.pointer('gnomonRecordImages', this.at, this.planner.at, ...sizePx));
        this.changed = list.changed !== 0;
        return commands;
    }
    drawMaps(): Command[] {
        const {list, commands} = this.read(this.wasm.pointer('gnomonRecordMaps', this.at, this.planner.at));
        this.reuse = {drawn: list.mapsDrawn, keptDrawn: list.mapsKeptDrawn, restored: list.mapsRestored, held: list.mapsHeld};
        return commands;
    }
    drawMask(inputs: MaskInputs, reversedZ: boolean): Command[] {
        const {wasm} = this;
        const images = (inputs.normal ? Has.normals : 0) | (inputs.smooth ? Has.smooth : 0) | (inputs.objectId ? Has.ids : 0);
        return wasm.with(sizeOf('Precision'), at => {
            wasm.init('gnomonInitPrecision', 'Precision', at);
            wasm.write('Precision', at, this.precisionOf(inputs, reversedZ));
            return this.read(wasm.pointer('gnomonRecordMask', this.at, this.planner.at, images, at)).commands;
        });
    }
    private precisionOf({depth, normal, normalRounding}: MaskInputs, reversedZ: boolean): object {
        const isFloat = depth.format === 'r32float' || depth.format.startsWith('depth32float');
        const depthRounding = depth.format === 'depth16unorm' ? 2 ** -17 : isFloat && reversedZ ? 0 : 2 ** -25;
        const normalErrorRad = normal ? this.wasm.call('gnomonWebNormalError', normalRounding ?? ROUNDING[normal.format] ?? 2 ** -8)
                                      : this.wasm.call('gnomonWebNormalErrorFromDepth', this.subPixelBits);
        return {subPixelBits: this.subPixelBits, depthRounding, normalErrorRad};
    }
    /** All maps are drawn again; `imagesToo`: images and buffers are made anew. */
    lose(imagesToo: boolean): void {
        this.wasm.done('gnomonLoseRecorded', this.at, imagesToo ? 1 : 0);
    }
    free(): void {
        this.wasm.call('gnomonFreeRecorder', this.at);
        this.at = 0;
    }

    private read(at: Pointer): {list: List, commands: Command[]} {
        const {wasm} = this;
        const list = wasm.read<List>('CommandList', at);
        const words = wasm.words(list.words, list.wordCount);
        const bindings = Array.from({length: list.bindingCount}, (_, i) => bindingOf(wasm.read('Binding', list.bindings + i * sizeOf('Binding'))));
        const commands = Array.from({length: list.commandCount}, (_, i) =>
            commandOf(wasm, wasm.read('Command', list.commands + i * sizeOf('Command')), words, bindings));
        return {list, commands};
    }
}

function namesOf(names: Record<string, number>): string[] {
    return Object.keys(names).sort((a, b) => names[a]! - names[b]!);
}
function imageOf([name, options]: number[]): ImageRef {
    return {kind: IMAGES[name!]!, options: options!};
}
function bufferOf([name, options]: number[]): BufferRef {
    return {kind: BUFFERS[name!]!, options: options!};
}
function rectangleOf(numbers: number[]): Rectangle {
    const [x, y, width, height] = numbers as [number, number, number, number];
    return {x, y, width, height};
}
function tileOf([layer, ...rest]: number[]): Tile {
    return {layer: layer!, ...rectangleOf(rest)};
}
function bindingOf(raw: RawBinding): Binding {
    const kinds = {[BindingKind.texture]: 'texture', [BindingKind.storageImage]: 'storageImage', [BindingKind.uniform]: 'uniform',
                   [BindingKind.storage]: 'storage'} as const;
    const isImage = raw.kind === BindingKind.texture || raw.kind === BindingKind.storageImage;
    return {binding: raw.binding, kind: kinds[raw.kind as keyof typeof kinds], image: isImage ? imageOf(raw.image) : null,
            level: raw.level === NO_INDEX ? null : raw.level, linear: raw.linear !== 0, buffer: isImage ? null : bufferOf(raw.buffer),
            offset: Number(raw.offset), bytes: Number(raw.bytes)};
}
function targetOf(raw: Raw): Target {
    return {colour: raw.colour[0] === NO_INDEX ? null : imageOf(raw.colour), colourLayer: raw.colourLayer,
            depth: raw.depth[0] === NO_INDEX ? null : imageOf(raw.depth), depthLayer: raw.depthLayer,
            viewport: rectangleOf(raw.viewport), scissor: rectangleOf(raw.scissor), channels: raw.channels};
}

function commandOf(wasm: Wasm, raw: Raw, words: Uint32Array<ArrayBuffer>, bindings: Binding[]): Command {
    const wordsOf = ([first, count]: number[]) => words.slice(first!, first! + count!);
    const runs = () => ({constants: wordsOf(raw.constants), push: wordsOf(raw.push),
                         bindings: bindings.slice(raw.bindings[0], raw.bindings[0]! + raw.bindings[1]!)});
    switch (raw.kind) {
    case CommandKind.dropOptions:
        return {kind: 'dropOptions', options: raw.options};
    case CommandKind.makeImage:
        return {kind: 'makeImage', image: imageOf(raw.image), keeps: raw.keeps !== 0,
                shape: {format: raw.format, width: raw.sizePx[0]!, height: raw.sizePx[1]!, layers: raw.layers, levels: raw.levels, samples: raw.samples}};
    case CommandKind.makeBuffer:
        return {kind: 'makeBuffer', buffer: bufferOf(raw.buffer), bytes: Number(raw.bytes), copies: Number(raw.copies)};
    case CommandKind.writeBuffer:
        return {kind: 'writeBuffer', buffer: bufferOf(raw.buffer), offset: Number(raw.offset), data: wordsOf(raw.data)};
    case CommandKind.zeroBuffer:
        return {kind: 'zeroBuffer', buffer: bufferOf(raw.buffer)};
    case CommandKind.copyTexels:
        return {kind: 'copyTexels', from: imageOf(raw.image), area: tileOf(raw.area), to: imageOf(raw.to), place: tileOf(raw.place)};
    case CommandKind.clearTarget:
        return {kind: 'clearTarget', target: targetOf(raw)};
    case CommandKind.drawCasters:
        return {kind: 'drawCasters', target: targetOf(raw), view: raw.view, casters: wasm.words(raw.casters, raw.casterCount)};
    case CommandKind.drawTriangle:
        return {kind: 'drawTriangle', target: targetOf(raw), vertex: raw.vertex, fragment: raw.module, least: raw.least !== 0, ...runs()};
    default:
        return {kind: 'runCompute', module: raw.module, groups: raw.groups as [number, number, number], ...runs()};
    }
}
