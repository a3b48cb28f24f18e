// SPDX-License-Identifier: Apache-2.0
// Based on: M. Giegl, M. Wimmer, "Fitted virtual shadow maps", 2007; R. Fernando et al., "Adaptive shadow maps", 2001;
// A. Lefohn et al., "Resolution-matched shadow maps", 2007; O. Olsson et al., "Efficient virtual shadow maps for many
// lights", 2014.
// Departure: no page shares its texels with the next. Each has a border of its own, which holds what its filter reads
// around a receiver, so every filter of depths reads a page as it reads any map.
#include "partition/virtual.h"

#include "motion/steps.h"

#include <gnomon/plan_views.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

/// A cell of a picture without an edge counts for this much of an edge: the next picture may have one there.
constexpr double kUnknownEdge = 0.05;

/// How deep along the light a scene reaches, in steps, so that pages hold while something moves.
DepthRange depthsOf(const LightSpace& space, const Aabb& scene_ws, double pad_m)
{
    const glm::dvec3 centre = 0.5 * (glm::dvec3(scene_ws.min) + glm::dvec3(scene_ws.max));
    const glm::dvec3 half = 0.5 * (glm::dvec3(scene_ws.max) - glm::dvec3(scene_ws.min));
    const double middle_m = space.coordinates(centre).z;
    const double reach_m = glm::dot(glm::abs(space.depth_ws), half) + 32.0 * pad_m + kLeastRange * glm::length(half);
    const SteppedRange stepped = steppedRange(middle_m - reach_m, middle_m + reach_m);
    return {stepped.low, stepped.high};
}

PageCaster casterOf(const LightSpace& space, std::uint32_t object, const Aabb& box)
{
    constexpr double kAlong = 1e-6; // the cosine of faces that light does not come in by
    const glm::dvec3 centre = 0.5 * (glm::dvec3(box.min) + glm::dvec3(box.max));
    const glm::dvec3 half = 0.5 * (glm::dvec3(box.max) - glm::dvec3(box.min));
    const glm::dvec3 at = space.coordinates(centre);
    const glm::dvec2 reach(glm::dot(glm::abs(space.right_ws), half), glm::dot(glm::abs(space.up_ws), half));
    PageCaster caster;
    caster.object = object;
    caster.low = glm::dvec2(at) - reach;
    caster.high = glm::dvec2(at) + reach;
    caster.nearest_m = at.z - glm::dot(glm::abs(space.depth_ws), half);
    for (int axis = 0; axis < 3; ++axis) {
        const double along = space.depth_ws[axis];
        caster.faces[axis] = {0.0, 0.0, caster.nearest_m};
        if (std::abs(along) > kAlong) {
            const double enters = along > 0.0 ? centre[axis] - half[axis] : centre[axis] + half[axis];
            caster.faces[axis] = glm::dvec3(-space.right_ws[axis], -space.up_ws[axis], enters) / along;
        }
    }
    return caster;
}

const PageRequests* requestsOf(const Frame& frame, std::uint32_t key)
{
    const auto found = std::ranges::find(frame.requests, key, &PageRequests::light_key);
    return found != frame.requests.end() && !frame.cut ? &*found : nullptr;
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
    const Slice whole = wholeSlice(input.light);
    found.space = lightSpaceOf(input.light, whole.axis_ws, whole.half_angle_rad, input.camera.scene_ws);
    found.outcome = region_.gatherReceivers(
        {found.space, whole, input.camera, *input.frame.objects, input.receivers, false, input.light.groups});
    if (found.outcome.kind != OutcomeKind::ok) {
        return;
    }
    const ResolvedOptions& options = input.recipe.resolved;
    const std::uint32_t largest = options.largestSide(input.light.type);
    const std::uint32_t side = std::min(kPageSide, largest);
    found.border = std::max(kPageBorder, options.borderOf(side) / side);
    const PageKey root = rootAround(region_.rect(), 32.0 * input.camera.pad_m);
    listCasters(input, found.space, root, found.border);
    if (boxes_.empty()) {
        found.outcome = {OutcomeKind::no_caster, "nothing can throw a shadow on what the camera sees"};
        return;
    }
    found.range = depthsOf(found.space, input.frame.objects->bounds(), input.camera.pad_m);
    listPoints(input, found.space);
    if (memory.direction_ws != found.space.forward_ws) {
        memory.pages.clear();
        memory.taken.clear();
        memory.direction_ws = found.space.forward_ws;
    }
    const double border = found.border * side;
    const std::uint64_t together = input.light.map_size != 0 ? std::min(input.light.map_size, largest) : largest;
    const std::uint64_t texels = options.asked().map_size || input.light.map_size != 0
                                     ? together * together
                                     : texelsOf(options.asked(), input.light.type);
    const double spread = options.integratesLight() ? std::tan(0.5 * input.light.angular_diameter_rad) : 0.0;
    tree_.divide({root, points_, boxes_, side - 2.0 * border, border,
                  tileMarginTexels(static_cast<double>(options.reach_texels())), spread,
                  static_cast<std::uint32_t>(std::max<std::uint64_t>(texels / (std::uint64_t{side} * side), 1)),
                  memory.taken});
    memory.taken.assign(tree_.taken().begin(), tree_.taken().end());
    namePages(memory, found);
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
    const double quarter = 0.25 * sideOf(root);
    root.x = static_cast<std::int64_t>(std::floor((rect.low.x - kRoom * length) / quarter));
    root.y = static_cast<std::int64_t>(std::floor((rect.low.y - kRoom * length) / quarter));
    return root;
}

