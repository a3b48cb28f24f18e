// SPDX-License-Identifier: Apache-2.0
// Placeholder until the package is merged.
import type { PageState } from './address.ts';
import type { Option } from './controls.ts';
import type { Sight } from './renderer.ts';
import type { SceneOnGpu } from './scene_on_gpu.ts';

export interface ShadowFrame {
  state: PageState;
  sight: Sight;
  clip_from_world: Float64Array;
  width: number;
  height: number;
  depth: GPUTexture;
}

export class Shadows {
  private white: GPUTexture | undefined;
  said = '';
  counts = { maps: 0, texels: 0 };
  static async make(device: GPUDevice): Promise<Shadows> {
    return new Shadows(device);
  }
  constructor(private readonly device: GPUDevice) {}
  setScene(_scene: SceneOnGpu): void {}
  record(_encoder: GPUCommandEncoder, _frame: ShadowFrame): void {}
  submitted(): void {}
  mask(width: number, height: number): GPUTextureView {
    if (!this.white || this.white.width !== width) {
      this.white = this.device.createTexture({ size: [width, height], format: 'r8unorm', usage: GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST });
      this.device.queue.writeTexture({ texture: this.white }, new Uint8Array(width * height).fill(255), { bytesPerRow: width }, [width, height]);
    }
    return this.white.createView();
  }
}

export function optionsOf(_shadows: Shadows): Option[] {
  return [];
}
