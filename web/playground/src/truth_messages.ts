// SPDX-License-Identifier: Apache-2.0
// The messages between the page and the workers that trace, and which rows are whose.
import { kCoarse, type TruthView } from './pixel_truth.ts';

export type ToWorker =
  | { kind: 'world'; bytes: ArrayBuffer; index: number; workers: number }
  | { kind: 'view'; id: number; view: TruthView };

/** Values are of the worker's own rows, one after the other: bands of kCoarse rows, of which each worker has every n-th. */
export type FromWorker =
  | { kind: 'ready' }
  /** For each square of kCoarse pixels: share of light, 255 all of it. */
  | { kind: 'coarse'; id: number; index: number; values: Uint8Array }
  /** Rays that reached the sun, of `samples`, and whether a pixel shows a surface. */
  | { kind: 'pass'; id: number; index: number; samples: number; sums: Uint16Array; surfaces: Uint8Array };

/** Rows of a picture that are worker `index`'s. */
export function bandsOf(height: number, index: number, workers: number): number[] {
  const bands = [];
  for (let y = index * kCoarse; y < height; y += workers * kCoarse) {
    bands.push(y);
  }
  return bands;
}
