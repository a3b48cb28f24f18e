// SPDX-License-Identifier: Apache-2.0
// usage: draw.mjs WGSL : draws a triangle with caster.vert as docs/kit.md says, in the lower half of Vulkan's range of y, which is
// the upper half of an image: rows 0 and 1 of 4. Prints the depths of each row's first texel. By Dawn, on the machine's device.
import {readFileSync} from 'node:fs';
import {create, globals} from 'webgpu';

Object.assign(globalThis, globals);
const gpu = create(['backend=vulkan']); // all of Dawn goes with it
const adapter = await gpu.requestAdapter();
if (!adapter) {
    console.log('SKIPPED: Dawn finds no device');
    process.exit(77);
}
const device = await adapter.requestDevice();

function bufferOf(numbers, usage) {
    const data = new Float32Array(numbers);
    const buffer = device.createBuffer({size: data.byteLength, usage: usage | GPUBufferUsage.COPY_DST});
    device.queue.writeBuffer(buffer, 0, data);
    return buffer;
}

// Counter-clockwise in Vulkan, whose y points down. Rows of the identity: x, y, z.
const corners = bufferOf([-1, 0, 0.25, 3, 0, 0.25, -1, -4, 0.25], GPUBufferUsage.VERTEX);
const rows = bufferOf([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0], GPUBufferUsage.VERTEX);
const push = bufferOf(new Array(24).fill(0), GPUBufferUsage.UNIFORM);
const FORMATS = {2: 'float32x4', 3: 'float32x4', 6: 'float32x2', 9: 'float32x2', 10: 'uint32'};
const attributes = [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11].map(
    location => ({shaderLocation: location, offset: location < 4 ? 16 * (location - 1) : 48, format: FORMATS[location] ?? 'float32x4'}));
const pipeline = device.createRenderPipeline({
    layout: 'auto',
    vertex: {
        module: device.createShaderModule({code: readFileSync(process.argv[2], 'utf8')}),
        entryPoint: 'main',
        buffers: [{arrayStride: 12, attributes: [{shaderLocation: 0, offset: 0, format: 'float32x3'}]},
                  {arrayStride: 0, stepMode: 'instance', attributes}],
    },
    primitive: {cullMode: 'back', frontFace: 'ccw'},
    depthStencil: {format: 'depth32float', depthWriteEnabled: true, depthCompare: 'less'},
});
const map = device.createTexture({size: [4, 4], format: 'depth32float', usage: GPUTextureUsage.RENDER_ATTACHMENT | GPUTextureUsage.COPY_SRC});
const kept = device.createBuffer({size: 4 * 256, usage: GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ});
const commands = device.createCommandEncoder();
const pass = commands.beginRenderPass({
    colorAttachments: [],
    depthStencilAttachment: {view: map.createView(), depthClearValue: 1, depthLoadOp: 'clear', depthStoreOp: 'store'},
});
pass.setPipeline(pipeline);
pass.setVertexBuffer(0, corners);
pass.setVertexBuffer(1, rows);
if (/@group\(3\)/.test(readFileSync(process.argv[2], 'utf8'))) {
    pass.setBindGroup(3, device.createBindGroup({layout: pipeline.getBindGroupLayout(3), entries: [{binding: 0, resource: {buffer: push}}]}));
}
pass.draw(3);
pass.end();
commands.copyTextureToBuffer({texture: map}, {buffer: kept, bytesPerRow: 256}, [4, 4]);
device.queue.submit([commands.finish()]);
await kept.mapAsync(GPUMapMode.READ);
const depths = new Float32Array(kept.getMappedRange());
console.log([0, 1, 2, 3].map(row => depths[64 * row]).join(' '));
process.exit(gpu ? 0 : 1);
