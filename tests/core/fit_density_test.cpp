// SPDX-License-Identifier: Apache-2.0
// The purpose of the warps: the texels of pixels in a long view of ground, and how little they change from frame to
// frame. Figures are recorded as properties of the tests.
#include "fit_stage.h"

#include <gtest/gtest.h>

#include <functional>

namespace gnomon {
namespace {

using test::Stage;

constexpr Fit kWarps[] = {Fit::lispsm, Fit::lispsm_simple, Fit::tsm, Fit::psm};

void record(const std::string& what, double value)
{
    testing::Test::RecordProperty(what, std::to_string(value));
}

/// Texels of the map that one step of one pixel crosses, the lesser of the steps across and down; all over the ground.
std::vector<double> texelsPerPixel(Stage& stage, Fit fit)
{
    const Plan plan = stage.plan(fit);
    const View& view = plan.views[0];
    const glm::dmat4 world_from_clip = glm::inverse(stage.camera.clip_from_world);
    const glm::dvec2 size_px(1280, 800);
    const auto groundAt = [&](const glm::dvec2& px) {
        const glm::dvec2 ndc = px / size_px * 2.0 - 1.0;
        const glm::dvec4 far = world_from_clip * glm::dvec4(ndc, 0.0, 1.0);
        const glm::dvec3 way = glm::dvec3(far) / far.w - stage.camera.eye_ws;
        return stage.camera.eye_ws - way * (stage.camera.eye_ws.y / way.y);
    };
    std::vector<double> found;
    for (double x = 8.0; x < size_px.x; x += 16.0)
        for (double y = 8.0; y < size_px.y; y += 8.0) {
            const glm::dvec3 p = groundAt({x, y});
            if (!(glm::distance(p, stage.camera.eye_ws) < 195.0) || p.z > 0.0)
                continue;
            const glm::dvec2 here = test::mapPlace(view, p);
            const double texels = 0.5 * largestSide(stage.options);
            const double across = glm::length(test::mapPlace(view, groundAt({x + 0.1, y})) - here) * texels / 0.1;
            const double down = glm::length(test::mapPlace(view, groundAt({x, y + 0.1})) - here) * texels / 0.1;
            found.push_back(std::min(across, down));
        }
    std::sort(found.begin(), found.end());
    return found;
}

double firstPercentile(Stage& stage, Fit fit)
{
    const std::vector<double> found = texelsPerPixel(stage, fit);
    EXPECT_GT(found.size(), 1000U);
    return found[found.size() / 100];
}

TEST(FitDensity, WarpsGiveALongViewThreeTimesTheTexelsWhereTheyAreFewest)
{
    Stage stage = test::levelGround();
    const double uniform = firstPercentile(stage, Fit::uniform);
    record("uniform", uniform);
    for (const Fit fit : kWarps) {
        const double warped = firstPercentile(stage, fit);
        record(std::string(nameOf(fit)), warped);
        EXPECT_GT(warped, 3.0 * uniform) << nameOf(fit);
    }
}

/// Sides of a texel across the light, the longer and the shorter one.
glm::dvec2 texelSides(const View& view, const Light& light, const glm::dvec3& p_ws)
{
    glm::dvec3 right(0.0);
    glm::dvec3 up(0.0);
    axesAcross(light.direction_ws, right, up);
    const glm::dmat2 texel = glm::inverse(test::mapSteps(view, p_ws, right, up));
    const double area = std::abs(glm::determinant(texel));
    const double squares = glm::dot(texel[0], texel[0]) + glm::dot(texel[1], texel[1]);
    const double sum = std::sqrt(std::max(0.0, squares + 2.0 * area));
    const double difference = std::sqrt(std::max(0.0, squares - 2.0 * area));
    return glm::dvec2(sum + difference, sum - difference) * 0.5;
}

struct Walk {
    double largest = 1.0; // ratio of a texel's longer side, from one frame to the next, at one place
    int jumps = 0;        // frames where the warp came or went
    int places = 0;       // compared
};

/// Some hills and boxes on ground, looked at from `pose` over 600 frames.
Walk walk(Fit fit, const std::function<void(Stage&, double)>& pose)
{
    Stage stage;
    stage.set.add(test::boxAt({0, 0, 0}, {100, 0, 100}));
    test::Random random(3);
    std::vector<glm::dvec3> places;
    for (int i = 0; i < 40; ++i) {
        places.push_back(random.inBox({-90, 0, -90}, {90, 0, 90}));
        stage.set.add(test::boxAt(places.back() + glm::dvec3(0, 2, 0), {1, 2, 1}));
    }
    Walk result;
    Plan last;
    Light last_light;
    for (int frame = 0; frame < 600; ++frame) {
        pose(stage, frame / 600.0);
        const Plan plan = stage.plan(fit);
        if (frame > 0 && plan.lights[0].outcome.kind != last.lights[0].outcome.kind)
            ++result.jumps;
        else if (frame > 0 && !plan.views.empty())
            for (const glm::dvec3& p : places) {
                const glm::dvec4 c = stage.camera.clip_from_world * glm::dvec4(p, 1.0);
                if (c.w <= 0.0 || std::abs(c.x) > c.w || std::abs(c.y) > c.w)
                    continue;
                const double ratio =
                    texelSides(plan.views[0], stage.light, p).x / texelSides(last.views[0], last_light, p).x;
                result.largest = std::max({result.largest, ratio, 1.0 / ratio});
                ++result.places;
            }
        last = plan;
        last_light = stage.light;
    }
    return result;
}

Walk orbit(Fit fit)
{
    return walk(fit, [](Stage& stage, double t) {
        const double turn = 6.283185307179586 * t;
        stage.light = test::sun({0.5, -1, 0.3});
        stage.camera = test::perspectiveCamera({60 * std::cos(turn), 12, 60 * std::sin(turn)}, {0, 0, 0}, 0.9);
    });
}
Walk pan(Fit fit)
{
    return walk(fit, [](Stage& stage, double t) {
        const double turn = 6.283185307179586 * t;
        stage.light = test::sun({0.5, -1, 0.3});
        const glm::dvec3 eye(0, 6, 0);
        stage.camera = test::perspectiveCamera(eye, eye + glm::dvec3(std::cos(turn), -0.2, std::sin(turn)), 0.9);
    });
}
Walk day(Fit fit)
{
    return walk(fit, [](Stage& stage, double t) {
        const double hour = 0.15 + (3.141592653589793 - 0.3) * t; // of the sun, from a little above the horizon
        stage.light = test::sun({-std::cos(hour), -std::sin(hour), 0.3});
        stage.camera = test::perspectiveCamera({-50, 8, 10}, {0, 0, 0}, 0.9);
    });
}
Walk lamp(Fit fit)
{
    return walk(fit, [](Stage& stage, double t) {
        const double turn = 6.283185307179586 * t;
        stage.light = test::spot({20, 40, 10}, {0.2, -1, 0.1}, 0.9);
        stage.camera = test::perspectiveCamera({60 * std::cos(turn), 12, 60 * std::sin(turn)}, {0, 0, 0}, 0.9);
    });
}

TEST(FitContinuity, TexelsChangeLittleFromFrameToFrame)
{
    // The camera alone moves: what the warps add to a fitted rectangle's own changes is a per cent or two.
    struct Path {
        Walk (*walk)(Fit);
        std::string name;
        double bound;
        double psm_bound;
    };
    for (const Path& path :
         {Path{orbit, "orbit", 1.025, 1.03}, {pan, "pan", 1.025, 1.025}, {lamp, "lamp", 1.03, 1.08}}) {
        for (const Fit fit : {Fit::uniform, Fit::lispsm, Fit::lispsm_simple, Fit::tsm, Fit::psm}) {
            const Walk found = path.walk(fit);
            record(path.name + " " + std::string(nameOf(fit)), found.largest);
            EXPECT_GT(found.places, 3000);
            EXPECT_EQ(found.jumps, 0) << path.name << " " << nameOf(fit);
            EXPECT_LT(found.largest, fit == Fit::psm ? path.psm_bound : path.bound) << path.name << " " << nameOf(fit);
        }
        EXPECT_LE(path.walk(Fit::tsm).largest, path.walk(Fit::lispsm).largest) << path.name;
    }
}

TEST(FitContinuity, TexelsChangeLittleOverADay)
{
    for (const Fit fit : {Fit::uniform, Fit::lispsm, Fit::lispsm_simple, Fit::tsm}) {
        const Walk found = day(fit);
        record("day " + std::string(nameOf(fit)), found.largest);
        EXPECT_EQ(found.jumps, 0) << nameOf(fit);
        EXPECT_LT(found.largest, 1.02) << nameOf(fit);
    }
    EXPECT_LE(day(Fit::tsm).largest, day(Fit::lispsm).largest + 0.001);
    // As the sun nears what is seen, post-perspective space runs away and must be left in one frame.
    const Walk post = day(Fit::psm);
    record("day psm", post.largest);
    EXPECT_EQ(post.jumps, 1);
    EXPECT_LT(post.largest, 2.0);
}

} // namespace
} // namespace gnomon
