// SPDX-License-Identifier: Apache-2.0
// Compiled alone: what it takes of gnomon/shared is in single precision.
#include "scene.h"

#include <gnomon/shared/octahedral.h>

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace gnomon::test {
namespace {

glm::dvec3 turned(const glm::dvec3& v, double angle)
{
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    return {c * v.x + s * v.z, v.y, -s * v.x + c * v.z};
}

// Slab test in the box's own frame.
std::optional<Hit> traceBox(const Box& box, const glm::dvec3& origin, const glm::dvec3& direction)
{
    const glm::dvec3 o = turned(origin - box.centre, -box.angle);
    const glm::dvec3 d = turned(direction, -box.angle);
    double near = 1e-9;
    double far = 1e300;
    glm::dvec3 normal(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        const double a = (-box.half[axis] - o[axis]) / d[axis];
        const double b = (box.half[axis] - o[axis]) / d[axis];
        if (std::min(a, b) > near) {
            near = std::min(a, b);
            normal = glm::dvec3(0.0);
            normal[axis] = d[axis] > 0.0 ? -1.0 : 1.0;
        }
        far = std::min(far, std::max(a, b));
    }
    if (near > far || normal == glm::dvec3(0.0)) {
        return std::nullopt;
    }
    return Hit{near, turned(normal, box.angle), 0};
}

glm::dvec3 anyPerpendicular(const glm::dvec3& v)
{
    return glm::normalize(glm::cross(v, std::abs(v.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0)));
}

} // namespace

Scene makeScene()
{
    Scene scene;
    scene.boxes = {{{0.0, 1.0, 0.0}, {1.0, 1.0, 1.0}, 0.3},    {{-4.0, 2.0, 1.5}, {0.5, 2.0, 0.5}, 0.8},
                   {{3.5, 0.5, -2.0}, {1.5, 0.5, 0.4}, -0.5},  {{1.5, 4.0, 2.5}, {1.0, 0.1, 1.0}, 0.2},
                   {{-2.0, 0.25, -3.0}, {0.25, 0.25, 3.0}, 0}, {{5.0, 1.5, 3.0}, {0.05, 1.5, 1.0}, 1.1}};
    return scene;
}

std::optional<Hit> Scene::trace(const glm::dvec3& origin, const glm::dvec3& direction) const
{
    std::optional<Hit> best;
    const double t = -origin.y / direction.y;
    const glm::dvec3 p = origin + direction * t;
    if (t > 1e-9 && std::abs(p.x) <= ground_half && std::abs(p.z) <= ground_half) {
        best = Hit{t, {0.0, origin.y > 0.0 ? 1.0 : -1.0, 0.0}, 0};
    }
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        auto hit = traceBox(boxes[i], origin, direction);
        if (hit && (!best || hit->t < best->t)) {
            hit->object = static_cast<std::uint32_t>(i + 1);
            best = hit;
        }
    }
    return best;
}

std::vector<vulkan::Rows3x4> Scene::transforms() const
{
    std::vector<vulkan::Rows3x4> result;
    const auto g = static_cast<float>(ground_half);
    result.push_back({{g, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, g, 0}});
    for (const Box& box : boxes) {
        const double c = std::cos(box.angle);
        const double s = std::sin(box.angle);
        result.push_back({glm::vec4(glm::dvec4(c * box.half.x, 0.0, s * box.half.z, box.centre.x)),
                          glm::vec4(glm::dvec4(0.0, box.half.y, 0.0, box.centre.y)),
                          glm::vec4(glm::dvec4(-s * box.half.x, 0.0, c * box.half.z, box.centre.z))});
    }
    return result;
}

