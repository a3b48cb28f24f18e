// SPDX-License-Identifier: Apache-2.0
// Parts of the views of `--debug`: those that colour receivers by the plan, and the view of the octree.
#pragma once

#include "app/shot.h"

#include <string_view>

namespace gnomon::app {

/// A frame as it was drawn.
struct Drawn {
    const host::Picture& picture; // colour and geometry
    const Plan& plan;
    host::FrameRenderer& renderer;
    const Shot& shot;
    const Settings& settings;
    std::size_t light;
};

/// Throws Error, which names `what`, when the light has no map.
void requireMap(const Drawn& drawn, std::string_view what);

/// Shadow texels per pixel.
[[nodiscard]] Image8 densityView(const Drawn& drawn);
/// Which of the light's maps serves a pixel; of a stepping sun, whichever of its positions the map is of.
[[nodiscard]] Image8 viewsView(const Drawn& drawn);
/// With partition multi and motion snap: what is shadowed from maps that fade in, and what from those they fade over.
[[nodiscard]] Image8 fadedView(const Drawn& drawn);
/// The cells of the octree that hold objects, and the spheres around what the light's maps draw.
[[nodiscard]] Image8 octreeView(const Drawn& drawn);
/// How many of all lights reach a pixel and have maps; whatever light the settings name.
[[nodiscard]] Image8 lightCountView(const Drawn& drawn);
/// How filter raymarch fared: where blocks knew the answer, where rays did, and where they came to their ceiling.
/// Precondition: the picture has masks, drawn with RenderOptions::shows_rays.
[[nodiscard]] Image8 raysView(const Drawn& drawn);
/// The share of each of a stepping sun's two positions.
[[nodiscard]] Image8 stepsView(const Drawn& drawn);

} // namespace gnomon::app
