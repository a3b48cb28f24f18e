// SPDX-License-Identifier: Apache-2.0
// Canvases whose pictures are textures: headless Chromium ends where it shows those of WebGPU with SwiftShader.
const getContext = HTMLCanvasElement.prototype.getContext;
HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
  if (kind !== 'webgpu') {
    return getContext.call(this, kind, ...rest);
  }
  let set;
  let texture;
  this.standIn ??= {
    canvas: this,
    configure: (configuration) => { set = configuration; },
    unconfigure: () => {},
    getConfiguration: () => set,
    getCurrentTexture: () => {
      if (texture?.width !== this.width || texture?.height !== this.height) {
        texture = set.device.createTexture({ size: [this.width, this.height], format: set.format, usage: set.usage | GPUTextureUsage.COPY_SRC | GPUTextureUsage.RENDER_ATTACHMENT });
      }
      return texture;
    },
  };
  return this.standIn;
};

/** The texels of a texture of four bytes each: rows of layer after layer. */
globalThis.texelsOf = async (device, texture, bytes = 4) => {
  const { width, height, depthOrArrayLayers: layers } = texture;
  const row = Math.ceil(bytes * width / 256) * 256;
  const buffer = device.createBuffer({ size: row * height * layers, usage: GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ });
  const encoder = device.createCommandEncoder();
  encoder.copyTextureToBuffer({ texture }, { buffer, bytesPerRow: row, rowsPerImage: height }, [width, height, layers]);
  device.queue.submit([encoder.finish()]);
  await buffer.mapAsync(GPUMapMode.READ);
  const rows = new Uint8Array(buffer.getMappedRange());
  const out = new Uint8Array(bytes * width * height * layers);
  for (let y = 0; y < height * layers; ++y) {
    out.set(rows.subarray(y * row, y * row + bytes * width), y * bytes * width);
  }
  buffer.destroy();
  return out;
};
