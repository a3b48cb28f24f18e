// SPDX-License-Identifier: Apache-2.0
// The planes of a convex region, made ready for testing many boxes.
#pragma once

#include <gnomon/geometry.h>

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>

namespace gnomon {

class RegionTest {
public:
    /// More than 32 planes: the rest is left out, which only makes the region larger.
    explicit RegionTest(std::span<const Plane> planes)
    {
        std::size_t count = 0;
        for (const Plane& plane : planes.first(std::min(planes.size(), kMaxPlanes))) {
            planes_[count++] = {plane.normal, plane.d, glm::abs(plane.normal)};
        }
        all_ = static_cast<std::uint32_t>((std::uint64_t{1} << count) - 1);
    }

    [[nodiscard]] std::uint32_t allPlanes() const { return all_; }

    /// Drops from `mask` the planes that the box is inside of; false when it is outside one.
    [[nodiscard]] bool narrow(const glm::dvec3& centre, const glm::dvec3& half, std::uint32_t& mask) const
    {
        for (std::uint32_t left = mask; left != 0; left &= left - 1) {
            const TestPlane& plane = planes_[static_cast<std::size_t>(std::countr_zero(left))];
            const double distance = glm::dot(plane.normal, centre) + plane.d;
            const double reach = glm::dot(plane.size, half) + slack(plane, centre);
            if (distance < -reach) {
                return false;
            }
            if (distance > reach) {
                mask &= ~(left & (~left + 1));
            }
        }
        return true;
    }

    /// Whether a box may touch the region, by the planes in `mask`. No early way out: the branches would be guesses.
    [[nodiscard]] bool touches(const Aabb& box, std::uint32_t mask) const
    {
        const glm::dvec3 centre = (glm::dvec3(box.min) + glm::dvec3(box.max)) * 0.5;
        const glm::dvec3 half = (glm::dvec3(box.max) - glm::dvec3(box.min)) * 0.5;
        double nearest = 0.0;
        for (std::uint32_t left = mask; left != 0; left &= left - 1) {
            const TestPlane& plane = planes_[static_cast<std::size_t>(std::countr_zero(left))];
            const double distance = glm::dot(plane.normal, centre) + plane.d;
            nearest = std::min(nearest, distance + glm::dot(plane.size, half) + slack(plane, centre));
        }
        return nearest >= 0.0;
    }

private:
    static constexpr std::size_t kMaxPlanes = 32;
    struct TestPlane {
        glm::dvec3 normal;
        double d;
        glm::dvec3 size; // |normal|
    };
    /// Rounding must not push out what touches the plane.
    [[nodiscard]] static double slack(const TestPlane& plane, const glm::dvec3& centre)
    {
        return 1e-12 * (std::abs(plane.d) + glm::dot(plane.size, glm::abs(centre)));
    }

    std::array<TestPlane, kMaxPlanes> planes_;
    std::uint32_t all_ = 0;
};

} // namespace gnomon
