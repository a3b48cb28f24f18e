// SPDX-License-Identifier: Apache-2.0
// `gnomon compare SCENE SCENE...`: the same techniques in several scenes, one after the other, and each technique's
// mean.
#pragma once

#include "app/settings.h"
#include "result_json.h"

#include <string>

namespace gnomon::app {

/// {"scenes": [{"name", "result"}...], "techniques": [{"technique", "rmse": [per scene], "mean"}...]}: results as
/// findByComparing() has them, techniques best first. With --report each scene has its report in a folder of its name
/// in the report's folder, which gets a page over all of them. When a scene fails, the reports of earlier ones stay.
/// Precondition: settings.scenes has several. Throws as findByComparing() does.
[[nodiscard]] Json compareScenes(const Settings& settings);
/// compareText() of each scene, then all of them in one table.
[[nodiscard]] std::string scenesText(const Json& scenes);
/// The page over all scenes, with links to their own pages.
[[nodiscard]] std::string scenesPage(const Json& scenes);

} // namespace gnomon::app
