// SPDX-License-Identifier: Apache-2.0
#include "shadow_rays.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace gnomon::truth {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr float kLeastSink = std::numeric_limits<float>::min(); // a positive number instead of 0 or less

/// A ray's own end is off by rounding, and a shell drawn around the emitter must not stand in its light.
constexpr double kEndShare = 1.0 - 0x1p-18;

/// The value of coloured light in a mask of one channel: ITU-R BT.709. White is 1, exactly.
double luminance(const glm::vec3& light)
{
    return light.y + 0.2126 * (double{light.x} - light.y) + 0.0722 * (double{light.z} - light.y);
}

} // namespace

glm::dvec3 offSurface(const glm::dvec3& rel, const Triangle& triangle, const glm::dvec3& normal)
{
    const glm::dvec3 on = rel - normal * glm::dot(rel - triangle.rel[0], normal);
    // Embree computes with differences of floats no larger than about reach_m, so it places a plane to a few units in
    // the last place of that, 2^-23. The own triangle is left out by its index; eight units also keep the start above
    // planes beside it and on it that are meant to be the same, which a ray above the horizon then leaves for good.
    // (Tests see the first false shadows at two units.)
    return on + normal * (triangle.reach_m * 0x1p-20);
}

/// Rays from one point to a disc, eight at a time.
struct ShadowRays::Packet {
    RayContext context;
    RTCRay8 rays{};
    alignas(64) std::array<int, kLanes> valid{};
    alignas(64) std::array<float, kLanes> ends{};

    Packet(const Receiver& receiver, const Seen& light, std::uint32_t groups);
    void aim(std::span<const DiscPoint> set, std::uint32_t first, const DiscShift& shift);

private:
    glm::vec3 normal_;
    glm::vec3 smooth_normal_;
    glm::vec3 centre_;
    glm::vec3 right_;
    glm::vec3 up_;
    // A ray's direction is w = c + tangent * rho * e, with c and e unit and perpendicular. It enters the sphere of
    // radius R around the centre, at distance d, where |t w - d c| = R. With s = R / d the smaller root is
    //     t = d (1 - s^2) / (1 + sqrt(s^2 - (1 - s^2) tangent^2 rho^2)),
    // in which nothing cancels; the root's argument is 0 where the ray just touches the sphere.
    float s2_;
    float slope_; // (1 - s^2) tangent^2
    float reach_; // d (1 - s^2)
    // It meets the near plane after t = above / (-w . n), above being how far its start is from there; hardly ever
    // where it does not sink.
    glm::vec3 plane_normal_;
    float above_plane_;
};

ShadowRays::Packet::Packet(const Receiver& receiver, const Seen& light, std::uint32_t groups)
    : normal_(receiver.normal), smooth_normal_(receiver.smooth_normal), centre_(light.direction)
{
    context.base.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    context.own_object = receiver.object;
    context.own_triangle = receiver.triangle;
    context.groups = groups;
    for (std::uint32_t k = 0; k < kLanes; ++k) {
        rays.org_x[k] = static_cast<float>(receiver.rel.x);
        rays.org_y[k] = static_cast<float>(receiver.rel.y);
        rays.org_z[k] = static_cast<float>(receiver.rel.z);
        rays.mask[k] = 0xFFFFFFFFU;
        rays.id[k] = k;
    }
    const glm::dvec3 other = std::abs(light.direction.x) < 0.6 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 right = glm::normalize(glm::cross(other, light.direction));
    right_ = right * light.tangent;
    up_ = glm::cross(light.direction, right) * light.tangent;
    const double s = light.end_radius_m / light.distance_m; // 0 for a directional light
    s2_ = static_cast<float>(s * s);
    slope_ = static_cast<float>((1.0 - s * s) * light.tangent * light.tangent);
    reach_ = static_cast<float>(light.distance_m * (1.0 - s * s) * kEndShare);
    plane_normal_ = light.plane_normal;
    above_plane_ = static_cast<float>(light.above_plane_m * kEndShare);
}

