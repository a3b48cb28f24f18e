// SPDX-License-Identifier: Apache-2.0
#include "fit/view_slope.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Sine of the angle between view and light below which a warp too weak to matter is laid to that angle: 6 degrees.
constexpr double kDuelSine = 0.1;
/// Below this the direction itself is rounding.
constexpr double kLeastSine = 1e-9;
/// The vanishing line keeps this many times off the outline what coordinates may be off in single precision.
constexpr double kRoundings = 16.0;
constexpr double kTangentRounding = 1e-6;

constexpr std::string_view kOrthographic =
    "the camera sees near and far things equally large, so the map is drawn without a warp";
constexpr std::string_view kDuel = "the camera looks along the light, so the map is drawn without a warp";
constexpr std::string_view kFlat =
    "all that is seen is about equally far from the camera, as the light sees it, so the map is drawn without a warp";
constexpr std::string_view kNothing = "what is seen has no extent across the light, so the map is drawn without a warp";

/// A point (x, y) as the light sees it, and z, the value there.
glm::dvec3 seenAt(const FitInput& input, const glm::dvec3& p_ws)
{
    const glm::dvec3 p = input.space.project(p_ws);
    const double depth = input.view.depthOf(p_ws);
    return {p.x, p.y, input.space.perspective ? depth / p.z : depth};
}

/// Integrals over an area of two functions that are affine on each of its triangles, and of their products.
struct Moments {
    double area = 0.0;
    glm::dvec3 sum{0.0}; // sums of x, y, z
    double xx = 0.0;
    double xy = 0.0;
    double yy = 0.0;
    double xz = 0.0;
    double yz = 0.0;

    void add(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
    {
        const double part = 0.5 * std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
        const glm::dvec3 all = a + b + c;
        const auto product = [&](int i, int j) {
            return part / 12.0 * (all[i] * all[j] + a[i] * a[j] + b[i] * b[j] + c[i] * c[j]);
        };
        area += part;
        sum += all * (part / 3.0);
        xx += product(0, 0);
        xy += product(0, 1);
        yy += product(1, 1);
        xz += product(0, 2);
        yz += product(1, 2);
    }
    /// From integrals to means and covariances. Precondition: area > 0.
    void centre()
    {
        sum /= area;
        xx = xx / area - sum.x * sum.x;
        xy = xy / area - sum.x * sum.y;
        yy = yy / area - sum.y * sum.y;
        xz = xz / area - sum.x * sum.z;
        yz = yz / area - sum.y * sum.z;
    }
};

/// The value over the faces of the body as the light sees them, front and back.
struct BodyValues {
    Moments moments; // from `base` on
    double least = kInfinity;
    double most = 0.0;
};
/// `base` is near the body, so that nothing is lost far from the origin.
BodyValues valuesOf(const FitInput& input, const glm::dvec3& base)
{
    BodyValues body;
    const auto take = [&](const glm::dvec3& p_ws) {
        const glm::dvec3 p = seenAt(input, p_ws) - base;
        body.least = std::min(body.least, p.z);
        body.most = std::max(body.most, p.z);
        return p;
    };
    std::size_t first = 0;
    for (const std::uint32_t count : input.face_sizes) {
        const std::span face = input.body_ws.subspan(first, count);
        first += count;
        const glm::dvec3 a = take(face[0]);
        glm::dvec3 b = take(face[1]);
        for (std::size_t i = 2; i < face.size(); ++i) {
            const glm::dvec3 c = take(face[i]);
            body.moments.add(a, b, c);
            b = c;
        }
    }
    return body;
}

/// The extent of the outline along the slope.
void measureOutline(const FitInput& input, ViewSlope& slope)
{
    double farthest = -kInfinity;
    slope.nearest = kInfinity;
    for (const glm::dvec2& q : input.outline) {
        const double s = glm::dot(slope.along, q);
        slope.nearest = std::min(slope.nearest, s);
        farthest = std::max(farthest, s);
    }
    slope.length = farthest - slope.nearest;
}

/// The value at the near end, on the plane of this slope that lies evenly through the body. Precondition: centred.
void setNearEnd(const BodyValues& body, const glm::dvec3& base, ViewSlope& slope)
{
    const double centre = glm::dot(slope.along, glm::dvec2(base) + glm::dvec2(body.moments.sum));
    const double at_nearest = body.moments.sum.z + slope.slope * (slope.nearest - centre);
    slope.low = std::max({at_nearest, body.least, 0.0});
}

ViewSlope none(std::string_view reason)
{
    ViewSlope slope;
    slope.outcome = {OutcomeKind::fallback, reason};
    return slope;
}

} // namespace

