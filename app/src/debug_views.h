// SPDX-License-Identifier: Apache-2.0
// `gnomon render --debug VIEW`: pictures that show what a technique does. A further one is a row in debug_views.cpp.
#pragma once

#include "app/shot.h"

#include <string_view>
#include <vector>

namespace gnomon::app {

/// The names that --debug takes, "none" first.
[[nodiscard]] std::vector<std::string_view> debugViewNames();
/// Throws UsageError where the view that --debug names has nothing to show.
void requireDebugView(const Settings& settings);
/// The last frame as that view shows it, RGB. Precondition: requireDebugView() held and it is not "none". Throws Error
/// when the light has no map.
[[nodiscard]] Image8 debugPicture(host::FrameRenderer& renderer, const Shot& shot, const Settings& settings,
                                  std::size_t light);

} // namespace gnomon::app
