// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "draw_table.h"
#include "pipelines.h"

#include "host/scene_on_gpu.h"

#include <future>
#include <optional>
#include <vector>

namespace gnomon::host {

struct SceneData {
    SceneData(Gpu& gpu, const scene::Scene& scene, const scene::State& state);
    /// `closed`: closures() of the scene, which are found while the rest is uploaded.
    SceneData(Gpu& gpu, const scene::Scene& scene, const scene::State& state,
              std::future<std::vector<scene::MeshClosure>> closed);

    Gpu& gpu;
    const scene::Scene& scene;
    Memory memory;
    std::unique_ptr<Uploader> uploader; // until the upload has been waited for
    Textures textures;
    Materials materials;
    Geometry geometry;
    DrawTable table;
    Pipelines pipelines;
    /// The time of the state whose deformed vertices are there once all submissions are done.
    std::optional<double> deformed_at_s;
    std::optional<double> occlusion_radius_m; // occlusionRadius(), once somebody has asked

    [[nodiscard]] double occlusionRadius_m();

    /// Waits for the upload, and gives its staging buffer back. Throws as waitFor().
    void finishUpload()
    {
        if (uploader) {
            uploader->wait();
            uploader.reset();
        }
    }
    [[nodiscard]] vulkan::CasterGeometry casterGeometry() const
    {
        const VkBuffer attributes = geometry.attributes.handle;
        return {geometry.positions.handle,
                0,
                geometry.uvs.handle,
                0,
                geometry.indices.handle,
                0,
                attributes,
                0,
                attributes,
                0};
    }
};

} // namespace gnomon::host
