// SPDX-License-Identifier: Apache-2.0
// A world for hostile options, frames and lights, and the properties that all its plans must have.
#pragma once

#include "worlds.h"

#include <gnomon/planner.h>

#include <gtest/gtest.h>

#include <limits>

namespace gnomon::test {

inline constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kWithoutEnd = std::numeric_limits<double>::infinity();
inline constexpr double kSmallest = std::numeric_limits<double>::denorm_min();

/// A meadow with things on it, a sun and a lamp.
struct Meadow {
    ObjectSet set;
    std::vector<Light> lights{sun({0.4, -1, 0.2}), spot({3, 20, 0}, {0, -1, 0}, 0.8)};
    Frame frame;

    Meadow()
    {
        set.add({{-40, -0.5, -40}, {40, 0, 40}});
        for (int i = 0; i < 12; ++i) {
            const double turn = 0.5 * i;
            set.add(boxAt({2.5 * i * std::cos(turn), 1, 2.5 * i * std::sin(turn)}, glm::dvec3(0.6)),
                    {.dynamic = i % 4 == 0});
        }
        frame.camera = perspectiveCamera({20, 25, 30}, {0, 0, 0}, 1.0);
        frame.objects = &set;
        lights[1].key = 1;
    }
    const Plan& plan(Planner& planner)
    {
        frame.lights = lights;
        return planner.plan(frame);
    }
};

inline bool isFinite(const glm::dmat4& matrix)
{
    for (int i = 0; i < 16; ++i) {
        if (!std::isfinite(matrix[i / 4][i % 4])) {
            return false;
        }
    }
    return true;
}

inline void expectDrawable(const Plan& plan, const View& view)
{
    EXPECT_TRUE(isFinite(view.projection.clip_from_world));
    EXPECT_TRUE(std::isfinite(view.projection.metric.near_m) &&
                view.projection.metric.far_m > view.projection.metric.near_m);
    EXPECT_TRUE(std::isfinite(glm::dot(view.projection.metric.metric_ws, glm::dvec4(1.0))));
    EXPECT_TRUE(std::isfinite(view.projection.texel_m) && view.projection.texel_m > 0.0);
    EXPECT_GE(view.place.tile.width, 8U);
    const MapPages& pages = plan.pages.at(plan.lights.at(view.light).options);
    EXPECT_LE(view.place.tile.x + view.place.tile.width, pages.width);
    EXPECT_LE(view.place.tile.y + view.place.tile.height, pages.height);
    EXPECT_LT(view.place.tile.layer, pages.layers);
    EXPECT_LE(view.casters.first + view.casters.count, plan.casters.size());
    EXPECT_FALSE(std::isnan(view.serves.slice.begin_m) || std::isnan(view.serves.slice.end_m));
}

/// All views of a light are drawable, and a light without views has a reason.
inline void expectSound(const Plan& plan, std::size_t lights)
{
    ASSERT_EQ(plan.lights.size(), lights);
    ASSERT_TRUE(plan.options != nullptr && !plan.options->empty());
    for (const LightPlan& light : plan.lights) {
        EXPECT_EQ(light.outcome.hasMap(), light.view_count > 0) << light.outcome.reason;
        EXPECT_EQ(light.outcome.reason.empty(), light.outcome.kind == OutcomeKind::ok);
    }
    for (const View& view : plan.views) {
        expectDrawable(plan, view);
    }
    EXPECT_FALSE(toJson(plan).empty());
}

} // namespace gnomon::test
