// SPDX-License-Identifier: Apache-2.0
// Waiting for the GPU, in slices: whoever runs the program can end it, and a GPU that hangs is told from one that is
// slow.
#pragma once

#include "host/gpu.h"

namespace gnomon::host {

/// Until the fence is signalled. Throws Error (lost device, memory, a GPU that hangs: see GpuOptions::patience_s) and
/// whatever GpuOptions::while_waiting throws; what was submitted has ended then all the same, or the device is
/// abandoned.
void waitFor(const Gpu& gpu, VkFence fence);
/// For destructors. Asked to end (GpuOptions::while_waiting throws) it gives the GPU a few seconds more. Where that is
/// not enough, or where the GPU hangs, the device is abandoned.
void settle(const Gpu& gpu, VkFence fence) noexcept;

/// The same for all that the queue was given, which is nobody else's meanwhile.
void waitForQueue(const Gpu& gpu);
void settleQueue(const Gpu& gpu) noexcept;

} // namespace gnomon::host
