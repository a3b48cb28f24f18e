// SPDX-License-Identifier: Apache-2.0
// Shared by the tests of the fits: a scene as the planner sees it and as a fit does.
#pragma once

#include "worlds.h"

#include "fit/fit.h"
#include "partition/partition.h"
#include "region.h"

#include <gnomon/planner.h>

#include <glm/mat2x2.hpp>

#include <algorithm>
#include <string_view>

namespace gnomon::test {

struct Stage {
    ObjectSet set;
    Camera camera;
    Light light = sun({0, -1, 0});
    ShadowOptions options{.technique = kPlainTechnique};

    [[nodiscard]] Plan plan(Fit fit)
    {
        options.technique.fit = fit;
        Frame frame;
        frame.camera = camera;
        frame.lights = std::span(&light, 1);
        frame.objects = &set;
        Planner planner(options);
        return planner.plan(frame);
    }
};

/// Level ground, a metre's box on it, and a viewer 1.7 m above it who sees 200 m far. `pitch_rad`: down.
inline Stage levelGround(double pitch_rad = 0.0, const glm::dvec3& origin = glm::dvec3(0.0))
{
    Stage stage;
    stage.set.add(boxAt(origin, {400, 0, 400}));
    stage.set.add(boxAt(origin + glm::dvec3(0, 0.5, -20), glm::dvec3(0.5)), {true, false, false});
    const glm::dvec3 eye = origin + glm::dvec3(0, 1.7, 0);
    const glm::dvec3 forward(0.0, -std::sin(pitch_rad), -std::cos(pitch_rad));
    stage.camera = perspectiveCamera(eye, eye + forward, glm::radians(60.0), 1.6, 0.1, 200.0);
    return stage;
}

/// The planner's input of a fit.
struct FitStage {
    CameraView view;
    LightSpace space;
    Region region;
    std::vector<std::uint32_t> seen;
    std::vector<Slice> slices;
    bool found = false;

    explicit FitStage(const Stage& stage)
    {
        Frame frame;
        frame.camera = stage.camera;
        frame.objects = &stage.set;
        view.look(frame, 0.0, seen);
        partitionSingle({stage.light, view, stage.options.cascades}, slices);
        space = lightSpaceOf(stage.light, slices[0].axis_ws, slices[0].half_angle_rad, view.scene_ws);
        found = region.gatherReceivers({space, slices[0], view, stage.set, seen}).kind == OutcomeKind::ok;
    }
    [[nodiscard]] FitInput input() const
    {
        return {space, region.outline(), region.body().points(), region.body().faceSizes(), view};
    }
};

/// Where a point is in a map, in [-1, 1].
inline glm::dvec2 mapPlace(const View& view, const glm::dvec3& p_ws)
{
    const glm::dvec4 c = view.projection.clip_from_world * glm::dvec4(p_ws, 1.0);
    return glm::dvec2(c) / c.w;
}

/// d map place / d world along two directions, by differences.
inline glm::dmat2 mapSteps(const View& view, const glm::dvec3& p_ws, const glm::dvec3& a_ws, const glm::dvec3& b_ws)
{
    const double step = 1e-4;
    const auto along = [&](const glm::dvec3& way) {
        return (mapPlace(view, p_ws + way * step) - mapPlace(view, p_ws - way * step)) / (2.0 * step);
    };
    return {along(a_ws), along(b_ws)};
}

} // namespace gnomon::test
