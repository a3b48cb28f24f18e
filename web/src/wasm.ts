// SPDX-License-Identifier: Apache-2.0
// The WebAssembly module and its memory: structs in and out by the table of layouts.ts, texts, errors.
import {LAYOUTS, Status, type ErrorTexts} from './layouts.js';

/** A call that failed: what was tried, what was found, what to do about it. */
export class GnomonError extends Error {
    /** The step that was tried. */
    readonly tried: string;
    /** The finding that made it fail. */
    readonly found: string;
    /** The advice what to do about it; may be empty. */
    readonly todo: string;

    constructor(tried: string, found: string, todo = '') {
        super(`${tried}: ${found}${todo ? `; ${todo}` : ''}`);
        this.name = 'GnomonError';
        this.tried = tried;
        this.found = found;
        this.todo = todo;
    }
}

/** A struct's members by name. */
export type Record_ = Record<string, unknown>;
/** An address in the module's memory; 0 is null. */
export type Pointer = number;

const READ = {
    u16: (at: DataView, offset: number) => at.getUint16(offset, true),
    u32: (at: DataView, offset: number) => at.getUint32(offset, true),
    ptr: (at: DataView, offset: number) => at.getUint32(offset, true),
    u64: (at: DataView, offset: number) => at.getBigUint64(offset, true),
    f32: (at: DataView, offset: number) => at.getFloat32(offset, true),
    f64: (at: DataView, offset: number) => at.getFloat64(offset, true),
} as const;
const BYTES: Record<string, number> = {u16: 2, u32: 4, ptr: 4, text: 4, u64: 8, f32: 4, f64: 8};

/** How the module is loaded. */
export interface LoadOptions {
    /** The bytes of gnomon.wasm or the compiled module; by default the file beside this one is read or fetched. */
    wasm?: BufferSource | WebAssembly.Module;
}

/** Reads a file of the package, in Node.js from the disk, else by fetch() from where this module came from. */
export async function readPackageFile(name: string): Promise<ArrayBuffer> {
    const address = new URL(name, import.meta.url);
    if (address.protocol === 'file:' && typeof process !== 'undefined') {
        const {readFile} = await import('node:fs/promises');
        const data = await readFile(address);
        return data.buffer.slice(data.byteOffset, data.byteOffset + data.byteLength) as ArrayBuffer;
    }
    const answer = await fetch(address);
    if (!answer.ok) {
        throw new GnomonError(`read ${address.href}`, `the server answers ${answer.status}`, 'serve the package\'s files beside its modules');
    }
    return answer.arrayBuffer();
}

/** The instance of the module. */
export class Wasm {
    private readonly exports: Record<string, (...args: never[]) => number>;
    private readonly memory: WebAssembly.Memory;
    private viewed: DataView;
    private readonly decoder = new TextDecoder();
    private readonly encoder = new TextEncoder();

    private constructor(instance: WebAssembly.Instance) {
        this.exports = instance.exports as never;
        this.memory = instance.exports['memory'] as WebAssembly.Memory;
        this.viewed = new DataView(this.memory.buffer);
    }

    /** Compiles and starts the module. */
    static async start(options: LoadOptions = {}): Promise<Wasm> {
        const given = options.wasm ?? await readPackageFile('gnomon.wasm');
        const module = given instanceof WebAssembly.Module ? given : await WebAssembly.compile(given);
        const imports: Record<string, Record<string, () => number>> = {};
        // The library reads no files, clocks or environment: what its C library names for them is never of use.
        for (const one of WebAssembly.Module.imports(module)) {
            (imports[one.module] ??= {})[one.name] = one.name === 'proc_exit' || one.name === 'abort' ? stop : () => 0;
        }
        const instance = await WebAssembly.instantiate(module, imports);
        (instance.exports['_initialize'] as (() => void) | undefined)?.();
        return new Wasm(instance);
    }

    /** Calls a function of the C interface. */
    call(name: string, ...args: (number | bigint)[]): number {
        return this.exports[name]!(...args as never[]);
    }
    /** Calls one that returns a status. Throws GnomonError. */
    done(name: string, ...args: (number | bigint)[]): void {
        if (this.call(name, ...args) !== Status.ok) {
            throw this.lastError();
        }
    }
    /** Calls one that returns a pointer. Throws GnomonError for null. */
    pointer(name: string, ...args: (number | bigint)[]): Pointer {
        const found = this.call(name, ...args) >>> 0;
        if (found === 0) {
            throw this.lastError();
        }
        return found;
    }
    private lastError(): GnomonError {
        const {tried, found, todo} = this.read<ErrorTexts>('ErrorTexts', this.call('gnomonLastError') >>> 0);
        return new GnomonError(tried, found, todo);
    }

