// SPDX-License-Identifier: Apache-2.0
export * from './layouts.js';
export {GnomonError, type LoadOptions} from './wasm.js';
export {flipY, loadGnomon, Gnomon, ObjectSet, Planner, type Frame, type Given, type Plan} from './planner.js';
export {loadShaders, Shaders} from './shaders.js';
export {ShadowRenderer, wantedFeatures, type CasterPass, type DrawCasters, type MapReuse, type MaskInputs,
        type ShadowRendererOptions} from './renderer.js';
export {CasterPipelines, type CasterMesh} from './casters.js';