namespace {

constexpr std::array<glm::vec3, 4> kGround{glm::vec3{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}};
constexpr std::array<std::uint32_t, 6> kGroundIndices{0, 2, 1, 0, 3, 2};
// Six for each side: -z, z, -x, x, -y, y.
constexpr std::array<std::uint32_t, 36> kCube{0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 4, 6, 0, 6, 2,
                                              1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3};

glm::vec3 cubeCorner(std::uint32_t i)
{
    return {(i & 1U) != 0 ? 1 : -1, (i & 2U) != 0 ? 1 : -1, (i & 4U) != 0 ? 1 : -1};
}

std::vector<glm::vec3> meshPositions()
{
    std::vector<glm::vec3> positions(kGround.begin(), kGround.end());
    for (std::uint32_t i = 0; i < 8; ++i) {
        positions.push_back(cubeCorner(i));
    }
    return positions;
}

/// The side of a box by a normal in the box's own frame.
std::uint32_t sideOf(const glm::dvec3& n)
{
    const glm::dvec3 a = glm::abs(n);
    const int axis = a.z > a.x && a.z > a.y ? 0 : a.x > a.y ? 1 : 2;
    const double along = axis == 0 ? n.z : axis == 1 ? n.x : n.y;
    return static_cast<std::uint32_t>(2 * axis) + (along > 0.0 ? 1 : 0);
}

template <class T>
VkBuffer bufferOf(Gpu& gpu, const std::vector<T>& values, VkBufferUsageFlags usage)
{
    const TestBuffer made = gpu.makeBuffer(values.size() * sizeof(T), usage);
    std::memcpy(made.mapped, values.data(), values.size() * sizeof(T));
    return made.buffer;
}

vulkan::VolumeMesh addEdges(std::span<const std::uint32_t> indices, std::uint32_t first_vertex, SceneEdges& out)
{
    constexpr std::uint32_t kNone = 0xFFFFFFFF;
    const auto first = static_cast<std::uint32_t>(out.triangles.size());
    const auto first_element = static_cast<std::uint32_t>(out.elements.size());
    for (std::size_t i = 0; i < indices.size(); i += 3) {
        out.triangles.push_back({indices[i], indices[i + 1], indices[i + 2]});
    }
    for (std::uint32_t t = first; t < out.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t from = out.triangles[t][k];
            const std::uint32_t to = out.triangles[t][(k + 1) % 3];
            std::uint32_t right = kNone;
            for (std::uint32_t other = first; other < out.triangles.size(); ++other) {
                for (std::size_t j = 0; j < 3; ++j) {
                    const bool meets = out.triangles[other][j] == to && out.triangles[other][(j + 1) % 3] == from;
                    right = meets ? other : right;
                }
            }
            if (right == kNone || from < to) {
                out.elements.emplace_back(from, to, t, right);
            }
        }
    }
    return {first_element, static_cast<std::uint32_t>(out.elements.size()) - first_element, first_vertex};
}

template <class T>
vulkan::BufferRef uploadStorage(Gpu& gpu, const std::vector<T>& data)
{
    const TestBuffer buffer = gpu.makeBuffer(data.size() * sizeof(T), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    std::memcpy(buffer.mapped, data.data(), data.size() * sizeof(T));
    return {buffer.buffer, data.size() * sizeof(T)};
}

} // namespace

SceneEdges sceneEdges()
{
    SceneEdges edges;
    edges.positions = meshPositions();
    edges.meshes[0] = addEdges(kGroundIndices, 0, edges);
    edges.meshes[1] = addEdges(kCube, 4, edges);
    return edges;
}

