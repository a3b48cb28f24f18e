// SPDX-License-Identifier: Apache-2.0
#include "view/map_inset.h"

#include <gnomon/error.h>
#include <gnomon/pack/filter_rule.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::app::view {
namespace {

constexpr std::uint32_t kSide_px = 160; // of a page
constexpr std::uint32_t kGap_px = 6;
constexpr std::uint32_t kColumns = 2;
constexpr std::size_t kMostPages = 6; // of more the first ones are shown

struct Page {
    const ImageF& texels;
    const ResolvedOptions& options;
    double scale;       // texels for a pixel of the inset
    glm::uvec2 at_px;   // in the inset
    glm::uvec2 size_px; // likewise
};

/// Layers that hold maps of this plan, ascending.
std::vector<std::uint32_t> pagesOf(const Plan& plan)
{
    std::vector<std::uint32_t> pages;
    for (const View& view : plan.views) {
        if (view.place.tile.width > 0) {
            pages.push_back(view.place.tile.layer);
        }
    }
    std::sort(pages.begin(), pages.end());
    pages.erase(std::unique(pages.begin(), pages.end()), pages.end());
    pages.resize(std::min(pages.size(), kMostPages));
    return pages;
}

/// One map's depths, stretched from black to white.
void paintMap(Image8& picture, const Page& page, const View& view)
{
    const Tile& tile = view.place.tile;
    const auto first_x = static_cast<std::uint32_t>(std::ceil(tile.x / page.scale));
    const auto first_y = static_cast<std::uint32_t>(std::ceil(tile.y / page.scale));
    const auto end_x = std::min(page.size_px.x, static_cast<std::uint32_t>((tile.x + tile.width) / page.scale));
    const auto end_y = std::min(page.size_px.y, static_cast<std::uint32_t>((tile.y + tile.height) / page.scale));
    const auto depthAt = [&](std::uint32_t x, std::uint32_t y) {
        const auto from_x = std::min(static_cast<std::uint32_t>((x + 0.5) * page.scale), page.texels.width - 1);
        const auto from_y = std::min(static_cast<std::uint32_t>((y + 0.5) * page.scale), page.texels.height - 1);
        return pack::mapDepth(page.options, {page.texels.pixel(from_x, from_y), page.texels.channels}, view.place.part);
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
            std::fill_n(picture.pixel(page.at_px.x + x, page.at_px.y + y), 3,
                        static_cast<std::uint8_t>(std::lround(share * 255.0F)));
        }
    }
}

} // namespace

void MapInset::paintPage(Viewer& viewer, std::uint32_t layer, const glm::uvec2& at, Image8& picture)
{
    const Plan& plan = viewer.renderer().plan();
    const ResolvedOptions options = resolvedOrThrow(viewer.settings().shadow);
    const ImageF texels = viewer.renderer().readMap(layer * imageLayersPerMap(options.filter(), options.moments()));
    const double scale = static_cast<double>(std::max(texels.width, texels.height)) / kSide_px;
    const glm::dvec2 size = glm::dvec2(texels.width, texels.height) / scale;
    const Page page{texels, options, scale, at, glm::uvec2(size)};
    const glm::dvec2 whole(picture.width, picture.height);
    for (std::uint32_t i = 0; i < plan.views.size(); ++i) {
        const View& view = plan.views[i];
        if (view.place.tile.layer == layer && view.place.tile.width > 0) {
            paintMap(picture, page, view);
            squares_.push_back({(glm::dvec2(at) + glm::dvec2(view.place.tile.x, view.place.tile.y) / scale) / whole,
                                glm::dvec2(view.place.tile.width, view.place.tile.height) / scale / whole, view.light,
                                i - plan.lights[view.light].first_view, view.contents.redraw});
        }
    }
}

void MapInset::take(Viewer& viewer)
{
    const std::vector<std::uint32_t> pages = pagesOf(viewer.renderer().plan());
    if (pages.empty()) {
        why_ = "no light has a map";
        return;
    }
    const auto count = static_cast<std::uint32_t>(pages.size());
    const std::uint32_t columns = std::min(count, kColumns);
    const std::uint32_t rows = (count + columns - 1) / columns;
    Image8 picture(columns * (kSide_px + kGap_px) - kGap_px, rows * (kSide_px + kGap_px) - kGap_px, 3);
    for (std::uint32_t i = 0; i < count; ++i) {
        paintPage(viewer, pages[i], glm::uvec2(i % columns, i / columns) * (kSide_px + kGap_px), picture);
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
