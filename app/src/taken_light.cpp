// SPDX-License-Identifier: Apache-2.0
// Based on: T. Möller, B. Trumbore, "Fast, minimum storage ray/triangle intersection", 1997; directions and points by
// M. Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018.
#include "shot_parts.h"

#include "command_text.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

namespace gnomon::app {
namespace {

constexpr std::size_t kPoints = 256;    // spread over what receives, by area
constexpr std::size_t kDirections = 96; // a lampshade's opening is wider than one of these
constexpr std::size_t kMostTriangles = 100'000;
constexpr std::int64_t kMostTests = 20'000'000; // tests of a ray against a triangle: a tenth of a second
constexpr double kInfinity = std::numeric_limits<double>::infinity();

using Triangle = std::array<glm::dvec3, 3>;

/// Two numbers in [0, 1) that fill a square evenly (Roberts' R2).
glm::dvec2 evenly(std::size_t i)
{
    const double n = static_cast<double>(i) + 0.5;
    return {n * 0.7548776662466927 - std::floor(n * 0.7548776662466927),
            n * 0.5698402909980532 - std::floor(n * 0.5698402909980532)};
}

/// Lengths of `way` to where the ray meets the triangle, from either side; infinity where it does not.
double meets(const Triangle& triangle, const glm::dvec3& from, const glm::dvec3& way)
{
    constexpr double kRounding = 1e-9; // no ray slips through between two triangles
    const glm::dvec3 a = triangle[1] - triangle[0];
    const glm::dvec3 b = triangle[2] - triangle[0];
    const glm::dvec3 p = glm::cross(way, b);
    const double determinant = glm::dot(a, p);
    const glm::dvec3 to = from - triangle[0];
    const double u = glm::dot(to, p) / determinant;
    const glm::dvec3 q = glm::cross(to, a);
    const double v = glm::dot(way, q) / determinant;
    const bool inside = u >= -kRounding && v >= -kRounding && u + v <= 1.0 + kRounding; // false for NaN
    return inside ? glm::dot(b, q) / determinant : kInfinity;
}

/// An object, or all objects of a node, which may together take all of a light.
struct Taker {
    std::vector<std::uint32_t> objects; // ascending
    Aabb bounds_ws;
    std::size_t triangles = 0;
};

class Search {
public:
    explicit Search(const Shot& shot) : shot_(shot)
    {
        for (std::uint32_t i = 0; i < shot.state.objects.size(); ++i) {
            if (counts(i)) {
                middles_ws_ = merge(middles_ws_, {objectAt(i).bounds_ws.centre(), objectAt(i).bounds_ws.centre()});
            }
        }
        listTakers();
    }

    /// The taker of all of a light; null where there is none.
    [[nodiscard]] const Taker* takerOf(const Light& light)
    {
        for (const Taker& taker : takers_) {
            if (mayTake(taker, light) && takesAll(taker, light)) {
                return &taker;
            }
        }
        return nullptr;
    }
    [[nodiscard]] const scene::Object& objectAt(std::uint32_t i) const { return shot_.state.objects[i]; }

private:
    [[nodiscard]] bool isBlended(const scene::Object& object) const
    {
        return alphaOf(object) == scene::AlphaMode::blend;
    }
    [[nodiscard]] scene::AlphaMode alphaOf(const scene::Object& object) const
    {
        return object.material < shot_.scene.materials.size() ? shot_.scene.materials[object.material].alpha_mode
                                                              : scene::AlphaMode::opaque;
    }
    /// Is it looked at whether this is lit? A ground that was put in says nothing of the file.
    [[nodiscard]] bool counts(std::uint32_t i) const
    {
        const scene::Object& object = objectAt(i);
        return object.receives && !object.bounds_ws.empty() && !isBlended(object) && object.node != shot_.ground;
    }
    [[nodiscard]] bool isSolid(const scene::Object& object) const
    {
        return object.casts && !object.bounds_ws.empty() && alphaOf(object) == scene::AlphaMode::opaque &&
               object.clip_planes == scene::kNoClipPlanes && object.node != shot_.ground;
    }
    [[nodiscard]] const scene::Primitive& primitiveOf(const scene::Object& object) const
    {
        return shot_.scene.meshes[object.mesh].primitives[object.primitive];
    }
    void listTakers();
    [[nodiscard]] bool mayTake(const Taker& taker, const Light& light) const;
    [[nodiscard]] bool takesAll(const Taker& taker, const Light& light);
    template <typename Take>
    void eachTriangle(std::uint32_t object, const Take& take) const;
    [[nodiscard]] std::vector<glm::dvec3> pointsBeside(const Taker& taker, const Light& light) const;
    [[nodiscard]] bool blocks(const glm::dvec3& from, const glm::dvec3& way, double begin, double end);
    [[nodiscard]] bool isDark(const glm::dvec3& p, const Light& light);
    [[nodiscard]] bool surrounds(const Light& light);

