// SPDX-License-Identifier: Apache-2.0
#include "host/frame_renderer.h"

#include <gnomon/error.h>

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::host {
namespace {

const Aabb kBounds{{-10.0F, -1.0F, -10.0F}, {10.0F, 4.0F, 10.0F}};

glm::dvec3 project(const Camera& camera, const glm::dvec3& p)
{
    const glm::dvec4 clip = camera.clip_from_world * glm::dvec4(p, 1.0);
    return glm::dvec3(clip) / clip.w;
}

TEST(CameraOf, HasReversedDepthAndYDown)
{
    Eye eye;
    eye.position_ws = {1000.0, 2.0, 30.0};
    eye.target_ws = {1000.0, 2.0, 0.0};
    eye.near_m = 0.5;
    eye.far_m = 200.0;
    eye.fov_y_rad = 1.0;
    const Camera camera = cameraOf(eye, 200, 100, kBounds);
    EXPECT_TRUE(camera.reversed_z);
    EXPECT_NEAR(project(camera, {1000.0, 2.0, 29.5}).z, 1.0, 1e-9);
    EXPECT_NEAR(project(camera, {1000.0, 2.0, -170.0}).z, 0.0, 1e-9);
    // The top edge of the picture is at y = -1, the right edge at x = 1.
    const double half = 10.0 * std::tan(0.5);
    const glm::dvec3 corner = project(camera, {1000.0 + half * 2.0, 2.0 + half, 20.0});
    EXPECT_NEAR(corner.x, 1.0, 1e-9);
    EXPECT_NEAR(corner.y, -1.0, 1e-9);
}

TEST(CameraOf, OfAHeightIsOrthographic)
{
    Eye eye;
    eye.position_ws = {1000.0, 2.0, 30.0};
    eye.target_ws = {1000.0, 2.0, 0.0};
    eye.height_m = 12.0;
    eye.near_m = 0.5;
    eye.far_m = 200.0;
    const Camera camera = cameraOf(eye, 200, 100, kBounds);
    for (const double depth : {0.5, 50.0, 200.0}) { // the same at every depth
        const glm::dvec3 corner = project(camera, {1012.0, 8.0, 30.0 - depth});
        EXPECT_NEAR(corner.x, 1.0, 1e-9);
        EXPECT_NEAR(corner.y, -1.0, 1e-9);
        EXPECT_NEAR(corner.z, (200.0 - depth) / 199.5, 1e-9);
    }
    EXPECT_EQ(pictureHeight(eye, 7.0), 12.0);
    eye.height_m = 0.0;
    eye.fov_y_rad = 1.0;
    EXPECT_NEAR(pictureHeight(eye, 7.0), 14.0 * std::tan(0.5), 1e-12);
}

TEST(CameraOf, PicksAFarPlaneBehindEverything)
{
    Eye eye;
    eye.position_ws = {0.0, 3.0, 40.0};
    eye.target_ws = {5.0, 0.0, 0.0};
    const Camera camera = cameraOf(eye, 16, 9, kBounds);
    for (int i = 0; i < 8; ++i) {
        const glm::dvec4 clip = camera.clip_from_world * glm::dvec4(glm::dvec3(kBounds.corner(i)), 1.0);
        EXPECT_GT(clip.z, 0.0) << i;
    }
}

TEST(CameraOf, LooksStraightDownWithoutGivingUp)
{
    Eye eye;
    eye.position_ws = {0.0, 50.0, 0.0};
    eye.target_ws = {0.0, 0.0, 0.0};
    const glm::dvec3 centre = project(cameraOf(eye, 16, 9, kBounds), {0.0, 0.0, 0.0});
    EXPECT_NEAR(centre.x, 0.0, 1e-12);
    EXPECT_NEAR(centre.y, 0.0, 1e-12);
}

TEST(CameraOf, RefusesAnEyeAtItsTarget)
{
    Eye eye;
    eye.target_ws = eye.position_ws;
    EXPECT_THROW((void)cameraOf(eye, 16, 9, kBounds), Error);
    eye.target_ws.x = 1.0;
    eye.fov_y_rad = 0.0;
    EXPECT_THROW((void)cameraOf(eye, 16, 9, kBounds), Error);
}

} // namespace
} // namespace gnomon::host
