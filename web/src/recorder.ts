// SPDX-License-Identifier: Apache-2.0
// The commands of the planner's last plan (pack::FrameRecorder).
import type {Command} from './commands.js';
import type {Planner} from './planner.js';
import type {MapReuse, MaskInputs} from './renderer.js';
import {GnomonError} from './wasm.js';

/** Limits of the device. */
export interface Traits {mostLayers: number, uniformAlignment: number}

// The C interface does not have it yet.
export class Recorder {
    constructor(readonly planner: Planner, readonly traits: Traits) {}
    prepare(sizePx: readonly [number, number]): {list: Command[], changed: boolean} {
        throw new GnomonError('record a frame', `nothing records ${sizePx[0]} x ${sizePx[1]} pixels yet`);
    }
    drawMaps(): Command[] {
        return [];
    }
    drawMask(inputs: MaskInputs): Command[] {
        return inputs ? [] : [];
    }
    lose(): void {}
    reuse(): MapReuse {
        return {drawn: 0, keptDrawn: 0, restored: 0, held: 0};
    }
    free(): void {}
}
