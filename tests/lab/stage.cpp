// SPDX-License-Identifier: Apache-2.0
#include "stage.h"

#include <glm/geometric.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <utility>

namespace gnomon::lab::test {
namespace {

host::Eye eyeOf(const scene::Scene& scene, const std::string& name)
{
    for (const scene::NamedView& view : scene.views) {
        if (view.name == name) {
            return {.position_ws = view.eye, .target_ws = view.target, .fov_y_rad = double{view.fov_y_rad}};
        }
    }
    throw std::invalid_argument("no view " + name);
}

truth::Traced traceOf(const Subject& subject, glm::uvec2 size_px, const truth::Options& options)
{
    const truth::Tracer tracer(*subject.scene, *subject.state);
    const truth::View view = truthView(subject, size_px);
    truth::Traced traced;
    traced.surfaces = tracer.see(view, options).value();
    traced.visibility = tracer.trace(traced.surfaces, view, truthLight(subject), options).value();
    return traced;
}

} // namespace

Stage::Stage(scene::Scene scene, const std::string& view, glm::uvec2 size_px, std::uint32_t light)
    : scene_(std::move(scene)), state_(scene::evaluate(scene_, 0.0)), gpu_({.gpu = "software", .validate = true}),
      uploaded_(gpu_, scene_, state_), subject_{.scene = &scene_,
                                                .state = &state_,
                                                .eye = eyeOf(scene_, view),
                                                .lights = host::lightsOf(scene_, state_),
                                                .light = light},
      size_px_(size_px)
{
}

Stage::~Stage()
{
    for (const std::string& message : gpu_.messages()) {
        ADD_FAILURE() << message;
    }
}

void Stage::turnLight(const glm::dvec3& direction_ws)
{
    subject_.lights[subject_.light].caster.direction_ws = glm::normalize(direction_ws);
    hard_truth_.reset();
}

const truth::Traced& Stage::hardTruth()
{
    if (!hard_truth_) {
        hard_truth_ = traceOf(subject_, size_px_, {.kind = truth::Kind::hard});
    }
    return *hard_truth_;
}

truth::Traced Stage::areaTruth(std::uint32_t samples)
{
    return traceOf(subject_, size_px_, {.kind = truth::Kind::area, .samples = samples});
}

View Stage::mapView(const host::RenderOptions& options)
{
    host::RenderOptions sized = options;
    sized.width = size_px_.x;
    sized.height = size_px_.y;
    host::FrameRenderer renderer(uploaded_, sized);
    renderer.draw(state_, subject_.eye, subject_.lights);
    return renderer.plan().views[renderer.plan().lights[subject_.light].first_view];
}

host::Picture Stage::geometry()
{
    host::RenderOptions options;
    options.width = size_px_.x;
    options.height = size_px_.y;
    options.shadows = false;
    host::FrameRenderer renderer(uploaded_, options);
    renderer.draw(state_, subject_.eye, subject_.lights);
    return renderer.read({.colour = false, .linear = false, .masks = false, .geometry = true});
}

Score Stage::score(const host::RenderOptions& options, bool with_perception)
{
    return scoreTechnique(uploaded_, subject_, hardTruth(), options, with_perception);
}

Score Stage::score(const host::RenderOptions& options, const truth::Traced& truth)
{
    return scoreTechnique(uploaded_, subject_, truth, options, false);
}

host::RenderOptions hardOptions(std::uint32_t map_size)
{
    host::RenderOptions options;
    options.shadow.technique.filter = Filter::hard;
    options.shadow.map_size = map_size;
    return options;
}

host::RenderOptions filterOptions(Filter filter, MapFormat format, std::uint32_t map_size)
{
    host::RenderOptions options;
    options.shadow.technique.filter = filter;
    options.shadow.map_size = map_size;
    options.shadow.format = format;
    options.shadow.border_texels = std::ceil(static_cast<double>(reachTexels(options.shadow)));
    return options;
}

} // namespace gnomon::lab::test
