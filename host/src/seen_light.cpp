// SPDX-License-Identifier: Apache-2.0
#include "seen_light.h"

#include <gnomon/frame.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace gnomon::host {
namespace {

constexpr std::size_t kMostLamps = 16;
constexpr std::size_t kRays = 13;
constexpr double kEnough = 3.0;        // rays that end in the picture: the lamp counts in full
constexpr double kUnseen = 1.0 / 16.0; // the share of a lamp's light that counts where nobody sees it: 4 stops
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double candelaOf(const ShadedLight& light)
{
    const double passed =
        light.cookie == scene::kNone ? 1.0 : 0.5; // a cookie is taken to let half of the light through
    return passed * glm::dot(glm::dvec3(light.colour), glm::dvec3(0.2126, 0.7152, 0.0722));
}

/// One ray along the axis and two rings of six around it; of a point light as of a spot that shines all around.
std::array<glm::dvec3, kRays> raysOf(const Light& lamp)
{
    const bool is_spot = lamp.type == LightType::spot;
    const glm::dvec3 axis = is_spot ? glm::normalize(lamp.direction_ws) : glm::dvec3(0.0, -1.0, 0.0);
    const glm::dvec3 aside = std::abs(axis.y) < 0.9 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0);
    const glm::dvec3 right = glm::normalize(glm::cross(axis, aside));
    const glm::dvec3 up = glm::cross(right, axis);
    const double half_rad = is_spot ? lamp.outer_half_angle_rad : std::numbers::pi;
    std::array<glm::dvec3, kRays> rays;
    rays[0] = axis;
    for (std::size_t i = 1; i < kRays; ++i) {
        const double from_axis_rad = (i <= 6 ? 0.4 : 0.8) * half_rad;
        const double around_rad = static_cast<double>(i) * std::numbers::pi / 3.0;
        rays[i] = axis * std::cos(from_axis_rad) +
                  (right * std::cos(around_rad) + up * std::sin(around_rad)) * std::sin(from_axis_rad);
    }
    return rays;
}

/// Metres to the first box that the ray enters. Where it enters none, a ray that starts inside of some, as in a room,
/// ends where it leaves the last of them: what surrounds a lamp closely lets its light out, or nothing would be lit.
double lengthOf(const glm::dvec3& from, const glm::dvec3& way, std::span<const Aabb> boxes)
{
    double entering_m = kInfinity;
    double leaving_m = 0.0;
    for (const Aabb& box : boxes) {
        const glm::dvec3 a = (glm::dvec3(box.min) - from) / way;
        const glm::dvec3 b = (glm::dvec3(box.max) - from) / way;
        double first_m = -kInfinity;
        double last_m = kInfinity;
        for (int axis = 0; axis < 3; ++axis) {
            if (way[axis] != 0.0) {
                first_m = std::max(first_m, std::min(a[axis], b[axis]));
                last_m = std::min(last_m, std::max(a[axis], b[axis]));
            } else if (from[axis] < static_cast<double>(box.min[axis]) ||
                       from[axis] > static_cast<double>(box.max[axis])) {
                last_m = -kInfinity;
            }
        }
        if (last_m < std::max(first_m, 0.0)) {
            continue;
        }
        if (first_m > 0.0) {
            entering_m = std::min(entering_m, first_m);
        } else {
            leaving_m = std::max(leaving_m, last_m);
        }
    }
    return entering_m < kInfinity || leaving_m == 0.0 ? entering_m : leaving_m;
}

/// [0, 1]: how well a patch of that size is seen. It fades beside the picture, so that nothing jumps when it is left.
double seenAs(const glm::dvec3& p_ws, double size_m, const Sight& sight)
{
    const glm::dvec3 to = p_ws - sight.eye_ws;
    const double depth_m = glm::dot(to, sight.forward_ws);
    if (!(depth_m > (sight.orthographic ? sight.near_m : 0.0))) {
        return 0.0;
    }
    const double scale = sight.orthographic ? 1.0 : depth_m;
    const double beside = std::max(std::abs(glm::dot(to, sight.right_ws)) / sight.half_x,
                                   std::abs(glm::dot(to, sight.up_ws)) / sight.half_y) /
                          scale;
    const double inside = 1.0 - glm::smoothstep(1.0, 4.0, beside);
    constexpr double kLarge = 0.25; // the share of half the picture's height at which a patch counts in full
    return inside * std::min(size_m / (kLarge * sight.half_y * scale), 1.0);
}

} // namespace

double SeenLight::lampGives(const Light& lamp, const ObjectSet& objects, const Sight& sight,
                            std::span<const std::uint8_t> left_out)
{
    const double reach_m = extentOf(lamp, objects.bounds()).reach_m;
    near_.clear();
    objects.query(planesAround(lamp.position_ws - reach_m, lamp.position_ws + reach_m), ObjectSet::Want::all, near_);
    boxes_.clear();
    for (const std::uint32_t object : near_) {
        if (left_out.empty() || left_out[object] == 0) {
            boxes_.push_back(objects.bounds(object));
        }
    }
    double all = 0.0;
    double ends = 0.0;
    double seen = 0.0;
    double seen_ends = 0.0;
    for (const glm::dvec3& way : raysOf(lamp)) {
        const double length_m = lengthOf(lamp.position_ws, way, boxes_);
        if (length_m > reach_m) {
            continue;
        }
        const double weight = seenAs(lamp.position_ws + way * length_m, length_m, sight);
        all += 1.0 / length_m;
        ends += 1.0;
        seen += weight / length_m;
        seen_ends += weight;
    }
    // Squares of means of 1 / distance: near surfaces count for more, but a lamp's own post does not rule.
    const auto perSquare = [](double sum, double count) {
        return count > 0.0 ? sum * sum / (count * count) : 0.0;
    };
    const double in_sight = perSquare(seen, seen_ends) * std::min(seen_ends / kEnough, 1.0);
    return kUnseen * perSquare(all, ends) + (1.0 - kUnseen) * in_sight;
}

std::span<const double> SeenLight::find(std::span<const ShadedLight> lights, const ObjectSet& objects,
                                        const Sight& sight, std::span<const std::uint8_t> left_out)
{
    given_.assign(lights.size(), 0.0);
    lamps_.clear();
    for (std::uint32_t i = 0; i < lights.size(); ++i) {
        if (lights[i].caster.type == LightType::directional) {
            given_[i] = candelaOf(lights[i]); // lux, of these
        } else {
            lamps_.push_back(i);
        }
    }
    std::ranges::sort(lamps_, [&](std::uint32_t a, std::uint32_t b) { // a stable sort would allocate
        const double first = candelaOf(lights[a]);
        const double second = candelaOf(lights[b]);
        return first > second || (first == second && a < b);
    });
    lamps_.resize(objects.bounds().empty() ? 0 : std::min(lamps_.size(), kMostLamps));
    for (const std::uint32_t lamp : lamps_) {
        given_[lamp] = candelaOf(lights[lamp]) * lampGives(lights[lamp].caster, objects, sight, left_out);
    }
    return given_;
}

} // namespace gnomon::host