    /** The memory as it is now: it may grow in each call. */
    get data(): DataView {
        if (this.viewed.buffer !== this.memory.buffer) {
            this.viewed = new DataView(this.memory.buffer);
        }
        return this.viewed;
    }
    /** A view of memory, which holds until the next call. */
    bytes(at: Pointer, count: number): Uint8Array {
        return new Uint8Array(this.memory.buffer, at, count);
    }
    /** A copy of numbers. */
    words(at: Pointer, count: number): Uint32Array<ArrayBuffer> {
        return new Uint32Array(this.memory.buffer as ArrayBuffer, at, count).slice();
    }
    /** A text; empty for null. */
    text(at: Pointer): string {
        if (at === 0) {
            return '';
        }
        const all = new Uint8Array(this.memory.buffer);
        return this.decoder.decode(all.subarray(at, all.indexOf(0, at)));
    }

    /** Memory that `use` may write to; it is given back afterwards. */
    with<T>(bytes: number, use: (at: Pointer) => T): T {
        const at = this.call('malloc', Math.max(bytes, 8)) >>> 0;
        if (at === 0) {
            throw new GnomonError('ask for memory', `there are no ${bytes} bytes left`, 'free planners and object sets that are not used');
        }
        try {
            return use(at);
        } finally {
            this.call('free', at);
        }
    }
    withText<T>(text: string, use: (at: Pointer) => T): T {
        const bytes = this.encoder.encode(`${text}\0`);
        return this.with(bytes.length, at => {
            this.bytes(at, bytes.length).set(bytes);
            return use(at);
        });
    }

    /** A struct's members; pointers as numbers, texts read. */
    read<T>(struct: string, at: Pointer): T {
        const made: Record_ = {};
        for (const [name, type, offset, counts] of LAYOUTS[struct]!.members) {
            made[name] = this.readMember(type, at + offset, counts);
        }
        return made as T;
    }
    private readMember(type: string, at: Pointer, counts: number[]): unknown {
        if (counts.length > 0) {
            const [count, ...rest] = counts;
            const step = rest.reduce((a, b) => a * b, sizeOf(type));
            return Array.from({length: count!}, (_, i) => this.readMember(type, at + i * step, rest));
        }
        if (type === 'text') {
            return this.text(this.data.getUint32(at, true));
        }
        return type in READ ? READ[type as keyof typeof READ](this.data, at) : this.read(type, at);
    }

    /** Writes the members that are given and leaves the others as they are. Throws GnomonError for unknown ones. */
    write(struct: string, at: Pointer, given: object): void {
        const members = LAYOUTS[struct]!.members;
        for (const [name, value] of Object.entries(given)) {
            const member = members.find(one => one[0] === name);
            if (!member) {
                throw new GnomonError(`fill in a ${struct}`, `it has no ${name}`, `it has ${members.map(one => one[0]).join(', ')}`);
            }
            if (value !== undefined) {
                this.writeMember(`${struct}.${name}`, member[1], at + member[2], member[3], value);
            }
        }
    }
    private writeMember(name: string, type: string, at: Pointer, counts: number[], value: unknown): void {
        if (counts.length > 0) {
            const list = value as ArrayLike<unknown>;
            if (list?.length !== counts[0]) {
                throw new GnomonError(`fill in ${name}`, `it has ${counts[0]} numbers, and ${list?.length ?? 'none'} are given`);
            }
            Array.from(list).forEach((one, i) => this.writeMember(name, type, at + i * sizeOf(type), counts.slice(1), one));
        } else if (!(type in READ)) {
            this.write(type, at, value as object);
        } else if (type === 'u64') {
            this.data.setBigUint64(at, BigInt.asUintN(64, BigInt(numberOf(name, value))), true);
        } else if (type === 'f64') {
            this.data.setFloat64(at, Number(numberOf(name, value)), true);
        } else if (type === 'f32') {
            this.data.setFloat32(at, Number(numberOf(name, value)), true);
        } else {
            this.data.setUint32(at, Number(wholeOf(name, value)), true);
        }
    }
    /** Sets a struct to its defaults. `init`: "gnomonInitLight". */
    init(init: string, struct: string, at: Pointer): void {
        this.done(init, at, sizeOf(struct));
    }
}

/** Bytes of a struct or a number. */
export function sizeOf(type: string): number {
    return BYTES[type] ?? LAYOUTS[type]!.size;
}

function numberOf(name: string, value: unknown): number | bigint {
    if (typeof value === 'boolean') {
        return value ? 1 : 0;
    }
    if (typeof value !== 'number' && typeof value !== 'bigint') {
        throw new GnomonError(`fill in ${name}`, `it is a number, and ${typeof value} is given`);
    }
    return value;
}

function wholeOf(name: string, value: unknown): number {
    const number = Number(numberOf(name, value));
    if (!Number.isInteger(number) || number < 0 || number > 0xFFFFFFFF) {
        throw new GnomonError(`fill in ${name}`, `it is a whole number from 0 to 4294967295, and ${number} is given`);
    }
    return number;
}

function stop(): never {
    throw new GnomonError('run the planner', 'it stopped', 'report this with the calls before it');
}
