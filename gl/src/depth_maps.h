// SPDX-License-Identifier: Apache-2.0
// Maps that are drawn and then read as they are. A view with a kept layer is drawn in two parts: what stands still into
// the kept layer, from which the map is restored where something moves, and what moves over that. Maps that share
// texels with another one are always drawn whole.
#pragma once

#include "depth_blocks.h"

#include <optional>

namespace gnomon::gl {

class DepthMaps final : public MapRecorder {
public:
    DepthMaps(const Context& context, Programs& programs, const ResolvedOptions& options);

    Prepared prepare(const Plan& plan, std::uint32_t options) override;
    void draw(const MapJob& job) override;
    [[nodiscard]] bool covers(const Plan& plan, const View& view) const override;
    [[nodiscard]] const Image& maps() const override { return maps_; }
    [[nodiscard]] const Image* blocks() const override { return blocks_ ? &blocks_->image() : nullptr; }

private:
    void drawKept(const MapJob& job, std::uint32_t view);
    void drawMap(const MapJob& job, std::uint32_t view);
    void restore(const View& view, const Tile& area);

    const Context& context_;
    MapStorage storage_;
    Target target_;
    Image maps_;
    Image depth_; // for maps in a colour format: decides which fragment wins
    Image kept_colours_;
    Image kept_depths_;
    std::optional<DepthBlocks> blocks_;
};

} // namespace gnomon::gl
