// SPDX-License-Identifier: Apache-2.0
// The planner: camera, lights and bounds in, a plan of shadow maps out. The rules are those of the C interface (docs/c.md).
import {INTERFACE, LAYOUTS, type Bounds, type Camera, type DeviceRates, type Light, type LightPlan, type ObjectFlags, type ObjectId, type Option,
        type PageRequests, type Pages, type Pass, type PlanHead, type Precision, type SeenCell, type View, type WorldLayer} from './layouts.js';
import {GnomonError, sizeOf, Wasm, type LoadOptions, type Pointer} from './wasm.js';

/** Members of a struct that a host gives; those it leaves out have their defaults. Questions take booleans, arrays any list of numbers. */
export type Given<T> = {[Name in keyof T as Exclude<Name, 'size'>]?: T[Name] extends number ? number | boolean : T[Name] extends bigint ? number | bigint
                                            : T[Name] extends number[] ? ArrayLike<number> : T[Name]};

/** All that planning asks of a host. */
export interface Frame {
    /** Counted by the host. */
    index?: number | bigint;
    /** The picture does not continue the last one. */
    cut?: boolean;
    /** On any clock that does not run back. */
    timeS?: number;
    /** The camera. `clipFromWorld` is in columns; y is -1 in row 0 of the picture, so negate the row of y of a matrix of WebGPU (`flipY()`). */
    camera: Given<Camera>;
    /** The picture's size, at least 1. */
    widthPx: number;
    heightPx: number;
    objects: ObjectSet;
    lights: Given<Light>[];
    /** Partition virtual: at most one for each light. */
    requests?: (Given<Omit<PageRequests, 'cellCount'>> & {cells: Given<SeenCell>[]})[];
    /** From low to high, for options with layers.placement=world. */
    layers?: WorldLayer[];
    /** The host clamps casters onto near planes: `ShadowRenderer.clampsDepth`. Default: true. */
    clampsDepth?: boolean;
    /** Measured time of drawing a texel of a map; 0: not known. */
    drawMsPerTexel?: number;
    rates?: Given<DeviceRates>;
}

/** The drawing that one frame needs: a copy, which holds as long as the host keeps it. */
export interface Plan extends PlanHead {
    /** As in the frame. */
    lights: LightPlan[];
    /** Light after light. */
    views: View[];
    /** The pages of each of the planner's options. */
    pages: Pages[];
    /** In their order. */
    passes: Pass[];
    /** Object indices, view after view; with filter volumes light after light. */
    casters: Uint32Array;
    /** Object indices that the camera sees, ascending. */
    receivers: Uint32Array;
    /** Filters of ids: one for each object, light after light. */
    objectIds: Uint16Array;
    /** soften=converge: around all that came, went or changed since the plan before. */
    moved: Bounds[];
    /** The picture's size. */
    sizePx: [number, number];
    /** The frame's camera has depth 1 near and 0 far. */
    reversedZ: boolean;
}

/** The same matrix with its row of y negated: from WebGPU's clip space to Gnomon's. `m`: 16 numbers in columns. */
export function flipY(m: ArrayLike<number>): number[] {
    return Array.from(m, (one, i) => i % 4 === 1 ? -one : one);
}

