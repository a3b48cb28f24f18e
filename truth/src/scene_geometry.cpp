// SPDX-License-Identifier: Apache-2.0
// Based on: Wald, Woop, Benthin, Johnson, Ernst, "Embree: a kernel framework for efficient CPU ray tracing", 2014.
#include "scene_geometry.h"

#include "filters.h"

#include <gnomon/error.h>
#include <gnomon/world_range.h>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>

namespace gnomon::truth {
namespace {

constexpr const char* kTried = "building the ray tracer's structure";

bool isFinite(const glm::dmat4& m)
{
    for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 3; ++r) {
            if (!std::isfinite(m[c][r])) {
                return false;
            }
        }
    }
    return true;
}

bool isSkewed(const glm::dmat3& m)
{
    const double lengths = glm::length(m[0]) * glm::length(m[1]) * glm::length(m[2]);
    return !(std::abs(glm::determinant(m)) > 1e-2 * lengths);
}

/// Around all objects that have a place.
Aabb boundsOf(const scene::State& state)
{
    Aabb bounds_ws;
    for (const scene::Object& object : state.objects) {
        const glm::dvec3 size(object.bounds_ws.max - object.bounds_ws.min);
        if (std::isfinite(size.x) && std::isfinite(size.y) && std::isfinite(size.z)) {
            bounds_ws = merge(bounds_ws, object.bounds_ws);
        }
    }
    return bounds_ws;
}

/// Embree computes with an instance's own coordinates, whatever its transform makes of them.
bool hasSoundSize(const Aabb& box)
{
    constexpr float kSmallest = 1e-12F;
    const glm::vec3 edges = box.extent();
    return !isTooFar(glm::dvec3(box.min)) && !isTooFar(glm::dvec3(box.max)) &&
           std::max({edges.x, edges.y, edges.z}) >= kSmallest;
}

std::uint64_t triangleCount(const scene::Primitive& primitive)
{
    return primitive.indices.size() / 3;
}

glm::dvec3 transformPoint(const glm::dmat4& m, const glm::vec3& p)
{
    return glm::dvec3(m * glm::dvec4(glm::dvec3(p), 1.0));
}

double largest(const glm::dvec3& v)
{
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

} // namespace

SceneGeometry::SceneGeometry(const scene::Scene& scene, const scene::State& state, std::uint64_t flat_triangles,
                             const Options& options)
    : device_(newDevice())
{
    if (const std::string_view fault = rangeFault(boundsOf(state)); !fault.empty()) {
        throw Error(kTried, std::string(fault), "scale it, or move it to the origin");
    }
    const glm::dvec3 centre(state.bounds_ws.centre());
    if (!state.bounds_ws.empty() && std::isfinite(centre.x) && std::isfinite(centre.y) && std::isfinite(centre.z)) {
        origin_ws_ = centre;
    }
    describe(scene, state);
    chooseInstances(state, flat_triangles);
    build(state, options);
}

void SceneGeometry::describe(const scene::Scene& scene, const scene::State& state)
{
    static const scene::Material kDefault;
    parts_.resize(state.objects.size());
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        const scene::Object& object = state.objects[i];
        const scene::Primitive& primitive = scene.meshes[object.mesh].primitives[object.primitive];
        const scene::Material& material =
            object.material < scene.materials.size() ? scene.materials[object.material] : kDefault;
        Part& part = parts_[i];
        part.casts = object.casts && object.groups != 0;
        part.groups = object.groups;
        part.receives = object.receives;
        part.clip_planes = object.clip_planes;
        part.double_sided = material.double_sided;
        part.blended = material.alpha_mode == scene::AlphaMode::blend;
        part.rel_from_object = glm::dmat4(object.world_from_object);
        part.rel_from_object[3] -= glm::dvec4(origin_ws_, 0.0);
        if (triangleCount(primitive) == 0 || primitive.positions.empty() || !isFinite(part.rel_from_object) ||
            (part.blended && !part.casts)) {
            continue;
        }
        tints_ = tints_ || part.blended;
        // In single precision, as rasterisers have it: of a flattened object rounding chooses, and must choose alike.
        part.mirrored = glm::determinant(glm::mat3(object.world_from_object)) < 0.0F;
        part.skewed = isSkewed(glm::dmat3(part.rel_from_object));
        part.primitive = &primitive;
        part.positions =
            object.deformed == scene::kNone ? &primitive.positions : &state.deformed[object.deformed].positions;
        part.normals = object.deformed == scene::kNone ? &primitive.normals : &state.deformed[object.deformed].normals;
        if (material.alpha_mode != scene::AlphaMode::opaque) {
            part.alpha.emplace(scene, primitive, material);
        }
    }
}

