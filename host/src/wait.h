// SPDX-License-Identifier: Apache-2.0
// Waiting for the GPU, in slices, so that the user can end the program, and a hanging GPU differs from a slow one.
#pragma once

#include "host/gpu.h"

namespace gnomon::host {

/// Waits until the fence is signalled. Throws Error (lost device, memory, a GPU that hangs: see GpuOptions::patience_s)
/// and any exception of GpuOptions::while_waiting; the submission has then ended too, or the device is abandoned.
void waitFor(const Gpu& gpu, VkFence fence);
/// Waits in destructors. When GpuOptions::while_waiting throws, it gives the GPU a few more seconds. Where those are
/// not enough, or where the GPU hangs, it abandons the device.
void settle(const Gpu& gpu, VkFence fence) noexcept;

/// waitFor() and settle() for all work of the queue, which nobody else may use meanwhile.
void waitForQueue(const Gpu& gpu);
void settleQueue(const Gpu& gpu) noexcept;

} // namespace gnomon::host