/** The bounds of everything that casts or receives. `free()` gives its memory back. */
export class ObjectSet {
    /** @internal */
    at: Pointer;
    private readonly wasm: Wasm;
    /** @internal */
    constructor(wasm: Wasm) {
        this.wasm = wasm;
        this.at = wasm.pointer('gnomonMakeObjects', INTERFACE);
    }
    /** Adds an object and returns its name. */
    add(bounds: Given<Bounds>, flags: Given<ObjectFlags> = {}): ObjectId {
        const {wasm} = this;
        return this.withBounds([bounds], at => this.withFlags(flags, set => wasm.with(sizeOf('ObjectId'), id => {
            wasm.done('gnomonAddObject', living(this.at), at, set, id);
            return wasm.read<ObjectId>('ObjectId', id);
        })));
    }
    /** Moves an object to other bounds. */
    move(id: ObjectId, bounds: Given<Bounds>): void {
        this.moveAll([id], [bounds]);
    }
    /** Moves objects; refused before any moves where one is not in the set. */
    moveAll(ids: ObjectId[], bounds: Given<Bounds>[]): void {
        const {wasm} = this;
        if (ids.length !== bounds.length) {
            throw new GnomonError('move objects', `${ids.length} names and ${bounds.length} boxes are given`);
        }
        const step = sizeOf('ObjectId');
        this.withBounds(bounds, at => wasm.with(step * ids.length, names => {
            ids.forEach((id, i) => wasm.write('ObjectId', names + i * step, id));
            wasm.done('gnomonMoveObjects', living(this.at), names, at, ids.length);
        }));
    }
    /** Says that an object's shape changed inside its bounds. */
    touch(id: ObjectId): void {
        this.withId(id, at => this.wasm.done('gnomonTouchObject', living(this.at), at));
    }
    /** Says that an object takes part otherwise from now on. */
    setFlags(id: ObjectId, flags: Given<ObjectFlags>): void {
        this.withId(id, at => this.withFlags(flags, set => this.wasm.done('gnomonSetObjectFlags', living(this.at), at, set)));
    }
    /** Removes an object. Its index is used again, its name is not. */
    remove(id: ObjectId): void {
        this.withId(id, at => this.wasm.done('gnomonRemoveObject', living(this.at), at));
    }
    free(): void {
        this.wasm.call('gnomonFreeObjects', this.at);
        this.at = 0;
    }

    private withBounds<T>(bounds: Given<Bounds>[], use: (at: Pointer) => T): T {
        const step = sizeOf('Bounds');
        return this.wasm.with(step * bounds.length, at => {
            bounds.forEach((box, i) => this.wasm.write('Bounds', at + i * step, box));
            return use(at);
        });
    }
    private withFlags<T>(flags: Given<ObjectFlags>, use: (at: Pointer) => T): T {
        return this.wasm.with(sizeOf('ObjectFlags'), at => {
            this.wasm.init('gnomonInitObjectFlags', 'ObjectFlags', at);
            this.wasm.write('ObjectFlags', at, flags);
            return use(at);
        });
    }
    // The C functions take names by value; WebAssembly's C passes a struct by its address.
    private withId<T>(id: ObjectId, use: (at: Pointer) => T): T {
        return this.wasm.with(sizeOf('ObjectId'), at => {
            this.wasm.write('ObjectId', at, id);
            return use(at);
        });
    }
}

