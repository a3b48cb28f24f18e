// SPDX-License-Identifier: Apache-2.0
#include "shot_parts.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace gnomon::app {
namespace {

constexpr double kFilled = 0.92; // share of the picture's width or height that framed things fill

/// Unit, from the scene; azimuth 0 is +z, where a glTF model looks, and grows towards +x.
glm::dvec3 towards(double azimuth_rad, double elevation_rad)
{
    return {std::sin(azimuth_rad) * std::cos(elevation_rad), std::sin(elevation_rad),
            std::cos(azimuth_rad) * std::cos(elevation_rad)};
}

/// The nearest eye that has all points in its picture, for axes that are known: each side of the picture is a plane
/// through the eye, and of the points it only counts how far out they lie along that plane's normal.
class TightEye {
public:
    TightEye(const glm::dvec3& backward, double tan_x, double tan_y)
        : backward_(backward), right_(glm::normalize(glm::cross(glm::dvec3(0.0, 1.0, 0.0), backward))),
          up_(glm::cross(backward, right_)), tan_x_(tan_x), tan_y_(tan_y)
    {
    }
    void add(const glm::dvec3& p)
    {
        const double near = glm::dot(p, backward_);
        const double x = glm::dot(p, right_);
        const double y = glm::dot(p, up_);
        right_most_ = std::max(right_most_, x + tan_x_ * near);
        left_most_ = std::max(left_most_, -x + tan_x_ * near);
        top_most_ = std::max(top_most_, y + tan_y_ * near);
        bottom_most_ = std::max(bottom_most_, -y + tan_y_ * near);
    }
    [[nodiscard]] glm::dvec3 place() const
    {
        const double back =
            std::max((right_most_ + left_most_) / (2.0 * tan_x_), (top_most_ + bottom_most_) / (2.0 * tan_y_));
        return right_ * ((right_most_ - left_most_) / 2.0) + up_ * ((top_most_ - bottom_most_) / 2.0) +
               backward_ * back;
    }

private:
    static constexpr double kNone = -std::numeric_limits<double>::infinity();
    glm::dvec3 backward_;
    glm::dvec3 right_;
    glm::dvec3 up_;
    double tan_x_;
    double tan_y_;
    double right_most_ = kNone;
    double left_most_ = kNone;
    double top_most_ = kNone;
    double bottom_most_ = kNone;
};

/// Where the shadow of a point falls on the ground, as far as a picture should make room for it.
class ShadowPlace {
public:
    ShadowPlace(const Shot& shot, const Aabb& model, bool has_ground)
    {
        const bool has_sun = !shot.lights.empty() && shot.lights.front().caster.type == LightType::directional &&
                             shot.lights.front().caster.direction_ws.y < 0.0;
        if (!has_ground || !has_sun) {
            return;
        }
        const glm::dvec3& way = shot.lights.front().caster.direction_ws;
        const glm::dvec2 along(way.x, way.z);
        constexpr double kLongest = 1.5; // a low sun's longest shadow, in heights
        const double slope = glm::length(along) / -way.y;
        per_metre_ = slope > 0.0 ? along / glm::length(along) * std::min(slope, kLongest) : glm::dvec2(0.0);
        ground_y_ = static_cast<double>(model.min.y);
        falls_ = true;
    }
    [[nodiscard]] bool falls() const { return falls_; }
    [[nodiscard]] glm::dvec3 of(const glm::dvec3& p) const
    {
        const glm::dvec2 moved = per_metre_ * (p.y - ground_y_);
        return {p.x + moved.x, ground_y_, p.z + moved.y};
    }

private:
    bool falls_ = false;
    double ground_y_ = 0.0;
    glm::dvec2 per_metre_{0.0};
};

/// For whose sake the scene is looked at.
std::vector<const scene::Object*> modelOf(const scene::Scene& scene, const scene::State& state,
                                          std::optional<std::uint32_t> ground)
{
    std::vector<const scene::Object*> objects;
    for (const scene::Object& object : state.objects) {
        if (object.node != ground && !object.bounds_ws.empty()) {
            objects.push_back(&object);
        }
    }
    return withoutSurroundings(scene, std::move(objects));
}

Aabb boundsOf(std::span<const scene::Object* const> objects)
{
    Aabb bounds;
    for (const scene::Object* const object : objects) {
        bounds.min = glm::min(bounds.min, object->bounds_ws.min);
        bounds.max = glm::max(bounds.max, object->bounds_ws.max);
    }
    return bounds;
}

/// Every vertex of these, in world space.
template <typename Take>
void eachVertex(const Shot& shot, std::span<const scene::Object* const> objects, const Take& take)
{
    for (const scene::Object* const object : objects) {
        const bool is_deformed = object->deformed != scene::kNone;
        const auto& positions = is_deformed ? shot.state.deformed[object->deformed].positions
                                            : shot.scene.meshes[object->mesh].primitives[object->primitive].positions;
        const glm::dmat4 world(object->world_from_object);
        for (const glm::vec3& position : positions) {
            take(glm::dvec3(world * glm::dvec4(position, 1.0)));
        }
    }
}

} // namespace

