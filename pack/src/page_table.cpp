// SPDX-License-Identifier: Apache-2.0
#include <gnomon/pack/page_table.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

namespace gnomon::pack {
namespace {

constexpr std::uint32_t kMostNodes = 0xFFFFU;

/// Which square of its light's root a page is, among 2^depth on a side.
struct PagePlace {
    std::uint32_t depth = 0;
    std::uint32_t x = 0;
    std::uint32_t y = 0;
};

PagePlace placeOf(const ViewSector& root, const ViewSector& page)
{
    const double times = glm::length(glm::dvec3(page.x)) / glm::length(glm::dvec3(root.x));
    // From the root's low end to the page's middle, in sides of the page.
    const glm::dvec2 middle =
        0.5 * (glm::dvec2(times) + times * glm::dvec2(root.x.w, root.y.w) - glm::dvec2(page.x.w, page.y.w));
    PagePlace place;
    place.depth = static_cast<std::uint32_t>(std::lround(std::log2(times)));
    place.x = static_cast<std::uint32_t>(middle.x);
    place.y = static_cast<std::uint32_t>(middle.y);
    return place;
}

class TableOfLight {
public:
    TableOfLight(std::vector<glm::uvec2>& out, std::uint32_t root_view) : out_(out), first_(out.size())
    {
        addNode(root_view);
    }
    /// Coarse ones first.
    void add(const PagePlace& place, std::uint32_t view)
    {
        std::uint32_t node = 1;
        for (std::uint32_t left = place.depth; left-- > 0;) {
            std::uint32_t& word = wordOf(node, place.x >> left & 1U, place.y >> left & 1U);
            if (left == 0) {
                word = (word & 0xFFFF0000U) | view;
            } else if (word >> 16U != 0) {
                node = word >> 16U;
            } else if (count_ == kMostNodes) {
                return; // it is served by the page around it
            } else {
                const std::uint32_t served = word & 0xFFFFU;
                node = count_ + 1;
                word |= node << 16U;
                addNode(served);
            }
        }
    }

private:
    std::uint32_t& wordOf(std::uint32_t node, std::uint32_t x, std::uint32_t y)
    {
        return out_[first_ + 2 * std::size_t{node - 1} + y][static_cast<int>(x)];
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
    out.resize(plan.lights.size() + 2, glm::uvec2(0)); // so that the first node's place, less two, is none of these
    for (std::size_t i = 0; i < plan.lights.size(); ++i) {
        const LightPlan& light = plan.lights[i];
        if (!isPaged(light)) {
            continue;
        }
        out[i].x = static_cast<std::uint32_t>(out.size()) - 2;
        const std::span views = std::span(plan.views).subspan(light.first_view, light.view_count);
        const ViewSector& root = views.back().serves.sector;
        const std::uint32_t last = light.view_count - 1;
        TableOfLight table(out, last);
        for (std::uint32_t view = last; view-- > 0;) {
            table.add(placeOf(root, views[view].serves.sector), view);
        }
    }
}

} // namespace gnomon::pack
