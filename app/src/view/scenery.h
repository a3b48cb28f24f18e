// SPDX-License-Identifier: Apache-2.0
// A scene in the window: loaded, on the GPU, at one time, with eye and lights.
#pragma once

#include "app/shot.h"
#include "host/scene_on_gpu.h"

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

} // namespace gnomon::app::view