    const Shot& shot_;
    std::vector<Taker> takers_;
    Aabb middles_ws_; // around the middles of all that counts
    std::vector<Triangle> triangles_;
    std::int64_t tests_ = 0;
};

void Search::listTakers()
{
    std::vector<Taker> of_nodes(shot_.state.nodes.size());
    for (std::uint32_t i = 0; i < shot_.state.objects.size(); ++i) {
        const scene::Object& object = objectAt(i);
        if (!isSolid(object)) {
            continue;
        }
        const std::size_t triangles = primitiveOf(object).indices.size() / 3;
        takers_.push_back({{i}, object.bounds_ws, triangles});
        Taker& node = of_nodes[object.node];
        node.objects.push_back(i);
        node.bounds_ws = merge(node.bounds_ws, object.bounds_ws);
        node.triangles += triangles;
    }
    std::ranges::copy_if(of_nodes, std::back_inserter(takers_),
                         [](const Taker& node) { return node.objects.size() > 1; });
}

bool Search::mayTake(const Taker& taker, const Light& light) const
{
    const bool in_groups = std::ranges::all_of(
        taker.objects, [&](std::uint32_t object) { return (objectAt(object).groups & light.groups) != 0; });
    const glm::vec3 place(light.position_ws);
    const Aabb held = light.type == LightType::directional ? middles_ws_ : Aabb{place, place};
    return in_groups && !held.empty() && taker.triangles <= kMostTriangles && taker.bounds_ws.contains(held);
}

/// Calls take(Triangle) for each of an object's triangles, in world space.
template <typename Take>
void Search::eachTriangle(std::uint32_t object, const Take& take) const
{
    const scene::Object& at = objectAt(object);
    const scene::Primitive& primitive = primitiveOf(at);
    const std::vector<glm::vec3>& positions =
        at.deformed == scene::kNone ? primitive.positions : shot_.state.deformed[at.deformed].positions;
    const glm::dmat4 world_from_object(at.world_from_object);
    for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        Triangle triangle;
        for (std::size_t k = 0; k < 3; ++k) {
            triangle[k] = glm::dvec3(world_from_object * glm::dvec4(positions[primitive.indices[i + k]], 1.0));
        }
        take(triangle);
    }
}

/// On all else that counts and is in the light's reach: the middle of each object's first triangle, and more by area.
std::vector<glm::dvec3> Search::pointsBeside(const Taker& taker, const Light& light) const
{
    std::vector<glm::dvec3> points;
    std::vector<std::uint32_t> others;
    double area = 0.0;
    const auto areaOf = [](const Triangle& t) {
        return 0.5 * glm::length(glm::cross(t[1] - t[0], t[2] - t[0]));
    };
    for (std::uint32_t i = 0; i < shot_.state.objects.size(); ++i) {
        if (counts(i) && !std::ranges::binary_search(taker.objects, i)) {
            others.push_back(i);
            bool is_first = true;
            eachTriangle(i, [&](const Triangle& t) {
                if (is_first) {
                    points.push_back((t[0] + t[1] + t[2]) / 3.0);
                }
                is_first = false;
                area += areaOf(t);
            });
        }
    }
    double passed = 0.0;
    std::size_t next = 0;
    for (const std::uint32_t object : others) {
        eachTriangle(object, [&](const Triangle& t) {
            passed += areaOf(t);
            for (; next < kPoints && (static_cast<double>(next) + 0.5) * area < passed * double{kPoints}; ++next) {
                glm::dvec2 share = evenly(next);
                share = share.x + share.y > 1.0 ? 1.0 - share : share;
                points.push_back(t[0] + (t[1] - t[0]) * share.x + (t[2] - t[0]) * share.y);
            }
        });
    }
    if (light.type != LightType::directional && light.range_m > 0.0) {
        std::erase_if(points, [&](const glm::dvec3& p) { return glm::distance(p, light.position_ws) > light.range_m; });
    }
    return points;
}

bool Search::blocks(const glm::dvec3& from, const glm::dvec3& way, double begin, double end)
{
    for (const Triangle& triangle : triangles_) {
        ++tests_;
        const double at = meets(triangle, from, way);
        if (at > begin && at < end) {
            return true;
        }
    }
    return false;
}

/// Is the point, or the camera at it, behind the taker?
bool Search::isDark(const glm::dvec3& p, const Light& light)
{
    if (light.type == LightType::directional) {
        return blocks(p, -light.direction_ws, 0.0, kInfinity);
    }
    const glm::dvec3 way = p - light.position_ws;
    return blocks(light.position_ws, way, light.near_m / glm::length(way), 1.0);
}

/// In all directions around a lamp; under a sun in nine of ten of those that lead up, or the ground would surround
/// its objects when the sun is below.
bool Search::surrounds(const Light& light)
{
    const bool is_sun = light.type == LightType::directional;
    const glm::dvec3 from = is_sun ? glm::dvec3(middles_ws_.centre()) : light.position_ws;
    std::size_t closed = 0;
    std::size_t tried = 0;
    for (std::size_t i = 0; i < kDirections && (is_sun || closed == tried); ++i) {
        const glm::dvec2 place = evenly(i);
        const double around_rad = 2.0 * std::numbers::pi * place.x;
        const double y = is_sun ? place.y : 1.0 - 2.0 * place.y;
        const double across = std::sqrt(std::max(1.0 - y * y, 0.0));
        const glm::dvec3 way(across * std::cos(around_rad), y, across * std::sin(around_rad));
        ++tried;
        closed += blocks(from, way, is_sun ? 0.0 : light.near_m, kInfinity) ? 1 : 0;
    }
    return is_sun ? 10 * closed >= 9 * tried : closed == tried;
}

bool Search::takesAll(const Taker& taker, const Light& light)
{
    if (tests_ > kMostTests) {
        return false;
    }
    triangles_.clear();
    for (const std::uint32_t object : taker.objects) {
        eachTriangle(object, [&](const Triangle& triangle) { triangles_.push_back(triangle); });
    }
    if (!surrounds(light)) {
        return false;
    }
    std::vector<glm::dvec3> points = pointsBeside(taker, light);
    if (points.empty()) {
        return false;
    }
    points.push_back(shot_.eye.position_ws); // a camera inside sees lit surfaces
    const auto isDarkInTime = [&](const glm::dvec3& p) {
        return tests_ <= kMostTests && isDark(p, light);
    };
    return std::ranges::all_of(points, isDarkInTime);
}

std::string nameOf(const Shot& shot, const scene::Object& object)
{
    const std::string& name = shot.state.nodes[object.node].name;
    return name.empty() ? shot.scene.meshes[object.mesh].name : name;
}

} // namespace

