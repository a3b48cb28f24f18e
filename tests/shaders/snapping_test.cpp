// SPDX-License-Identifier: Apache-2.0
// A device moves vertices to a grid before it draws: what the automatic bias allows for that, searched over planes,
// maps, cameras, distances and grids, at every texel that a filter may look at.
#include "plane_under_light.h"

#include <gnomon/lib/receiver_footprint.glsl>

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include <array>
#include <string>

namespace gnomon::shared {
namespace {

constexpr dvec2 kScreen{640.0, 400.0};
constexpr double kLeastW = 0.75; // of a texel, as a share of the receiver's

struct Grid {
    double bits;
    bool cuts_off;   // places a vertex at the step before it, not at the nearest one
    double rounding; // half a step of the camera's depth
};

class Snapping : public testing::Test, public PlanesUnderLight {
protected:
    // How far away the point lies whose depth is drawn, pixels.
    dvec2 drawnFrom(const Grid& grid)
    {
        const double step = std::exp2(-grid.bits);
        const dvec2 off(uniform(-0.5, 0.5), uniform(-0.5, 0.5));
        return (grid.cuts_off ? off + 0.5 : off) * step;
    }

    // A camera that sees the plane's point from its lit side, as the matrix from normalised device coordinates.
    glm::dmat4 camera(const PlaneUnderLight& s)
    {
        dvec3 from = direction();
        from *= glm::dot(from, s.normal) < 0.0 ? -1.0 : 1.0;
        const dvec3 eye = s.point + from * std::exp(uniform(std::log(0.5), std::log(200.0)));
        const dvec3 target = s.point + direction() * (0.1 * glm::distance(eye, s.point));
        const double fov = uniform(0.3, 1.6);
        return glm::inverse(glm::perspectiveRH_ZO(fov, kScreen.x / kScreen.y, 1000.0, 0.1) * // reversed
                            glm::lookAtRH(eye, target, glm::normalize(glm::cross(from, direction()))));
    }

    // Where the receiver is: on the ray of its pixel, at the depth that the plane has some way from there.
    struct Seen {
        dvec3 p;
        std::array<dvec4, 4> rows; // of the matrix from normalised device coordinates
        double w;

        [[nodiscard]] double offPlane(const dvec3& n, double snap_px, double rounding) const
        {
            return shared::offPlane(rows[0], rows[1], rows[2], rows[3], w, 2.0 / kScreen, p, n, snap_px, rounding);
        }
    };
    Seen see(const PlaneUnderLight& s, const glm::dmat4& world_from_ndc, const Grid& grid)
    {
        const glm::dmat4 ndc_from_world = glm::inverse(world_from_ndc);
        const auto row = [&](int i) {
            return dvec4(world_from_ndc[0][i], world_from_ndc[1][i], world_from_ndc[2][i], world_from_ndc[3][i]);
        };
        const dvec4 clip = ndc_from_world * dvec4(s.point, 1.0);
        // On the plane depth is affine in x and y: (plane . world_from_ndc) (x, y, depth, 1) = 0.
        const dvec4 plane(s.normal, -glm::dot(s.normal, s.point));
        const dvec4 on_screen = glm::transpose(world_from_ndc) * plane;
        const dvec2 moved = dvec2(clip) / clip.w + drawnFrom(grid) * 2.0 / kScreen;
        const double depth = -(on_screen.x * moved.x + on_screen.y * moved.y + on_screen.w) / on_screen.z +
                             uniform(-1.0, 1.0) * grid.rounding;
        const dvec4 ndc(dvec2(clip) / clip.w, depth, 1.0);
        const dvec4 h = world_from_ndc * ndc;
        return {dvec3(h) / h.w, {row(0), row(1), row(2), row(3)}, h.w};
    }
};

// How far a stored texel of the receiver's own plane rises over the plane that it is compared with, where there is no
// bias, in units of the bias of a single step: as a share of what would do, in maps where texels of the plane are as
// long as at the receiver, and in those where they get longer.
TEST_F(Snapping, oneStepIsTheLeastThatNeverShowsAPlaneItsOwnShadow)
{
    for (const bool cuts_off : {false, true}) {
        double worst_even = 0.0;
        double worst_warped = 0.0;
        for (int round = 0; round < 30000; ++round) {
            const Grid grid{std::array{4.0, 6.0, 8.0, 10.0}[round / 3 % 4], cuts_off,
                            cuts_off && round % 5 == 0 ? 0x1p-25 : 0.0};
            const Shape shape = kShapes[round % 3];
            PlaneUnderLight s = make(shape, 20.0);
            const Seen seen = see(s, camera(s), grid);
            s.rule = {.automatic = 1.0, .exact_plane = 1.0};
            const MapPoint plain = projectReceiver(s.map, s.rule, seen.p, s.normal);
            const double step = std::exp2(-grid.bits);
            s.rule.snap_texels = step;
            s.rule.off_plane_m = seen.offPlane(s.normal, step, grid.rounding);
            const double bias = plain.depth - projectReceiver(s.map, s.rule, seen.p, s.normal).depth;
            const dvec2 texel = glm::floor(plain.texel + dvec2(uniform(-3.0, 3.0), uniform(-3.0, 3.0))) + 0.5;
            const dvec2 at = texel - plain.texel;
            const double w = 1.0 + glm::dot(plain.w_slope, at);
            if (w < kLeastW) {
                continue; // at the plane's horizon, which no bias in metres serves
            }
            const double compared = (plain.depth + glm::dot(plain.depth_slope, at)) / w;
            const double share = (compared - planeDepth(s, texel + drawnFrom(grid), 0.0)) / bias;
            double& worst = shape == Shape::orthographic ? worst_even : worst_warped;
            worst = std::max(worst, share);
        }
        EXPECT_LT(worst_even, cuts_off ? 1.0 + 1e-6 : 0.5 + 1e-6);
        EXPECT_GT(worst_even, cuts_off ? 0.9 : 0.45);
        EXPECT_LT(worst_warped, kSnapSteps);
        RecordProperty(cuts_off ? "cuts_off" : "rounds", std::to_string(worst_even));
        RecordProperty(cuts_off ? "cuts_off_warped" : "rounds_warped", std::to_string(worst_warped));
    }
}

} // namespace
} // namespace gnomon::shared
