// SPDX-License-Identifier: Apache-2.0
#include "support.h"

#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>

namespace gnomon::truth::test {
namespace {

std::uint32_t addPrimitive(scene::Scene& scene, scene::Primitive primitive)
{
    scene.meshes.push_back({.name = "mesh", .primitives = {std::move(primitive)}});
    return static_cast<std::uint32_t>(scene.meshes.size() - 1);
}

void addFace(scene::Primitive& primitive, const Corners& corners)
{
    const auto first = static_cast<std::uint32_t>(primitive.positions.size());
    primitive.positions.insert(primitive.positions.end(), corners.begin(), corners.end());
    for (const glm::vec2 uv : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)}) {
        primitive.uv0.push_back(uv);
    }
    for (const std::uint32_t corner : {0U, 1U, 2U, 0U, 2U, 3U}) {
        primitive.indices.push_back(first + corner);
    }
}

} // namespace

std::uint32_t addQuad(scene::Scene& scene, const Corners& corners, std::uint32_t material)
{
    scene::Primitive primitive;
    primitive.material = material;
    addFace(primitive, corners);
    return addPrimitive(scene, std::move(primitive));
}

std::uint32_t addCube(scene::Scene& scene, std::uint32_t material)
{
    scene::Primitive primitive;
    primitive.material = material;
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : {-1.0F, 1.0F}) {
            const auto corner = [&](float a, float b) {
                glm::vec3 p(0.0F);
                p[axis] = side;
                p[(axis + 1) % 3] = a * side; // turns the winding on the negative side
                p[(axis + 2) % 3] = b;
                return p;
            };
            addFace(primitive, {corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)});
        }
    }
    return addPrimitive(scene, std::move(primitive));
}

std::uint32_t addBall(scene::Scene& scene, std::uint32_t rings)
{
    scene::Primitive primitive;
    const auto corner = [&](std::uint32_t ring, std::uint32_t column) {
        const double polar = std::numbers::pi * ring / rings;
        const double around = std::numbers::pi * (column % (2 * rings)) / rings;
        return glm::vec3(std::sin(polar) * std::sin(around), std::cos(polar), std::sin(polar) * std::cos(around));
    };
    for (std::uint32_t ring = 0; ring < rings; ++ring) {
        for (std::uint32_t column = 0; column < 2 * rings; ++column) {
            addFace(primitive, {corner(ring, column), corner(ring + 1, column), corner(ring + 1, column + 1),
                                corner(ring, column + 1)});
        }
    }
    return addPrimitive(scene, std::move(primitive));
}

scene::Node& place(scene::Scene& scene, std::uint32_t mesh, const glm::mat4& world_from_mesh)
{
    scene::Node node;
    node.mesh = mesh;
    node.use_matrix = true;
    node.matrix = world_from_mesh;
    scene.nodes.push_back(node);
    return scene.nodes.back();
}

Corners level(float y, float half_size_m)
{
    const float h = half_size_m;
    return {glm::vec3(-h, y, h), glm::vec3(h, y, h), glm::vec3(h, y, -h), glm::vec3(-h, y, -h)};
}

Corners ceiling(float y, float min_x, float max_x, float half_depth_m)
{
    const float d = half_depth_m;
    return {glm::vec3(min_x, y, -d), glm::vec3(max_x, y, -d), glm::vec3(max_x, y, d), glm::vec3(min_x, y, d)};
}

View lookAt(const glm::dvec3& eye, const glm::dvec3& target, double fov_y_rad, const glm::uvec2& size_px,
            const glm::dvec3& up)
{
    glm::dmat4 clip_from_view = glm::perspectiveRH_ZO(fov_y_rad, static_cast<double>(size_px.x) / size_px.y, 1e-3, 1e5);
    clip_from_view[1][1] *= -1.0;
    return {eye, glm::inverse(clip_from_view * glm::lookAt(eye, target, up)), size_px};
}

View lookDown(double centre_x, double height_m, double half_width_m, const glm::uvec2& size_px)
{
    const double half_height_m = half_width_m * size_px.y / size_px.x;
    return lookAt({centre_x, height_m, 0.0}, {centre_x, 0.0, 0.0}, 2.0 * std::atan(half_height_m / height_m), size_px,
                  {0.0, 0.0, -1.0});
}

glm::dvec3 Traced::point(std::uint32_t x, std::uint32_t y) const
{
    const float* p = surfaces.points.pixel(x, y);
    return view.eye_ws + glm::dvec3(p[0], p[1], p[2]);
}

Traced trace(scene::Scene& scene, const View& view, const Light& light, const Options& options, double time_s)
{
    scene::finishScene(scene);
    Traced traced;
    traced.view = view;
    traced.state = scene::evaluate(scene, time_s);
    const Tracer tracer(scene, traced.state);
    traced.surfaces = tracer.see(view, options).value();
    traced.visibility = tracer.trace(traced.surfaces, view, light, options).value();
    return traced;
}

bool meetsCube(const glm::dvec3& start, const glm::dvec3& step, double end, double margin)
{
    double enter = 0.0;
    double leave = end;
    for (int axis = 0; axis < 3; ++axis) {
        const double half = 1.0 + margin;
        if (step[axis] == 0.0) {
            if (std::abs(start[axis]) >= half) {
                return false;
            }
            continue;
        }
        const double a = (-half - start[axis]) / step[axis];
        const double b = (half - start[axis]) / step[axis];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    return enter < leave;
}

void expectSound(const Traced& traced)
{
    const Surfaces& surfaces = traced.surfaces;
    const Visibility& visibility = traced.visibility;
    const std::size_t pixels = std::size_t{traced.view.size_px.x} * traced.view.size_px.y;
    ASSERT_EQ(surfaces.object_ids.values.size(), pixels);
    ASSERT_EQ(surfaces.triangle_ids.values.size(), pixels);
    ASSERT_EQ(surfaces.points.values.size(), 3 * pixels);
    ASSERT_EQ(surfaces.normals.values.size(), 3 * pixels);
    ASSERT_EQ(surfaces.smooth_normals.values.size(), 3 * pixels);
    ASSERT_EQ(visibility.visibility.values.size(), pixels);
    ASSERT_EQ(visibility.standard_error.values.size(), pixels);
    ASSERT_EQ(visibility.first_blocker_m.values.size(), pixels);
    const auto finite = [](float v) {
        return std::isfinite(v);
    };
    EXPECT_TRUE(std::all_of(surfaces.points.values.begin(), surfaces.points.values.end(), finite));
    for (std::size_t i = 0; i < pixels; ++i) {
        const float v = visibility.visibility.values[i];
        ASSERT_TRUE(v >= 0.0F && v <= 1.0F) << v;
        const float error = visibility.standard_error.values[i];
        ASSERT_TRUE(error >= 0.0F && error <= 0.5F) << error;
        ASSERT_TRUE(visibility.first_blocker_m.values[i] >= 0.0F) << visibility.first_blocker_m.values[i];
        for (const ImageF* normals : {&surfaces.normals, &surfaces.smooth_normals}) {
            const float* n = normals->values.data() + 3 * i;
            const float length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
            ASSERT_NEAR(length, surfaces.object_ids.values[i] == 0 ? 0.0F : 1.0F, 1e-5F);
        }
    }
}

std::string sharedScene(const std::string& name)
{
    const char* given = std::getenv("GNOMON_SHARED");
    const std::filesystem::path file =
        std::filesystem::path(given != nullptr ? given : GNOMON_SHARED_DIR) / "scenes" / name;
    return std::filesystem::exists(file) ? file.string() : std::string();
}

} // namespace gnomon::truth::test
