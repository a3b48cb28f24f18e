// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/shot.h"

namespace gnomon::app {

/// Throws Error when scene, camera or a light that casts is beyond the limits of gnomon/world_range.h: single precision
/// has no room for its shadows, and it is not drawn without them.
void requireInRange(const Shot& shot, const Settings& settings);

} // namespace gnomon::app
