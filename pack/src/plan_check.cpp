// SPDX-License-Identifier: Apache-2.0
#include <gnomon/pack/map_notes.h>

#include <gnomon/error.h>

#include <algorithm>

namespace gnomon::pack {
namespace {

constexpr std::uint32_t kMostMaps = 1U << 26; // a name beyond is none that a planner gave

bool isRange(std::uint64_t first, std::uint64_t count, std::uint64_t size)
{
    return first + count <= size;
}

const char* wrongOf(const View& view, const MapPages& pages)
{
    const Tile& tile = view.place.tile;
    if (tile.width == 0 || tile.height == 0 || !isRange(tile.x, tile.width, pages.width) ||
        !isRange(tile.y, tile.height, pages.height) || tile.layer >= pages.layers) {
        return "a view's tile is not inside of its pages";
    }
    if (view.contents.kept_layer != kNoIndex && view.contents.kept_layer >= pages.kept_layers) {
        return "a view's kept layer is beyond its pages";
    }
    if (!isRange(view.contents.dirty.x, view.contents.dirty.width, tile.width) ||
        !isRange(view.contents.dirty.y, view.contents.dirty.height, tile.height)) {
        return "what is dirty of a view is not inside of its tile";
    }
    if ((view.place.map && view.place.map.index >= kMostMaps) ||
        (view.contents.kept_map && view.contents.kept_map.index >= kMostMaps)) {
        return "a view's map has a name that no planner gave";
    }
    return nullptr;
}

const char* wrongOf(const Plan& plan)
{
    if (plan.options == nullptr || plan.options->empty() || plan.pages.size() < plan.options->size()) {
        return "the plan has no options, or no pages for them";
    }
    for (const LightPlan& light : plan.lights) {
        if (light.options >= plan.options->size()) {
            return "a light names options that the plan has not";
        }
        if (!isRange(light.first_view, light.view_count, plan.views.size())) {
            return "a light names views that the plan has not";
        }
        if (light.first_object_id == kNoIndex && light.view_count > 0 && (*plan.options)[light.options].traits().ids) {
            return "a light's maps hold ids of objects, and it has none";
        }
        if (light.first_object_id != kNoIndex &&
            (plan.object_bounds.empty() ||
             !isRange(light.first_object_id, plan.object_bounds.size(), plan.object_ids.size()))) {
            return "a light's ids of objects are beyond the plan's list";
        }
        if (!isRange(light.first_volume, light.volume_count, plan.casters.size())) {
            return "a light names casters that the plan has not";
        }
        if (light.mask_layer >= plan.mask_layers || light.mask_channel > 3) {
            return "a light's channel is beyond the mask's layers";
        }
        if (light.mask_coloured && light.mask_channel != 3) {
            return "a coloured light's channel is not the last of its layer";
        }
    }
    for (const View& view : plan.views) {
        if (view.light >= plan.lights.size()) {
            return "a view names a light that the plan has not";
        }
        if (!isRange(view.casters.first, view.casters.count, plan.casters.size()) ||
            view.casters.still > view.casters.count) {
            return "a view's casters are beyond the plan's list";
        }
        const auto casters = std::span(plan.casters).subspan(view.casters.first, view.casters.count);
        if (plan.lights[view.light].first_object_id != kNoIndex &&
            std::ranges::any_of(casters, [&](std::uint32_t object) { return object >= plan.object_bounds.size(); })) {
            return "a view's casters are objects without ids";
        }
        if (const char* const wrong = wrongOf(view, plan.pages[plan.lights[view.light].options])) {
            return wrong;
        }
    }
    return nullptr;
}

} // namespace

void checkPlan(const char* tried, const Plan& plan)
{
    if (const char* const wrong = wrongOf(plan)) {
        throw Error(tried, wrong, "hand in a plan as its planner made it");
    }
}

} // namespace gnomon::pack
