// SPDX-License-Identifier: Apache-2.0
#include <gnomon/pack/filter_passes.h>
#include <gnomon/pack/filter_rule.h>

#include <gnomon/shared/map_blocks.h>

#include <algorithm>

namespace gnomon::pack {
namespace {

// Shaders have room for everything that options allow.
static_assert(kMaxBlurRadius == shared::kMostBlurRadius && kMaxBlurRadius < shared::kBlockTexels);
static_assert(kMaxDepthLayers == shared::kDepthLayers && kMaxDepthLayers == 2 * shared::kMostImageLayers);

std::int32_t channelsOf(MapFormat format)
{
    switch (format) {
    case MapFormat::r16f:
    case MapFormat::r32f:
        return 1;
    case MapFormat::rg16:
    case MapFormat::rg16f:
    case MapFormat::rg32f:
        return 2;
    default:
        return 4;
    }
}

} // namespace

FilterConstants filterConstants(const ResolvedOptions& options)
{
    const shared::MomentRule rule = momentRuleOf(options);
    FilterConstants constants;
    constants.filter = static_cast<std::int32_t>(options.filter());
    constants.flags = rule.flags;
    constants.layers = rule.layers;
    constants.exponent = rule.exponent;
    constants.exponent_negative = rule.exponent_negative;
    constants.moment_bias = rule.moment_bias;
    constants.radius = static_cast<std::int32_t>(blurRadius(options.moments()));
    constants.channels = channelsOf(options.format());
    return constants;
}

ScratchStrips stripsOf(std::uint32_t tile_width, std::uint32_t image_layers, std::uint32_t most_layers)
{
    ScratchStrips strips;
    while (groupsOf(tile_width, strips.width) * image_layers > most_layers) {
        strips.width *= 2;
    }
    strips.count = groupsOf(tile_width, strips.width);
    return strips;
}

float nearOverFar(const View& view, const DepthMetric& metric)
{
    return view.projection.parallel ? 1.0F : static_cast<float>(metric.near_m / metric.far_m);
}

shared::FilterPassPlace placeOf(const FilterStep& step)
{
    const glm::ivec4 tile(step.tile.x, step.tile.y, step.first_layer, 0);
    shared::FilterPassPlace place{};
    place.source = tile;
    place.source.w = static_cast<int>(step.depth_slot);
    place.target = tile;
    place.target.w = static_cast<int>(step.image_layers);
    place.size = glm::ivec4(step.tile.width, step.tile.height, groupsOf(step.tile.width, shared::kBlockTexels),
                            groupsOf(step.tile.height, shared::kBlockTexels));
    place.strips = glm::ivec4(step.strips.width, step.strips.count, 0, 0);
    place.metric.x = step.near_over_far;
    return place;
}

shared::FilterPassPlace placeFromDepths(const FilterStep& step)
{
    shared::FilterPassPlace place = placeOf(step);
    place.source.x = 0;
    place.source.y = 0;
    return place;
}

shared::FilterPassPlace placeOfLevel(const FilterStep& step, std::uint32_t level)
{
    const std::uint32_t fine = level - 1;
    shared::FilterPassPlace place = placeOf(step);
    place.source.x = static_cast<int>(step.tile.x >> fine);
    place.source.y = static_cast<int>(step.tile.y >> fine);
    place.target.x = static_cast<int>(step.tile.x >> level);
    place.target.y = static_cast<int>(step.tile.y >> level);
    place.size.x = static_cast<int>(step.tile.width >> level);
    place.size.y = static_cast<int>(step.tile.height >> level);
    return place;
}

std::uint32_t blockPassCount(std::uint32_t levels)
{
    return groupsOf(levels, shared::kBlockLevelsOfPass);
}

BlockPass blockPass(std::uint32_t index, const glm::uvec2& size_px, const Tile& part)
{
    constexpr std::uint32_t kGroupReads = shared::kBlockGroup << shared::kBlockLevelsOfPass; // along x and y
    BlockPass pass;
    pass.first_level = index * shared::kBlockLevelsOfPass;
    const std::uint32_t side = kGroupReads << pass.first_level; // texels of a group
    const std::uint32_t x = part.x / side;
    const std::uint32_t y = part.y / side;
    // Texels beyond the maps' end repeat the last ones.
    const auto last = [&](std::uint32_t texels) {
        return static_cast<std::int32_t>(groupsOf(texels, 1U << pass.first_level)) - 1;
    };
    const std::uint32_t levels =
        std::min<std::uint32_t>(shared::kBlockLevelsOfPass, blockLevels(size_px) - pass.first_level);
    pass.first = {static_cast<std::int32_t>(x), static_cast<std::int32_t>(y), static_cast<std::int32_t>(part.layer),
                  static_cast<std::int32_t>(levels)};
    pass.last = {last(size_px.x), last(size_px.y), 0, 0};
    pass.groups_x = groupsOf(part.x + part.width, side) - x;
    pass.groups_y = groupsOf(part.y + part.height, side) - y;
    return pass;
}

} // namespace gnomon::pack
