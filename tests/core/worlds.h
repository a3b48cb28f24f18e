// SPDX-License-Identifier: Apache-2.0
// Cameras and seeded random numbers that the tests of the core share.
#pragma once

#include <gnomon/frame.h>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include <cmath>
#include <cstdint>

namespace gnomon::test {

/// The same numbers on every machine, which the distributions of the standard library do not promise.
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed * 0x9E3779B97F4A7C15U + 1) {}

    std::uint64_t bits()
    {
        // SplitMix64 (Steele, Lea, Flood, "Fast splittable pseudorandom number generators", 2014).
        std::uint64_t z = (state_ += 0x9E3779B97F4A7C15U);
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
        return z ^ (z >> 31);
    }
    double uniform() { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }
    double uniform(double low, double high) { return low + (high - low) * uniform(); }
    std::uint32_t below(std::uint32_t end) { return static_cast<std::uint32_t>(bits() % end); }
    glm::dvec3 inBox(const glm::dvec3& low, const glm::dvec3& high)
    {
        const double x = uniform(low.x, high.x);
        const double y = uniform(low.y, high.y);
        return {x, y, uniform(low.z, high.z)};
    }
    glm::dvec3 direction()
    {
        for (;;) {
            const glm::dvec3 v = inBox(glm::dvec3(-1.0), glm::dvec3(1.0));
            const double length = glm::length(v);
            if (length > 0.1 && length <= 1.0)
                return v / length;
        }
    }

private:
    std::uint64_t state_;
};

inline glm::dmat4 viewFrom(const glm::dvec3& eye, const glm::dvec3& target)
{
    const glm::dvec3 forward = glm::normalize(target - eye);
    const glm::dvec3 up = std::abs(forward.y) > 0.999 ? glm::dvec3(0, 0, -1) : glm::dvec3(0, 1, 0);
    return glm::lookAtRH(eye, target, up);
}

/// Reversed z, y down.
inline Camera perspectiveCamera(const glm::dvec3& eye, const glm::dvec3& target, double fov_y_rad, double aspect = 1.6,
                                double near_m = 0.1, double far_m = 1000.0)
{
    glm::dmat4 clip_from_view = glm::perspectiveRH_ZO(fov_y_rad, aspect, far_m, near_m);
    clip_from_view[1][1] *= -1.0;
    return {eye, clip_from_view * viewFrom(eye, target), true};
}

/// Reversed z with the far plane at infinity.
inline Camera endlessCamera(const glm::dvec3& eye, const glm::dvec3& target, double fov_y_rad, double aspect = 1.6,
                            double near_m = 0.1)
{
    const double f = 1.0 / std::tan(fov_y_rad * 0.5);
    glm::dmat4 clip_from_view(0.0);
    clip_from_view[0][0] = f / aspect;
    clip_from_view[1][1] = -f;
    clip_from_view[2][3] = -1.0;
    clip_from_view[3][2] = near_m;
    return {eye, clip_from_view * viewFrom(eye, target), true};
}

inline Camera orthographicCamera(const glm::dvec3& eye, const glm::dvec3& target, double half_m, double far_m = 1000.0)
{
    glm::dmat4 clip_from_view = glm::orthoRH_ZO(-half_m, half_m, -half_m, half_m, 0.0, far_m);
    clip_from_view[1][1] *= -1.0;
    return {eye, clip_from_view * viewFrom(eye, target), false};
}

inline Aabb boxAt(const glm::dvec3& centre, const glm::dvec3& half)
{
    return {glm::vec3(centre - half), glm::vec3(centre + half)};
}

inline Light sun(const glm::dvec3& direction)
{
    Light light;
    light.direction_ws = glm::normalize(direction);
    return light;
}

inline Light spot(const glm::dvec3& position, const glm::dvec3& direction, double half_angle_rad, double range_m = 0.0)
{
    Light light;
    light.type = LightType::spot;
    light.position_ws = position;
    light.direction_ws = glm::normalize(direction);
    light.outer_half_angle_rad = half_angle_rad;
    light.range_m = range_m;
    return light;
}

} // namespace gnomon::test
