// SPDX-License-Identifier: Apache-2.0
// Lights of three.js as Gnomon's, and their shadow: a light reads its channel of the mask at the fragment's pixel.
import {LightType, type Given, type Light as PlannedLight, type LightPlan} from 'gnomon-shadows';
import {ivec2, dot, mix, screenUV, texture, uniform, vec4} from 'three/tsl';
import {ExternalTexture, NearestFilter, Vector2, Vector3, Vector4, type Camera, type DirectionalLight, type Light, type Node, type Object3D,
        type PointLight, type SpotLight} from 'three/webgpu';

const SUN_DEGREES = 0.53;
/** The planner's options of directional lights, and those of spot and point lights. */
export const SUNS = 0;
export const LAMPS = 1;

/** Members that three.js' lights lack: `light.userData.gnomon`. */
export interface LightSettings {
    /** Directional: how wide it is in the sky, degrees; default: the sun's 0.53. */
    angularDiameter?: number;
    /** Spot, point: radius of the sphere that shines, metres; default: 0, which makes hard shadows. */
    radius?: number;
}
type ShadowedLight = (DirectionalLight | SpotLight | PointLight) & {castShadow: boolean};

function isShadowed(object: Object3D): object is ShadowedLight {
    return 'isDirectionalLight' in object || 'isSpotLight' in object || 'isPointLight' in object;
}

/** The mask, as materials read it. */
export class MaskTexture {
    /** Its texture is replaced when the mask is another one. */
    readonly node: ReturnType<typeof texture>;
    readonly size = uniform(new Vector2(1, 1));
    /** 0 where the camera of a picture is not the one that the mask is for: everything is lit. */
    readonly counts = uniform(0);
    private current: GPUTexture | null = null;

    constructor(device: GPUDevice) {
        const white = device.createTexture({label: 'gnomon: everything is lit', size: [1, 1, 1], format: 'rgba8unorm',
                                            usage: GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST});
        device.queue.writeTexture({texture: white}, new Uint8Array(4).fill(255), {bytesPerRow: 4}, [1, 1]);
        this.node = texture(wrapped(white));
        this.current = white;
    }
    set(mask: GPUTexture): void {
        if (mask !== this.current) {
            this.current = mask;
            this.node.value = wrapped(mask);
            this.size.value.set(mask.width, mask.height);
        }
    }
}

function wrapped(mask: GPUTexture): ExternalTexture {
    const found = new ExternalTexture(mask as never);
    found.image = {width: mask.width, height: mask.height, depth: mask.depthOrArrayLayers} as never;
    found.isArrayTexture = true;
    found.minFilter = found.magFilter = NearestFilter;
    found.generateMipmaps = false;
    return found;
}

/** A light's channel of the mask. */
class LightMask {
    readonly layer = uniform(0, 'int');
    readonly channel = uniform(new Vector4(1, 0, 0, 0));
    readonly node: Node;

    constructor(mask: MaskTexture) {
        const place = ivec2(screenUV.mul(mask.size));
        const texel = vec4(mask.node.load(place).depth(this.layer) as unknown as Node<'vec4'>);
        this.node = vec4(mix(1, dot(texel, this.channel), mask.counts)) as unknown as Node;
    }
    show(plan: LightPlan): void {
        this.layer.value = plan.maskLayer;
        this.channel.value.set(0, 0, 0, 0).setComponent(plan.maskChannel, 1);
    }
}

export class SceneLights {
    /** The last update()'s, in the order of the frame's lights. */
    readonly given: Given<PlannedLight>[] = [];
    private readonly mask: MaskTexture;
    private readonly masks = new Map<ShadowedLight, LightMask>();
    private seen: ShadowedLight[] = [];
    private readonly from = new Vector3();
    private readonly to = new Vector3();

    constructor(mask: MaskTexture) {
        this.mask = mask;
    }

    update(scene: Object3D, camera: Camera): void {
        this.seen = [];
        this.given.length = 0;
        scene.traverseVisible(object => {
            if (isShadowed(object) && object.castShadow && object.layers.test(camera.layers)) {
                this.see(object);
            }
        });
        for (const light of this.masks.keys()) {
            if (!this.seen.includes(light)) {
                this.release(light);
            }
        }
    }
    /** Where the plan has put each light's visibility. */
    show(plans: readonly LightPlan[]): void {
        this.seen.forEach((light, i) => this.masks.get(light)!.show(plans[i]!));
    }
    /** Gives all lights their own shadows back. */
    dispose(): void {
        [...this.masks.keys()].forEach(light => this.release(light));
    }

    private see(light: ShadowedLight): void {
        if (!this.masks.has(light)) {
            const mask = new LightMask(this.mask);
            this.masks.set(light, mask);
            (light.shadow as {shadowNode?: Node}).shadowNode = mask.node;
        }
        this.seen.push(light);
        this.given.push(this.describe(light));
    }
    private release(light: ShadowedLight): void {
        this.masks.delete(light);
        delete (light.shadow as {shadowNode?: Node}).shadowNode;
    }

    private describe(light: ShadowedLight): Given<PlannedLight> {
        const settings = ((light as Light).userData['gnomon'] ?? {}) as LightSettings;
        this.from.setFromMatrixPosition(light.matrixWorld);
        const key = light.id;
        if ('isPointLight' in light) {
            return {key, type: LightType.point, options: LAMPS, positionWs: this.from.toArray(), rangeM: light.distance, radiusM: settings.radius ?? 0};
        }
        const aimed = light as DirectionalLight | SpotLight;
        this.to.setFromMatrixPosition(aimed.target.matrixWorld);
        const directionWs = this.to.sub(this.from).normalize().toArray();
        if ('isSpotLight' in light) {
            const spot = light as SpotLight;
            return {key, type: LightType.spot, options: LAMPS, positionWs: this.from.toArray(), directionWs, outerHalfAngleRad: spot.angle, rangeM: spot.distance,
                    radiusM: settings.radius ?? 0};
        }
        return {key, type: LightType.directional, directionWs, angularDiameterRad: (settings.angularDiameter ?? SUN_DEGREES) * Math.PI / 180};
    }
}
