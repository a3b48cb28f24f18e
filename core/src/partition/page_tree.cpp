// SPDX-License-Identifier: Apache-2.0
#include "partition/page_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace gnomon {
namespace {

/// Texels narrower than this share of a pixel gain nothing.
constexpr double kFinestShare = 0.125;
/// A page that is there gains so many times more than one that would have to be drawn: at rest from the eighth frame on
/// twice as many in each, because edges are those of the pages themselves, and may change with them for ever.
double stays(std::uint32_t rested)
{
    constexpr std::uint32_t kFree = 8;
    return 1.25 * std::exp2(std::min(std::max(rested, kFree) - kFree, 64U));
}
/// No page is so many times narrower than the root, as a power of two.
constexpr int kDeepest = 24;

/// What a texel's width, in pixels, costs in squared error: an edge is misplaced by a part of it, over as many pixels.
double errorOf(double texel_px)
{
    return std::max(texel_px, kFinestShare);
}

} // namespace

double sideOf(const PageKey& key)
{
    return std::exp2(key.level);
}

glm::dvec2 lowOf(const PageKey& key)
{
    return glm::dvec2(static_cast<double>(key.x), static_cast<double>(key.y)) * (0.25 * sideOf(key));
}

double nearestOver(const PageCaster& caster, const glm::dvec2& low, const glm::dvec2& high)
{
    double enters = caster.nearest;
    for (const glm::dvec3& face : caster.faces) {
        enters = std::max(enters,
                          face.z + face.x * (face.x > 0.0 ? low.x : high.x) + face.y * (face.y > 0.0 ? low.y : high.y));
    }
    return enters;
}

void PageTree::divide(const Input& input)
{
    stays_ = stays(input.rested);
    addRoots(input);
    const auto later = [this](const Wish& a, const Wish& b) {
        return comesLater(a, b);
    };
    while (!wishes_.empty() && page_count_ < input.most_pages) {
        std::ranges::pop_heap(wishes_, later);
        const std::uint32_t node = wishes_.back().node;
        wishes_.pop_back();
        take(node);
        addQuarters(input, node);
    }
    listPages();
}

bool PageTree::comesLater(const Wish& a, const Wish& b) const
{
    return a.gain != b.gain ? a.gain < b.gain : nodes_[b.node].key < nodes_[a.node].key;
}

void PageTree::addRoots(const Input& input)
{
    nodes_.clear();
    wishes_.clear();
    order_.resize(input.points.size());
    std::iota(order_.begin(), order_.end(), 0U);
    casters_.resize(input.casters.size());
    std::iota(casters_.begin(), casters_.end(), 0U);
    auto first = order_.begin();
    for (const PageRoot& root : input.roots) {
        const auto end = std::partition(first, order_.end(),
                                        [&](std::uint32_t point) { return input.points[point].face == root.key.face; });
        if (root.caster_count > 0) {
            Node node;
            node.key = root.key;
            node.first_point = static_cast<std::uint32_t>(first - order_.begin());
            node.point_count = static_cast<std::uint32_t>(end - first);
            node.first_caster = root.first_caster;
            node.caster_count = root.caster_count;
            node.served = sideOf(root.key) / input.inner_texels;
            node.mapped = true;
            nodes_.push_back(node);
        }
        first = end;
    }
    page_count_ = static_cast<std::uint32_t>(nodes_.size());
    for (std::uint32_t root = 0; root < page_count_; ++root) {
        addQuarters(input, root);
    }
}

void PageTree::addQuarters(const Input& input, std::uint32_t parent)
{
    const Node node = nodes_[parent];
    const double half = 0.5 * sideOf(node.key);
    const glm::dvec2 middle = lowOf(node.key) + half;
    const auto begin = order_.begin() + node.first_point;
    const auto end = begin + node.point_count;
    const auto split = [&](auto first, auto last, int axis) {
        return std::partition(first, last,
                              [&](std::uint32_t point) { return input.points[point].at[axis] < middle[axis]; });
    };
    const auto above = split(begin, end, 1);
    const std::array bounds{begin, split(begin, above, 0), above, split(above, end, 0), end};
    for (std::size_t i = 0; i < 4; ++i) {
        // Its low corner is the parent's, or half a side on: in quarters of its own side 0 or 4 more.
        const PageKey key{node.key.level - 1, node.key.face, 2 * node.key.x + 4 * static_cast<std::int64_t>(i & 1U),
                          2 * node.key.y + 4 * static_cast<std::int64_t>(i >> 1U)};
        addQuarter(input, parent, key, static_cast<std::uint32_t>(bounds[i] - order_.begin()),
                   static_cast<std::uint32_t>(bounds[i + 1] - bounds[i]));
    }
}

