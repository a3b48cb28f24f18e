// SPDX-License-Identifier: Apache-2.0
#include "shot_parts.h"

#include <gnomon/world_range.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gnomon::app {
namespace {

/// Heights of a model over a grid of places, seen along one axis.
class Heights {
public:
    static constexpr int kSide = 48;

    Heights(const Aabb& bounds, int up) : low_(bounds.min), extent_(bounds.extent()), up_(up)
    {
        lowest_.fill(kNothing);
        lowest_upwards_.fill(kNothing);
    }
    void add(const std::array<glm::dvec3, 3>& corners)
    {
        std::array<glm::dvec3, 3> p; // across, along, height: a right-handed system, in cells
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec3 local = corners[i] - low_;
            p[i] = {inCells(local, (up_ + 1) % 3), inCells(local, (up_ + 2) % 3), local[up_]};
        }
        const double area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (p[1].y - p[0].y);
        if (area == 0.0) {
            return; // edge on
        }
        const glm::dvec3 across = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        constexpr double kFlat = 0.7; // cosine: as steep as one can stand on
        const bool is_upwards = across[up_] > kFlat * glm::length(across);
        const auto least = glm::min(p[0], glm::min(p[1], p[2]));
        const auto most = glm::max(p[0], glm::max(p[1], p[2]));
        for (int y = first(least.y); y <= last(most.y); ++y) {
            for (int x = first(least.x); x <= last(most.x); ++x) {
                addAt(x, y, p, area, is_upwards);
            }
        }
    }
    [[nodiscard]] double flooredShare() const
    {
        constexpr double kSlab = 0.12; // share of the height
        constexpr double kLow = 0.3;   // share of the height; above it is a roof
        int seen = 0;
        int floored = 0;
        for (std::size_t i = 0; i < lowest_.size(); ++i) {
            const bool is_low = lowest_upwards_[i] <= kLow * extent_[up_];
            const bool is_thin = lowest_upwards_[i] - lowest_[i] <= kSlab * extent_[up_];
            seen += lowest_[i] < kNothing ? 1 : 0;
            floored += is_low && is_thin ? 1 : 0;
        }
        return seen > 0 ? static_cast<double>(floored) / seen : 0.0;
    }

private:
    static constexpr double kNothing = std::numeric_limits<double>::infinity();

    [[nodiscard]] double inCells(const glm::dvec3& local, int axis) const
    {
        return extent_[axis] > 0.0 ? local[axis] / extent_[axis] * kSide : 0.0;
    }
    static int first(double at) { return std::clamp(static_cast<int>(std::ceil(at - 0.5)), 0, kSide); }
    static int last(double at) { return std::clamp(static_cast<int>(std::floor(at - 0.5)), -1, kSide - 1); }
    /// By barycentric coordinates of the cell's centre.
    void addAt(int x, int y, const std::array<glm::dvec3, 3>& p, double area, bool is_upwards)
    {
        const double cx = x + 0.5;
        const double cy = y + 0.5;
        const double b = ((cx - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (cy - p[0].y)) / area;
        const double c = ((p[1].x - p[0].x) * (cy - p[0].y) - (cx - p[0].x) * (p[1].y - p[0].y)) / area;
        if (b < 0.0 || c < 0.0 || b + c > 1.0) {
            return;
        }
        const double height = p[0].z + b * (p[1].z - p[0].z) + c * (p[2].z - p[0].z);
        const auto cell = static_cast<std::size_t>(y * kSide + x);
        lowest_[cell] = std::min(lowest_[cell], height);
        lowest_upwards_[cell] = is_upwards ? std::min(lowest_upwards_[cell], height) : lowest_upwards_[cell];
    }

    glm::dvec3 low_;
    glm::dvec3 extent_;
    int up_;
    std::array<double, static_cast<std::size_t>(kSide) * kSide> lowest_;
    std::array<double, static_cast<std::size_t>(kSide) * kSide> lowest_upwards_;
};

void addObject(Heights& heights, const scene::Scene& scene, const scene::State& state, const scene::Object& object)
{
    const scene::Primitive& primitive = scene.meshes[object.mesh].primitives[object.primitive];
    const auto& positions =
        object.deformed != scene::kNone ? state.deformed[object.deformed].positions : primitive.positions;
    const glm::dmat4 world(object.world_from_object);
    const bool is_mirrored = glm::determinant(glm::dmat3(world)) < 0.0;
    for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        std::array<glm::dvec3, 3> corners;
        for (std::size_t k = 0; k < 3; ++k) {
            corners[k] = glm::dvec3(world * glm::dvec4(positions[primitive.indices[i + k]], 1.0));
        }
        if (is_mirrored) {
            std::swap(corners[1], corners[2]);
        }
        heights.add(corners);
    }
}

constexpr double kHasFloor = 0.7; // share of all that is seen from above

} // namespace

double flooredShare(const scene::Scene& scene, const scene::State& state, int up)
{
    Heights heights(state.bounds_ws, up);
    for (const scene::Object& object : state.objects) {
        if (!object.bounds_ws.empty()) {
            addObject(heights, scene, state, object);
        }
    }
    return heights.flooredShare();
}

bool isBottomless(const scene::Scene& scene, const scene::State& state)
{
    const glm::vec3 extent = state.bounds_ws.extent();
    constexpr float kNarrow = 0.5F; // share of the height: a plinth, or a wall's ledge
    return std::min(extent.x, extent.z) < kNarrow * extent.y || flooredShare(scene, state, 1) < kHasFloor;
}