Outlook outlookOn(const scene::Scene& scene, const scene::State& state)
{
    const Aabb bounds_ws = boundsOf(modelOf(scene, state, std::nullopt));
    Outlook outlook;
    if (bounds_ws.empty()) {
        return outlook;
    }
    const glm::dvec3 extent(bounds_ws.extent());
    const double across = std::max(extent.x, extent.z);
    if (!(across > 0.0)) {
        outlook.elevation_rad = glm::radians(14.0);
        return outlook;
    }
    // All by eye. -1: a wall that faces +z; 1: one that faces +x.
    const double length = (extent.z - extent.x) / (extent.z + extent.x);
    outlook.azimuth_rad = glm::radians(35.0 + 20.0 * length);
    outlook.elevation_rad = glm::radians(14.0 + 24.0 * std::exp(-1.2 * extent.y / across));
    outlook.sun_azimuth_rad = glm::radians(-5.0 + 36.0 * length);
    return outlook;
}

glm::dvec3 sunOf(const Outlook& outlook)
{
    constexpr double kHeight_deg = 46.0; // shadows about as long as things are high
    return -towards(outlook.sun_azimuth_rad, glm::radians(kHeight_deg));
}

Aabb modelBounds(const Shot& shot)
{
    return boundsOf(modelOf(shot.scene, shot.state, shot.ground));
}

host::Eye framedEye(const Shot& shot, double fov_y_rad, double aspect)
{
    const std::vector<const scene::Object*> objects = modelOf(shot.scene, shot.state, shot.ground);
    const Aabb model = boundsOf(objects);
    const glm::dvec3 centre = model.empty() ? glm::dvec3(0.0) : glm::dvec3(model.centre());
    const glm::dvec3 backward = towards(shot.outlook.azimuth_rad, shot.outlook.elevation_rad);
    const double tan_y = std::tan(fov_y_rad / 2.0) * kFilled;
    TightEye tight(backward, tan_y * aspect, tan_y);
    const ShadowPlace shadow(shot, model, objects.size() < shot.state.objects.size());
    const auto add = [&](const glm::dvec3& p) {
        tight.add(p - centre); // far from the origin numbers are coarse
        if (shadow.falls()) {
            tight.add(shadow.of(p) - centre);
        }
    };
    eachVertex(shot, objects, add);
    host::Eye eye;
    const glm::dvec3 place = tight.place();
    eye.position_ws = centre + place;
    eye.target_ws = eye.position_ws - backward * glm::dot(place, backward);
    eye.fov_y_rad = fov_y_rad;
    return eye;
}

host::Eye standingBack(const host::Eye& eye, const Aabb& scene_ws)
{
    const glm::dvec3 backward = glm::normalize(eye.position_ws - eye.target_ws);
    const double size_m = glm::length(glm::dvec3(scene_ws.extent()));
    host::Eye moved = eye;
    moved.position_ws = eye.target_ws + backward * std::max(glm::distance(eye.position_ws, eye.target_ws), size_m);
    return moved;
}

} // namespace gnomon::app
