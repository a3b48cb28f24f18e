// SPDX-License-Identifier: Apache-2.0
// The map that a camera at the light would draw in the viewer's post-perspective space.
// Based on: M. Stamminger, G. Drettakis, "Perspective Shadow Maps", SIGGRAPH 2002.
//
// With C the camera's matrix, p' = C p the image of a point and l' that of the light, the map is a perspective picture
// taken from l'_xyz / l'_w toward the middle of the cube [-1, 1]^3. Its w is the distance along that view,
//   w = r' . (p'_xyz / p'_w - l'_xyz / l'_w),  r' = -l'_xyz / l'_w,
// and times p'_w l'_w^2, which leaves the picture as it is,
//   F(p) = |l'_xyz|^2 p'_w - l'_w (l'_xyz . p'_xyz).
// F is linear in p and F(l) = 0: it depends on the ray alone, up to the distance from the light. So it is an affine
// function of the plane across the light, and its zero is the vanishing line of the homography; the rest of it is
// affine, which the map's rectangle makes good. A light in the camera's plane, l'_w = 0, needs no case of its own: F is
// p'_w.
//
// The known difficulties of the technique do not affect F. A caster behind the camera's plane has a p' that is turned
// inside out, but it is on the ray of its receiver and has that ray's F. An inverse light (l'_w < 0) reverses the order
// of depths along the rays, but the map stores metres along the ray. Only F = 0 among the seen points does harm, which
// needs the light's image in or close to the cube. These cases are detected and drawn without a warp.
#include "fit/psm.h"

#include "fit/view_slope.h"

#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <limits>

namespace gnomon {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// The camera's plane for a light, as a share of its image's length.
constexpr double kParallel = 1e-9;

constexpr std::string_view kOrthographic =
    "the camera sees near and far things equally large, so the map is drawn without a warp";
constexpr std::string_view kInside =
    "the light is in the camera's view, where post-perspective space has no picture from "
    "it; the map is drawn without a warp";
constexpr std::string_view kCrosses =
    "what is seen lies around the light in post-perspective space, and no picture from "
    "there holds it; the map is drawn without a warp";
constexpr std::string_view kTooStrong =
    "post-perspective space asks for a stronger warp than the map can bear, so it is drawn without one";
constexpr std::string_view kWeak =
    "post-perspective space is about even across the light, so the map is drawn without a warp";

Warp none(std::string_view reason)
{
    Warp warp;
    warp.outcome = {OutcomeKind::fallback, reason};
    return warp;
}

} // namespace

PsmImage psmImageOf(const FitInput& input)
{
    PsmImage image;
    glm::dmat4& rows = image.clip_rows;
    rows = glm::transpose(input.view.clip_from_world);
    double near = kInfinity;
    double far = -kInfinity;
    for (const glm::dvec3& p_ws : input.body_ws) {
        const double w = glm::dot(rows[3], glm::dvec4(p_ws, 1.0));
        near = std::min(near, w);
        far = std::max(far, w);
    }
    // Things in one plane of view have no range; any small one will do.
    far = std::max(far, near + 1e-6 * std::abs(near));
    // z'/w' = -1 at w' = near, 1 at w' = far.
    rows[2] = rows[3] * ((far + near) / (far - near));
    rows[2].w -= 2.0 * far * near / (far - near);

    const glm::dvec4 light =
        input.space.perspective ? glm::dvec4(input.space.origin_ws, 1.0) : glm::dvec4(-input.space.forward_ws, 0.0);
    image.light = light * rows;
    const glm::dvec3 place(image.light);
    if (std::abs(image.light.w) <= kParallel * glm::length(place)) {
        image.kind = PsmLight::parallel;
    } else {
        image.kind = image.light.w > 0.0 ? PsmLight::point : PsmLight::inverse;
    }
    const glm::dvec3 apart = glm::abs(place);
    image.inside = image.light.w > 0.0 && std::max({apart.x, apart.y, apart.z}) <= image.light.w;
    return image;
}

Warp fitPsm(const FitInput& input)
{
    if (!input.view.perspective) {
        return none(kOrthographic);
    }
    const PsmImage image = psmImageOf(input);
    if (image.inside) {
        return none(kInside);
    }
    const glm::dvec3 light(image.light);
    const glm::dmat4& rows = image.clip_rows;
    const glm::dvec4 f =
        rows[3] * glm::dot(light, light) - (rows[0] * light.x + rows[1] * light.y + rows[2] * light.z) * image.light.w;
    // Along the axes of the plane, and at its origin: one metre before a light with a place.
    const LightSpace& space = input.space;
    const glm::dvec2 gradient(glm::dot(glm::dvec3(f), space.right_ws), glm::dot(glm::dvec3(f), space.up_ws));
    const double at_origin =
        space.perspective ? glm::dot(glm::dvec3(f), space.forward_ws) : glm::dot(f, glm::dvec4(space.origin_ws, 1.0));
    double least = kInfinity;
    double most = -kInfinity;
    for (const glm::dvec2& q : input.outline) {
        const double w = at_origin + glm::dot(gradient, q);
        least = std::min(least, w);
        most = std::max(most, w);
    }
    const double sign = most > 0.0 ? 1.0 : -1.0;
    if (sign < 0.0) {
        std::swap(least, most);
        least = -least;
        most = -most;
    }
    if (!(least > 0.0)) {
        return none(kCrosses);
    }
    if (most > least * input.strongest) {
        return none(kTooStrong);
    }
    if (!(most >= least * kLeastStrength)) {
        return none(kWeak);
    }
    ViewSlope slope;
    slope.slope = glm::length(gradient);
    slope.along = gradient * (sign / slope.slope);
    slope.weak = kWeak;
    slope.nearest = (least - sign * at_origin) / slope.slope;
    slope.length = (most - least) / slope.slope;
    Warp warp = warpAlong(input, slope, least / slope.slope);
    if (warp.warped()) {
        standUpright(warp, input.outline);
    }
    return warp;
}

} // namespace gnomon
