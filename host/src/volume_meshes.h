// SPDX-License-Identifier: Apache-2.0
// What the library's VolumeDrawer draws of a scene: the edges and triangles of what is closed; and what its FinDrawer
// draws: the edges of whatever has the outline of its mesh.
#pragma once

#include "scene_data.h"

#include <gnomon/vulkan/volume_drawer.h>

#include <vector>

namespace gnomon::host {

class VolumeMeshes {
public:
    enum class Use : std::uint8_t { volumes, fins };
    /// Uploads them, and waits for that. Throws Error.
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
