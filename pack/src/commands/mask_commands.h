// SPDX-License-Identifier: Apache-2.0
// Records the pass that draws the mask from maps, and the one that blurs it on the screen (soften=blur).
#pragma once

#include "commands/recording.h"

#include <gnomon/pack/mask_draws.h>
#include <gnomon/pack/shading_buffers.h>
#include <gnomon/pack/soften_draws.h>
#include <gnomon/pack/technique_constants.h>

#include <vector>

namespace gnomon::pack {

class MaskCommands {
public:
    MaskCommands(Recording& recording, const RecorderTraits& traits);

    /// True when the mask is another image.
    bool prepare(const Plan& plan, glm::uvec2 size_px);
    [[nodiscard]] bool holds(const Plan& plan) const;
    void draw(const Plan& plan, const RecorderInputs& inputs);
    [[nodiscard]] const ImageShape& mask() const { return recording_.shapeOf({ImageName::mask}); }
    /// All images and buffers are gone.
    void forget() { has_small_ = false; }

private:
    void makeSmall();
    void upload(const Plan& plan, const RecorderInputs& inputs);
    [[nodiscard]] CommandRange bindingsFor(const Plan& plan, const RecorderInputs& inputs, std::uint32_t options);
    void drawPart(const Plan& plan, const RecorderInputs& inputs, const MaskDraw& draw, CommandRange bindings);
    void soften(const RecorderInputs& inputs, const SoftenDraw& draw);

    Recording& recording_;
    const RecorderTraits& traits_;
    std::size_t stride_; // of constants, by options
    bool has_small_ = false;
    // This frame's.
    std::vector<MaskDraw> draws_;
    std::vector<SoftenDraw> soften_draws_;
    std::vector<MapImage> map_images_;
    std::vector<std::uint32_t> constant_words_;
    std::vector<shared::GpuLight> lights_;
    std::vector<shared::GpuView> views_;
    std::vector<glm::uvec2> page_table_;
    std::vector<CommandRange> bindings_; // by options; empty: not made yet
};

} // namespace gnomon::pack
