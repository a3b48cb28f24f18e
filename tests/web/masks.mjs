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

/** A renderer of the scene, whose first box may be moved. `meshesOf`: of an object. */
function makeSide(settings, subPixelBits, meshesOf = object => object === 0 ? world.mesh.ground : world.mesh.box) {
    const planner = plannerOf(gnomon, settings);
    const shadows = new ShadowRenderer(device, gnomon, planner, {shaders, subPixelBits});
    const casters = new CasterPipelines(device, planner, shaders);
    const objects = gnomon.makeObjects();
    const names = scene.bounds.map((box, i) => objects.add(box, {dynamic: i === 1}));
    const transforms = scene.transforms.map(rows => [...rows]);
    const size = [scene.widthPx, scene.heightPx];
    let index = 0;
    return {
        move(x) {
            transforms[1][3] += x;
            const {min, max} = scene.bounds[1];
            const moved = [min, max].map(corner => [corner[0] + transforms[1][3] - scene.transforms[1][3], corner[1], corner[2]]);
            objects.move(names[1], {min: moved[0], max: moved[1]});
        },
        draw(lights) {
            const plan = planner.plan({index: index++, camera: scene.camera, widthPx: size[0], heightPx: size[1], objects, lights});
            shadows.prepare(plan, size);
            const encoder = device.createCommandEncoder();
            shadows.draw(encoder, plan, {depth: world.depth, normal: world.normal, normalRounding: 2 ** -16},
                         pass => casters.draw(pass, meshesOf, object => transforms[object]));
            device.queue.submit([encoder.finish()]);
            return {layers: plan.maskLayers, channels: plan.maskChannels};
        },
        warmUp(lights) {
            const plan = planner.plan({index: index++, camera: scene.camera, widthPx: size[0], heightPx: size[1], objects, lights});
            shadows.prepare(plan, size);
            return shadows.warmUp(plan, {depth: world.depth, normal: world.normal, normalRounding: 2 ** -16});
        },
        mask: shape => readMask(shadows.mask, shape),
        get reuse() {
            return shadows.reuse;
        },
        end() {
            shadows.destroy();
            planner.free();
            objects.free();
            if (problems.length > 0) {
                throw new Error(problems.splice(0).join('\n'));
            }
        },
    };
}

/** The mask after `frames` frames of the same picture, on a device that places vertices as exactly as the folder's does. */
async function drawCase(name, frames, folder) {
    const one = told[folder].cases.find(each => each.name === name);
    const side = makeSide(one.settings, told[folder].scene.subPixelBits);
    for (let i = 0; i < frames; ++i) {
        side.draw(one.lights);
    }
    const texels = await side.mask(one);
    const {reuse} = side;
    side.end();
    return {texels: Array.from(texels, byte => byte.toString(16).padStart(2, '0')).join(''), reuse};
}

function farthest(a, b) {
    return a.length === b.length ? a.reduce((most, one, i) => Math.max(most, Math.abs(one - b[i])), 0) : 256;
}

/**
 * Frames in which a box moves and lights come, and the last of them drawn from nothing: by how much their masks differ, and which maps
 * the last frame drew.
 */
async function drawOn(settings, names) {
    const lights = told['cases'].cases.find(each => each.name === 'three_lights').lights;
    const [kept, anew] = [makeSide(settings, 4), makeSide(settings, 4)];
    kept.draw(lights.slice(0, 1));
    for (let i = 0; i < 3; ++i) {
        kept.move(0.2);
        anew.move(0.2);
        kept.draw(lights.slice(0, names));
    }
    const {reuse} = kept;
    const masks = [await kept.mask(kept.draw(lights.slice(0, names))), await anew.mask(anew.draw(lights.slice(0, names)))];
    kept.end();
    anew.end();
    return {apart: farthest(...masks), reuse};
}

/**
 * Frames of a renderer that was warmed up, and of one that was not: by how much their masks differ, and which pipelines
 * are compiled by warming up, and by the frame after it. Those of casters are the host's, and those that clear run no module.
 */
async function drawWarm(settings) {
    const {lights} = told['cases'].cases[0];
    const names = {ahead: [], late: []};
    for (const [kind, list] of [['createRenderPipelineAsync', names.ahead], ['createComputePipelineAsync', names.ahead],
                                ['createRenderPipeline', names.late], ['createComputePipeline', names.late]]) {
        device[kind] = descriptor => {
            list.push(descriptor.label);
            return Object.getPrototypeOf(device)[kind].call(device, descriptor);
        };
    }
    const [warm, cold] = [makeSide(settings, 4), makeSide(settings, 4)];
    await warm.warmUp(lights);
    const ahead = names.ahead.slice();
    names.late.length = 0;
    const shape = warm.draw(lights);
    const late = names.late.filter(name => !/^gnomon (caster|clear)/.test(name));
    const masks = [await warm.mask(shape), await cold.mask(cold.draw(lights))];
    ['createRenderPipelineAsync', 'createComputePipelineAsync', 'createRenderPipeline', 'createComputePipeline'].forEach(kind => delete device[kind]);
    warm.end();
    cold.end();
    return {apart: farthest(...masks), least: Math.min(...masks[0]), ahead, late};
}

/** By how much the masks differ of boxes whose texture is clear everywhere, and of no boxes. */
async function drawHoles() {
    const texture = device.createTexture({size: [1, 1], format: 'rgba8unorm', usage: GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST});
    const uvs = bufferOf(new Float32Array(2 * scene.positions.length), GPUBufferUsage.VERTEX);
    const box = world.mesh.box.map(mesh => ({...mesh, holes: {uvs, texture: texture.createView()}}));
    const {settings, lights} = told['cases'].cases[0];
    const masks = [];
    for (const meshes of [box, [], world.mesh.box]) {
        const side = makeSide(settings, 4, object => object === 0 ? world.mesh.ground : meshes);
        masks.push(await side.mask(side.draw(lights)));
        side.end();
    }
    return [farthest(masks[0], masks[1]), farthest(masks[0], masks[2])];
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

Object.assign(globalThis, {drawCase, drawExample, drawHoles, drawOn, drawWarm, refusal, hasDevice: Boolean(device), isReady: true});