ViewSlope slopeAcrossLight(const FitInput& input)
{
    if (!input.view.perspective) {
        return none(kOrthographic);
    }
    const glm::dvec3& forward = input.view.forward_ws;
    const glm::dvec2 gradient(glm::dot(forward, input.space.right_ws), glm::dot(forward, input.space.up_ws));
    ViewSlope slope;
    slope.slope = glm::length(gradient);
    if (!(slope.slope > kLeastSine)) {
        return none(kDuel);
    }
    const glm::dvec3 base(input.outline.front(), 0.0);
    BodyValues body = valuesOf(input, base);
    if (!(body.moments.area > 0.0)) {
        return none(kNothing);
    }
    body.moments.centre();
    slope.along = gradient / slope.slope;
    slope.weak = slope.slope < kDuelSine ? kDuel : kFlat;
    measureOutline(input, slope);
    setNearEnd(body, base, slope);
    slope.high = std::max(body.most, slope.low);
    return slope;
}

ViewSlope slopeOfBody(const FitInput& input)
{
    if (!input.view.perspective) {
        return none(kOrthographic);
    }
    const glm::dvec3 base(input.outline.front(), 0.0);
    BodyValues body = valuesOf(input, base);
    Moments& moments = body.moments;
    if (!(moments.area > 0.0)) {
        return none(kNothing);
    }
    moments.centre();
    // A body that is a line to the light has no slope across it; a grain of variance added keeps it from having any.
    const double grain = 1e-9 * (moments.xx + moments.yy);
    const double xx = moments.xx + grain;
    const double yy = moments.yy + grain;
    const double determinant = xx * yy - moments.xy * moments.xy;
    if (!(determinant > 0.0)) {
        return none(kNothing);
    }
    const glm::dvec2 gradient =
        glm::dvec2(yy * moments.xz - moments.xy * moments.yz, xx * moments.yz - moments.xy * moments.xz) / determinant;
    ViewSlope slope;
    slope.slope = glm::length(gradient);
    // The plane across the light has a unit gradient at most; the least share of it that is more than rounding.
    if (!(slope.slope > kLeastSine)) {
        return none(kFlat);
    }
    slope.along = gradient / slope.slope;
    slope.weak = kFlat;
    measureOutline(input, slope);
    setNearEnd(body, base, slope);
    slope.high = slope.low + slope.slope * slope.length;
    return slope;
}

ViewSlope slopeOfView(const FitInput& input)
{
    return input.space.perspective ? slopeOfBody(input) : slopeAcrossLight(input);
}

Warp warpAlong(const FitInput& input, const ViewSlope& slope, double n)
{
    Warp warp;
    warp.outcome = slope.outcome;
    if (warp.outcome.kind != OutcomeKind::ok) {
        return warp;
    }
    const double rounding = input.space.perspective ? kTangentRounding : input.view.pad_m;
    const double least = std::max(slope.length / (input.strongest - 1.0), kRoundings * rounding);
    n = std::max(n, least);
    // Also where n is infinite, or no number at all.
    if (!(1.0 + slope.length / n >= kLeastStrength)) {
        warp.outcome = {OutcomeKind::fallback, slope.length > 0.0 ? slope.weak : kNothing};
        return warp;
    }
    warp.along = slope.along;
    warp.nearest = slope.nearest;
    warp.n = n;
    return warp;
}

void standUpright(Warp& warp, std::span<const glm::dvec2> outline)
{
    // x = (b - upright) / w. Another `upright` adds a multiple of 1 / w to x, and y is affine in 1 / w.
    const double base = glm::dot(warp.across(), outline.front());
    const auto imageOf = [&](const glm::dvec2& q) {
        const double w = warp.wAt(q);
        return glm::dvec3((glm::dot(warp.across(), q) - base) / w, 1.0 / w, 0.0);
    };
    Moments moments;
    const glm::dvec3 a = imageOf(outline[0]);
    for (std::size_t i = 2; i < outline.size(); ++i) {
        moments.add(a, imageOf(outline[i - 1]), imageOf(outline[i]));
    }
    warp.upright = base;
    if (!(moments.area > 0.0)) {
        return;
    }
    moments.centre();
    if (moments.yy > 0.0) {
        warp.upright += moments.xy / moments.yy;
    }
}

void standOnViewer(Warp& warp, const FitInput& input)
{
    if (input.space.perspective) {
        standUpright(warp, input.outline);
    } else {
        warp.upright = glm::dot(warp.across(), glm::dvec2(input.space.project(input.view.eye_ws)));
    }
}

} // namespace gnomon
