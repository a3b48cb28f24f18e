// SPDX-License-Identifier: Apache-2.0
// The camera's depth and the geometric normals of what it sees, drawn by three.js itself: whatever its materials do to vertices and
// holes holds here, too. Transparent surfaces are left out.
import {abs, cameraWorldMatrix, float, normalize, positionView, select, vec2, vec4} from 'three/tsl';
import {Color, DepthTexture, FloatType, HalfFloatType, MeshBasicNodeMaterial, NearestFilter, RenderTarget, RGFormat, type Camera, type Material,
        type Node, type Object3D, type Scene, type Texture, type WebGPURenderer} from 'three/webgpu';
import {textureOf} from './backend.js';

type Source = Material & {map?: Texture | null, alphaMap?: Texture | null, positionNode?: Node | null, displacementMap?: Texture | null,
                          displacementScale?: number, displacementBias?: number, transmission?: number};

/** octahedralEncode() of gnomon/shared/octahedral.h. */
function octahedral(n: Node<'vec3'>): Node<'vec2'> {
    const sign = (v: Node<'float'>): Node<'float'> => select(v.greaterThanEqual(0), float(1), float(-1));
    const p = n.xy.div(abs(n.x).add(abs(n.y)).add(abs(n.z)));
    const folded = vec2(abs(p.y).oneMinus().mul(sign(p.x)), abs(p.x).oneMinus().mul(sign(p.y)));
    return select(n.z.lessThan(0), folded, p);
}

/** The triangle's normal, facing the camera: from how the surface's place changes from pixel to pixel. */
function geometricNormal(): Node<'vec3'> {
    const inView = normalize(positionView.dFdx().cross(positionView.dFdy()));
    return normalize(cameraWorldMatrix.mul(vec4(inView, 0)).xyz);
}

export class Prepass {
    private readonly renderer: WebGPURenderer;
    private readonly target: RenderTarget;
    private readonly output = vec4(octahedral(geometricNormal()), 0, 1);
    private readonly materials = new WeakMap<Material, MeshBasicNodeMaterial>();
    private readonly colour = new Color();

    constructor(renderer: WebGPURenderer) {
        this.renderer = renderer;
        const depth = new DepthTexture(1, 1, FloatType);
        this.target = new RenderTarget(1, 1, {depthTexture: depth, format: RGFormat, type: HalfFloatType, minFilter: NearestFilter,
                                              magFilter: NearestFilter, generateMipmaps: false});
        this.target.texture.name = 'gnomon normals';
    }

    /** Draws what this camera sees of the scene. */
    render(scene: Scene, camera: Camera, width: number, height: number): void {
        const {renderer, target} = this;
        if (target.width !== width || target.height !== height) {
            target.setSize(width, height);
        }
        const kept = {target: renderer.getRenderTarget(), face: renderer.getActiveCubeFace(), level: renderer.getActiveMipmapLevel(),
                      alpha: renderer.getClearAlpha(), draw: renderer.getRenderObjectFunction(), mrt: renderer.getMRT(), clear: renderer.autoClear,
                      background: scene.background, node: scene.backgroundNode};
        renderer.getClearColor(this.colour as never);
        try {
            scene.background = null;
            (scene as {backgroundNode: unknown}).backgroundNode = null;
            renderer.autoClear = true;
            renderer.setClearColor(0x000000, 0);
            renderer.setMRT(null);
            renderer.setRenderTarget(target);
            renderer.setRenderObjectFunction(this.draw as never);
            renderer.render(scene, camera);
        } finally {
            renderer.setRenderObjectFunction(kept.draw as never);
            renderer.setRenderTarget(kept.target, kept.face, kept.level);
            renderer.setMRT(kept.mrt);
            renderer.setClearColor(this.colour, kept.alpha);
            renderer.autoClear = kept.clear;
            scene.background = kept.background;
            (scene as {backgroundNode: unknown}).backgroundNode = kept.node;
        }
    }

    /** The camera's depth, 32-bit floats. */
    get depth(): GPUTexture {
        return textureOf(this.renderer, this.target.depthTexture!)!;
    }
    /** World-space normals, octahedral, 16-bit floats. */
    get normal(): GPUTexture {
        return textureOf(this.renderer, this.target.texture)!;
    }
    dispose(): void {
        this.target.depthTexture?.dispose();
        this.target.dispose();
    }

    private readonly draw = (object: Object3D, scene: Scene, camera: Camera, geometry: unknown, material: Source, ...rest: unknown[]): void => {
        if (material.transparent || (material.transmission ?? 0) > 0 || !('isMesh' in object)) {
            return;
        }
        (this.renderer.renderObject as (...args: unknown[]) => void)(object, scene, camera, geometry, this.materialOf(material), ...rest);
    };

    private materialOf(source: Source): MeshBasicNodeMaterial {
        let found = this.materials.get(source);
        if (!found) {
            found = new MeshBasicNodeMaterial();
            found.lights = false;
            found.fog = false;
            found.outputNode = this.output as never;
            this.materials.set(source, found);
            source.addEventListener('dispose', () => found!.dispose());
        }
        const holed = source.alphaTest > 0;
        found.side = source.side;
        found.alphaTest = source.alphaTest;
        found.map = holed ? source.map ?? null : null;
        found.alphaMap = holed ? source.alphaMap ?? null : null;
        found.positionNode = (source.positionNode ?? null) as never;
        Object.assign(found, {displacementMap: source.displacementMap ?? null, displacementScale: source.displacementScale ?? 1,
                              displacementBias: source.displacementBias ?? 0});
        return found;
    }
}