void SceneGeometry::chooseInstances(const scene::State& state, std::uint64_t flat_triangles)
{
    std::uint64_t triangles = 0;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> uses;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        if (parts_[i].primitive != nullptr) {
            triangles += triangleCount(*parts_[i].primitive);
            ++uses[{state.objects[i].mesh, state.objects[i].primitive}];
        }
    }
    if (triangles <= flat_triangles) {
        return;
    }
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        const scene::Object& object = state.objects[i];
        parts_[i].instanced = parts_[i].primitive != nullptr && object.deformed == scene::kNone && !parts_[i].skewed &&
                              uses[{object.mesh, object.primitive}] > 1 && hasSoundSize(parts_[i].primitive->bounds);
    }
}

/// The triangles of all scenes that build() commits.
std::uint64_t SceneGeometry::trianglesToBuild(const scene::State& state, bool all_cast) const
{
    std::uint64_t triangles = 1; // a scene may have none
    std::set<std::pair<std::uint32_t, std::uint32_t>> instanced;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        const Part& part = parts_[i];
        if (part.primitive == nullptr) {
            continue;
        }
        if (!part.instanced) {
            triangles += triangleCount(*part.primitive) * (all_cast || !part.casts || part.blended ? 1 : 2);
        } else if (instanced.insert({state.objects[i].mesh, state.objects[i].primitive}).second) {
            triangles += triangleCount(*part.primitive);
        }
    }
    return triangles;
}

void SceneGeometry::build(const scene::State& state, const Options& options)
{
    seen_ = newScene();
    const bool all_cast = std::all_of(parts_.begin(), parts_.end(), [](const Part& part) {
        return (part.casts && !part.blended) || part.primitive == nullptr;
    });
    if (!all_cast) {
        casters_ = newScene();
    }
    Building building(options, trianglesToBuild(state, all_cast));
    std::uint64_t seen_triangles = 0;
    std::uint64_t caster_triangles = 0;
    for (std::uint32_t i = 0; i < parts_.size(); ++i) {
        const Part& part = parts_[i];
        if (part.primitive == nullptr) {
            continue;
        }
        building.start(0);
        const GeometryPointer geometry =
            part.instanced ? instanceOf(state.objects[i], part, building) : trianglesOf(part, part.rel_from_object);
        if (!part.instanced) {
            seen_triangles += part.blended ? 0 : triangleCount(*part.primitive);
            caster_triangles += part.casts ? triangleCount(*part.primitive) : 0;
        }
        if (!part.blended) {
            rtcAttachGeometryByID(seen_.get(), geometry.get(), i);
        }
        if (casters_ && part.casts) {
            rtcAttachGeometryByID(casters_.get(), geometry.get(), i);
        }
    }
    commit(seen_.get(), building, seen_triangles);
    if (casters_) {
        commit(casters_.get(), building, caster_triangles);
    }
}

GeometryPointer SceneGeometry::trianglesOf(const Part& part, const glm::dmat4& to_from_object)
{
    GeometryPointer geometry(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
    check();
    // Copied even where the transform is the identity: Embree reads 16 bytes at each vertex, past the end of a vector.
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), part.positions->size()));
    check();
    for (const glm::vec3& position : *part.positions) {
        const glm::dvec3 p = transformPoint(to_from_object, position);
        *vertices++ = static_cast<float>(p.x);
        *vertices++ = static_cast<float>(p.y);
        *vertices++ = static_cast<float>(p.z);
    }
    rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                               part.primitive->indices.data(), 0, 3 * sizeof(std::uint32_t),
                               triangleCount(*part.primitive));
    rtcSetGeometryUserData(geometry.get(), parts_.data());
    rtcSetGeometryIntersectFilterFunction(geometry.get(), filterNearest);
    rtcSetGeometryOccludedFilterFunction(geometry.get(), filterAny);
    rtcCommitGeometry(geometry.get());
    check();
    return geometry;
}