/** Keeps maps and their contents from frame to frame. `free()` gives its memory back. */
export class Planner {
    /** @internal */
    at: Pointer;
    /** @internal */
    readonly wasm: Wasm;
    /** The last plan; null: there is none. */
    last: Plan | null = null;
    /** @internal */
    constructor(wasm: Wasm) {
        this.wasm = wasm;
        this.at = wasm.pointer('gnomonMakePlanner', INTERFACE);
    }
    /** Sets an option, as `gnomon --set KEY=VALUE` does. `options`: of those there are, or one past the last, which adds further ones. */
    set(key: string, value: string | number, options = 0): void {
        const {wasm} = this;
        wasm.withText(key, at => wasm.withText(String(value), text => wasm.done('gnomonSetOption', living(this.at), options, at, text)));
    }
    /** The value of an option, as `set()` takes it. */
    get(key: string, options = 0): string {
        return this.wasm.withText(key, at => this.wasm.text(this.wasm.pointer('gnomonGetOption', living(this.at), options, at)));
    }
    /** Throws GnomonError with the reason where a light of this type (`LightType`) cannot have these options. */
    check(lightType: number, options = 0): void {
        this.wasm.done('gnomonCheckOptions', living(this.at), options, lightType);
    }
    /** A map's texels are gone: it is drawn whole when it is read next. */
    loseMap(view: Pick<View, 'mapIndex' | 'mapGeneration'>): void {
        this.wasm.done('gnomonLoseMap', living(this.at), view.mapIndex, view.mapGeneration);
    }
    /** All maps are lost. */
    loseAllMaps(): void {
        this.wasm.done('gnomonLoseAllMaps', living(this.at));
    }
    /** Plans a frame. Any numbers are taken: a light's outcome says why it cannot be planned. */
    plan(frame: Frame): Plan {
        const {wasm} = this;
        for (const needed of ['camera', 'objects', 'lights'] as const) {
            if (!frame[needed]) {
                throw new GnomonError('plan a frame', `it has no ${needed}`, 'give the camera, the set of objects and the list of lights');
            }
        }
        this.last = null;
        const at = wasm.with(frameBytes(frame), room => wasm.pointer('gnomonPlan', living(this.at), writeFrame(wasm, room, frame)));
        this.last = this.read(at, frame);
        return this.last;
    }
    private read(at: Pointer, {widthPx, heightPx, camera}: Frame): Plan {
        const {wasm} = this;
        const head = wasm.read<PlanHead & Record<'casters' | 'receivers' | 'objectIds' | 'moved', Pointer>>('PlanHead', at);
        const all = <T>(name: string, struct: string, count: number): T[] => Array.from(
            {length: count}, (_, i) => wasm.read<T>(struct, wasm.pointer(name, this.at, i)));
        return {
            ...head, sizePx: [widthPx, heightPx], reversedZ: Boolean(camera.reversedZ ?? true),
            casters: wasm.words(head.casters, head.casterCount),
            receivers: wasm.words(head.receivers, head.receiverCount),
            objectIds: Uint16Array.from({length: head.objectIdCount}, (_, i) => wasm.data.getUint16(head.objectIds + 2 * i, true)),
            moved: Array.from({length: head.movedCount}, (_, i) => wasm.read<Bounds>('Bounds', head.moved + i * sizeOf('Bounds'))),
            lights: all<LightPlan>('gnomonLightAt', 'LightPlan', head.lightCount),
            views: all<View>('gnomonViewAt', 'View', head.viewCount),
            pages: all<Pages>('gnomonPagesAt', 'Pages', head.optionsCount),
            passes: all<Pass>('gnomonPassAt', 'Pass', head.passCount),
        };
    }
    /** All of the last plan as JSON text. */
    json(): string {
        return this.wasm.text(this.wasm.pointer('gnomonPlanJson', living(this.at)));
    }
    /** The bytes of a buffer (`BufferKind`) of the last plan, for shaders of the host's own. */
    fillBuffer(kind: number, options = 0, precision: Given<Precision> = {}): Uint8Array<ArrayBuffer> {
        const {wasm} = this;
        return wasm.with(4 + sizeOf('Precision'), room => {
            wasm.done('gnomonBufferBytes', living(this.at), kind, room);
            const bytes = wasm.data.getUint32(room, true);
            wasm.init('gnomonInitPrecision', 'Precision', room + 4);
            wasm.write('Precision', room + 4, precision);
            return wasm.with(bytes, out => {
                wasm.done('gnomonFillBuffer', this.at, kind, options, room + 4, out, bytes);
                return wasm.bytes(out, bytes).slice();
            });
        });
    }
    /**
     * Rows that take casters' own points to a view of the last plan, in double precision: `View.casterRows` rows of four floats for each
     * object. `worldFromObject`: three rows of four floats for each object. `biasM`: metres that depth is moved away from the light.
     */
    writeCasterRows(view: number, worldFromObject: Float32Array, biasM = 0): Float32Array<ArrayBuffer> {
        const {wasm} = this;
        const objects = Math.floor(worldFromObject.length / 12);
        if (objects * 12 !== worldFromObject.length) {
            throw new GnomonError('write rows of casters', `worldFromObject has ${worldFromObject.length} floats`, 'give 12 for each object');
        }
        const rows = wasm.data.getUint32(wasm.pointer('gnomonViewAt', living(this.at), view) + CASTER_ROWS, true);
        const floats = objects * rows * 4;
        return wasm.with(4 * worldFromObject.length, given => {
            wasm.bytes(given, 4 * worldFromObject.length).set(new Uint8Array(worldFromObject.buffer, worldFromObject.byteOffset,
                                                                             worldFromObject.byteLength));
            return wasm.with(4 * floats, out => {
                wasm.done('gnomonWriteCasterRows', this.at, view, given, objects, biasM, out, floats);
                return new Float32Array(wasm.bytes(out, 4 * floats).slice().buffer);
            });
        });
    }
    free(): void {
        this.wasm.call('gnomonFreePlanner', this.at);
        this.at = 0;
    }
}

