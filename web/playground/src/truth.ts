// SPDX-License-Identifier: Apache-2.0
// The traced picture beside Gnomon's: workers trace it, and this joins what they send.
import { kCoarse, type TruthView } from './pixel_truth.ts';
import { bandsOf, type FromWorker, type ToWorker } from './truth_messages.ts';

export class Truth {
  /** Visibility, 255 in full light, by pixel. */
  visibility: Uint8Array<ArrayBuffer> = new Uint8Array(0);
  /** 1 where a pixel shows a surface, once samples is not 0. */
  surfaces: Uint8Array<ArrayBuffer> = new Uint8Array(0);
  /** Rays for each pixel so far; 0: squares of pixels share some. */
  samples = 0;
  private readonly workers: Worker[];
  private readonly samplesOf: number[];
  private readonly idle: boolean[];
  /** The scene that is traced. */
  view: TruthView | undefined;
  private id = 0;

  /** `changed` is called when there is more to see. */
  constructor(private readonly changed: () => void) {
    const count = Math.max(1, Math.min(8, (navigator.hardwareConcurrency || 2) - 1));
    this.workers = Array.from({ length: count }, () => new Worker('truth_worker.js', { type: 'module' }));
    this.samplesOf = this.workers.map(() => 0);
    this.idle = this.workers.map(() => false);
    this.workers.forEach((worker, index) => {
      worker.onmessage = (event: MessageEvent<FromWorker>) => this.take(event.data, index);
    });
  }

  /** Nothing is traced until there are a world and a view. */
  stop(): void {
    ++this.id;
    this.view = undefined;
    this.samples = 0;
    this.idle.fill(false);
  }

  /** The world that the present view, and all that follow, are traced in. Call stop() before. */
  setWorld(bytes: ArrayBuffer): void {
    this.workers.forEach((worker, index) => this.post(worker, { kind: 'world', bytes, index, workers: this.workers.length }));
  }

  /** Begins anew with another view. */
  restart(view: TruthView): void {
    const size = view.width * view.height;
    if (this.visibility.length !== size) {
      this.visibility = new Uint8Array(size).fill(255);
    }
    this.surfaces = new Uint8Array(size);
    this.samples = 0;
    this.samplesOf.fill(0);
    this.view = view;
    ++this.id;
    this.workers.forEach((worker, index) => this.idle[index] && this.post(worker, { kind: 'view', id: this.id, view }));
  }

  private post(worker: Worker, message: ToWorker): void {
    worker.postMessage(message);
  }

  private take(message: FromWorker, index: number): void {
    if (message.kind === 'ready') {
      this.idle[index] = true;
      if (this.view) {
        this.post(this.workers[index], { kind: 'view', id: this.id, view: this.view });
      }
      return;
    }
    if (message.id !== this.id || !this.view) {
      return;
    }
    const { width, height } = this.view;
    let at = 0;
    for (const band of bandsOf(height, index, this.workers.length)) {
      for (let y = band; y < Math.min(band + kCoarse, height); ++y) {
        for (let x = 0; x < width; ++x) {
          if (message.kind === 'coarse') {
            this.visibility[y * width + x] = message.values[at + Math.floor(x / kCoarse)];
          } else {
            const surface = message.surfaces[at];
            this.surfaces[y * width + x] = surface;
            this.visibility[y * width + x] = surface ? Math.round((255 * message.sums[at]) / message.samples) : 255;
            ++at;
          }
        }
      }
      at += message.kind === 'coarse' ? Math.ceil(width / kCoarse) : 0;
    }
    this.samplesOf[index] = message.kind === 'pass' ? message.samples : 0;
    this.samples = Math.min(...this.samplesOf);
    this.changed();
  }

  /** The rmse of a mask (255 in full light, rows of `width`) over the pixels that show a surface; nothing before a whole sample. */
  rmseOf(mask: Uint8Array): number | undefined {
    if (this.samples === 0 || mask.length !== this.visibility.length) {
      return undefined;
    }
    let sum = 0;
    let count = 0;
    for (let i = 0; i < mask.length; ++i) {
      if (this.surfaces[i]) {
        sum += (mask[i] - this.visibility[i]) ** 2;
        ++count;
      }
    }
    return count > 0 ? Math.sqrt(sum / count) / 255 : undefined;
  }
}
