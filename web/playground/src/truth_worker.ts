// SPDX-License-Identifier: Apache-2.0
// A worker that traces its share of a picture, coarsely first, then with more and more rays a pixel.
import { kCoarse, PixelTruth, type TruthView } from './pixel_truth.ts';
import { Tracer } from './tracer.ts';
import { bandsOf, type FromWorker, type ToWorker } from './truth_messages.ts';
import { readWorld } from './world.ts';

const kMostSamples = 256;
const kCoarseSamples = 2;
const kSlice_ms = 12; // then it looks whether another view is wanted

let tracer: Tracer | undefined;
let share = { index: 0, workers: 1 };
let wanted = 0;
const turn = new MessageChannel();

/** Lets messages in. */
function breathe(): Promise<void> {
  return new Promise((done) => {
    turn.port1.onmessage = () => done();
    turn.port2.postMessage(0);
  });
}

function post(message: FromWorker): void {
  (self as unknown as { postMessage(message: FromWorker): void }).postMessage(message);
}

/** Calls `row` for each of this worker's rows that are wanted; false where another view came meanwhile. */
async function eachRow(id: number, height: number, step: number, row: (y: number) => void): Promise<boolean> {
  let since = performance.now();
  for (const band of bandsOf(height, share.index, share.workers)) {
    for (let y = band; y < Math.min(band + kCoarse, height); y += step) {
      row(y);
      if (performance.now() - since > kSlice_ms) {
        await breathe();
        since = performance.now();
        if (id !== wanted) {
          return false;
        }
      }
    }
  }
  return true;
}

async function traceCoarsely(id: number, truth: PixelTruth): Promise<boolean> {
  const { width, height } = truth.view;
  const values: number[] = [];
  const whole = await eachRow(id, height, kCoarse, (y) => {
    for (let x = 0; x < width; x += kCoarse) {
      const pixel = Math.min(y + kCoarse / 2, height - 1) * width + Math.min(x + kCoarse / 2, width - 1);
      let lit = 0;
      for (let i = 0; i < kCoarseSamples; ++i) {
        lit += !truth.surface(pixel) || truth.reaches(pixel, i) ? 1 : 0;
      }
      values.push((255 * lit) / kCoarseSamples);
    }
  });
  if (whole) {
    post({ kind: 'coarse', id, index: share.index, values: Uint8Array.from(values) });
  }
  return whole;
}

/** The worker's own rows of a picture, one after the other. */
function ownRows<T extends Uint8Array | Uint16Array>(from: T, into: T, width: number, height: number): T {
  let at = 0;
  for (const band of bandsOf(height, share.index, share.workers)) {
    const rows = from.subarray(band * width, Math.min(band + kCoarse, height) * width);
    into.set(rows, at);
    at += rows.length;
  }
  return into.subarray(0, at) as T;
}

async function trace(id: number, view: TruthView): Promise<void> {
  if (!tracer) {
    return;
  }
  const truth = new PixelTruth(tracer, view);
  const surfaces = new Uint8Array(view.width * view.height);
  if (!(await traceCoarsely(id, truth))) {
    return;
  }
  for (let samples = 0; samples < kMostSamples; ) {
    const more = Math.min(Math.max(samples, 1), 16);
    const whole = await eachRow(id, view.height, 1, (y) => {
      for (let pixel = y * view.width; pixel < (y + 1) * view.width; ++pixel) {
        surfaces[pixel] = truth.surface(pixel) ? 1 : 0;
        for (let i = samples; i < samples + more && surfaces[pixel]; ++i) {
          truth.addRay(pixel, i);
        }
      }
    });
    if (!whole) {
      return;
    }
    samples += more;
    const size = view.width * view.height;
    post({
      kind: 'pass', id, index: share.index, samples,
      sums: ownRows(truth.sums, new Uint16Array(size), view.width, view.height),
      surfaces: ownRows(surfaces, new Uint8Array(size), view.width, view.height),
    });
  }
}

self.onmessage = (event: MessageEvent<ToWorker>) => {
  const message = event.data;
  if (message.kind === 'world') {
    wanted = -1;
    share = { index: message.index, workers: message.workers };
    tracer = new Tracer(readWorld(message.bytes));
    post({ kind: 'ready' });
  } else {
    wanted = message.id;
    void trace(message.id, message.view);
  }
};
