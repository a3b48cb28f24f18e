// SPDX-License-Identifier: Apache-2.0
// Draws cases of cases.json by WebGPU in a page. `drawCase(name)` gives the mask's texels as hexadecimal text.
import {CasterPipelines, flipY, loadGnomon, loadShaders, ShadowRenderer} from 'gnomon-shadows';
import {makeShadows, openDevice} from './example.mjs';
import {objectsOf, plannerOf} from './scene.mjs';

const read = async name => (await fetch(name)).arrayBuffer();
const told = {};
for (const folder of ['cases', 'exact']) {
    told[folder] = JSON.parse(new TextDecoder().decode(await read(`${folder}/cases.json`)));
}
const {scene, cases} = told['cases'];
const device = navigator.gpu ? await openDevice() : null;
const gnomon = await loadGnomon();
const shaders = await loadShaders();
const problems = [];
device?.addEventListener('uncapturederror', event => problems.push(event.error.message));

function bufferOf(data, usage) {
    const buffer = device.createBuffer({size: Math.ceil(data.byteLength / 4) * 4, usage: usage | GPUBufferUsage.COPY_DST});
    device.queue.writeBuffer(buffer, 0, data);
    return buffer;
}
function textureOf(format, bytes, data) {
    const size = [scene.widthPx, scene.heightPx];
    const texture = device.createTexture({size, format, usage: GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST});
    device.queue.writeTexture({texture}, data, {bytesPerRow: bytes * scene.widthPx}, size);
    return texture;
}

const world = device && {
    mesh: (() => {
        const positions = bufferOf(new Float32Array(scene.positions.flat()), GPUBufferUsage.VERTEX);
        const indices = bufferOf(new Uint32Array(scene.indices), GPUBufferUsage.INDEX);
        const part = (firstIndex, indexCount, baseVertex) => [{positions, indices, indexFormat: 'uint32', firstIndex, indexCount, baseVertex}];
        return {ground: part(0, 6, 0), box: part(6, 36, 4)};
    })(),
    depth: textureOf('r32float', 4, await read('cases/depth.bin')),
    normal: textureOf('rg32float', 8, await read('cases/normals.bin')),
};

/** The mask after `frames` frames of the same picture, on a device that places vertices as exactly as the folder's does. */
async function drawCase(name, frames, folder) {
    const one = told[folder].cases.find(each => each.name === name);
    const planner = plannerOf(gnomon, one.settings);
    const shadows = new ShadowRenderer(device, gnomon, planner, {shaders, subPixelBits: told[folder].scene.subPixelBits});
    const casters = new CasterPipelines(device, planner, shaders);
    const objects = objectsOf(gnomon, scene.bounds);
    const size = [scene.widthPx, scene.heightPx];
    let reuse = null;
    for (let index = 0; index < frames; ++index) {
        const plan = planner.plan({index, camera: scene.camera, widthPx: size[0], heightPx: size[1], objects, lights: one.lights});
        shadows.prepare(plan, size);
        const encoder = device.createCommandEncoder();
        shadows.draw(encoder, plan, {depth: world.depth, normal: world.normal, normalRounding: 2 ** -16},
                     pass => casters.draw(pass, object => object === 0 ? world.mesh.ground : world.mesh.box, object => scene.transforms[object]));
        device.queue.submit([encoder.finish()]);
        reuse = shadows.reuse;
    }
    const texels = await readMask(shadows.mask, one);
    shadows.destroy();
    planner.free();
    objects.free();
    if (problems.length > 0) {
        throw new Error(problems.splice(0).join('\n'));
    }
    return {texels: Array.from(texels, byte => byte.toString(16).padStart(2, '0')).join(''), reuse};
}

async function readMask(mask, {layers, channels}) {
    const row = Math.ceil(mask.width * channels / 256) * 256;
    const buffer = device.createBuffer({size: row * mask.height * layers, usage: GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ});
    const encoder = device.createCommandEncoder();
    encoder.copyTextureToBuffer({texture: mask}, {buffer, bytesPerRow: row, rowsPerImage: mask.height}, [mask.width, mask.height, layers]);
    device.queue.submit([encoder.finish()]);
    await buffer.mapAsync(GPUMapMode.READ);
    const all = new Uint8Array(buffer.getMappedRange());
    const texels = new Uint8Array(mask.width * mask.height * layers * channels);
    for (let i = 0; i < mask.height * layers; ++i) {
        texels.set(all.subarray(i * row, i * row + mask.width * channels), i * mask.width * channels);
    }
    buffer.destroy();
    return texels;
}

/** The mask of the document's example, of the same scene: the least and the largest value, and its size. */
async function drawExample() {
    const things = scene.transforms.map((transform, i) => ({bounds: scene.bounds[i], transform, meshes: i === 0 ? world.mesh.ground : world.mesh.box}));
    const shadows = await makeShadows(device, things);
    let texels;
    for (let index = 0; index < 2; ++index) {
        const encoder = device.createCommandEncoder();
        const mask = shadows.draw(encoder, {index, eye: scene.camera.eyeWs, clipFromWorld: flipY(scene.camera.clipFromWorld), depth: world.depth,
                                            sun: cases[0].lights[0].directionWs});
        device.queue.submit([encoder.finish()]);
        texels = await readMask(mask, {layers: 1, channels: 1});
        shadows.move(1, scene.bounds[1]);
    }
    if (problems.length > 0) {
        throw new Error(problems.splice(0).join('\n'));
    }
    return [Math.min(...texels), Math.max(...texels), texels.length];
}

/** The message with which these options are refused. */
function refusal(options) {
    const planner = plannerOf(gnomon, options);
    const shadows = new ShadowRenderer(device, gnomon, planner, {shaders});
    const size = [scene.widthPx, scene.heightPx];
    const plan = planner.plan({camera: scene.camera, widthPx: size[0], heightPx: size[1], objects: objectsOf(gnomon, scene.bounds), lights: cases[0].lights});
    try {
        shadows.prepare(plan, size);
    } catch (error) {
        return error.message;
    } finally {
        shadows.destroy();
        planner.free();
    }
    return '';
}

Object.assign(globalThis, {drawCase, drawExample, refusal, hasDevice: Boolean(device), isReady: true});