void noteTakenLight(Shot& shot)
{
    Search search(shot);
    std::vector<std::string> notices;
    for (const host::ShadedLight& light : shot.lights) {
        const Taker* const taker = light.caster.casts_shadow ? search.takerOf(light.caster) : nullptr;
        if (taker == nullptr) {
            continue;
        }
        const scene::Object& object = search.objectAt(taker->objects.front());
        const std::string& node_name = shot.state.nodes[object.node].name;
        // --set object= has nodes' names, with semicolons between several.
        const bool can_be_set = !node_name.empty() && node_name.find(';') == std::string::npos;
        const std::string set =
            can_be_set ? ", or --set " + shellWord(fmt::format("object={}:casts=false", node_name)) : "";
        const std::string around = light.caster.type == LightType::directional ? "the scene" : "the lamp";
        notices.push_back(fmt::format("object \"{0}\" stands around {1} and takes all of the light of {2}; it casts "
                                      "nothing with \"extras\": {{\"gnomon\": {{\"casts\": false}}}} in the file{3}",
                                      nameOf(shot, object), around, light.name, set));
    }
    for (std::string& notice : notices) {
        if (std::ranges::find(shot.notices, notice) == shot.notices.end()) {
            shot.notices.push_back(std::move(notice));
        }
    }
}

} // namespace gnomon::app
