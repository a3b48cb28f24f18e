// SPDX-License-Identifier: Apache-2.0
#include "atlas/layers.h"

namespace gnomon {

void LayerAtlas::begin(std::uint32_t map_size, std::uint32_t max_layers)
{
    map_size_ = map_size;
    max_layers_ = max_layers;
    taken_ = 0;
}

std::optional<std::uint32_t> LayerAtlas::take(std::uint32_t count)
{
    if (count > max_layers_ - taken_)
        return std::nullopt;
    const std::uint32_t first = taken_;
    taken_ += count;
    return first;
}

MapPages LayerAtlas::size() const
{
    if (taken_ == 0)
        return {};
    return {map_size_, map_size_, taken_};
}

} // namespace gnomon
