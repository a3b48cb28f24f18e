// SPDX-License-Identifier: Apache-2.0
// Sources of worlds name parts of a scene without their namespace.
#pragma once

#include "scene/model.h"

namespace gnomon::worlds {

using namespace scene;

} // namespace gnomon::worlds
