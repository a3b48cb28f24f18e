// SPDX-License-Identifier: Apache-2.0
#include <gnomon/pack/page_table.h>

#include <algorithm>
#include <cstdint>
#include <span>

namespace gnomon::pack {
namespace {

/// A node is two vectors, and no more than a word's upper half of them lie after another of one light.
constexpr std::uint32_t kMostNodes = 0x7FFFU;

/// The tree below one of a light's roots.
class TableOfRoot {
public:
    /// `views`: the light's.
    TableOfRoot(std::vector<glm::uvec2>& out, std::span<const View> views, std::uint32_t root)
        : out_(out), first_(out.size())
    {
        addNode(root);
        for (std::uint32_t view = root; view-- > 0;) { // coarse ones first
            if (const ViewPage& page = views[view].serves.page; page.face == views[root].serves.page.face) {
                add(page, view);
            }
        }
    }
    [[nodiscard]] std::uint32_t first() const { return static_cast<std::uint32_t>(first_); }

private:
    void add(const ViewPage& place, std::uint32_t view)
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

/// Its entries from `first` on, and its nodes.
void addLight(std::span<const View> views, std::uint32_t first_view, std::size_t first, std::vector<glm::uvec2>& out)
{
    const auto last = static_cast<std::uint32_t>(views.size()) - 1;
    for (std::uint32_t view = last + 1; view-- > 0 && views[view].serves.page.depth == 0;) { // roots are last
        const TableOfRoot table(out, views, view);
        const glm::uvec2 entry(table.first() - 1, first_view + view);
        if (view == last) { // a face without a root finds pages that do not show it
            std::fill_n(out.begin() + static_cast<std::ptrdiff_t>(first), kPageFaces, entry);
        }
        out[first + views[view].serves.page.face] = entry;
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