void partSides(Gpu& gpu, SceneMesh& mesh)
{
    std::vector<glm::vec3> positions(kGround.begin(), kGround.end());
    std::vector<std::uint32_t> indices(kGroundIndices.begin(), kGroundIndices.end());
    std::vector<std::uint32_t> pieces(positions.size(), 0);
    for (std::uint32_t i = 0; i < kCube.size(); ++i) {
        positions.push_back(cubeCorner(kCube[i]));
        indices.push_back(i);
        pieces.push_back(i / 6);
    }
    mesh.geometry.positions = bufferOf(gpu, positions, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
    mesh.geometry.indices = bufferOf(gpu, indices, VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
    mesh.geometry.pieces = bufferOf(gpu, pieces, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
}

TestMesh testMesh()
{
    TestMesh mesh;
    mesh.positions = meshPositions();
    mesh.indices.assign(kGroundIndices.begin(), kGroundIndices.end());
    mesh.indices.insert(mesh.indices.end(), kCube.begin(), kCube.end());
    return mesh;
}

SceneMesh uploadMesh(Gpu& gpu, const Scene& scene)
{
    const auto [positions, indices] = testMesh();

    SceneMesh mesh;
    const TestBuffer vertex_buffer =
        gpu.makeBuffer(positions.size() * sizeof(glm::vec3), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
    std::memcpy(vertex_buffer.mapped, positions.data(), positions.size() * sizeof(glm::vec3));
    const TestBuffer index_buffer = gpu.makeBuffer(indices.size() * 4, VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
    std::memcpy(index_buffer.mapped, indices.data(), indices.size() * 4);
    mesh.geometry.positions = vertex_buffer.buffer;
    mesh.geometry.indices = index_buffer.buffer;
    mesh.parts = {{{0, 6, 0}, 0}, {{6, 36, 4}, 0}};
    mesh.objects.push_back({0, 1});
    mesh.objects.resize(1 + scene.boxes.size(), {1, 1});
    mesh.batches.resize(1);
    const SceneEdges edges = sceneEdges();
    mesh.edges = {uploadStorage(gpu, edges.positions), uploadStorage(gpu, edges.elements),
                  uploadStorage(gpu, edges.triangles)};
    mesh.outlines.push_back(edges.meshes[0]);
    mesh.outlines.resize(1 + scene.boxes.size(), edges.meshes[1]);
    mesh.vertex_count = static_cast<std::uint32_t>(positions.size());
    mesh.mapped_indices = index_buffer.mapped;
    return mesh;
}

Camera makeCamera(glm::dvec3 eye, glm::dvec3 target, double aspect, bool reversed_z)
{
    const double near = 0.1;
    const double far = 200.0;
    glm::dmat4 clip_from_view =
        reversed_z ? glm::perspectiveRH_ZO(0.9, aspect, far, near) : glm::perspectiveRH_ZO(0.9, aspect, near, far);
    clip_from_view[1][1] = -clip_from_view[1][1];
    Camera camera;
    camera.eye_ws = eye;
    camera.clip_from_world = clip_from_view * glm::lookAtRH(eye, target, glm::dvec3(0, 1, 0));
    camera.reversed_z = reversed_z;
    return camera;
}

Picture tracePicture(const Scene& scene, const Camera& camera, VkExtent2D extent)
{
    Picture picture;
    picture.extent = extent;
    const glm::dmat4 world_from_clip = glm::inverse(camera.clip_from_world);
    for (std::uint32_t y = 0; y < extent.height; ++y) {
        for (std::uint32_t x = 0; x < extent.width; ++x) {
            const glm::dvec4 far = world_from_clip * glm::dvec4((x + 0.5) / extent.width * 2.0 - 1.0,
                                                                (y + 0.5) / extent.height * 2.0 - 1.0, 0.5, 1.0);
            const glm::dvec3 direction = glm::normalize(glm::dvec3(far) / far.w - camera.eye_ws);
            const auto hit = scene.trace(camera.eye_ws, direction);
            const glm::dvec3 p = hit ? camera.eye_ws + direction * hit->t : glm::dvec3(0.0);
            const glm::dvec4 clip = camera.clip_from_world * glm::dvec4(p, 1.0);
            const float background = camera.reversed_z ? 0.0F : 1.0F;
            picture.depth.push_back(hit ? static_cast<float>(clip.z / clip.w) : background);
            picture.position.push_back(p);
            picture.normal.push_back(hit ? hit->normal : glm::dvec3(0.0));
            picture.object_plus_one.push_back(hit ? hit->object + 1 : 0);
            const bool is_box = hit && hit->object > 0;
            picture.piece.push_back(is_box ? sideOf(turned(hit->normal, -scene.boxes[hit->object - 1].angle)) : 0);
            const glm::vec2 e = hit ? shared::octahedralEncode(glm::vec3(hit->normal)) : glm::vec2(0.0F);
            picture.octahedral.push_back(glm::i16vec2(glm::round(e * 32767.0F)));
        }
    }
    return picture;
}

Light makeSun(glm::dvec3 direction)
{
    Light light;
    light.direction_ws = glm::normalize(direction);
    return light;
}

Light makeSpot(glm::dvec3 position, glm::dvec3 target, double half_angle)
{
    Light light;
    light.type = LightType::spot;
    light.position_ws = position;
    light.direction_ws = glm::normalize(target - position);
    light.outer_half_angle_rad = half_angle;
    return light;
}

View makeView(const Scene& scene, const Light& light, std::uint32_t index, Tile tile)
{
    const glm::dvec3 axis = light.direction_ws;
    const glm::dvec3 up = anyPerpendicular(axis);
    View view;
    view.light = index;
    view.place.tile = tile;
    glm::dmat4 clip_from_view;
    glm::dvec3 origin;
    if (light.type == LightType::directional) {
        const double radius = 12.0; // less than the ground: its rim stays outside, and reads lit
        origin = -axis * 40.0;
        view.projection.metric.near_m = 25.0;
        view.projection.metric.far_m = 40.0 + scene.ground_half;
        clip_from_view = glm::orthoRH_ZO(-radius, radius, -radius, radius, view.projection.metric.near_m,
                                         view.projection.metric.far_m);
        view.projection.texel_m = 2.0 * radius / tile.width;
    } else {
        origin = light.position_ws;
        view.projection.metric.near_m = 0.2;
        view.projection.metric.far_m = 40.0;
        clip_from_view = glm::perspectiveRH_ZO(2.0 * light.outer_half_angle_rad, 1.0, view.projection.metric.near_m,
                                               view.projection.metric.far_m);
        view.projection.texel_m = 2.0 * std::tan(light.outer_half_angle_rad) / tile.width;
        view.projection.orthographic = false;
        view.projection.parallel = false;
        view.projection.clamp_near = false;
    }
    clip_from_view[1][1] = -clip_from_view[1][1];
    view.projection.clip_from_world = clip_from_view * glm::lookAtRH(origin, origin + axis, up);
    const double range = view.projection.metric.far_m - view.projection.metric.near_m;
    view.projection.metric.metric_ws =
        glm::dvec4(axis, -glm::dot(axis, origin) - view.projection.metric.near_m) / range;
    return view;
}

std::shared_ptr<const std::vector<ResolvedOptions>> planOptions(const ShadowOptions& options)
{
    return std::make_shared<const std::vector<ResolvedOptions>>(1, resolvedOrThrow(options));
}

Plan makePlan(const Scene& scene, std::span<const Light> lights, std::span<const Tile> tiles, MapPages atlas,
              const ShadowOptions& options)
{
    Plan plan;
    plan.options = planOptions(options);
    plan.pages[0] = atlas;
    plan.made_for.camera = makeCamera({9.0, 6.0, 11.0}, {0.0, 0.5, 0.0}, 4.0 / 3.0);
    plan.made_for.lights.assign(lights.begin(), lights.end());
    plan.mask_layers = static_cast<std::uint32_t>((lights.size() + 3) / 4);
    for (std::uint32_t i = 0; i <= scene.boxes.size(); ++i) {
        plan.casters.push_back(i);
    }
    for (std::uint32_t i = 0; i < lights.size(); ++i) {
        View view = makeView(scene, lights[i], i, tiles[i]);
        view.casters.count = static_cast<std::uint32_t>(plan.casters.size());
        plan.views.push_back(view);
        plan.lights.push_back({i, 1, i / 4, i % 4, {}});
    }
    return plan;
}

void MapNames::name(Plan& plan)
{
    static ContentNumber last = 0; // no number is given twice, by any MapNames
    contents_.resize(std::max(contents_.size(), plan.views.size()));
    plan.map_count = static_cast<std::uint32_t>(2 * contents_.size());
    for (std::uint32_t i = 0; i < plan.views.size(); ++i) {
        View& view = plan.views[i];
        Contents& held = contents_[i];
        const bool known = held.map != 0;
        held.map = known ? held.map : ++last;
        view.place.map = {2 * i, 0};
        view.contents.presumes = known || !view.contents.redraw ? held.map : 0;
        held.map = view.contents.redraw ? ++last : held.map;
        view.contents.makes = held.map;
        if (view.contents.kept_layer != kNoIndex) {
            held.kept = held.kept != 0 ? held.kept : ++last;
            view.contents.kept_map = {2 * i + 1, 0};
            view.contents.kept_presumes = held.kept;
            held.kept = view.contents.redraw_kept ? ++last : held.kept;
            view.contents.kept_makes = held.kept;
        }
    }
}

} // namespace gnomon::test
