// SPDX-License-Identifier: Apache-2.0
// The panel beside the picture: what there is to change, and what it costs.
#pragma once

#include "view/widgets.h"

#include <functional>
#include <string>

namespace gnomon::app::view {

/// What the panel shares with the picture.
struct Shown {
    bool panel = true;
    bool sun = true;        // the handle
    float divider = 0.5F;   // of the picture's width, where the second picture begins
    bool half_size = false; // pixels are drawn twice as large on each side
    bool frusta = false;    // of the maps
    bool maps = false;      // in a corner
    bool hint = true;       // what hand and keys do; until they did something
};

/// Text that is typed in the panel, kept from turn to turn.
struct Typed {
    std::string scene;
    std::string technique_beside = "hard";
    std::string screenshot = "gnomon.png";
    std::string preset_file = "preset.json";
};

struct PanelState {
    Shown& shown;
    Typed& typed;
    Widgets& widgets;
    std::function<void(const std::string&)> to_clipboard;
};

// Its parts, in this order.
void techniquePanel(Viewer& viewer, PanelState& state);
void comparePanel(Viewer& viewer, PanelState& state);
void timesPanel(Viewer& viewer, PanelState& state);
void scenePanel(Viewer& viewer, PanelState& state);
void lightPanel(Viewer& viewer, PanelState& state);
void picturePanel(Viewer& viewer, PanelState& state);
void filesPanel(Viewer& viewer, PanelState& state);

/// How wide the panel is, pixels.
[[nodiscard]] float panelWidth();

} // namespace gnomon::app::view
