// SPDX-License-Identifier: Apache-2.0
// The blocks of a map's depths (gnomon/shared/map_blocks.h), for filters that look far around a receiver.
#pragma once

#include "map_recorder.h"

namespace gnomon::gl {

class DepthBlocks {
public:
    DepthBlocks(const Context& context, Programs& programs);

    /// The maps are another texture: the next draw() makes all blocks.
    void setMaps(const Image& maps);
    void draw(const MapJob& job, const Image& maps);
    /// Level L of the blocks is mip level L - 1.
    [[nodiscard]] const Image& image() const { return image_; }

private:
    void make(const Image& maps, const Tile& part);

    const Context& context_;
    Programs& programs_;
    Sampler nearest_;
    Image image_;
    bool is_new_ = false; // no block is made yet
};

} // namespace gnomon::gl
