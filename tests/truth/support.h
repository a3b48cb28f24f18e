// SPDX-License-Identifier: Apache-2.0
// Small scenes and views for the tests of the truth.
#pragma once

#include "scene/state.h"
#include "truth/visibility.h"

#include <glm/vec3.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::truth::test {

/// Corners counter-clockwise as seen from the front; uv (0, 0), (1, 0), (1, 1), (0, 1) in that order.
using Corners = std::array<glm::vec3, 4>;

/// Adds a mesh of one quad and returns its index.
std::uint32_t addQuad(scene::Scene& scene, const Corners& corners, std::uint32_t material = scene::kNone);
/// The box [-1, 1]^3, single-sided, faces outward.
std::uint32_t addCube(scene::Scene& scene, std::uint32_t material = scene::kNone);
/// A ball of `rings` by 2 * `rings` quads, convex, of radius 1.
std::uint32_t addBall(scene::Scene& scene, std::uint32_t rings);
scene::Node& place(scene::Scene& scene, std::uint32_t mesh, const glm::mat4& world_from_mesh = glm::mat4(1.0F));
/// A level square around the origin at height y, facing up.
Corners level(float y, float half_size_m);
/// A level rectangle at height y that faces down: a camera above sees through it, yet it casts.
Corners ceiling(float y, float min_x, float max_x, float half_depth_m);

/// Looks from `eye` to `target`; `up` is any vector not along that.
View lookAt(const glm::dvec3& eye, const glm::dvec3& target, double fov_y_rad, const glm::uvec2& size_px,
            const glm::dvec3& up = {0.0, 1.0, 0.0});
/// Straight down on y = 0 from `height_m`, +x to the right; the picture is 2 * `half_width_m` wide there.
View lookDown(double centre_x, double height_m, double half_width_m, const glm::uvec2& size_px);

struct Traced {
    scene::State state;
    Surfaces surfaces;
    Visibility visibility;
    View view;

    /// In world space.
    [[nodiscard]] glm::dvec3 point(std::uint32_t x, std::uint32_t y) const;
    [[nodiscard]] double at(std::uint32_t x, std::uint32_t y) const { return *visibility.visibility.pixel(x, y); }
    [[nodiscard]] std::uint32_t id(std::uint32_t x, std::uint32_t y) const { return *surfaces.object_ids.pixel(x, y); }
};

/// Finishes `scene`, evaluates it and traces it.
Traced trace(scene::Scene& scene, const View& view, const Light& light, const Options& options, double time_s = 0.0);

inline Options hard(std::uint32_t threads = 2)
{
    return {.kind = Kind::hard, .threads = threads};
}
inline Options area(std::uint32_t samples = 256, std::uint32_t threads = 2)
{
    return {.kind = Kind::area, .samples = samples, .threads = threads};
}
inline Light sun(const glm::dvec3& direction, double angular_diameter_rad = 0.0092502450)
{
    return {.direction_ws = direction / std::sqrt(direction.x * direction.x + direction.y * direction.y +
                                                  direction.z * direction.z),
            .angular_diameter_rad = angular_diameter_rad};
}
inline Light lamp(const glm::dvec3& position, double radius_m, double near_m = 0.0)
{
    return {.type = scene::LightType::point, .position_ws = position, .radius_m = radius_m, .near_m = near_m};
}

/// Where the segment start + t * step, t in (0, end), enters or leaves the box [-1, 1]^3 grown by `margin`: the slab
/// method in double precision.
bool meetsCube(const glm::dvec3& start, const glm::dvec3& step, double end, double margin);

/// No NaN, all in range, images of the right size.
void expectSound(const Traced& traced);

/// `name` under the folder of shared scenes; empty where it is not there.
std::string sharedScene(const std::string& name);

} // namespace gnomon::truth::test
