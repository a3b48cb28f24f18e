// SPDX-License-Identifier: Apache-2.0
// Based on: M. Giegl, M. Wimmer, "Fitted virtual shadow maps", 2007; R. Fernando et al., "Adaptive shadow maps", 2001;
// A. Lefohn et al., "Resolution-matched shadow maps", 2007; O. Olsson et al., "Efficient virtual shadow maps for many
// lights", 2014.
// Departure: no page shares its texels with the next. Each has a border of its own, which holds what its filter reads
// around a receiver, so every filter of depths reads a page as it reads any map.
#include "partition/virtual.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon {
namespace {

/// A cell of a picture without an edge counts for this much of an edge: the next picture may have one there.
constexpr double kUnknownEdge = 0.05;

const PageRequests* requestsOf(const Frame& frame, std::uint32_t key)
{
    const auto found = std::ranges::find(frame.requests, key, &PageRequests::light_key);
    return found != frame.requests.end() && !frame.cut ? &*found : nullptr;
}

ViewPage squareIn(const PageKey& root, const PageKey& page)
{
    const int depth = root.level - page.level;
    const auto placed = [&](std::int64_t at, std::int64_t low) { // both in quarters of a side
        return static_cast<std::uint32_t>((at - (low << depth)) / 4);
    };
    return {page.face, static_cast<std::uint32_t>(depth), placed(page.x, root.x), placed(page.y, root.y)};
}

/// The texels that a light's pages may have together.
std::uint64_t pageTexels(const ResolvedOptions& options, const Light& light)
{
    const std::uint32_t largest = options.largestSide(light.type);
    const std::uint64_t side = light.map_size != 0 ? std::clamp(light.map_size, kSmallestMap, largest) : largest;
    const bool by_side = options.asked().map_size || light.map_size != 0; // as a cube's
    return by_side ? side * side * pageFaces(light) : texelsOf(options.asked(), light.type);
}

} // namespace

void VirtualPartition::follow(std::span<const Light> lights)
{
    keys_.clear();
    for (const Light& light : lights) {
        keys_.push_back(light.key);
    }
    rows_.follow(keys_);
    memories_.resize(std::max<std::size_t>(memories_.size(), rows_.end()));
    for (const std::uint32_t row : rows_.gone()) {
        memories_[row] = {};
    }
    found_.assign(lights.size(), {});
    spaces_.clear();
    pages_.clear();
    casters_.clear();
}

std::span<const VirtualPage> VirtualPartition::pagesOf(std::size_t light) const
{
    return std::span(pages_).subspan(found_[light].first_page, found_[light].page_count);
}

void VirtualPartition::divide(const Input& input, std::size_t light)
{
    Memory& memory = memories_[rows_.rowOf(light)];
    Found& found = found_[light];
    const ResolvedOptions& options = input.recipe.resolved;
    found.texels = pageTexels(options, input.light);
    const std::uint64_t faces = pageFaces(input.light);
    found.side = std::min(kPageSide, options.largestSide(input.light.type));
    while (found.side > kSmallestMap && faces * found.side * found.side > found.texels) {
        found.side /= 2; // each root has a page
    }
    found.border = std::max(options.integratesLight() ? kPageBorder : 0.0, options.borderOf(found.side) / found.side);
    listRoots(input, found);
    if (found.outcome.kind != OutcomeKind::ok) {
        return;
    }
    const PageSpread spread =
        options.integratesLight() ? pageSpreadOf(input.light, spaces_[found.first_space]) : PageSpread{};
    widenPages(input, spread, found);
    listPoints(input, found);
    forgetOther(found, memory);
    const double side = found.side;
    const double border = found.border * side;
    const std::uint64_t most = std::max<std::uint64_t>(found.texels / (std::uint64_t{found.side} * found.side), 1);
    tree_.divide({roots_, points_, boxes_, side - 2.0 * border, border,
                  tileMarginTexels(static_cast<double>(options.reach_texels())), spread.spread, spread.slant,
                  static_cast<std::uint32_t>(most), memory.taken, input.rested});
    memory.taken.assign(tree_.taken().begin(), tree_.taken().end());
    namePages(memory, found);
}

