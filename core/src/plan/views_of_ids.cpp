// SPDX-License-Identifier: Apache-2.0
// Ids of the objects in the maps of a light that tells them apart (filters id and depth-id).
#include "plan/views.h"

#include <algorithm>
#include <bit>

namespace gnomon {

/// Ids are given in the order in which the light sees objects. A sun that moves in steps keeps them with its maps: the
/// order is from its earlier position.
Outcome Views::handOutIds(const Results& from, std::uint32_t index)
{
    Plan& plan = from.plan;
    LightPlan& planned = plan.lights[index];
    const ResolvedOptions& options = from.setupOf(index).recipe.resolved;
    const ObjectSet& objects = *from.sights.frame().objects;
    if (objects.size() > kMostIdObjects) {
        static_assert(kMostIdObjects == 1048575);
        return {OutcomeKind::refused, "ids tell at most 1048575 objects apart"};
    }
    if (options.ids().of == IdOf::face && plan.object_pieces.empty()) {
        plan.object_pieces.resize(objects.size(), 0);
        for (std::uint32_t object = 0; object < objects.size(); ++object) {
            plan.object_pieces[object] = objects.flags(object).pieces;
            if (objects.flags(object).casts && plan.object_pieces[object] == 0) {
                plan.object_pieces.clear();
                return {OutcomeKind::refused,
                        "id.of face: an object that casts does not say of how many pieces it is (ObjectFlags::pieces)"};
            }
        }
    }
    Light light = from.sights.frame().lights[index];
    if (planned.steps.stepping) {
        light.direction_ws = planned.steps.earlier_ws;
    }
    if (plan.object_bounds.empty()) {
        shareIdBounds(objects, ids_, plan.object_bounds);
        shares_bounds_.assign(plan.object_bounds.size(), false);
        for (const auto& [a, b] : ids_.links) {
            shares_bounds_[a] = shares_bounds_[a] || a != b;
            shares_bounds_[b] = shares_bounds_[b] || a != b;
        }
    }
    planned.first_object_id = static_cast<std::uint32_t>(plan.object_ids.size());
    gnomon::handOutIds(light, objects,
                       {.most = idsOf(options.format()),
                        .of = options.ids().of,
                        .sharing = idSharingOf(options.filter(), options.ids().of)},
                       ids_, plan.object_ids);
    return {};
}

/// FNV-1a (G. Fowler, L. C. Noll, K.-P. Vo, 1991) over the ids of a view's casters, and over bounds that are not their
/// own alone: other ids, another key.
std::uint64_t Views::idsKey(const Plan& plan, const View& view) const
{
    const std::span<const std::uint16_t> ids = objectIdsOf(plan, view.light);
    if (ids.empty()) {
        return 0;
    }
    std::uint64_t key = 14695981039346656037ULL;
    for (std::uint32_t i = 0; i < view.casters.count; ++i) {
        const std::uint32_t object = plan.casters[view.casters.first + i];
        const auto add = [&](std::uint32_t number) {
            key = (key ^ number) * 1099511628211ULL;
        };
        add(ids[object]);
        const Aabb& box = plan.object_bounds[object];
        if (shares_bounds_[object]) {
            for (int axis = 0; axis < 3; ++axis) {
                add(std::bit_cast<std::uint32_t>(box.min[axis]));
                add(std::bit_cast<std::uint32_t>(box.max[axis]));
            }
        }
    }
    return std::max<std::uint64_t>(key, 1);
}

} // namespace gnomon