const CASTER_ROWS = LAYOUTS['View']!.members.find(([name]) => name === 'casterRows')![2];

/** The library, once it is loaded. */
export class Gnomon {
    /** @internal */
    readonly wasm: Wasm;
    /** The library's version, such as "0.1.0". */
    readonly version: string;
    /** @internal */
    constructor(wasm: Wasm) {
        this.wasm = wasm;
        this.version = wasm.text(wasm.call('gnomonVersion'));
    }
    /** An empty set of objects. */
    makeObjects(): ObjectSet {
        return new ObjectSet(this.wasm);
    }
    /** A planner whose options 0 are the defaults. */
    makePlanner(): Planner {
        return new Planner(this.wasm);
    }
    /** All options, in the order of `gnomon list`. */
    options(): Option[] {
        return Array.from({length: this.wasm.call('gnomonOptionCount')},
                          (_, i) => this.wasm.read<Option>('Option', this.wasm.pointer('gnomonOptionAt', i)));
    }
}

/** Loads the WebAssembly module, from the file beside this one. */
export async function loadGnomon(options: LoadOptions = {}): Promise<Gnomon> {
    return new Gnomon(await Wasm.start(options));
}

function living(at: Pointer): Pointer {
    if (at === 0) {
        throw new GnomonError('call a function', 'its object has been freed', 'make a new one');
    }
    return at;
}

// A frame's structs lie one after the other in memory.
function frameBytes({lights, requests = [], layers = []}: Frame): number {
    const cells = requests.reduce((sum, one) => sum + one.cells.length, 0);
    return sizeOf('FrameHead') + sizeOf('Light') * lights.length + sizeOf('PageRequests') * requests.length +
        sizeOf('WorldLayer') * layers.length + sizeOf('SeenCell') * cells;
}

function writeFrame(wasm: Wasm, at: Pointer, frame: Frame): Pointer {
    const {objects, lights, requests = [], layers = [], ...rest} = frame;
    let next = at;
    const write = <T extends object>(struct: string, list: T[], fill: (one: T, place: Pointer) => object): Pointer => {
        const first = next;
        next += sizeOf(struct) * list.length;
        list.forEach((one, i) => {
            const place = first + i * sizeOf(struct);
            wasm.write(struct, place, fill(one, place));
        });
        return first;
    };
    const same = <T>(one: T): T => one;
    write('FrameHead', [rest], (given, place) => {
        wasm.init('gnomonInitFrame', 'FrameHead', place);
        return given;
    });
    wasm.write('FrameHead', at, {
        objects: living(objects.at), lightCount: lights.length, requestCount: requests.length, layerCount: layers.length,
        lights: write('Light', lights, (light, place) => {
            wasm.init('gnomonInitLight', 'Light', place);
            return light;
        }),
        requests: write('PageRequests', requests, ({cells, ...request}, place) => {
            wasm.init('gnomonInitPageRequests', 'PageRequests', place);
            return {...request, cellCount: cells.length};
        }),
        layers: write('WorldLayer', layers, same),
    });
    const first = wasm.data.getUint32(at + LAYOUTS['FrameHead']!.members.find(([name]) => name === 'requests')![2], true);
    requests.forEach(({cells}, i) => wasm.write('PageRequests', first + i * sizeOf('PageRequests'), {cells: write('SeenCell', cells, same)}));
    return at;
}
