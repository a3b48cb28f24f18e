// SPDX-License-Identifier: Apache-2.0
#include "traced.h"

#include "truth/visibility.h"

#include <glm/matrix.hpp>

namespace gnomon::host::test {

ImageF tracedMask(const scene::Scene& scene, const scene::State& state, const Eye& eye, std::uint32_t width,
                  std::uint32_t height, std::uint32_t light)
{
    const Camera camera = cameraOf(eye, width, height, state.bounds_ws);
    const truth::View view{
        .eye_ws = camera.eye_ws, .world_from_clip = glm::inverse(camera.clip_from_world), .size_px = {width, height}};
    const Light caster = lightsOf(scene, state)[light].caster;
    const truth::Light traced{
        .type = scene.lights[light].type, .position_ws = caster.position_ws, .direction_ws = caster.direction_ws};
    const truth::Options options{.kind = truth::Kind::hard, .threads = 2};
    const truth::Tracer tracer(scene, state, options);
    return tracer.trace(*tracer.see(view, options), view, traced, options)->visibility;
}

std::size_t wrongPixels(const ImageF& mask, const ImageF& truth)
{
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < mask.values.size(); ++i) {
        wrong += (mask.values[i] > 0.5F) != (truth.values[i] > 0.5F) ? 1 : 0;
    }
    return wrong;
}

} // namespace gnomon::host::test
