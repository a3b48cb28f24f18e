// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace gnomon::host {

/// Throws Error unless this process may start `count` more threads at once, which it tries. llvmpipe does not look
/// whether it got those that it draws with, and waits for them without end.
void requireThreads(unsigned count, const char* tried);

/// How many a driver that draws with the processor starts at most: one for each core, one for its queue and one for its
/// cache.
[[nodiscard]] unsigned threadsOfSoftwareDriver();

} // namespace gnomon::host
