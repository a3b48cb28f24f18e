// SPDX-License-Identifier: Apache-2.0
#include "shot_parts.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cstddef>

namespace gnomon::app {
namespace {

constexpr float kSmall = 0.3F; // share of the surroundings' diagonal, by eye

float sizeOf(const Aabb& box)
{
    return box.empty() ? 0.0F : glm::length(box.extent());
}

Aabb both(const Aabb& a, const Aabb& b)
{
    return {glm::min(a.min, b.min), glm::max(a.max, b.max)};
}

bool holds(const Aabb& box, const glm::vec3& p)
{
    return glm::all(glm::lessThanEqual(box.min, p)) && glm::all(glm::greaterThanEqual(box.max, p));
}

/// Some of the objects together.
struct Group {
    Aabb bounds_ws;
    std::size_t triangles = 0;

    void add(const scene::Scene& scene, const scene::Object& object)
    {
        bounds_ws = both(bounds_ws, object.bounds_ws);
        triangles += scene.meshes[object.mesh].primitives[object.primitive].indices.size() / 3;
    }
};

} // namespace

std::vector<const scene::Object*> withoutSurroundings(const scene::Scene& scene,
                                                      std::vector<const scene::Object*> objects)
{
    std::ranges::stable_sort(objects, [](const scene::Object* a, const scene::Object* b) {
        return sizeOf(a->bounds_ws) > sizeOf(b->bounds_ws);
    });
    std::vector<Group> from(objects.size() + 1); // each one on
    for (std::size_t i = objects.size(); i-- > 0;) {
        from[i] = from[i + 1];
        from[i].add(scene, *objects[i]);
    }
    Group around;
    std::size_t count = 0;
    for (std::size_t i = 0; i + 1 < objects.size(); ++i) {
        around.add(scene, *objects[i]);
        const Group& others = from[i + 1];
        const float size = sizeOf(others.bounds_ws);
        const glm::vec3 above(0.0F, size, 0.0F); // an object on a ground, or hung below a roof, is amid it
        const Aabb wide{around.bounds_ws.min - above, around.bounds_ws.max + above};
        const bool small = size > 0.0F && size < kSmall * sizeOf(objects[i]->bounds_ws);
        if (small && others.triangles > around.triangles && holds(wide, others.bounds_ws.centre())) {
            count = i + 1;
        }
    }
    objects.erase(objects.begin(), objects.begin() + static_cast<std::ptrdiff_t>(count));
    return objects;
}

} // namespace gnomon::app