/// Around a light with a place something may cast so near to it, as a lampshade does, that no page narrower than the
/// roots has room for the rays. Then these get the texels.
void VirtualPartition::widenPages(const Input& input, const PageSpread& spread, Found& found) const
{
    if (!spaces_[found.first_space].space.perspective) {
        return;
    }
    double nearest = -std::numeric_limits<double>::infinity(); // over all of a root, of that where it is farthest
    for (const PageRoot& root : roots_) {
        const glm::dvec2 low = lowOf(root.key);
        const glm::dvec2 high = low + gnomon::sideOf(root.key);
        double own = root.caster_count > 0 ? 0.0 : nearest;
        for (const PageCaster& box : std::span(boxes_).subspan(root.first_caster, root.caster_count)) {
            const bool covers =
                glm::all(glm::lessThanEqual(box.low, low)) && glm::all(glm::lessThanEqual(high, box.high));
            own = covers ? std::min(own, nearestOver(box, low, high)) : own;
        }
        nearest = std::max(nearest, own);
    }
    const double room = gnomon::sideOf(roots_.front().key) * found.border / (1.0 - 2.0 * found.border);
    const std::uint64_t faces = pageFaces(input.light);
    const std::uint32_t largest = input.recipe.resolved.largestSide(input.light.type);
    while (-nearest * spread.spread > 0.5 * room && 2 * found.side <= largest &&
           faces * 4 * found.side * found.side <= found.texels) {
        found.side *= 2;
    }
}

/// A root in which nobody is seen, or nobody casts, has no pages; the light has some when any root does.
void VirtualPartition::listRoots(const Input& input, Found& found)
{
    found.first_space = static_cast<std::uint32_t>(spaces_.size());
    found.outcome = {OutcomeKind::no_receiver, "nothing that the camera sees is in the light's reach"};
    roots_.clear();
    boxes_.clear();
    const std::uint32_t faces = pageFaces(input.light);
    for (std::uint32_t face = 0; face < faces; ++face) {
        PageRoot& root = roots_.emplace_back();
        const bool whole = faces == 1;
        const Slice slice = whole ? wholeSlice(input.light) : cubeFace(input.light, static_cast<int>(face));
        spaces_.push_back(pageSpaceOf(input.light, slice, input.camera.scene_ws));
        root.key = {1, face, -2, -2}; // from -1 to 1
        if (!whole && !shinesIntoFace(input.light, slice)) {
            continue;
        }
        const Outcome outcome = addRoot(input, slice, found.border, root);
        const bool says_more = outcome.kind == OutcomeKind::ok || outcome.kind == OutcomeKind::degenerate || whole;
        if (says_more || found.outcome.kind == OutcomeKind::no_receiver) {
            found.outcome = outcome;
        }
    }
}

Outcome VirtualPartition::addRoot(const Input& input, const Slice& slice, double border, PageRoot& root)
{
    PageSpace& space = spaces_.back();
    if (const Outcome seen = region_.gatherReceivers(
            {space.space, slice, input.camera, *input.frame.objects, input.receivers, false, input.light.groups});
        seen.kind != OutcomeKind::ok) {
        return seen;
    }
    if (!space.space.perspective) {
        root.key = rootAround(region_.rect(), 32.0 * input.camera.pad_m);
    }
    listCasters(input, space, border, root);
    if (root.caster_count == 0) {
        return {OutcomeKind::no_caster, "nothing can throw a shadow on what the camera sees"};
    }
    space.range = pageDepths(space, input.frame.objects->bounds(), std::span(boxes_).subspan(root.first_caster),
                             input.camera.pad_m);
    return {};
}

/// What was known of pages that showed something else.
void VirtualPartition::forgetOther(const Found& found, Memory& memory) const
{
    const PageSpace& first = spaces_[found.first_space];
    if (memory.place_ws != first.space.origin_ws || memory.direction_ws != first.space.forward_ws ||
        memory.unit != first.unit) {
        memory.pages.clear();
        memory.taken.clear();
    }
    memory.place_ws = first.space.origin_ws;
    memory.direction_ws = first.space.forward_ws;
    memory.unit = first.unit;
}

/// A square of the grid around a rectangle. Its low corner is a multiple of a quarter of its side, so that all but the
/// coarsest pages stay where they are when it moves.
PageKey VirtualPartition::rootAround(const LightRect& rect, double least_m)
{
    constexpr double kRoom = 1.0 / 64.0; // on each side, for what rounding moves
    const glm::dvec2 size = rect.high - rect.low;
    const double length = std::max({size.x, size.y, least_m});
    PageKey root;
    root.level = static_cast<int>(std::ceil(std::log2(length * (4.0 / 3.0) * (1.0 + 2.0 * kRoom))));
    const double quarter = 0.25 * gnomon::sideOf(root);
    root.x = static_cast<std::int64_t>(std::floor((rect.low.x - kRoom * length) / quarter));
    root.y = static_cast<std::int64_t>(std::floor((rect.low.y - kRoom * length) / quarter));
    return root;
}

