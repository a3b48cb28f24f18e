// SPDX-License-Identifier: Apache-2.0
// Pictures of plans are read back from their SVG: well-formed, with a frame for each map, a box for each object, and
// the lines of a warped map where its matrix has them.
#include "lab/plan_picture.h"

#include "host/frame_renderer.h"
#include "lab/src/plan_shapes.h"
#include "xml.h"

#include <gnomon/planner.h>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace gnomon::lab {
namespace {

/// Ground of 200 m with a row of 20 boxes from the eye to the horizon, and one box far off at its side.
struct Row {
    Row()
    {
        objects.add({{-100.0F, -0.1F, -100.0F}, {100.0F, 0.0F, 100.0F}}, {.casts = false});
        for (int i = 0; i < 20; ++i) {
            const float z = 85.0F - 9.0F * static_cast<float>(i);
            objects.add({{-1.0F, 0.0F, z - 1.0F}, {1.0F, 3.0F, z + 1.0F}});
        }
        objects.add({{95.0F, 0.0F, 90.0F}, {97.0F, 3.0F, 92.0F}}); // beside the eye: neither seen nor casting on it
        light.direction_ws = glm::normalize(glm::dvec3(0.3, -1.0, 0.1));
        frame.objects = &objects;
        frame.lights = {&light, 1};
        const host::Eye eye{.position_ws = {0.0, 3.0, 98.0}, .target_ws = {0.0, 0.0, 40.0}, .fov_y_rad = 0.8};
        frame.camera = host::cameraOf(eye, 640, 360, objects.bounds());
        options.technique.filter = Filter::hard;
    }
    [[nodiscard]] const Plan& plan()
    {
        planner = std::make_unique<Planner>(options);
        return planner->plan(frame);
    }
    [[nodiscard]] std::string svg() { return planSvg(frame, plan(), 0, {"title", "subtitle"}); }

