// SPDX-License-Identifier: Apache-2.0
// A ground under panes of coloured glass, and the light through them.
#pragma once

#include "host/frame_renderer.h"
#include "scene/model.h"

#include <glm/vec3.hpp>

#include <vector>

namespace gnomon::host::test {

/// A level pane over the right half of the ground, x from 0 to 4.
struct Pane {
    float height_m = 0.0F;
    glm::vec3 colour{0.25F, 0.5F, 1.0F};
};
inline constexpr float kPaneAlpha = 0.5F;
/// The light that passes a pane of that colour.
[[nodiscard]] glm::vec3 through(const glm::vec3& colour = Pane{}.colour);
/// ITU-R BT.709.
[[nodiscard]] float luminance(const glm::vec3& light);

/// A level quad that faces up, of this material, from x = `left_m` to `right_m`.
void addLevel(scene::Scene& scene, float left_m, float right_m, float y, std::uint32_t material);
/// The ground, of material 0, under these panes, a sun overhead and a spot light over its middle.
[[nodiscard]] scene::Scene panes(const std::vector<Pane>& panes);
/// From above: the ground's middle is in the middle of the picture.
[[nodiscard]] Eye panesEye();

/// A map of 128 texels a side, and nothing automatic.
[[nodiscard]] ShadowOptions plainWith(Filter filter, Partition partition = Partition::single);
/// Plain options with every filter, and with every partition.
[[nodiscard]] std::vector<ShadowOptions> plainWithAll();

} // namespace gnomon::host::test
