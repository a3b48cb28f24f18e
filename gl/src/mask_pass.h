// SPDX-License-Identifier: Apache-2.0
// The pass that draws the mask from maps, and the one that blurs it on the screen (soften=blur).
#pragma once

#include "map_recorder.h"

#include <gnomon/pack/mask_draws.h>
#include <gnomon/pack/shading_buffers.h>
#include <gnomon/pack/soften_draws.h>
#include <gnomon/pack/technique_constants.h>

#include <glm/vec2.hpp>

#include <array>
#include <memory>
#include <vector>

namespace gnomon::gl {

/// By options; null where no light names them.
using MapClasses = std::vector<std::unique_ptr<MapRecorder>>;

class MaskPass {
public:
    MaskPass(const Context& context, Programs& programs);

    /// True when the mask is another texture.
    bool prepare(const Plan& plan, glm::uvec2 size_px);
    [[nodiscard]] bool holds(const Plan& plan) const;
    void draw(const Plan& plan, const MaskInputs& inputs, const MapClasses& maps);
    [[nodiscard]] const Image& mask() const { return mask_; }

private:
    void fill(const Plan& plan, const MaskInputs& inputs, const MapClasses& maps);
    void bindInputs(const MaskInputs& inputs);
    void bindMaps(const Plan& plan, std::uint32_t options, const MapRecorder& maps);
    void drawPart(const Plan& plan, const MaskInputs& inputs, const pack::MaskDraw& draw);
    [[nodiscard]] GLuint program(const Plan& plan, const MaskInputs& inputs, const pack::MaskDraw& draw);
    void soften(const MaskInputs& inputs, const pack::SoftenDraw& draw);

    const Context& context_;
    Programs& programs_;
    Target target_;
    Sampler nearest_;
    Sampler linear_;
    VertexArray no_vertices_;
    Image mask_;
    Image no_number_;  // stands in for ids of objects
    Image no_numbers_; // and for blocks
    std::array<Image, 2> blurred_;
    Buffer constants_; // by options, `stride_` apart
    Buffer lights_;
    Buffer views_;
    Buffer pages_;  // pack::fillPageTable()
    Buffer points_; // of the disc, two to a vector
    std::size_t stride_;
    // This frame's.
    std::vector<pack::MaskDraw> draws_;
    std::vector<pack::SoftenDraw> soften_draws_;
    std::vector<pack::MapImage> map_images_;
    std::vector<std::byte> constant_bytes_;
    std::vector<shared::GpuLight> light_list_;
    std::vector<shared::GpuView> view_list_;
    std::vector<glm::uvec2> page_table_;
};

} // namespace gnomon::gl
