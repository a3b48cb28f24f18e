// SPDX-License-Identifier: Apache-2.0
// usage: check_wgsl.mjs FILE... : prints a line for each file that Dawn refuses, "FILE: LINE: MESSAGE".
import {readFileSync} from 'node:fs';
import {create, globals} from 'webgpu';

Object.assign(globalThis, globals);
const adapter = await create(['backend=null']).requestAdapter();
const device = await adapter.requestDevice({requiredFeatures: ['clip-distances']});
for (const file of process.argv.slice(2)) {
    const module = device.createShaderModule({code: readFileSync(file, 'utf8')});
    const {messages} = await module.getCompilationInfo();
    const wrong = messages.find(one => one.type === 'error');
    if (wrong) {
        console.log(`${file}: ${wrong.lineNum}: ${wrong.message.split('\n')[0]}`);
    }
}
process.exit(0);