/// Rays `first` and on of `set`, as many as there are; those below the horizon, the triangle's or the smooth surface's,
/// are not valid.
void ShadowRays::Packet::aim(std::span<const DiscPoint> set, std::uint32_t first, const DiscShift& shift)
{
    const auto count = static_cast<std::uint32_t>(set.size());
    for (std::uint32_t k = 0; k < kLanes; ++k) {
        const DiscPoint point = moved(set[std::min(first + k, count - 1)], shift);
        const float rho = std::sqrt(point.area);
        const float a = rho * point.direction.x;
        const float b = rho * point.direction.y;
        rays.dir_x[k] = centre_.x + right_.x * a + up_.x * b;
        rays.dir_y[k] = centre_.y + right_.y * a + up_.y * b;
        rays.dir_z[k] = centre_.z + right_.z * a + up_.z * b;
        const float sphere_end = reach_ / (1.0F + std::sqrt(std::max(s2_ - slope_ * point.area, 0.0F)));
        const float sinks =
            -(rays.dir_x[k] * plane_normal_.x + rays.dir_y[k] * plane_normal_.y + rays.dir_z[k] * plane_normal_.z);
        ends[k] = std::min(sphere_end, above_plane_ / std::max(sinks, kLeastSink));
        rays.tfar[k] = ends[k];
        const float height = rays.dir_x[k] * normal_.x + rays.dir_y[k] * normal_.y + rays.dir_z[k] * normal_.z;
        const float smooth_height =
            rays.dir_x[k] * smooth_normal_.x + rays.dir_y[k] * smooth_normal_.y + rays.dir_z[k] * smooth_normal_.z;
        valid[k] = std::min(height, smooth_height) > 0.0F && first + k < count ? -1 : 0;
    }
}

ShadowRays::ShadowRays(const SceneGeometry& geometry, const Light& light, const Options& options)
    : geometry_(geometry), light_(light), light_rel_(light.position_ws - geometry.originWs()), seed_(options.seed)
{
    const bool directional = light.type == scene::LightType::directional;
    light_.direction_ws = glm::normalize(light.direction_ws);
    area_ = options.kind == Kind::area && (directional ? light.angular_diameter_rad : light.radius_m) > 0.0;
    if (area_) {
        set_ = makeDiscSet(options.samples / kSampleSets);
    }
}

ShadowRays::Seen ShadowRays::see(const glm::dvec3& rel) const
{
    Seen seen;
    if (light_.type == scene::LightType::directional) {
        seen.direction = -light_.direction_ws;
        seen.distance_m = kInfinity;
        seen.tangent = std::tan(light_.angular_diameter_rad * 0.5);
        return seen;
    }
    const glm::dvec3 to_centre = light_rel_ - rel;
    seen.distance_m = glm::length(to_centre);
    const double radius_m = area_ ? light_.radius_m : 0.0;
    seen.inside = seen.distance_m <= radius_m || seen.distance_m <= 0.0;
    const bool has_plane = light_.type == scene::LightType::spot && light_.near_m > 0.0;
    if (has_plane) {
        seen.plane_normal = light_.direction_ws;
        seen.above_plane_m = -glm::dot(to_centre, light_.direction_ws) - light_.near_m;
    }
    if (!seen.inside) {
        seen.direction = to_centre / seen.distance_m;
        // The cone that touches the sphere: sine r / d, so tangent r / sqrt(d^2 - r^2).
        seen.tangent = radius_m / std::sqrt((seen.distance_m - radius_m) * (seen.distance_m + radius_m));
        seen.end_radius_m = has_plane ? radius_m : std::max(radius_m, light_.near_m);
    }
    return seen;
}

double ShadowRays::Seen::centreEnd_m() const
{
    const double sinks = -glm::dot(direction, plane_normal);
    return std::min(distance_m - end_radius_m, above_plane_m / std::max(sinks, double{kLeastSink})) * kEndShare;
}

double ShadowRays::Seen::sine() const
{
    return tangent / std::sqrt(1.0 + tangent * tangent);
}

ShadowRays::Result ShadowRays::trace(const Receiver& receiver) const
{
    const Seen light = see(receiver.rel);
    const double facing = glm::dot(receiver.normal, light.direction);
    // Where the triangle faces all of the light, no other part of a smooth body stands in the way of it.
    if (light.inside || !receiver.lifts || facing > (area_ ? light.sine() : 0.0)) {
        return traceFrom(receiver, light);
    }
    Receiver lifted = receiver;
    lifted.rel = receiver.lifted_rel;
    lifted.normal = receiver.smooth_normal;
    // The ray may come down on the triangle that it starts over: that is in its way then.
    lifted.object = RTC_INVALID_GEOMETRY_ID;
    lifted.triangle = RTC_INVALID_GEOMETRY_ID;
    return traceFrom(lifted, see(lifted.rel));
}

