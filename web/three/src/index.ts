// SPDX-License-Identifier: Apache-2.0
// Gnomon's soft shadows in place of three.js' own (docs/three.md).
import {CasterPipelines, flipY, loadGnomon, loadShaders, ShadowRenderer, type Gnomon, type ObjectSet, type Plan, type Planner} from 'gnomon-shadows';
import {Matrix4, Vector2, Vector3, type Camera, type Scene, type WebGPURenderer} from 'three/webgpu';
import {backendOf} from './backend.js';
import {Geometries} from './geometries.js';
import {LAMPS, MaskTexture, SceneLights, SUNS} from './lights.js';
import {SceneObjects} from './objects.js';
import {Prepass} from './prepass.js';

export type {LightSettings} from './lights.js';

/** How shadows are made. */
export interface GnomonShadowsOptions {
    /** Values with "+" between them, such as "pcf+cascades" or "raymarch+map-size=1024"; default: "auto". Lamps leave out partition and fit. */
    technique?: string;
    /** Further options by their names, as `gnomon --set` has them. */
    options?: Record<string, string | number>;
    /** Hears once of each thing that is left out; default: console.warn. */
    onNotice?: (text: string) => void;
}

const CHOICES = ['partition', 'fit', 'filter', 'soften', 'motion'];

/**
 * Replaces the shadows of every directional, spot and point light of a scene whose `castShadow` is set, for one camera.
 *
 * `await init()` once, then call `update()` in each frame before `renderer.render(scene, camera)`. Pictures by other cameras, and
 * transparent surfaces in them, are lit.
 */
export class GnomonShadows {
    /** The last frame's plan: what became of each light, and what was drawn. */
    plan: Plan | null = null;
    /** The things that are left out, each once. */
    readonly notices = new Set<string>();

    private readonly renderer: WebGPURenderer;
    private readonly scene: Scene;
    private readonly camera: Camera;
    private readonly asked: GnomonShadowsOptions;
    private parts: Parts | null = null;
    private hooked: Scene['onBeforeRender'] | null = null; // the scene's own
    private readonly size = new Vector2();
    private readonly matrix = new Matrix4();
    private readonly eye = new Vector3();

    constructor(renderer: WebGPURenderer, scene: Scene, camera: Camera, options: GnomonShadowsOptions = {}) {
        this.renderer = renderer;
        this.scene = scene;
        this.camera = camera;
        this.asked = options;
    }

    /** Loads the library. Throws an Error where the renderer does not draw by WebGPU, and for options that there are not. */
    async init(): Promise<this> {
        await this.renderer.init();
        const {device} = backendOf(this.renderer);
        const [gnomon, shaders] = await Promise.all([loadGnomon(), loadShaders()]);
        const planner = gnomon.makePlanner();
        this.setOptions(planner, gnomon);
        const set = gnomon.makeObjects();
        const mask = new MaskTexture(device);
        const geometries = new Geometries(this.renderer, this.note);
        this.parts = {device, planner, set, mask, shadows: new ShadowRenderer(device, gnomon, planner, {shaders}),
                      casters: new CasterPipelines(device, planner, shaders), objects: new SceneObjects(set, geometries, this.note),
                      lights: new SceneLights(mask), prepass: new Prepass(this.renderer)};
        this.renderer.shadowMap.enabled = true;
        const {onBeforeRender} = this.scene;
        this.hooked = onBeforeRender;
        this.scene.onBeforeRender = (...args) => {
            onBeforeRender.apply(this.scene, args);
            mask.counts.value = args[2] === this.camera ? 1 : 0;
        };
        return this;
    }

