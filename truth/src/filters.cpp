// SPDX-License-Identifier: Apache-2.0
#include "filters.h"

#include "scene_geometry.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <span>
#include <utility>

namespace gnomon::truth {
namespace {

struct Hit {
    std::uint32_t object;
    std::uint32_t triangle;
    float u;
    float v;
};

/// An instance is attached under its object's index, and so are triangles that are not instanced.
Hit hitOf(const RTCFilterFunctionNArguments& args, unsigned lane)
{
    const unsigned instance = RTCHitN_instID(args.hit, args.N, lane, 0);
    return {instance != RTC_INVALID_GEOMETRY_ID ? instance : RTCHitN_geomID(args.hit, args.N, lane),
            RTCHitN_primID(args.hit, args.N, lane), RTCHitN_u(args.hit, args.N, lane),
            RTCHitN_v(args.hit, args.N, lane)};
}

/// Ray and normal are both in the space of the triangles that Embree holds. Instances keep the order of their vertices,
/// so their normal faces front there; what is not instanced was taken to the world, where a mirror turns it over.
bool isBehind(const RTCFilterFunctionNArguments& args, unsigned lane, const Part& part)
{
    const float along = RTCHitN_Ng_x(args.hit, args.N, lane) * RTCRayN_dir_x(args.ray, args.N, lane) +
                        RTCHitN_Ng_y(args.hit, args.N, lane) * RTCRayN_dir_y(args.ray, args.N, lane) +
                        RTCHitN_Ng_z(args.hit, args.N, lane) * RTCRayN_dir_z(args.ray, args.N, lane);
    const bool turned = part.mirrored && !part.instanced;
    return turned ? along < 0.0F : along > 0.0F;
}

bool passes(const Part& part, const Hit& hit, const RayContext& context)
{
    return part.blended || (hit.object == context.own_object && hit.triangle == context.own_triangle) ||
           (part.alpha && !part.alpha->isSolid(hit.triangle, hit.u, hit.v));
}

/// A shadow ray of a light that names none of the object's groups.
bool isOfOthers(const Part& part, const RayContext& context)
{
    return !context.from_camera && (part.groups & context.groups) == 0;
}

/// A clip plane has cut away the point that is hit.
bool isCutAway(const Part& part, const Hit& hit)
{
    if (part.clip_planes == scene::kNoClipPlanes) {
        return false;
    }
    const std::uint32_t* corners = part.primitive->indices.data() + std::size_t{hit.triangle} * 3;
    const auto corner = [&](std::size_t k) {
        return glm::dvec3((*part.positions)[corners[k]]);
    };
    const glm::dvec3 a = corner(0);
    const glm::dvec3 p = a + (corner(1) - a) * double{hit.u} + (corner(2) - a) * double{hit.v};
    return std::ranges::any_of(part.clip_planes, [&](const glm::vec4& plane) {
        return glm::dot(glm::dvec3(plane), p) + double{plane.w} < 0.0;
    });
}

/// Takes away from the ray's light what a blended surface does not let through.
void tint(const RTCFilterFunctionNArguments& args, unsigned lane, const Part& part, const Hit& hit)
{
    if (!part.blended) {
        return;
    }
    auto& context = *reinterpret_cast<RayContext*>(args.context);
    Tint& tint = context.tints[RTCRayN_id(args.ray, args.N, lane)];
    const std::pair crossing(hit.object, hit.triangle);
    const auto known = std::span(tint.crossed).first(std::min(tint.count, Tint::kMost));
    if (std::ranges::find(known, crossing) == known.end()) {
        tint.crossed[tint.count++ % Tint::kMost] = crossing;
        tint.through *= part.alpha->transmittance(hit.triangle, hit.u, hit.v);
    }
}

} // namespace

void filterNearest(const RTCFilterFunctionNArguments* args)
{
    const auto* parts = static_cast<const Part*>(args->geometryUserPtr);
    const auto& context = *reinterpret_cast<const RayContext*>(args->context);
    for (unsigned lane = 0; lane < args->N; ++lane) {
        if (args->valid[lane] == 0) {
            continue;
        }
        const Hit hit = hitOf(*args, lane);
        const Part& part = parts[hit.object];
        if (isOfOthers(part, context) || isCutAway(part, hit)) {
            args->valid[lane] = 0;
            continue;
        }
        tint(*args, lane, part, hit);
        const bool culled = context.from_camera && !part.double_sided && isBehind(*args, lane, part);
        if (culled || passes(part, hit, context)) {
            args->valid[lane] = 0;
        }
    }
}

void filterAny(const RTCFilterFunctionNArguments* args)
{
    const auto* parts = static_cast<const Part*>(args->geometryUserPtr);
    const auto& context = *reinterpret_cast<const RayContext*>(args->context);
    for (unsigned lane = 0; lane < args->N; ++lane) {
        if (args->valid[lane] == 0) {
            continue;
        }
        const Hit hit = hitOf(*args, lane);
        const Part& part = parts[hit.object];
        if (isOfOthers(part, context) || isCutAway(part, hit)) {
            args->valid[lane] = 0;
            continue;
        }
        tint(*args, lane, part, hit);
        if (passes(part, hit, context)) {
            args->valid[lane] = 0;
        }
    }
}

} // namespace gnomon::truth