ShadowRays::Result ShadowRays::traceFrom(const Receiver& receiver, const Seen& light) const
{
    Result result;
    result.first_blocker_m = kInfinity;
    if (light.inside) {
        return result;
    }
    if (!(glm::dot(receiver.normal, light.direction) > 0.0 &&
          glm::dot(receiver.smooth_normal, light.direction) > 0.0)) {
        result.visibility = 0.0;
        return result;
    }
    if (light.distance_m <= light.end_radius_m || light.above_plane_m <= 0.0) {
        return result; // all between the point and the light is too near to the light to cast
    }
    return area_ ? traceDisc(receiver, light) : traceCentre(receiver, light);
}

ShadowRays::Along ShadowRays::lookAlong(const Receiver& receiver, const glm::dvec3& direction, double end) const
{
    RayContext context;
    context.groups = light_.groups;
    context.own_object = receiver.object;
    context.own_triangle = receiver.triangle;
    RTCRayHit query{};
    query.ray.org_x = static_cast<float>(receiver.rel.x);
    query.ray.org_y = static_cast<float>(receiver.rel.y);
    query.ray.org_z = static_cast<float>(receiver.rel.z);
    query.ray.dir_x = static_cast<float>(direction.x);
    query.ray.dir_y = static_cast<float>(direction.y);
    query.ray.dir_z = static_cast<float>(direction.z);
    query.ray.tfar = static_cast<float>(end);
    query.ray.mask = 0xFFFFFFFFU;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(geometry_.casters(), &context.base, &query);
    if (query.hit.geomID != RTC_INVALID_GEOMETRY_ID) {
        return {query.ray.tfar * glm::length(direction), 0.0};
    }
    return {kInfinity, luminance(context.tints[0].through)};
}

ShadowRays::Result ShadowRays::traceCentre(const Receiver& receiver, const Seen& light) const
{
    Result result;
    result.rays = 1;
    const Along along = lookAlong(receiver, light.direction, light.centreEnd_m());
    result.first_blocker_m = along.blocker_m;
    result.visibility = along.visibility;
    return result;
}

ShadowRays::Result ShadowRays::traceDisc(const Receiver& receiver, const Seen& light) const
{
    Packet packet(receiver, light, light_.groups);
    Result result;
    std::array<double, kSampleSets> lit{};
    Blocked blocked;
    const auto count = static_cast<std::uint32_t>(set_.size());
    for (std::uint32_t set = 0; set < kSampleSets; ++set) {
        const DiscShift shift = shiftOf(seed_, receiver.pixel, set);
        double unblocked = 0.0;
        for (std::uint32_t first = 0; first < count; first += kLanes) {
            packet.aim(set_, first, shift);
            if (geometry_.tints()) {
                packet.context.clearTints();
            }
            rtcOccluded8(packet.valid.data(), geometry_.casters(), &packet.context.base, &packet.rays);
            for (std::uint32_t k = 0; k < kLanes; ++k) {
                const bool traced = packet.valid[k] != 0;
                const bool is_free = traced && packet.rays.tfar[k] >= 0.0F; // Embree leaves -infinity where it hits
                result.rays += traced ? 1 : 0;
                unblocked += is_free ? luminance(packet.context.tints[k].through) : 0.0;
                if (traced && !is_free && blocked.count < kBlockedKept) {
                    blocked.rays[blocked.count++] = {packet.rays.dir_x[k], packet.rays.dir_y[k], packet.rays.dir_z[k],
                                                     packet.ends[k]};
                }
            }
        }
        lit[set] = unblocked / count;
    }
    result.visibility = (lit[0] + lit[1] + lit[2] + lit[3]) / kSampleSets;
    result.standard_error = standardError(lit);
    findBlocker(receiver, light, blocked, result);
    return result;
}

/// Along the ray to the light's centre, which is what a shadow map's texel holds; where that is free, the nearest along
/// the first few rays that were blocked.
void ShadowRays::findBlocker(const Receiver& receiver, const Seen& light, const Blocked& blocked, Result& result) const
{
    result.first_blocker_m = kInfinity;
    if (blocked.count == 0) {
        return;
    }
    ++result.rays;
    result.first_blocker_m = lookAlong(receiver, light.direction, light.centreEnd_m()).blocker_m;
    if (result.first_blocker_m < kInfinity) {
        return;
    }
    for (std::uint32_t i = 0; i < blocked.count; ++i) {
        ++result.rays;
        const glm::vec4& ray = blocked.rays[i];
        const Along along = lookAlong(receiver, glm::dvec3(glm::vec3(ray)), double{ray.w});
        result.first_blocker_m = std::min(result.first_blocker_m, along.blocker_m);
    }
}

} // namespace gnomon::truth
