// SPDX-License-Identifier: Apache-2.0
#include "lab/compare.h"

#include "lab/metrics/flip.h"

#include <glm/geometric.hpp>

#include <cassert>

namespace gnomon::lab {

Score scoreMask(const Subject& subject, const truth::Traced& truth, const host::Picture& picture, const ImageF& mask,
                bool with_perception)
{
    const ImageF& exact = truth.visibility.visibility;
    assert(mask.width == exact.width && mask.height == exact.height);
    Score score;
    score.mask = mask;
    score.pixels = countPixels(subject, truth.surfaces, picture);
    score.density.map = ImageF(mask.width, mask.height, 1);
    const Counted& counted = score.pixels.counted;
    score.error = errorNumbers(mask, exact, counted);
    score.classification = classifyErrors(mask, exact, counted, truth.visibility.first_blocker_m,
                                          glm::length(glm::dvec3(subject.state->bounds_ws.extent())));
    if (with_perception) {
        score.ssim = ssim(mask, exact, counted);
        score.flip = flip(mask, exact, counted);
    }
    return score;
}

Score scoreTechnique(host::Gpu& gpu, const Subject& subject, const truth::Traced& truth,
                     const host::RenderOptions& options, bool with_perception)
{
    assert(subject.scene != nullptr && subject.state != nullptr && subject.light < subject.lights.size());
    host::RenderOptions wish = options;
    wish.width = truth.surfaces.object_ids.width;
    wish.height = truth.surfaces.object_ids.height;
    wish.anti_aliasing = host::AntiAliasing::none; // the truth looks through the middle of each pixel only
    wish.shadows = true;
    host::Renderer renderer(gpu, *subject.scene, *subject.state, wish);
    renderer.draw(*subject.state, subject.eye, subject.lights);
    const host::Picture picture = renderer.read({.colour = false, .linear = false, .masks = true, .geometry = true});
    Score score = scoreMask(subject, truth, picture, picture.masks[subject.light], with_perception);

    const Plan& plan = renderer.plan();
    const Camera camera = host::cameraOf(subject.eye, wish.width, wish.height, subject.state->bounds_ws);
    score.outcome = plan.lights[subject.light].outcome;
    score.atlas = plan.atlas;
    score.density = texelDensity(picture, score.pixels.counted, camera, plan, subject.light);
    score.fit_efficiency = fitEfficiency(picture, score.pixels.counted, camera, plan, subject.light,
                                         vulkan::filterReachTexels(wish.filter));
    return score;
}

} // namespace gnomon::lab
