// SPDX-License-Identifier: Apache-2.0
// Where finished pictures go, and how pixels come back from the device.
import type { Drawn } from './shadows.ts';

/** The texels of a texture of one or four bytes each, rows without gaps. */
export async function readTexels(device: GPUDevice, texture: GPUTexture, bytes: 1 | 4): Promise<Uint8Array<ArrayBuffer>> {
  const { width, height } = texture;
  const row = width * bytes;
  const bytesPerRow = Math.ceil(row / 256) * 256;
  const buffer = device.createBuffer({ size: bytesPerRow * height, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST });
  const encoder = device.createCommandEncoder();
  encoder.copyTextureToBuffer({ texture }, { buffer, bytesPerRow }, [width, height]);
  device.queue.submit([encoder.finish()]);
  await buffer.mapAsync(GPUMapMode.READ);
  const rows = new Uint8Array(buffer.getMappedRange());
  const out = new Uint8Array(row * height);
  for (let y = 0; y < height; ++y) {
    out.set(rows.subarray(y * bytesPerRow, y * bytesPerRow + row), y * row);
  }
  buffer.destroy();
  return out;
}

/** A canvas. Where the device is software its pictures are copied to it: not every browser can show those otherwise. */
export class Screen {
  readonly format: GPUTextureFormat;
  private readonly context: GPUCanvasContext | undefined;
  private picture: GPUTexture | undefined;
  private copying = false;
  private what: Drawn = 'nothing';
  private again = false;

  /** Throws an Error where the canvas cannot be drawn to. */
  constructor(private readonly device: GPUDevice, private readonly canvas: HTMLCanvasElement, software: boolean,
              private readonly shown: (what: Drawn) => void) {
    this.format = software ? 'rgba8unorm' : navigator.gpu.getPreferredCanvasFormat();
    if (!software) {
      const context = canvas.getContext('webgpu');
      if (!context) {
        throw new Error('The browser cannot draw into the page by WebGPU. Here are pictures instead.');
      }
      this.context = context;
      context.configure({ device, format: this.format, alphaMode: 'opaque' });
    }
  }

  /** Draw here; then call show(). */
  view(): GPUTextureView {
    if (this.context) {
      return this.context.getCurrentTexture().createView();
    }
    const { width, height } = this.canvas;
    if (this.picture?.width !== width || this.picture.height !== height) {
      this.picture?.destroy();
      const usage = GPUTextureUsage.RENDER_ATTACHMENT | GPUTextureUsage.COPY_SRC;
      this.picture = this.device.createTexture({ size: [width, height], format: this.format, usage });
    }
    return this.picture.createView();
  }

  /** Shows what was submitted. One copy at a time: frames in between are left out. */
  show(what: Drawn): void {
    this.what = what;
    if (this.context) {
      this.shown(what);
    } else if (this.copying) {
      this.again = true;
    } else {
      void this.copy();
    }
  }

  private async copy(): Promise<void> {
    this.copying = true;
    do {
      this.again = false;
      const [picture, what] = [this.picture!, this.what];
      const texels = await readTexels(this.device, picture, 4);
      if (picture.width === this.canvas.width && picture.height === this.canvas.height) {
        this.canvas.getContext('2d')!.putImageData(new ImageData(new Uint8ClampedArray(texels.buffer), picture.width), 0, 0);
        this.shown(what);
      }
    } while (this.again);
    this.copying = false;
  }
}