GeometryPointer SceneGeometry::instanceOf(const scene::Object& object, const Part& part, Building& building)
{
    ScenePointer& scene = instanced_[{object.mesh, object.primitive}];
    if (!scene) {
        scene = newScene();
        rtcAttachGeometry(scene.get(), trianglesOf(part, glm::dmat4(1.0)).get());
        commit(scene.get(), building, triangleCount(*part.primitive));
    }
    GeometryPointer geometry(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_INSTANCE));
    check();
    rtcSetGeometryInstancedScene(geometry.get(), scene.get());
    const glm::mat4 transform(part.rel_from_object);
    rtcSetGeometryTransform(geometry.get(), 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &transform[0][0]);
    rtcCommitGeometry(geometry.get());
    check();
    return geometry;
}

ScenePointer SceneGeometry::newScene()
{
    ScenePointer scene(rtcNewScene(device_.get()));
    check();
    rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
    return scene;
}

void SceneGeometry::commit(RTCScene scene, Building& building, std::uint64_t triangles) const
{
    building.start(triangles);
    rtcSetSceneProgressMonitorFunction(
        scene, [](void* to, double share) { return static_cast<Building*>(to)->reached(share); }, &building);
    rtcCommitScene(scene);
    rtcSetSceneProgressMonitorFunction(scene, nullptr, nullptr);
    check();
    building.finish();
}

void SceneGeometry::check() const
{
    const RTCError error = rtcGetDeviceError(device_.get());
    if (error == RTC_ERROR_OUT_OF_MEMORY) {
        throw Error(kTried, "memory ran out", "use a smaller scene", ErrorKind::out_of_memory);
    }
    // A cancelled build is reported by the code that cancelled it.
    if (error != RTC_ERROR_NONE && error != RTC_ERROR_CANCELLED) {
        throw Error(kTried, "Embree's error " + std::to_string(static_cast<int>(error)));
    }
}

std::optional<Triangle> SceneGeometry::triangle(std::uint32_t object, std::uint32_t index) const
{
    if (object >= parts_.size() || parts_[object].primitive == nullptr ||
        index >= triangleCount(*parts_[object].primitive)) {
        return {};
    }
    const Part& part = parts_[object];
    Triangle triangle;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t vertex = part.primitive->indices[std::size_t{index} * 3 + k];
        triangle.rel[k] = transformPoint(part.rel_from_object, (*part.positions)[vertex]);
        triangle.reach_m = std::max(triangle.reach_m, largest(triangle.rel[k]));
    }
    if (part.instanced) {
        triangle.reach_m = std::max(triangle.reach_m, largest(glm::dvec3(part.rel_from_object[3])));
    }
    const glm::dvec3 across = glm::cross(triangle.rel[1] - triangle.rel[0], triangle.rel[2] - triangle.rel[0]);
    const double length = glm::length(across);
    if (!(length > 0.0) || !std::isfinite(length)) {
        return {};
    }
    triangle.front = across * ((part.mirrored ? -1.0 : 1.0) / length);
    return triangle;
}

std::array<glm::dvec3, 3> SceneGeometry::vertexNormals(std::uint32_t object, std::uint32_t index) const
{
    const Part& part = parts_[object];
    // The cofactors take normals along whatever the transform is.
    const glm::dmat3 to_rel(part.rel_from_object);
    const glm::dmat3 cofactors(glm::cross(to_rel[1], to_rel[2]), glm::cross(to_rel[2], to_rel[0]),
                               glm::cross(to_rel[0], to_rel[1]));
    std::array<glm::dvec3, 3> normals{};
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t vertex = part.primitive->indices[std::size_t{index} * 3 + k];
        if (part.primitive->creased[vertex] != 0) {
            return {};
        }
        const glm::dvec3 along = cofactors * glm::dvec3((*part.normals)[vertex]);
        const double length = glm::length(along);
        normals[k] = length > 0.0 && std::isfinite(length) ? along / length : glm::dvec3(0.0);
    }
    return normals;
}

} // namespace gnomon::truth
