// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace gnomon::host {

/// Throws Error unless this process can start `count` more threads at once, which it tries, because a driver may
/// wait without end for one that it did not get [drivers: threads].
void requireThreads(unsigned count, const char* tried);

/// The most threads that a driver on the processor starts: one for each core, one for its queue and one for its cache.
[[nodiscard]] unsigned threadsOfSoftwareDriver();

} // namespace gnomon::host
