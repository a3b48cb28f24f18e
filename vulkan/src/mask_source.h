// SPDX-License-Identifier: Apache-2.0
// The source that a mask is drawn from, so that it need not be drawn again from the same one.
#pragma once

#include <gnomon/frame.h>
#include <gnomon/options.h>
#include <gnomon/pack/mask_draws.h>
#include <gnomon/plan.h>
#include <gnomon/vulkan/shadow_renderer.h>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace gnomon::vulkan {

/// All that the pass reads: what shaders read is here as they read it, and images are named by what they hold, which
/// the host says.
struct MaskSource {
    ContentNumber inputs = 0;      // MaskInputs::content. 0: what the pass makes cannot be told from this
    std::uint64_t map_changes = 0; // pack::MapNotes::changes()
    std::shared_ptr<const std::vector<ResolvedOptions>> options; // the options that pipelines are made by
    MaskShape shape;
    bool pieces = false; // MaskInputs::object_pieces
    // Where shadow volumes are counted what they are planned by; else nothing.
    std::uint64_t objects = 0; // ObjectSet::identity() and version()
    std::uint64_t version = 0;
    Camera camera;
    std::vector<Light> lights;
    std::vector<std::byte> constants; // GpuConstants by options, then lights and views
    std::vector<glm::vec4> numbers;   // pack::fillObjects()
    std::vector<glm::uvec2> tiles;    // pack::fillMaskTiles(), or of a mask that is not compact pack::fillPageTable()
    std::vector<pack::MaskDraw> draws;

    bool operator==(const MaskSource&) const = default;
};

/// Are shadow volumes counted for some light?
[[nodiscard]] bool hasVolumes(const Plan& plan);
/// MaskInputs::content, or 0 for a plan whose mask depends on more: on the frames before, or on what the GPU finds.
[[nodiscard]] ContentNumber nameOfInputs(const Plan& plan, const MaskInputs& inputs);

} // namespace gnomon::vulkan
