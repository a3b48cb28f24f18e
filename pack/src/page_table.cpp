// SPDX-License-Identifier: Apache-2.0
#include <gnomon/pack/page_table.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

namespace gnomon::pack {
namespace {

/// A node is two vectors, and no more than a word's upper half of them lie after another of one light.
constexpr std::uint32_t kMostNodes = 0x7FFFU;

/// Which square of its light's root a page is, among 2^depth on a side.
struct PagePlace {
    std::uint32_t depth = 0;
    std::uint32_t x = 0;
    std::uint32_t y = 0;
};

/// The part of a row across that is the divisor's: of a page's, minus its middle in halves of its side. It is the
/// constant under parallel rays, else what is along the axis.
double middleOf(const glm::dvec4& row, const glm::dvec4& divisor)
{
    const glm::dvec3 axis(divisor);
    return axis == glm::dvec3(0.0) ? row.w : glm::dot(glm::dvec3(row), axis);
}

double sharpnessOf(const ViewSector& sector)
{
    const glm::dvec3 across = glm::dvec3(sector.x) - glm::dvec3(sector.w) * middleOf(sector.x, sector.w);
    const bool is_parallel = glm::dvec3(sector.w) == glm::dvec3(0.0);
    return glm::length(is_parallel ? glm::dvec3(sector.x) : across);
}

PagePlace placeOf(const ViewSector& root, const ViewSector& page)
{
    const double times = sharpnessOf(page) / sharpnessOf(root);
    const auto middles = [](const ViewSector& sector) {
        return glm::dvec2(middleOf(sector.x, sector.w), middleOf(sector.y, sector.w));
    };
    // From the root's low end to the page's middle, in sides of the page.
    const glm::dvec2 middle = 0.5 * (glm::dvec2(times) + times * middles(root) - middles(page));
    PagePlace place;
    place.depth = static_cast<std::uint32_t>(std::lround(std::log2(times)));
    place.x = static_cast<std::uint32_t>(middle.x);
    place.y = static_cast<std::uint32_t>(middle.y);
    return place;
}

/// The tree below one of a light's roots.
class TableOfRoot {
public:
    /// `views`: the light's.
    TableOfRoot(std::vector<glm::uvec2>& out, std::span<const View> views, std::uint32_t root)
        : out_(out), first_(out.size())
    {
        const ViewSector& sector = views[root].serves.sector;
        addNode(root);
        for (std::uint32_t view = root; view-- > 0;) { // coarse ones first
            if (views[view].serves.sector.w == sector.w) {
                add(placeOf(sector, views[view].serves.sector), view);
            }
        }
    }
    [[nodiscard]] std::uint32_t first() const { return static_cast<std::uint32_t>(first_); }

private:
    void add(const PagePlace& place, std::uint32_t view)
    {
        std::size_t node = first_;
        for (std::uint32_t left = place.depth; left-- > 0;) {
            std::uint32_t& word = out_[node + (place.y >> left & 1U)][static_cast<int>(place.x >> left & 1U)];
            if (left == 0) {
                word = (word & 0xFFFF0000U) | view;
            } else if (word >> 16U != 0) {
                node += word >> 16U;
            } else if (count_ == kMostNodes) {
                return; // it is served by the page around it
            } else {
                const std::uint32_t served = word & 0xFFFFU;
                word |= static_cast<std::uint32_t>(out_.size() - node) << 16U;
                node = out_.size();
                addNode(served);
            }
        }
    }
    void addNode(std::uint32_t served)
    {
        ++count_;
        out_.insert(out_.end(), 2, glm::uvec2(served));
    }

    std::vector<glm::uvec2>& out_;
    std::size_t first_;
    std::uint32_t count_ = 0;
};

/// Of which face of the cube around a light its root is, if it has several.
std::uint32_t faceOf(const ViewSector& root)
{
    const glm::dvec3 axis(root.w);
    const int number = std::abs(axis.x) > 0.5 ? 0 : std::abs(axis.y) > 0.5 ? 1 : 2;
    return static_cast<std::uint32_t>(number + (axis[number] < 0.0 ? 3 : 0));
}

/// Its entries from `first` on, and its nodes.
void addLight(std::span<const View> views, std::uint32_t first_view, std::size_t first, std::vector<glm::uvec2>& out)
{
    const double coarsest = sharpnessOf(views.back().serves.sector);
    const auto last = static_cast<std::uint32_t>(views.size()) - 1;
    for (std::uint32_t view = last + 1; view-- > 0;) {
        const ViewSector& sector = views[view].serves.sector;
        if (sharpnessOf(sector) > 1.5 * coarsest) {
            return; // all roots were before
        }
        const TableOfRoot table(out, views, view);
        const glm::uvec2 entry(table.first() - 1, first_view + view);
        if (view == last) { // a face without a root finds pages that do not show it
            std::fill_n(out.begin() + static_cast<std::ptrdiff_t>(first), kPageFaces, entry);
        }
        out[first + faceOf(sector)] = entry;
    }
}

} // namespace

bool hasPages(const ResolvedOptions& options)
{
    return options.technique().partition == Partition::virtual_pages;
}

void fillPageTable(const Plan& plan, std::vector<glm::uvec2>& out)
{
    out.clear();
    const auto isPaged = [&](const LightPlan& light) {
        return light.outcome.hasMap() && light.view_count > 0 && light.view_count <= 0xFFFFU &&
               hasPages((*plan.options)[light.options]);
    };
    if (std::ranges::none_of(plan.lights, isPaged)) {
        return;
    }
    out.resize(kPageFaces * plan.lights.size(), glm::uvec2(0));
    for (std::size_t i = 0; i < plan.lights.size(); ++i) {
        const LightPlan& light = plan.lights[i];
        if (!isPaged(light)) {
            continue;
        }
        addLight(std::span(plan.views).subspan(light.first_view, light.view_count), light.first_view, kPageFaces * i,
                 out);
    }
}

} // namespace gnomon::pack
