// SPDX-License-Identifier: Apache-2.0
// Which camera a run looks through.
#pragma once

#include "app/shot.h"

namespace gnomon::app {

/// Sets eye and camera from the settings and the state. Throws UsageError when the named camera is not there.
void placeEye(Shot& shot, const Settings& settings);

/// The names that --camera takes, in the order of its search: the scene's views, then its placed cameras.
[[nodiscard]] std::vector<std::string> cameraNames(const Shot& shot);

} // namespace gnomon::app
