// SPDX-License-Identifier: Apache-2.0
// A scene at one moment as Embree holds it, and each triangle of it in double precision.
#pragma once

#include "alpha.h"
#include "building.h"
#include "device.h"

#include "scene/state.h"

#include <embree3/rtcore.h>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace gnomon::truth {

struct SceneDeleter {
    using pointer = RTCScene;
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
struct GeometryDeleter {
    using pointer = RTCGeometry;
    void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
using ScenePointer = std::unique_ptr<RTCScene, SceneDeleter>;
using GeometryPointer = std::unique_ptr<RTCGeometry, GeometryDeleter>;

inline constexpr std::uint32_t kLanes = 8; // rays in a packet

/// The light along a ray after blended surfaces. It means nothing for a blocked ray.
struct Tint {
    static constexpr std::uint32_t kMost = 16;

    glm::vec3 through;   // the share of red, green and blue that is left
    std::uint32_t count; // triangles counted; `crossed` has the last of them
    /// The last kMost triangles that were counted, since Embree may call a filter more than once for one hit. Behind
    /// more panes than that it is dark in any case.
    std::array<std::pair<std::uint32_t, std::uint32_t>, kMost> crossed;
};

/// The data that a ray carries into the filters that Embree calls at every hit.
struct RayContext {
    RTCIntersectContext base;           // first: a filter is handed a pointer to it
    bool from_camera = false;           // single-sided triangles are passed through from behind
    std::uint32_t groups = 0xFFFFFFFFU; // the groups of a shadow ray: Light::groups
    /// The triangle that a shadow ray starts on, which it does not hit.
    std::uint32_t own_object = RTC_INVALID_GEOMETRY_ID;
    std::uint32_t own_triangle = RTC_INVALID_GEOMETRY_ID;
    std::array<Tint, kLanes> tints; // by the ray's id

    RayContext()
    {
        rtcInitIntersectContext(&base);
        clearTints();
    }
    void clearTints()
    {
        for (Tint& tint : tints) {
            tint.through = glm::vec3(1.0F);
            tint.count = 0;
        }
    }
};

/// An object of the state as the rays know it; `primitive` is null where it takes no part at all.
struct Part {
    const scene::Primitive* primitive = nullptr;
    const std::vector<glm::vec3>* positions = nullptr;
    const std::vector<glm::vec3>* normals = nullptr;      // the vertices' normals
    glm::dmat4 rel_from_object{1.0};                      // relative to SceneGeometry::originWs()
    std::optional<AlphaTest> alpha;                       // masked and blended materials
    scene::ClipPlanes clip_planes = scene::kNoClipPlanes; // in the space of `positions`
    bool blended = false;                                 // not seen; shadow rays go through and are tinted
    bool mirrored = false;
    bool double_sided = false;
    bool casts = true;
    std::uint32_t groups = 1; // scene::Object::groups
    bool receives = true;
    bool instanced = false;
    /// Flat, or so nearly that Embree's single-precision inverse of an instance would misplace it.
    bool skewed = false;
};

struct Triangle {
    std::array<glm::dvec3, 3> rel; // relative to SceneGeometry::originWs()
    glm::dvec3 front;              // unit normal of the side that faces front
    double reach_m = 0.0;          // size of the coordinates that Embree computes with near it
};

class SceneGeometry {
public:
    /// `scene` and `state` must outlive it. Objects that take more than `flat_triangles` together are instanced where a
    /// mesh is used more than once. Throws Error when memory runs out, BuildingCancelled when `options` says so.
    SceneGeometry(const scene::Scene& scene, const scene::State& state, std::uint64_t flat_triangles,
                  const Options& options = {});

    /// All that a camera sees, and all that casts.
    [[nodiscard]] RTCScene seen() const { return seen_.get(); }
    [[nodiscard]] RTCScene casters() const { return casters_ ? casters_.get() : seen_.get(); }
    /// Some surface is blended.
    [[nodiscard]] bool tints() const { return tints_; }
    /// Rays are traced relative to this point, the middle of the scene, so that a scene far from the world's origin
    /// loses nothing.
    [[nodiscard]] const glm::dvec3& originWs() const { return origin_ws_; }
    [[nodiscard]] const Part& part(std::uint32_t object) const { return parts_[object]; }
    /// Nothing where there is no such triangle, or where it has no area.
    [[nodiscard]] std::optional<Triangle> triangle(std::uint32_t object, std::uint32_t index) const;
    /// Unit normals of the vertices of a triangle that triangle() gives; 0 where a vertex has none, and all of them
    /// where one rounds off an edge (scene::Primitive::creased).
    [[nodiscard]] std::array<glm::dvec3, 3> vertexNormals(std::uint32_t object, std::uint32_t index) const;

private:
    void describe(const scene::Scene& scene, const scene::State& state);
    void chooseInstances(const scene::State& state, std::uint64_t flat_triangles);
    void build(const scene::State& state, const Options& options);
    [[nodiscard]] std::uint64_t trianglesToBuild(const scene::State& state, bool all_cast) const;
    [[nodiscard]] GeometryPointer trianglesOf(const Part& part, const glm::dmat4& to_from_object);
    [[nodiscard]] GeometryPointer instanceOf(const scene::Object& object, const Part& part, Building& building);
    [[nodiscard]] ScenePointer newScene();
    /// `triangles` is the scene's part of those that `building` counts.
    void commit(RTCScene scene, Building& building, std::uint64_t triangles) const;
    void check() const;

    DevicePointer device_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, ScenePointer> instanced_; // by mesh and primitive
    ScenePointer seen_;
    ScenePointer casters_; // null: all that is seen casts, and nothing else
    bool tints_ = false;
    std::vector<Part> parts_;
    glm::dvec3 origin_ws_{0.0};
};

} // namespace gnomon::truth
