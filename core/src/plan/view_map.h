// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "store/map_store.h"

namespace gnomon {

/// The map of a view of the plan, and whether the view may wait.
struct ViewMap {
    const MapPlace* place = nullptr; // null: the view is of the plan before, with nothing to draw
    bool read = true;                // in this frame
    bool own_turn = false;           // it is a cascade that takes turns by itself
    bool may_wait = false;           // and the view that it had shows what it has to
    bool waits = false;              // its turn has not come
};

} // namespace gnomon
