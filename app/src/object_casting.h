// SPDX-License-Identifier: Apache-2.0
// --set object and --set light-groups: which objects cast and receive, for which lights.
#pragma once

#include "app/shot.h"

namespace gnomon::app {

/// NAME:KEY=VALUE,... with the keys of a file's extras (scene::Casting), several with ; between them. Adds to
/// Settings::objects. Throws UsageError.
void applyObjects(Settings& settings, const SettingValue& value);
/// NAME:GROUP+GROUP..., several with ; between them. Adds to Settings::light_groups. Throws UsageError.
void applyLightGroups(Settings& settings, const SettingValue& value);

/// To the nodes of that name, all of them, and what is below them. Throws UsageError where a name has nothing to draw.
void castAsTold(scene::Scene& scene, const Settings& settings);
/// To the lights of that name. Throws UsageError where there is none.
void groupAsTold(Shot& shot, const Settings& settings);

} // namespace gnomon::app
