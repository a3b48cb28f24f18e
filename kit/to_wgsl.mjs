// SPDX-License-Identifier: Apache-2.0
// usage: to_wgsl.mjs FILE... : each file names a SPIR-V module, and gets its translation by naga in its place.
import {readFileSync, writeFileSync} from 'node:fs';
import {parseSpirv, validate, writeWgsl} from 'naga-wasm';

for (const file of process.argv.slice(2)) {
    let text;
    try {
        const module = parseSpirv(readFileSync(readFileSync(file, 'utf8')));
        text = writeWgsl(module, validate(module));
    } catch (error) {
        console.error(`${file}: ${error.formatted ?? error}`);
        process.exit(1);
    }
    // WGSL asks for a proof that all invocations of a group read the same before a barrier. One that is known to be so is
    // said by this function, which waits for the others as the barriers around the read in the source do.
    text = text.replaceAll(/= atomicLoad\(\(?(&\w+)\)?\);(?=[^]*?workgroupBarrier)/g,
                           (whole, variable) => isShared(text, variable.slice(1)) ? `= workgroupUniformLoad(${variable});` : whole);
    writeFileSync(file, text);
}

function isShared(text, name) {
    return text.includes(`var<workgroup> ${name}: atomic<u32>;`);
}