/// Where nobody looks, or nobody casts, a finer page gains nothing. One without room for the rays of what it serves is
/// passed over for its quarters, of which some may have room: fewer casters are over them.
void PageTree::addQuarter(const Input& input, std::uint32_t parent, const PageKey& key, std::uint32_t first,
                          std::uint32_t count)
{
    Node node;
    node.key = key;
    node.depth = nodes_[parent].depth + 1;
    if (count == 0 || node.depth > kDeepest) {
        return;
    }
    node.parent = parent;
    node.first_point = first;
    node.point_count = count;
    node.served = nodes_[parent].served;
    const double gain = gainOf(input, node);
    if (!(gain > 0.0) || !listCasters(input, nodes_[parent], node)) {
        return;
    }
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back(node);
    if (!holdsRays(input, node)) {
        addQuarters(input, index);
        return;
    }
    const bool is_known = std::ranges::binary_search(input.known, key);
    nodes_[index].served = sideOf(key) / input.inner_texels;
    wishes_.push_back({is_known ? gain * stays_ : gain, index});
    std::ranges::push_heap(wishes_, [this](const Wish& a, const Wish& b) { return comesLater(a, b); });
}

/// Those of its parent's casters that reach into it or its border. False: there are none.
bool PageTree::listCasters(const Input& input, const Node& parent, Node& node)
{
    const double side = sideOf(node.key);
    const double border = side / input.inner_texels * (input.border_texels + 1.0);
    const glm::dvec2 low = lowOf(node.key) - border;
    const glm::dvec2 high = lowOf(node.key) + side + border;
    node.first_caster = static_cast<std::uint32_t>(casters_.size());
    for (std::uint32_t i = 0; i < parent.caster_count; ++i) {
        const std::uint32_t caster = casters_[parent.first_caster + i];
        const PageCaster& box = input.casters[caster];
        if (box.low.x <= high.x && box.low.y <= high.y && box.high.x >= low.x && box.high.y >= low.y) {
            casters_.push_back(caster);
        }
    }
    node.caster_count = static_cast<std::uint32_t>(casters_.size()) - node.first_caster;
    return node.caster_count > 0;
}

/// Does the border hold the rays from all its points to the light's rim, as far as somebody may cast?
bool PageTree::holdsRays(const Input& input, const Node& node) const
{
    const double side = sideOf(node.key);
    const double texel = side / input.inner_texels;
    if (!(input.spread > 0.0)) {
        return true;
    }
    const double border = texel * input.border_texels;
    const glm::dvec2 low = lowOf(node.key) - border;
    const glm::dvec2 high = lowOf(node.key) + side + border;
    const double outmost = std::max({-low.x, -low.y, high.x, high.y});
    const double spread = input.spread * std::sqrt(1.0 + input.slant * outmost * outmost);
    double near = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < node.caster_count; ++i) {
        const PageCaster& box = input.casters[casters_[node.first_caster + i]];
        near = std::min(near, nearestOver(box, low, high));
    }
    double far = -std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < node.point_count; ++i) {
        far = std::max(far, input.points[order_[node.first_point + i]].depth);
    }
    return (far - near) * spread + input.reach_texels * texel <= border;
}

/// By how much the squared error of its points falls with it.
double PageTree::gainOf(const Input& input, const Node& node) const
{
    const double texel = sideOf(node.key) / input.inner_texels;
    double gain = 0.0;
    for (std::uint32_t i = 0; i < node.point_count; ++i) {
        const PagePoint& point = input.points[order_[node.first_point + i]];
        gain += point.weight * (errorOf(node.served / point.pixel) - errorOf(texel / point.pixel));
    }
    return gain;
}

/// Gives a node its page. Pages around it are given up that have nothing left to serve.
void PageTree::take(std::uint32_t node)
{
    nodes_[node].mapped = true;
    nodes_[node].taken = true;
    ++page_count_;
    std::uint32_t up = nodes_[node].parent;
    while (up != kNone && ++nodes_[up].covered == 4) {
        const bool was_covered = nodes_[up].mapped;
        if (was_covered && nodes_[up].parent != kNone) {
            nodes_[up].mapped = false;
            --page_count_;
        }
        up = was_covered ? kNone : nodes_[up].parent;
    }
}

void PageTree::listPages()
{
    pages_.clear();
    taken_.clear();
    for (const Node& node : nodes_) {
        if (node.taken) {
            taken_.push_back(node.key);
        }
        if (node.mapped) {
            pages_.push_back({node.key, node.first_caster, node.caster_count});
        }
    }
    std::ranges::sort(pages_, {}, &FoundPage::key);
    std::ranges::sort(taken_);
}

} // namespace gnomon
