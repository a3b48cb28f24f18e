// SPDX-License-Identifier: Apache-2.0
#include "model_bounds.h"

namespace gnomon::host {

bool fades(const scene::Scene& scene, const scene::Object& object)
{
    return object.material != scene::kNone && scene.materials[object.material].model == scene::ShadingModel::horizon;
}

Aabb modelBounds(const scene::Scene& scene, const scene::State& state)
{
    Aabb bounds;
    for (const scene::Object& object : state.objects) {
        if (!object.bounds_ws.empty() && !fades(scene, object)) {
            bounds = merge(bounds, object.bounds_ws);
        }
    }
    return bounds;
}

} // namespace gnomon::host
