// SPDX-License-Identifier: Apache-2.0
#include "view/map_inset.h"

#include <gnomon/error.h>
#include <gnomon/pack/filter_rule.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::app::view {
namespace {

constexpr std::uint32_t kSide_px = 240; // of the longer side

struct Page {
    const ImageF& texels;
    const ResolvedOptions& options;
    double scale; // texels for a pixel of the inset
};

/// One map's depths, stretched from black to white.
void paintMap(Image8& picture, const Page& page, const View& view)
{
    const Tile& tile = view.tile;
    const auto first_x = static_cast<std::uint32_t>(std::ceil(tile.x / page.scale));
    const auto first_y = static_cast<std::uint32_t>(std::ceil(tile.y / page.scale));
    const auto end_x = std::min(picture.width, static_cast<std::uint32_t>((tile.x + tile.width) / page.scale));
    const auto end_y = std::min(picture.height, static_cast<std::uint32_t>((tile.y + tile.height) / page.scale));
    const auto depthAt = [&](std::uint32_t x, std::uint32_t y) {
        const auto from_x = std::min(static_cast<std::uint32_t>((x + 0.5) * page.scale), page.texels.width - 1);
        const auto from_y = std::min(static_cast<std::uint32_t>((y + 0.5) * page.scale), page.texels.height - 1);
        return pack::mapDepth(page.options, {page.texels.pixel(from_x, from_y), page.texels.channels}, view.part);
    };
    float least = std::numeric_limits<float>::infinity();
    float most = -least;
    for (std::uint32_t y = first_y; y < end_y; ++y) {
        for (std::uint32_t x = first_x; x < end_x; ++x) {
            const float depth = depthAt(x, y);
            least = std::isfinite(depth) ? std::min(least, depth) : least;
            most = std::isfinite(depth) ? std::max(most, depth) : most;
        }
    }
    for (std::uint32_t y = first_y; y < end_y; ++y) {
        for (std::uint32_t x = first_x; x < end_x; ++x) {
            const float depth = depthAt(x, y);
            const float share = most > least && std::isfinite(depth) ? (depth - least) / (most - least) : 0.0F;
            std::fill_n(picture.pixel(x, y), 3, static_cast<std::uint8_t>(std::lround(share * 255.0F)));
        }
    }
}

} // namespace

void MapInset::take(Viewer& viewer)
{
    const Plan& plan = viewer.renderer().plan();
    const auto light = static_cast<std::uint32_t>(lightIndex(viewer.shot(), viewer.settings()));
    if (light >= plan.lights.size() || plan.lights[light].view_count == 0) {
        why_ = "this light has no map";
        return;
    }
    const ResolvedOptions options = resolvedOrThrow(viewer.settings().shadow);
    const std::uint32_t layer = plan.views[plan.lights[light].first_view].tile.layer;
    const ImageF texels = viewer.renderer().readMap(layer * imageLayersPerMap(options.filter(), options.moments()));
    const double scale = std::max(1.0, static_cast<double>(std::max(texels.width, texels.height)) / kSide_px);
    Image8 picture(static_cast<std::uint32_t>(texels.width / scale), static_cast<std::uint32_t>(texels.height / scale),
                   3);
    const glm::dvec2 whole(texels.width, texels.height);
    for (std::uint32_t i = 0; i < plan.views.size(); ++i) {
        const View& view = plan.views[i];
        if (view.tile.layer != layer || view.tile.width == 0) {
            continue;
        }
        paintMap(picture, {texels, options, scale}, view);
        squares_.push_back({glm::dvec2(view.tile.x, view.tile.y) / whole,
                            glm::dvec2(view.tile.width, view.tile.height) / whole, view.light,
                            i - plan.lights[view.light].first_view, view.redraw});
    }
    canvas_.paint(picture);
}

void MapInset::paint(Viewer& viewer)
{
    squares_.clear();
    why_.clear();
    try {
        take(viewer);
    } catch (const Error& error) {
        if (error.kind() == ErrorKind::device_lost) {
            throw;
        }
        squares_.clear();
        why_ = error.what();
    }
}

} // namespace gnomon::app::view
