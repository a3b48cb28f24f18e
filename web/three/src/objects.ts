// SPDX-License-Identifier: Apache-2.0
// Keeps Gnomon's set of objects as a scene graph is: who came, went, moved or changed since the last frame.
import type {CasterMesh, ObjectId, ObjectSet} from 'gnomon-shadows';
import {Box3, Matrix4, Mesh, type InstancedMesh, type Object3D, type SkinnedMesh} from 'three/webgpu';
import {Geometries, versionOf} from './geometries.js';

const STILL_FRAMES = 120; // a mesh that stood still for so long is expected to go on so

/** A mesh of the scene, or an instance of one. */
interface Tracked {
    id: ObjectId;
    mesh: Mesh;
    world: Float64Array; // its matrix when its bounds were found
    shape: string;       // what its triangles come from
    flags: string;
    frame: number;       // when it was seen last
    moved: number;       // when it moved last
    dynamic: boolean;
    bounds: Box3;
}

/** Why a mesh casts no shadow, though it should; empty: it does. */
export function refusal(mesh: Mesh): string {
    if ((mesh as SkinnedMesh).isSkinnedMesh) {
        return 'skinned meshes receive shadows and cast none';
    }
    if (mesh.geometry.morphAttributes['position'] && (mesh.morphTargetInfluences?.length ?? 0) > 0) {
        return 'meshes with morph targets receive shadows and cast none';
    }
    if ('isBatchedMesh' in mesh) {
        return 'a BatchedMesh receives shadows and casts none';
    }
    const materials = [mesh.material].flat() as {positionNode?: unknown, displacementMap?: unknown}[];
    return materials.some(one => one?.positionNode || one?.displacementMap)
        ? 'meshes whose material moves vertices (positionNode, displacementMap) receive shadows and cast none' : '';
}

export class SceneObjects {
    private readonly set: ObjectSet;
    private readonly geometries: Geometries;
    private readonly note: (text: string) => void;
    private readonly tracked = new Map<Mesh, Tracked[]>();
    private readonly byIndex: Tracked[] = [];
    private frame = 0;
    private readonly matrix = new Matrix4();
    private readonly box = new Box3();
    private readonly meshes = new Map<Mesh, CasterMesh[]>(); // of this frame

    constructor(set: ObjectSet, geometries: Geometries, note: (text: string) => void) {
        this.set = set;
        this.geometries = geometries;
        this.note = note;
    }

    /** After world matrices are up to date. */
    update(scene: Object3D): void {
        ++this.frame;
        this.meshes.clear();
        scene.traverseVisible(object => {
            const mesh = object as Mesh;
            if (mesh.castShadow && ('isLine' in object || 'isPoints' in object || 'isSprite' in object)) {
                this.note('lines, points and sprites cast no shadow');
            }
            if (mesh.isMesh && (mesh.castShadow || mesh.receiveShadow) && mesh.geometry.getAttribute('position')) {
                this.see(mesh);
            }
        });
        for (const [mesh, all] of this.tracked) {
            const kept = all.filter(one => one.frame === this.frame);
            all.filter(one => one.frame !== this.frame).forEach(one => this.remove(one));
            if (kept.length === 0) {
                this.tracked.delete(mesh);
            } else if (kept.length < all.length) {
                this.tracked.set(mesh, kept);
            }
        }
    }

    /** The triangles of an object of a plan. */
    meshesOf(index: number): CasterMesh[] {
        const mesh = this.byIndex[index]!.mesh;
        let found = this.meshes.get(mesh);
        if (!found) {
            found = this.geometries.meshesOf(mesh);
            this.meshes.set(mesh, found);
        }
        return found;
    }
    /** Its transform: three rows of four numbers. */
    transformOf(index: number): number[] {
        const m = this.byIndex[index]!.world;
        return [0, 1, 2].flatMap(row => [m[row]!, m[4 + row]!, m[8 + row]!, m[12 + row]!]);
    }

    private see(mesh: Mesh): void {
        const why = mesh.castShadow ? refusal(mesh) : '';
        if (why) {
            this.note(`${mesh.name || mesh.type}: ${why}`);
        }
        const instances = (mesh as InstancedMesh).isInstancedMesh ? mesh as InstancedMesh : null;
        const count = instances ? instances.count : 1;
        const all = this.tracked.get(mesh) ?? [];
        this.tracked.set(mesh, all);
        for (let i = 0; i < count; ++i) {
            this.matrix.copy(mesh.matrixWorld);
            if (instances) {
                instances.getMatrixAt(i, this.matrix);
                this.matrix.premultiply(mesh.matrixWorld);
            }
            all[i] = this.seeOne(mesh, all[i], mesh.castShadow && !why);
        }
    }

    private seeOne(mesh: Mesh, known: Tracked | undefined, casts: boolean): Tracked {
        const {geometry} = mesh;
        const index = geometry.getIndex();
        const shape = [geometry.id, versionOf(geometry.getAttribute('position')), index ? index.version : -1, geometry.drawRange.start,
                       geometry.drawRange.count, ...[mesh.material].flat().map(one => `${one.id} ${one.alphaTest} ${one.visible}`)].join();
        const one = known ?? this.add(mesh);
        const moved = this.matrix.elements.some((number, i) => number !== one.world[i]);
        if (moved || shape !== one.shape || (mesh as SkinnedMesh).isSkinnedMesh) {
            this.place(one, shape !== one.shape);
            one.moved = known ? this.frame : one.moved;
            one.shape = shape;
        }
        one.dynamic = one.moved > 0 && this.frame - one.moved < STILL_FRAMES;
        const flags = `${casts} ${mesh.receiveShadow} ${one.dynamic}`;
        if (flags !== one.flags) {
            one.flags = flags;
            this.set.setFlags(one.id, {casts, receives: mesh.receiveShadow, dynamic: one.dynamic});
        }
        one.frame = this.frame;
        return one;
    }

    private add(mesh: Mesh): Tracked {
        const id = this.set.add({min: [0, 0, 0], max: [0, 0, 0]});
        const one: Tracked = {id, mesh, world: new Float64Array(16), shape: '', flags: '', frame: 0, moved: 0, dynamic: false, bounds: new Box3()};
        this.byIndex[id.index] = one;
        return one;
    }
    private remove(one: Tracked): void {
        this.set.remove(one.id);
        delete this.byIndex[one.id.index];
    }

    private place(one: Tracked, reshaped: boolean): void {
        const {geometry} = one.mesh;
        const skinned = (one.mesh as SkinnedMesh).isSkinnedMesh ? one.mesh as SkinnedMesh : null;
        if (skinned) {
            skinned.computeBoundingBox();
        } else if (!geometry.boundingBox || reshaped) {
            geometry.computeBoundingBox();
        }
        this.box.copy((skinned ? skinned.boundingBox : geometry.boundingBox)!).applyMatrix4(this.matrix);
        one.world.set(this.matrix.elements);
        const stays = reshaped && this.box.equals(one.bounds);
        one.bounds.copy(this.box);
        if (stays) {
            this.set.touch(one.id);
        } else {
            this.set.move(one.id, {min: this.box.min.toArray(), max: this.box.max.toArray()});
        }
    }
}