    /** Draws this frame's maps and mask. */
    update(): void {
        if (!this.parts) {
            throw new Error('cannot update Gnomon\'s shadows: they are not ready; await init() first');
        }
        const {device, planner, shadows, casters, objects, lights, prepass, mask, set} = this.parts;
        const {renderer, scene, camera} = this;
        scene.updateMatrixWorld();
        if (camera.parent === null) {
            camera.updateMatrixWorld();
        }
        renderer.getDrawingBufferSize(this.size);
        const [width, height] = [Math.max(this.size.x, 1), Math.max(this.size.y, 1)];
        lights.update(scene, camera);
        prepass.render(scene, camera, width, height);
        objects.update(scene);
        this.matrix.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
        this.eye.setFromMatrixPosition(camera.matrixWorld);
        const plan = planner.plan({camera: {eyeWs: this.eye.toArray(), clipFromWorld: flipY(this.matrix.elements),
                                            reversedZ: renderer.reversedDepthBuffer === true}, widthPx: width, heightPx: height, objects: set,
                                   lights: lights.given, clampsDepth: shadows.clampsDepth, timeS: performance.now() / 1000});
        shadows.prepare(plan, [width, height]);
        const encoder = device.createCommandEncoder({label: 'gnomon'});
        shadows.draw(encoder, plan, {depth: prepass.depth, normal: prepass.normal},
                     pass => casters.draw(pass, object => objects.meshesOf(object), object => objects.transformOf(object)));
        device.queue.submit([encoder.finish()]);
        mask.set(shadows.mask);
        lights.show(plan.lights);
        this.plan = plan;
    }

    /** Visibility by pixel, 1 lit: a 2D array; `plan.lights` has each light's layer and channel. Holds until the next update(). */
    get mask(): GPUTexture {
        return this.parts!.shadows.mask;
    }

    /** All maps are drawn again by the next update(): for shapes that changed without a new version of their attributes. */
    redraw(): void {
        this.parts?.planner.loseAllMaps();
    }

    /** Gives the lights their own shadows, and all memory back. */
    dispose(): void {
        const parts = this.parts;
        this.parts = null;
        if (this.hooked) {
            this.scene.onBeforeRender = this.hooked;
            this.hooked = null;
        }
        parts?.lights.dispose();
        parts?.prepass.dispose();
        parts?.shadows.destroy();
        parts?.planner.free();
        parts?.set.free();
    }

    private readonly note = (text: string): void => {
        if (!this.notices.has(text)) {
            this.notices.add(text);
            (this.asked.onNotice ?? (said => console.warn(`gnomon: ${said}`)))(text);
        }
    };

    /** Options 0 are those of suns, options 1 those of lamps, whose partition and fit go by their own shape. */
    private setOptions(planner: Planner, gnomon: Gnomon): void {
        const all = gnomon.options();
        const set = (key: string, value: string | number): void => {
            planner.set(key, value, SUNS);
            planner.set(key, key === 'partition' || key === 'fit' ? '' : value, LAMPS);
        };
        for (const word of (this.asked.technique ?? 'auto').split('+').filter(one => one !== 'auto')) {
            const [key, value] = word.split('=');
            const choice = value === undefined ? all.find(one => CHOICES.includes(one.key) && one.choices.split(' ').includes(word)) : undefined;
            if (value === undefined && !choice) {
                throw new Error(`cannot set the technique ${this.asked.technique}: there is no value ${word}`);
            }
            set(choice?.key ?? key!, value ?? word);
        }
        Object.entries(this.asked.options ?? {}).forEach(([key, value]) => set(key, value));
        if (/^(msm|lvsm)$/.test(planner.get('filter', SUNS)) && planner.get('map-format', SUNS) === '') {
            set('map-format', 'rgba32f'); // their own, rgba16, is one that shaders of WebGPU do not store to
        }
        planner.set('map-size', planner.get('map-size', SUNS), LAMPS); // there are options of lamps even where nothing is asked
    }
}

interface Parts {
    device: GPUDevice;
    planner: Planner;
    set: ObjectSet;
    mask: MaskTexture;
    shadows: ShadowRenderer;
    casters: CasterPipelines;
    objects: SceneObjects;
    lights: SceneLights;
    prepass: Prepass;
}
