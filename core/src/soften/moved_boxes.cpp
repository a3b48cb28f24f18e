// SPDX-License-Identifier: Apache-2.0
#include "soften/moved_boxes.h"

#include <gnomon/plan.h>

#include <algorithm>

namespace gnomon {
namespace {

double girth(const Aabb& box)
{
    const glm::dvec3 size = glm::dvec3(box.max) - glm::dvec3(box.min);
    return size.x + size.y + size.z;
}

/// Where there is no room for another box, the one that grows least takes it in.
void add(const Aabb& box, std::vector<Aabb>& boxes)
{
    if (box.empty()) {
        return;
    }
    const auto growth = [&](const Aabb& one) {
        return girth(merge(one, box)) - girth(one);
    };
    const auto nearest = std::ranges::min_element(boxes, {}, growth);
    const bool holds = nearest != boxes.end() && growth(*nearest) <= 0.0;
    if (holds || boxes.size() == kMostMoved) {
        *nearest = merge(*nearest, box);
    } else {
        boxes.push_back(box);
    }
}

} // namespace

bool MovedBoxes::follow(const ObjectSet& objects, std::vector<Aabb>& moved_ws)
{
    moved_ws.clear();
    moved_ws.reserve(kMostMoved);
    const bool known = identity_ == objects.identity();
    const std::span<const Aabb> now = objects.allBounds();
    const std::span<const std::uint64_t> changes = objects.allChanges();
    if (!known) {
        bounds_.assign(now.begin(), now.end());
    } else if (version_ != objects.version()) {
        bounds_.resize(std::max(bounds_.size(), now.size()));
        for (std::size_t i = 0; i < bounds_.size(); ++i) {
            const Aabb here = i < now.size() ? now[i] : Aabb{};
            if (i < changes.size() && changes[i] <= version_) {
                continue;
            }
            // An object that moved less than its own size sweeps one box.
            const Aabb swept = merge(bounds_[i], here);
            if (!bounds_[i].empty() && !here.empty() && girth(swept) <= 2.0 * girth(here)) {
                add(swept, moved_ws);
            } else {
                add(bounds_[i], moved_ws);
                add(here, moved_ws);
            }
            bounds_[i] = here;
        }
    }
    identity_ = objects.identity();
    version_ = objects.version();
    return known;
}

} // namespace gnomon
