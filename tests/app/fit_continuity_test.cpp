// SPDX-License-Identifier: Apache-2.0
// How much the texels of a fitted map change from one frame to the next, in two of the built-in worlds and along the
// program's own paths. Prints a table.
#include "app/command_line.h"
#include "app/shot.h"

#include <gnomon/object_set.h>
#include <gnomon/planner.h>

#include <gtest/gtest.h>

#include <glm/matrix.hpp>

#include <algorithm>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

namespace gnomon {
namespace {

constexpr std::uint32_t kFrames = 300; // 10 s
/// A warp that comes or goes changes texels at the ends by more than this.
constexpr double kJump = 1.2;

bool sees(const glm::dmat4& clip_from_world, const glm::dvec3& p)
{
    const glm::dvec4 c = clip_from_world * glm::dvec4(p, 1.0);
    return c.w > 0.0 && std::abs(c.x) < c.w && std::abs(c.y) < c.w && c.z > 0.0 && c.z < c.w;
}

/// Texels per metre across the sun at a point, along the direction in which they are longest, up to a factor that all
/// maps share. 0 where the point is behind the map.
double densityAt(const View& view, const Light& sun, const glm::dvec3& p)
{
    const glm::dvec4 c = view.projection.clip_from_world * glm::dvec4(p, 1.0);
    if (!(c.w > 0.0))
        return 0.0;
    const glm::dmat4 rows = glm::transpose(view.projection.clip_from_world);
    const glm::dvec3 x = (glm::dvec3(rows[0]) * c.w - glm::dvec3(rows[3]) * c.x) / (c.w * c.w);
    const glm::dvec3 y = (glm::dvec3(rows[1]) * c.w - glm::dvec3(rows[3]) * c.y) / (c.w * c.w);
    // The smaller singular value of the two gradients, which have no part along the light.
    const glm::dvec3 way = glm::normalize(sun.direction_ws);
    const glm::dvec3 a = x - way * glm::dot(x, way);
    const glm::dvec3 b = y - way * glm::dot(y, way);
    const double sum = glm::dot(a, a) + glm::dot(b, b);
    const double cross = glm::length(glm::cross(a, b));
    return std::sqrt(std::max(0.0, 0.5 * (sum - std::sqrt(std::max(0.0, sum * sum - 4.0 * cross * cross)))));
}

struct Change {
    double largest = 1.0; // of the density at one point, from one frame to the next, as a ratio >= 1
    int given_up = 0;     // frames in which a warp came or went
    int compared = 0;     // points
};

/// A frame and what was planned for its sun with every fit.
struct Planned {
    glm::dmat4 clip_from_world{1.0};
    Light sun;
    std::map<Fit, std::pair<Outcome, View>> views;
};

class Walk {
public:
    Walk(const std::vector<std::string>& view, const std::string& path)
    {
        std::vector<std::string> arguments{"plan"};
        arguments.insert(arguments.end(), view.begin(), view.end());
        arguments.insert(arguments.end(), {"--path", path, "--frames", "0-" + std::to_string(kFrames - 1)});
        settings_ = app::parseCommandLine(arguments).settings;
        shot_ = app::makeShot(settings_);
        for (const Fit fit : {Fit::uniform, Fit::lispsm, Fit::lispsm_simple, Fit::tsm, Fit::psm}) {
            ShadowOptions options = settings_.shadow;
            options.technique = kPlainTechnique;
            options.technique.fit = fit;
            planners_.emplace(fit, Planner(options));
        }
    }
    std::map<Fit, Change> go()
    {
        Planned last;
        for (std::uint32_t frame = 0; frame < kFrames; ++frame) {
            if (frame > 0)
                app::moveShot(shot_, settings_, frame);
            host::fillObjectSet(shot_.state, objects_);
            Planned now = plan();
            if (frame > 0)
                compare(last, now);
            last = std::move(now);
        }
        return changes_;
    }

private:
    Planned plan()
    {
        const std::vector<Light> lights = app::castersOf(shot_);
        Frame frame;
        frame.camera = host::cameraOf(shot_.eye, settings_.size_px.x, settings_.size_px.y, shot_.state.bounds_ws);
        frame.size_px = settings_.size_px;
        frame.lights = lights;
        frame.objects = &objects_;
        Planned planned{frame.camera.clip_from_world, lights[0], {}};
        for (auto& [fit, planner] : planners_) {
            const Plan& made = planner.plan(frame);
            const LightPlan& light = made.lights[0];
            planned.views[fit] = {light.outcome, light.view_count > 0 ? made.views[light.first_view] : View{}};
        }
        return planned;
    }
    /// At the middle and at two corners of every object that both frames see.
    void compare(const Planned& last, const Planned& now)
    {
        for (auto& [fit, view] : now.views) {
            const auto& before = last.views.at(fit);
            changes_[fit].given_up += view.first.kind != before.first.kind ? 1 : 0;
        }
        for (std::uint32_t object = 0; object < objects_.size(); ++object) {
            const Aabb& box = objects_.bounds(object);
            if (!objects_.flags(object).receives)
                continue;
            for (const glm::vec3& corner : {box.min, box.max, (box.min + box.max) * 0.5F}) {
                const glm::dvec3 p(corner);
                if (sees(last.clip_from_world, p) && sees(now.clip_from_world, p))
                    comparePoint(last, now, p);
            }
        }
    }
    void comparePoint(const Planned& last, const Planned& now, const glm::dvec3& p)
    {
        for (const auto& [fit, view] : now.views) {
            const auto& before = last.views.at(fit);
            if (!view.first.hasMap() || !before.first.hasMap())
                continue;
            const double ratio = densityAt(view.second, now.sun, p) / densityAt(before.second, last.sun, p);
            Change& change = changes_[fit];
            change.largest = std::max({change.largest, ratio, 1.0 / ratio});
            ++change.compared;
        }
    }

    app::Settings settings_;
    app::Shot shot_;
    ObjectSet objects_;
    std::map<Fit, Planner> planners_;
    std::map<Fit, Change> changes_;
};

class FitContinuityOfWorlds : public testing::TestWithParam<std::vector<std::string>> {};

TEST_P(FitContinuityOfWorlds, TexelsChangeLittleFromFrameToFrame)
{
    for (const std::string path : {"pan", "orbit", "day"}) {
        std::map<Fit, Change> changes = Walk(GetParam(), path).go();
        std::printf("| `%s`, `%s` |", GetParam()[0].c_str(), path.c_str());
        for (const auto& [fit, change] : changes) {
            EXPECT_GT(change.compared, 30 * static_cast<int>(kFrames)) << path << " " << nameOf(fit);
            EXPECT_LT(change.largest, kJump) << path << " " << nameOf(fit);
            EXPECT_EQ(change.given_up, 0) << path << " " << nameOf(fit);
            std::printf(" %.2f %%%s |", 100.0 * (change.largest - 1.0),
                        change.given_up > 0 ? (", " + std::to_string(change.given_up) + " x").c_str() : "");
        }
        std::printf("\n");
        EXPECT_LE(changes[Fit::tsm].largest, changes[Fit::lispsm].largest) << path;
    }
}

INSTANTIATE_TEST_SUITE_P(Worlds, FitContinuityOfWorlds,
                         testing::Values(std::vector<std::string>{"sundial", "--camera", "long"},
                                         std::vector<std::string>{"rts", "--camera", "unit"}),
                         [](const auto& world) { return world.param[0]; });

} // namespace
} // namespace gnomon
