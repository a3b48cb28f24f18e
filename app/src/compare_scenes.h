// SPDX-License-Identifier: Apache-2.0
// `gnomon compare SCENE SCENE...`: the same techniques in several scenes, one after the other, and what that says of
// each technique.
#pragma once

#include "app/settings.h"
#include "result_json.h"

#include <string>

namespace gnomon::app {

/// {"scenes": [{"name", "result"}...], "techniques": [{"technique", "rmse": [per scene], "mean"}...]}: results as
/// findByComparing() has them, techniques best first. With --report each scene has its report in a folder of its
/// name in that one, which itself gets a page over all of them. A scene that fails leaves those before it.
/// Precondition: settings.scenes has several. Throws as findByComparing() does.
[[nodiscard]] Json compareScenes(const Settings& settings);
/// Each scene as compareText() has it, then all of them in one table.
[[nodiscard]] std::string scenesText(const Json& scenes);
/// The page. Its links lead to the scenes' own.
[[nodiscard]] std::string scenesPage(const Json& scenes);

} // namespace gnomon::app
