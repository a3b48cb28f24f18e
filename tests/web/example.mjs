// SPDX-License-Identifier: Apache-2.0
// The example of docs/webgpu.md. A page of the host's draws depth before it and shades after it (example_page.mjs).
// docs/webgpu.md begin
import {CasterPipelines, flipY, loadGnomon, loadShaders, ShadowRenderer, wantedFeatures} from 'gnomon-shadows';

export async function openDevice() {
    const adapter = await navigator.gpu.requestAdapter();
    return adapter.requestDevice({requiredFeatures: wantedFeatures(adapter)});
}

export async function makeShadows(device, things) { // {bounds: {min, max}, meshes: CasterMesh[], transform: 3 rows of 4 numbers}
    const [gnomon, shaders] = [await loadGnomon(), await loadShaders()];
    const objects = gnomon.makeObjects();
    const names = things.map(thing => objects.add(thing.bounds));
    const planner = gnomon.makePlanner();
    planner.set('filter', 'pcf');
    planner.set('partition', 'cascades');
    const shadows = new ShadowRenderer(device, gnomon, planner, {shaders});
    const casters = new CasterPipelines(device, planner, shaders);

    return {
        move(index, bounds) { // in the order of `things`
            objects.move(names[index], bounds);
        },
        // `clipFromWorld`: WebGPU's, in columns, with depth 1 near and 0 far. `depth`: of the same camera.
        draw(encoder, {index, eye, clipFromWorld, depth, sun}) {
            const plan = planner.plan({
                index, objects, widthPx: depth.width, heightPx: depth.height,
                camera: {eyeWs: eye, clipFromWorld: flipY(clipFromWorld)},
                lights: [{directionWs: sun}], clampsDepth: shadows.clampsDepth,
            });
            shadows.prepare(plan, [depth.width, depth.height]);
            shadows.draw(encoder, plan, {depth}, pass => casters.draw(
                pass, object => things[object].meshes, object => things[object].transform));
            return shadows.mask; // visibility by pixel: red of layer 0 is the sun's
        },
    };
}
// docs/webgpu.md end
