// SPDX-License-Identifier: Apache-2.0
import {PUSH_BYTES} from './pipelines.js';

const ALIGNMENT = 256; // of dynamic offsets, on every device

/** Data of a frame's commands, in one buffer that is written once a list. */
export class Uploads {
    private readonly device: GPUDevice;
    private buffer: GPUBuffer | null = null;
    private bytes = new Uint8Array(1 << 16);
    private used = 0;
    private written = 0;
    /** Tells its buffers apart. */
    number = 0;

    constructor(device: GPUDevice) {
        this.device = device;
    }
    /** Its room is free again: all that was put has been submitted. */
    begin(): void {
        this.used = 0;
        this.written = 0;
    }
    /** Where data will lie when the commands run that are recorded now. */
    put(data: Uint32Array | Int32Array): {buffer: GPUBuffer, offset: number} {
        const needs = Math.ceil(Math.max(data.byteLength, PUSH_BYTES) / ALIGNMENT) * ALIGNMENT;
        if (!this.buffer || this.used + needs > this.buffer.size) {
            this.grow(needs);
        }
        const offset = this.used;
        this.bytes.set(new Uint8Array(data.buffer, data.byteOffset, data.byteLength), offset);
        this.used += needs;
        return {buffer: this.buffer!, offset};
    }
    private grow(needs: number): void {
        this.flush();
        const size = 2 ** Math.ceil(Math.log2(Math.max(2 * needs, this.bytes.length, 2 * (this.buffer?.size ?? 0))));
        this.bytes = new Uint8Array(size);
        const {UNIFORM, COPY_SRC, COPY_DST} = GPUBufferUsage;
        this.buffer = this.device.createBuffer({label: 'gnomon uploads', size, usage: UNIFORM | COPY_SRC | COPY_DST});
        this.begin();
        ++this.number;
    }
    flush(): void {
        if (this.buffer && this.used > this.written) {
            this.device.queue.writeBuffer(this.buffer, this.written, this.bytes, this.written, this.used - this.written);
            this.written = this.used;
        }
    }
    destroy(): void {
        this.buffer?.destroy();
        this.buffer = null;
    }
}