/// All that may cast into the root, seen or not, so that a page's casters do not change with the camera.
void VirtualPartition::listCasters(const Input& input, const PageSpace& space, double border_share, PageRoot& root)
{
    const double side = gnomon::sideOf(root.key);
    const double border = side * border_share / (1.0 - 2.0 * border_share);
    planesAroundPage(space, lowOf(root.key) - border, lowOf(root.key) + side + border, planes_);
    objects_.clear();
    input.frame.objects->query(planes_, ObjectSet::Want::casters, objects_, input.light.groups);
    root.first_caster = static_cast<std::uint32_t>(boxes_.size());
    const std::span<const Aabb> bounds = input.frame.objects->allBounds();
    for (const std::uint32_t object : objects_) {
        if (const std::optional<PageCaster> caster = pageCasterOf(space, object, bounds[object])) {
            boxes_.push_back(*caster);
        }
    }
    root.caster_count = static_cast<std::uint32_t>(boxes_.size()) - root.first_caster;
}

void VirtualPartition::listPoints(const Input& input, const Found& found)
{
    points_.clear();
    if (const PageRequests* const requests = requestsOf(input.frame, input.light.key)) {
        addRequested(input, *requests, found);
    }
    if (!points_.empty()) {
        return;
    }
    for (const SightPoint& seen : input.sight.points()) {
        addPoint(input.light, found, seen.p_ws, seen.facing_m, 1.0);
    }
}

void VirtualPartition::addRequested(const Input& input, const PageRequests& requests, const Found& found)
{
    const glm::dmat4 world_from_clip = glm::inverse(requests.clip_from_world);
    const glm::dvec2 per_pixel = 2.0 / glm::max(glm::dvec2(requests.size_px), glm::dvec2(1.0));
    const auto worldAt = [&](const glm::dvec2& pixel, double depth) {
        const glm::dvec4 h = world_from_clip * glm::dvec4(pixel * per_pixel - 1.0, depth, 1.0);
        return glm::dvec3(h) / h.w;
    };
    for (const SeenCell& cell : requests.cells) {
        if (!(cell.edge >= 0.0F)) {
            continue;
        }
        const glm::dvec2 pixel(cell.place_px);
        const double depth = static_cast<double>(cell.depth);
        const glm::dvec3 p_ws = worldAt(pixel, depth);
        const double pixel_m = glm::distance(worldAt(pixel + glm::dvec2(1.0, 0.0), depth), p_ws);
        addPoint(input.light, found, p_ws, pixel_m, kUnknownEdge + static_cast<double>(cell.edge));
    }
}

void VirtualPartition::addPoint(const Light& light, const Found& found, const glm::dvec3& p_ws, double pixel_m,
                                double weight)
{
    if (!(pixel_m > 0.0) || !std::isfinite(p_ws.x + p_ws.y + p_ws.z + pixel_m + weight)) {
        return;
    }
    const std::uint32_t face = pageFaceAt(light, p_ws);
    if (roots_[face].caster_count == 0) {
        return;
    }
    if (std::optional<PagePoint> point = pagePointOf(light, spaces_[found.first_space + face], p_ws, pixel_m)) {
        point->face = face;
        point->weight = weight;
        points_.push_back(*point);
    }
}

/// A page keeps its name as long as it is there.
void VirtualPartition::namePages(Memory& memory, Found& found)
{
    found.first_page = static_cast<std::uint32_t>(pages_.size());
    memory.next.clear();
    for (const FoundPage& one : tree_.pages()) {
        const auto known = std::ranges::lower_bound(memory.pages, one.key, {}, &Known::key);
        const bool is_known = known != memory.pages.end() && known->key == one.key;
        const Known named{one.key, is_known ? known->id : memory.next_id++};
        memory.next.push_back(named);
        VirtualPage& page = pages_.emplace_back();
        page.id = named.id;
        page.key = one.key;
        page.square = squareIn(roots_[one.key.face].key, one.key);
        page.first_caster = static_cast<std::uint32_t>(casters_.size());
        for (const std::uint32_t caster : tree_.castersOf(one)) {
            casters_.push_back(boxes_[caster].object);
        }
        page.caster_count = static_cast<std::uint32_t>(casters_.size()) - page.first_caster;
    }
    std::swap(memory.pages, memory.next);
    found.page_count = static_cast<std::uint32_t>(pages_.size()) - found.first_page;
}

void VirtualPartition::project(std::size_t light, const VirtualPage& page, std::uint32_t side, View& view) const
{
    projectPage(spaces_[found_[light].first_space + page.key.face], page.key, side, found_[light].border, view);
    view.serves.page = page.square;
}

} // namespace gnomon
