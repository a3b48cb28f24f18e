// SPDX-License-Identifier: Apache-2.0
// The commands of a frame (pack/frame_commands.h), as the executor reads them.

/** An image that commands name: its kind, and the planner's options that it belongs to (0: the frame's own). */
export interface ImageRef {kind: string, options: number}
/** A buffer that commands name, by the same two. */
export interface BufferRef {kind: string, options: number}
/** A rectangle, texels. */
export interface Rectangle {x: number, y: number, width: number, height: number}
/** A rectangle of a layer. */
export interface Tile extends Rectangle {layer: number}
/** The shape of an image. `format`: of gnomon::MapFormat ("d32f"), or "r32ui". */
export interface ImageShape {format: string, width: number, height: number, layers: number, levels: number, samples: number}
/** The images that are drawn to, and the part of them. */
export interface Target {
    colour: ImageRef | null;
    colourLayer: number;
    depth: ImageRef | null;
    depthLayer: number;
    viewport: Rectangle;
    scissor: Rectangle;
    /** Bit i: channel i of colour is written. */
    channels: number;
}
/** An image or a buffer as a module reads or writes it. */
export interface Binding {
    binding: number;
    kind: 'texture' | 'storageImage' | 'uniform' | 'storage';
    image: ImageRef | null;
    /** Mip level; null: all. */
    level: number | null;
    linear: boolean;
    buffer: BufferRef | null;
    offset: number;
    /** 0: the whole buffer. */
    bytes: number;
}
interface Runs {constants: Uint32Array, push: Uint32Array, bindings: Binding[]}
/** One command. */
export type Command =
    | {kind: 'dropOptions', options: number}
    | {kind: 'makeImage', image: ImageRef, shape: ImageShape, keeps: boolean}
    | {kind: 'makeBuffer', buffer: BufferRef, bytes: number, copies: number}
    | {kind: 'writeBuffer', buffer: BufferRef, offset: number, data: Uint32Array<ArrayBuffer>}
    | {kind: 'zeroBuffer', buffer: BufferRef}
    | {kind: 'copyTexels', from: ImageRef, area: Tile, to: ImageRef, place: Tile}
    | {kind: 'clearTarget', target: Target}
    | {kind: 'drawCasters', target: Target, view: number, casters: Uint32Array}
    | {kind: 'drawTriangle', target: Target, vertex: string, fragment: string, least: boolean} & Runs
    | {kind: 'runCompute', module: string, groups: [number, number, number]} & Runs;
export type DrawTriangle = Extract<Command, {kind: 'drawTriangle'}>;
export type RunCompute = Extract<Command, {kind: 'runCompute'}>;
