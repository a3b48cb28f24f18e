// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/shot.h"

namespace gnomon::app {

/// With filter volumes, or where one of several techniques has it: throws Error, with the names of meshes, where
/// casters are not closed; or with volumes.open=skip says so in a notice.
void requireClosedCasters(Shot& shot, const Settings& settings);
/// With filter smoothies, or where one of several techniques has it: says in a notice which casters have no fins.
void noteFinless(Shot& shot, const Settings& settings);

} // namespace gnomon::app