bool looksFallen(const scene::Scene& scene, const scene::State& state)
{
    const glm::vec3 extent = state.bounds_ws.extent();
    constexpr float kFlat = 0.25F;      // a town or a landscape is wide,
    constexpr std::size_t kSeveral = 8; // and made of parts
    return state.objects.size() >= kSeveral && extent.z > 0.0F && extent.z < kFlat * std::min(extent.x, extent.y) &&
           isBottomless(scene, state) && flooredShare(scene, state, 2) >= kHasFloor;
}

void standUp(scene::Scene& scene)
{
    const auto moved = [](std::uint32_t& node) {
        node += node != scene::kNone ? 1 : 0;
    };
    const glm::quat turn = glm::angleAxis(-glm::half_pi<float>(), glm::vec3(1.0F, 0.0F, 0.0F));
    for (scene::Node& node : scene.nodes) {
        node.parent = node.parent == scene::kNone ? 0 : node.parent + 1;
        for (glm::vec4& plane : node.clip_planes) { // a skinned mesh has them in the scene's space
            plane = node.skin != scene::kNone ? glm::vec4(turn * glm::vec3(plane), plane.w) : plane;
        }
    }
    for (scene::Skin& skin : scene.skins) {
        std::for_each(skin.joints.begin(), skin.joints.end(), moved);
    }
    for (scene::Animation& animation : scene.animations) {
        for (scene::AnimationChannel& channel : animation.channels) {
            moved(channel.node);
        }
    }
    scene::Node root;
    root.name = "up";
    root.transform.rotation = turn;
    scene.nodes.insert(scene.nodes.begin(), std::move(root));
}

namespace {

/// Rings of a disc that faces up; vertices' alpha falls from 1 to 0 where it fades.
scene::Primitive disc(const glm::vec3& centre, float radius)
{
    constexpr int kRings = 24;
    constexpr int kSpokes = 96;
    constexpr float kWhole = 0.3F; // share of the radius
    scene::Primitive disc;
    const auto add = [&](const glm::vec3& place, float alpha) {
        disc.positions.push_back(place);
        disc.normals.emplace_back(0.0F, 1.0F, 0.0F);
        disc.colours.emplace_back(1.0F, 1.0F, 1.0F, alpha);
    };
    add(centre, 1.0F);
    for (int ring = 0; ring <= kRings; ++ring) {
        const float t = static_cast<float>(ring) / kRings;
        const float r = radius / glm::mix(1.0F / kWhole, 1.0F, t); // even in the picture of a viewer on it
        const float alpha = 1.0F - t * t * (3.0F - 2.0F * t);
        for (int spoke = 0; spoke < kSpokes; ++spoke) {
            const float angle = glm::two_pi<float>() * static_cast<float>(spoke) / kSpokes;
            add(centre + glm::vec3(r * std::sin(angle), 0.0F, r * std::cos(angle)), alpha);
        }
    }
    for (int spoke = 0; spoke < kSpokes; ++spoke) {
        const auto a = static_cast<std::uint32_t>(1 + spoke);
        const auto b = static_cast<std::uint32_t>(1 + (spoke + 1) % kSpokes);
        disc.indices.insert(disc.indices.end(), {0, a, b});
        for (std::uint32_t out = 0; out < kRings * kSpokes; out += kSpokes) {
            disc.indices.insert(disc.indices.end(), {a + out, a + out + kSpokes, b + out + kSpokes});
            disc.indices.insert(disc.indices.end(), {a + out, b + out + kSpokes, b + out});
        }
    }
    return disc;
}

/// The world ends somewhere.
float radiusUnder(const Aabb& model)
{
    constexpr float kRadii = 9.0F; // it ends behind the model, close under the horizon
    const glm::vec3 extent = model.extent();
    const float wished = kRadii * 0.5F * std::max(glm::length(glm::vec2(extent.x, extent.z)), extent.y);
    const glm::vec3 centre = model.centre();
    const auto room = static_cast<float>(kFarthestPlace_m) * 0.99F - std::max(std::abs(centre.x), std::abs(centre.z));
    return std::max(std::min(wished, room), 0.5F * std::max(extent.x, extent.z));
}

} // namespace

void addGround(scene::Scene& scene, const Aabb& model_ws)
{
    const glm::vec3 extent = model_ws.extent();
    constexpr float kBelow = 2e-4F; // share of the model's size, so that things on it are seen and not the ground
    glm::vec3 centre = model_ws.centre();
    centre.y = model_ws.min.y - kBelow * std::max({extent.x, extent.y, extent.z});
    scene::Primitive primitive = disc(centre, radiusUnder(model_ws));
    primitive.material = static_cast<std::uint32_t>(scene.materials.size());
    scene::Material material;
    material.name = "ground";
    material.model = scene::ShadingModel::horizon;
    material.base_colour = {0.42F, 0.41F, 0.38F, 1.0F};
    material.metallic = 0.0F;
    scene.materials.push_back(material);
    scene::Mesh mesh;
    mesh.name = "ground";
    mesh.primitives.push_back(std::move(primitive));
    scene::Node node;
    node.name = "ground";
    node.mesh = static_cast<std::uint32_t>(scene.meshes.size());
    node.casts = false; // there is nothing beneath it, and filter volumes asks for closed casters
    scene.meshes.push_back(std::move(mesh));
    scene.nodes.push_back(std::move(node));
    scene::finishScene(scene);
}

} // namespace gnomon::app