    ObjectSet objects;
    Light light;
    Frame frame;
    ShadowOptions options{.technique = kPlainTechnique};
    std::unique_ptr<Planner> planner;
};

/// The paths in the groups of a class.
std::size_t pathsIn(const std::string& svg, const std::string& name)
{
    std::size_t paths = 0;
    const std::string opening = "<g class=\"" + name + "\"";
    for (std::size_t at = svg.find(opening); at != std::string::npos; at = svg.find(opening, at + 1)) {
        paths += count(svg.substr(at, svg.find("</g>", at) - at), "<path");
    }
    return paths;
}

/// The shapes that the paths of a class have together.
std::size_t shapesIn(const std::string& svg, const std::string& name)
{
    std::size_t shapes = 0;
    const std::string opening = "<path class=\"" + name + "\"";
    for (std::size_t at = svg.find(opening); at != std::string::npos; at = svg.find(opening, at + 1)) {
        const std::string path = svg.substr(at, svg.find("/>", at) - at);
        shapes += count(path, "M");
        EXPECT_EQ(count(path, "z\"") + count(path, "zM"), count(path, "M"));
    }
    return shapes;
}

void expectSound(const std::string& svg)
{
    EXPECT_EQ(whyNotWellFormed(svg), "");
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
}

TEST(PlanPicture, HasWhatThePlanHas)
{
    Row row;
    const std::string svg = row.svg();
    expectSound(svg);
    const Plan& plan = row.planner->plan(row.frame);
    ASSERT_EQ(plan.views.size(), 1U);
    EXPECT_EQ(pathsIn(svg, "edge"), 2U);              // across the light and in the map
    EXPECT_EQ(pathsIn(svg, "eighths"), 2U * 2U * 7U); // both ways
    EXPECT_EQ(shapesIn(svg, "body"), 2U);
    EXPECT_EQ(shapesIn(svg, "casters"), 2U * plan.views[0].casters.count);
    EXPECT_EQ(shapesIn(svg, "seen"), 2U); // the ground
    EXPECT_EQ(count(svg, "class=\"tile\""), 1U);
    EXPECT_NE(svg.find("title"), std::string::npos);
    EXPECT_EQ(svg, row.svg()); // the same bytes
}

TEST(PlanPicture, TellsCulledCastersFromDrawnOnes)
{
    Row row;
    row.options.max_distance_m = 40.0;
    const std::string svg = row.svg();
    expectSound(svg);
    const View& view = row.planner->plan(row.frame).views.at(0);
    ASSERT_LT(view.casters.count, 10U);
    EXPECT_EQ(shapesIn(svg, "casters"), 2U * view.casters.count);
    EXPECT_GT(shapesIn(svg, "culled"), 0U);
    EXPECT_LE(shapesIn(svg, "culled"), 21U - view.casters.count);
}

/// A lamp amid the row, so that the eye sees what lies on several sides of it.
void lightALamp(Row& row)
{
    row.light = {.type = LightType::point, .position_ws = {3.0, 2.0, 60.0}, .range_m = 25.0};
    row.options.technique.partition = Partition::multi;
}

TEST(PlanShapes, WhatIsSeenOfALampIsInItsPyramids)
{
    Row row;
    lightALamp(row);
    const Plan& plan = row.plan();
    const LightPlane above = planeFromAbove(row.light.position_ws, row.frame.camera);
    EXPECT_NEAR(above.forward_ws.y, -1.0, 1e-12);
    for (const View& view : plan.views) {
        const LightPlane plane = lightPlaneOf(view, row.frame.camera);
        const glm::dmat3 map = mapFromPlane(plane, view);
        const Polygon seen = seenFrom(plane, row.frame, plan, view);
        EXPECT_EQ(inWindow(seen, map, 1.0 + 1e-6).size(), seen.size()) << "nothing is cut";
        const Polygon pyramid = pyramidOf(above, {plane, map}, 100.0);
        ASSERT_GE(pyramid.size(), 3U);
        for (std::size_t i = 0; i < pyramid.size(); ++i) {
            const glm::dvec2 a = pyramid[i];
            const glm::dvec2 along = pyramid[(i + 1) % pyramid.size()] - a;
            for (const glm::dvec2& q : seenFrom(above, row.frame, plan, view)) {
                EXPECT_GT(along.x * (q.y - a.y) - along.y * (q.x - a.x), -1e-6 * glm::length(along));
            }
        }
    }
}

TEST(PlanPicture, IsWellFormedWhateverTheNames)
{
    Row row;
    const std::string evil = "</text><script>\"&'<\x01\xFF\xC0\x80 \xC3\xA4" + std::string(300, 'x');
    const std::string svg = planSvg(row.frame, row.plan(), 0, {evil, evil});
    expectSound(svg);
    EXPECT_EQ(count(svg, "<script"), 0U);
    EXPECT_EQ(svg.find('\x01'), std::string::npos);
}

TEST(PlanPicture, StandsAnySight)
{
    Row row;
    for (const Fit fit : {Fit::uniform, Fit::lispsm, Fit::tsm, Fit::psm}) {
        row.options.technique.fit = fit;
        for (const glm::dvec3& sun : {glm::dvec3(0, -1, 0), glm::dvec3(0, -0.05, -1), glm::dvec3(0, -0.05, 1)}) {
            row.light.direction_ws = glm::normalize(sun);
            for (const glm::dvec3& target : {glm::dvec3(0, -100, 97.9), glm::dvec3(0, 3, 0), glm::dvec3(90, 3, 98)}) {
                const host::Eye eye{.position_ws = {0.0, 3.0, 98.0}, .target_ws = target, .fov_y_rad = 0.8};
                row.frame.camera = host::cameraOf(eye, 640, 360, row.objects.bounds());
                expectSound(row.svg());
            }
        }
    }
    row.light = {.type = LightType::spot,
                 .position_ws = {2.0, 6.0, 60.0},
                 .direction_ws = glm::normalize(glm::dvec3(0.1, -0.7, -1.0)),
                 .outer_half_angle_rad = 0.6,
                 .range_m = 60.0};
    for (const glm::dvec3& eye_ws : {glm::dvec3(0, 3, 98), glm::dvec3(0, 3, 20), glm::dvec3(2, 6, 60)}) {
        const host::Eye eye{.position_ws = eye_ws, .target_ws = {2.0, 0.0, 45.0}, .fov_y_rad = 0.8};
        row.frame.camera = host::cameraOf(eye, 640, 360, row.objects.bounds());
        expectSound(row.svg());
    }
}

TEST(PlanShapes, AMapsPointsAreThoseOfItsMatrix)
{
    Row row;
    for (const Fit fit : {Fit::uniform, Fit::lispsm, Fit::tsm}) {
        row.options.technique.fit = fit;
        const View view = row.plan().views.at(0);
        const LightPlane plane = lightPlaneOf(view, row.frame.camera);
        EXPECT_LT(glm::length(plane.forward_ws - row.light.direction_ws), 1e-6);
        EXPECT_GT(glm::dot(plane.y_ws, forwardOf(row.frame.camera)), 0.0);
        const glm::dmat3 map = mapFromPlane(plane, view);
        for (const glm::dvec3& p : {glm::dvec3(0, 0, 80), glm::dvec3(-3, 1, 50), glm::dvec3(5, 0, 0)}) {
            const glm::dvec4 clip = view.projection.clip_from_world * glm::dvec4(p, 1.0);
            const glm::dvec2 q = planePoint(map, clip.x / clip.w, clip.y / clip.w);
            EXPECT_LT(glm::length(q - plane.project(p).value()), 1e-6 * 100.0);
        }
    }
}

/// All that is seen is in every map, and reaches its edge.
TEST(PlanShapes, WhatIsSeenIsInTheMap)
{
    Row row;
    for (const Fit fit : {Fit::uniform, Fit::lispsm, Fit::tsm, Fit::psm}) {
        row.options.technique.fit = fit;
        const Plan& plan = row.plan();
        const View& view = plan.views.at(0);
        const LightPlane plane = lightPlaneOf(view, row.frame.camera);
        const glm::dmat3 map = mapFromPlane(plane, view);
        const Polygon seen = seenFrom(plane, row.frame, plan, view);
        const Polygon window = inWindow(seen, map, 1.0);
        ASSERT_EQ(window.size(), seen.size()) << "nothing is cut";
        double largest = 0.0;
        for (const glm::dvec2& p : window) {
            largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
        }
        EXPECT_GT(largest, 0.98);
        EXPECT_LE(largest, 1.0);
    }
}

TEST(PlanShapes, AWindowCutsWhatLeavesIt)
{
    const Polygon square{{-3.0, -0.5}, {3.0, -0.5}, {3.0, 0.5}, {-3.0, 0.5}};
    const Polygon cut = inWindow(square, glm::dmat3(1.0), 1.0);
    ASSERT_EQ(cut.size(), 4U);
    for (const glm::dvec2& p : cut) {
        EXPECT_DOUBLE_EQ(std::abs(p.x), 1.0);
        EXPECT_DOUBLE_EQ(std::abs(p.y), 0.5);
    }
    EXPECT_TRUE(inWindow({}, glm::dmat3(1.0), 1.0).empty());
    // w = x: what is to the left of x = 0 is behind.
    const glm::dmat3 behind(glm::dvec3(1.0, 0.0, 1.0), glm::dvec3(0.0, 1.0, 0.0), glm::dvec3(0.0, 0.0, 0.0));
    for (const glm::dvec2& p : inWindow(square, behind, 1.0)) {
        EXPECT_DOUBLE_EQ(p.x, 1.0);
        EXPECT_LE(std::abs(p.y), 1.0 + 1e-12);
    }
}

} // namespace
} // namespace gnomon::lab
