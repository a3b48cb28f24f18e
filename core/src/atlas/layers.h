// SPDX-License-Identifier: Apache-2.0
// The plainest atlas: every view has a layer of its own.
#pragma once

#include <gnomon/plan.h>

#include <optional>

namespace gnomon {

class LayerAtlas {
public:
    void begin(std::uint32_t map_size, std::uint32_t max_layers);
    /// Layers for the views of a light, whether it needs them in this frame or not: a light that comes into sight must
    /// not push the others into new layers, or all of them would be drawn anew. None when there is no room.
    std::optional<std::uint32_t> take(std::uint32_t count);
    [[nodiscard]] Tile tile(std::uint32_t layer) const { return {layer, 0, 0, map_size_, map_size_}; }
    [[nodiscard]] MapPages size() const;

private:
    std::uint32_t map_size_ = 0;
    std::uint32_t max_layers_ = 0;
    std::uint32_t taken_ = 0;
};

} // namespace gnomon