/// All that may cast into the root, seen or not, so that a page's casters do not change with the camera.
void VirtualPartition::listCasters(const Input& input, const LightSpace& space, const PageKey& root,
                                   double border_share)
{
    const double side = sideOf(root);
    const double border = side * border_share / (1.0 - 2.0 * border_share);
    const glm::dvec2 low = lowOf(root) - border;
    const glm::dvec2 high = lowOf(root) + side + border;
    const std::array planes{Plane{space.right_ws, -low.x}, Plane{-space.right_ws, high.x}, Plane{space.up_ws, -low.y},
                            Plane{-space.up_ws, high.y}};
    objects_.clear();
    input.frame.objects->query(planes, ObjectSet::Want::casters, objects_, input.light.groups);
    boxes_.clear();
    const std::span<const Aabb> bounds = input.frame.objects->allBounds();
    for (const std::uint32_t object : objects_) {
        boxes_.push_back(casterOf(space, object, bounds[object]));
    }
}

void VirtualPartition::listPoints(const Input& input, const LightSpace& space)
{
    points_.clear();
    if (const PageRequests* const requests = requestsOf(input.frame, input.light.key)) {
        addRequested(*requests, space);
    }
    if (!points_.empty()) {
        return;
    }
    for (const SightPoint& seen : input.sight.points()) {
        const glm::dvec3 at = space.coordinates(seen.p_ws);
        points_.push_back({glm::dvec2(at), at.z, seen.facing_m, 1.0});
    }
}

void VirtualPartition::addRequested(const PageRequests& requests, const LightSpace& space)
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
        const glm::dvec3 at = space.coordinates(p_ws);
        const double weight = kUnknownEdge + static_cast<double>(cell.edge);
        if (pixel_m > 0.0 && std::isfinite(at.x + at.y + at.z + pixel_m + weight)) {
            points_.push_back({glm::dvec2(at), at.z, pixel_m, weight});
        }
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
    const LightSpace& space = found_[light].space;
    const DepthRange& range = found_[light].range;
    const double length = sideOf(page.key);
    const double texel = length / (side * (1.0 - 2.0 * found_[light].border));
    const glm::dvec2 centre = lowOf(page.key) + 0.5 * length;
    const MapFrame frame{centre, glm::dvec2(0.5 * side * texel), glm::dvec2(texel)};
    ViewProjection& projection = view.projection;
    projection.clip_from_world = clipFromWorld(space, {}, frame, range.near_m, range.far_m);
    projection.parallel = true;
    projection.orthographic = true;
    projection.clamp_near = false; // the range has room for all casters
    projection.texel_m = texel;
    projection.texel_xy_m = glm::dvec2(texel);
    projection.light_reach = 0.0;
    projection.light_place_ws = space.right_ws * centre.x + space.up_ws * centre.y + space.forward_ws * range.near_m;
    projection.metric.near_m = 0.0;
    projection.metric.far_m = range.far_m - range.near_m;
    projection.metric.metric_ws = glm::dvec4(space.depth_ws, -range.near_m) / (range.far_m - range.near_m);
    view.fit.finest_texel = glm::dvec2(texel);
    view.fit.coarsest_texel = glm::dvec2(texel);
    view.serves.sector.x = glm::dvec4(space.right_ws, -centre.x) / (0.5 * length);
    view.serves.sector.y = glm::dvec4(space.up_ws, -centre.y) / (0.5 * length);
}

} // namespace gnomon
