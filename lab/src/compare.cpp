// SPDX-License-Identifier: Apache-2.0
#include "lab/compare.h"

#include <cassert>
#include <utility>

namespace gnomon::lab {
namespace {

Camera cameraOf(const Subject& subject, glm::uvec2 size_px)
{
    return host::cameraOf(subject.eye, size_px.x, size_px.y, subject.state->bounds_ws);
}

glm::uvec2 sizeOf(const truth::Surfaces& surfaces)
{
    return {surfaces.object_ids.width, surfaces.object_ids.height};
}

const Light& judgedLight(const Subject& subject)
{
    assert(subject.light < subject.lights.size());
    return subject.lights[subject.light].caster;
}

} // namespace

truth::View truthView(const Subject& subject, glm::uvec2 size_px)
{
    return truthView(cameraOf(subject, size_px), size_px);
}

truth::Light truthLight(const Subject& subject)
{
    return truthLight(judgedLight(subject));
}

CountedPixels countPixels(const Subject& subject, const truth::Surfaces& surfaces, const host::Picture& picture)
{
    const Camera camera = cameraOf(subject, sizeOf(surfaces));
    return countPixels({*subject.state, camera, judgedLight(subject)}, surfaces, picture.object_ids);
}

Score scoreMask(const Subject& subject, const truth::Traced& truth, const host::Picture& picture, const ImageF& mask,
                bool with_perception)
{
    const Camera camera = cameraOf(subject, sizeOf(truth.surfaces));
    return scoreMask({*subject.state, camera, judgedLight(subject)}, truth, picture.object_ids, mask, with_perception);
}

host::RenderOptions judgedOptions(const host::RenderOptions& options, glm::uvec2 size_px)
{
    host::RenderOptions judged = options;
    judged.width = size_px.x;
    judged.height = size_px.y;
    judged.anti_aliasing = host::AntiAliasing::none;
    judged.ambient_occlusion.on = false; // masks know nothing of it, and times are to stay comparable
    judged.shadows = true;
    return judged;
}

Score scoreDrawn(host::FrameRenderer& renderer, const Subject& subject, const truth::Traced& truth,
                 const host::RenderOptions& options, bool with_perception)
{
    host::Picture picture = renderer.read({.colour = false, .linear = false, .masks = true, .geometry = true});
    const Plan plan = renderer.plan();
    if (options.average_pixels) { // geometry is not drawn in the middle of pixels, where the truth's is
        std::vector<ImageF> masks = std::move(picture.masks);
        renderer.drawAgain(*subject.state, subject.eye, subject.lights);
        picture = renderer.read({.colour = false, .masks = false, .geometry = true});
        picture.masks = std::move(masks);
    }
    Score score = scoreMask(subject, truth, picture, picture.masks[subject.light], with_perception);

    const Camera camera = cameraOf(subject, sizeOf(truth.surfaces));
    const double reach_texels = reachTexels(options.shadow);
    score.outcome = plan.lights[subject.light].outcome;
    score.atlas = plan.pages[0];
    // At the terminator the triangle, whose plane texels are laid out on, may face away.
    const Counted facing = without(score.pixels.counted, score.pixels.terminator);
    score.density = texelDensity(picture, facing, camera, plan, subject.light, reach_texels);
    score.fit_efficiency = fitEfficiency(picture, facing, camera, plan, subject.light, reach_texels);
    return score;
}

Score scoreTechnique(const host::SceneOnGpu& scene, const Subject& subject, const truth::Traced& truth,
                     const host::RenderOptions& options, bool with_perception, std::uint32_t frames)
{
    assert(frames > 0);
    assert(subject.scene == &scene.scene() && subject.state != nullptr && subject.light < subject.lights.size());
    const host::RenderOptions wish = judgedOptions(options, sizeOf(truth.surfaces));
    host::FrameRenderer renderer(scene, wish);
    for (std::uint32_t frame = 0; frame < frames; ++frame) {
        renderer.draw(*subject.state, subject.eye, subject.lights);
    }
    return scoreDrawn(renderer, subject, truth, wish, with_perception);
}

} // namespace gnomon::lab
