// SPDX-License-Identifier: Apache-2.0
// Reads {kit: passes.json, folder: where its files are, programs: lists of modules} from standard input, and makes all modules
// and pipelines with Dawn, on no device. Prints a line "MODULE: MESSAGE" for each that Dawn refuses.
import {readFileSync} from 'node:fs';
import {create, globals} from 'webgpu';

Object.assign(globalThis, globals);
const {kit, folder, programs} = JSON.parse(readFileSync(0, 'utf8'));
const gpu = create(['backend=null']); // all of Dawn goes with it
const adapter = await gpu.requestAdapter();
const device = await adapter.requestDevice({requiredFeatures: ['clip-distances']});
const ATTRIBUTES = {float: 'float32', vec2: 'float32x2', vec3: 'float32x3', vec4: 'float32x4', uint: 'uint32'};
const TARGETS = {float: 'r16float', uint: 'r32uint', vec2: 'rg16float', uvec2: 'rg32uint', vec4: 'rgba16float'};
const modules = {};
let refused = 0;

function say(name, message) {
    console.log(`${name}: ${message.split('\n').find(line => line.includes('rror')) ?? message.split('\n')[0]}`);
    ++refused;
}

for (const described of kit.modules) {
    for (const [form, file] of Object.entries(described.files.wgsl ?? {})) {
        const module = device.createShaderModule({code: readFileSync(`${folder}/${file}`, 'utf8')});
        const wrong = (await module.getCompilationInfo()).messages.find(one => one.type === 'error');
        if (wrong) {
            say(described.name, `${file}:${wrong.lineNum}: ${wrong.message}`);
        } else {
            modules[described.name] = {...modules[described.name], described, [form]: module};
        }
    }
}

// The pipeline of a list of modules; undefined where one of them has not been made.
function makePipeline(names) {
    const [first, fragment] = names.map(name => modules[name]);
    if (!first || (names.length > 1 && !fragment)) {
        return undefined;
    }
    if (first.described.stage === 'compute') {
        const module = first.any ?? first.rgba16f;
        return device.createComputePipelineAsync({layout: 'auto', compute: {module, entryPoint: 'main'}});
    }
    const perSample = fragment?.described.stage_inputs.some(one => one.per_sample);
    const attributes = first.described.stage_inputs.map(one => ({shaderLocation: one.location, offset: 0, format: ATTRIBUTES[one.type]}));
    const buffers = attributes.map(one => ({arrayStride: 16, attributes: [one]})).slice(0, 8);
    if (buffers.length === 8) { // WebGPU promises eight buffers and sixteen attributes
        buffers[7] = {arrayStride: 16, attributes: attributes.slice(7)};
    }
    const targets = fragment?.described.stage_outputs.map(one => ({format: TARGETS[one.type]}));
    return device.createRenderPipelineAsync({
        layout: 'auto',
        vertex: {module: perSample ? first.sample : first.any, entryPoint: 'main', buffers},
        fragment: fragment && {module: fragment.any, entryPoint: 'main', targets},
        multisample: {count: perSample ? 4 : 1},
        depthStencil: {format: 'depth32float', depthWriteEnabled: true, depthCompare: 'less'},
    });
}

let made = 0;
for (const names of programs) {
    try {
        made += await makePipeline(names) ? 1 : 0;
    } catch (error) {
        say(names.at(-1), `with ${names[0]}: ${error.message}`);
    }
}
if (made === 0 && refused === 0) {
    console.log('none: no pipeline was made');
}
process.exit(gpu ? 0 : 1);
