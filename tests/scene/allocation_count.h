// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

/// How often this program has called operator new so far.
[[nodiscard]] std::size_t allocationCount();
