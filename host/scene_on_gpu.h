// SPDX-License-Identifier: Apache-2.0
// A scene on the GPU: meshes, materials, textures and the pipelines that draw them. Uploaded once for all later frames.
#pragma once

#include "host/gpu.h"
#include "scene/state.h"

#include <gnomon/vulkan/shadow_renderer.h>

#include <memory>
#include <vector>

namespace gnomon::host {

struct SceneData;

/// Shared by any number of FrameRenderers, which must not outlive it. Not thread-safe: they draw by turns.
class SceneOnGpu {
public:
    /// Uploads the scene. `state` has the objects, and the places of those that never move. `gpu` and `scene` outlive
    /// this. Throws Error (limits, memory, device).
    SceneOnGpu(Gpu& gpu, const scene::Scene& scene, const scene::State& state);
    ~SceneOnGpu();
    SceneOnGpu(const SceneOnGpu&) = delete;
    SceneOnGpu& operator=(const SceneOnGpu&) = delete;

    [[nodiscard]] Gpu& gpu() const;
    [[nodiscard]] const scene::Scene& scene() const;
    /// Bytes of its images and buffers, by purpose.
    [[nodiscard]] std::vector<vulkan::MemoryUse> memory() const;

private:
    friend class FrameRenderer;
    std::unique_ptr<SceneData> data_;
};

} // namespace gnomon::host
