// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace gnomon::host {

/// Throws Error unless this process can start `count` more threads at once, which it tries. llvmpipe does not check
/// that it got its threads, and waits for them without end.
void requireThreads(unsigned count, const char* tried);

/// The most threads that a driver on the processor starts: one for each core, one for its queue and one for its cache.
[[nodiscard]] unsigned threadsOfSoftwareDriver();

} // namespace gnomon::host
