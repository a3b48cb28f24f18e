// SPDX-License-Identifier: Apache-2.0
// A scene in the window: loaded, on the GPU, at one time, with eye and lights.
#pragma once

#include "app/shot.h"
#include "host/scene_on_gpu.h"

#include <algorithm>

namespace gnomon::app::view {

struct Scenery {
    /// Throws as makeShot() and SceneOnGpu do.
    Scenery(host::Gpu& gpu, const Settings& settings) : shot(makeShot(settings)), on_gpu(gpu, shot.scene, shot.state) {}
    /// Eye, lights and time by other settings of the same scene. Throws UsageError; then they are as before or as the
    /// settings have them.
    void move(const Settings& settings) { moveShot(shot, settings, 0); }

    Shot shot;
    host::SceneOnGpu on_gpu;
};

/// The first directional light; null where there is none.
[[nodiscard]] inline const host::ShadedLight* sunOf(const Shot& shot)
{
    const auto sun = std::find_if(shot.lights.begin(), shot.lights.end(), [](const host::ShadedLight& light) {
        return light.caster.type == LightType::directional;
    });
    return sun != shot.lights.end() ? &*sun : nullptr;
}

} // namespace gnomon::app::view
