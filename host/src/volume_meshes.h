// SPDX-License-Identifier: Apache-2.0
// The meshes of a scene for the library's VolumeDrawer and FinDrawer. The former draws edges and triangles of closed
// objects, the latter the edges of objects whose shadow has their mesh's outline.
#pragma once

#include "scene_data.h"

#include <gnomon/vulkan/volume_drawer.h>

#include <vector>

namespace gnomon::host {

class VolumeMeshes {
public:
    enum class Use : std::uint8_t { volumes, fins };
    /// Uploads the meshes and waits for that. Throws Error.
    VolumeMeshes(SceneData& scene, Use use);

    /// By object.
    [[nodiscard]] std::span<const vulkan::VolumeMesh> objects() const { return objects_; }
    [[nodiscard]] vulkan::VolumeGeometry geometry(const Buffer& positions) const;
    [[nodiscard]] const std::vector<vulkan::MemoryUse>& memory() const { return memory_.uses(); }

private:
    Memory memory_;
    Buffer elements_;
    Buffer triangles_;
    std::vector<vulkan::VolumeMesh> objects_;
};

} // namespace gnomon::host
