// SPDX-License-Identifier: Apache-2.0
#include "fit/tsm_segments.h"

#include "fit/projection.h"
#include "fit/view_slope.h"

namespace gnomon {
namespace {

/// Lengths along it are from 0 at its near end, where dot(along, q) is `nearest`.
struct Trapezoid {
    double nearest = 0.0;
    double length = 0.0;
    double low = 1.0;      // depth of view at the near end
    double slope = 0.0;    // its growth
    double widening = 0.0; // growth of the width, as a share of the near end's width

    [[nodiscard]] double depthAt(double s) const { return low + slope * s; }
    /// Where the segment ends that begins at `a` and has the error `e`: (b - a) (1 + widening b) = (e depth(a))^2.
    [[nodiscard]] double endFrom(double a, double e) const
    {
        const double area = e * depthAt(a) * e * depthAt(a);
        if (!(widening > 0.0)) {
            return a + area;
        }
        const double half = 0.5 * (1.0 - widening * a);
        return (std::sqrt(half * half + widening * (a + area)) - half) / widening;
    }
};

Trapezoid trapezoidOf(const FitInput& input, const glm::dvec2& along, const ViewSlope& slope, const Warp& warp)
{
    const LightRect rect = rectOf(Warp{.along = along}, input.outline);
    Trapezoid shape;
    shape.nearest = rect.low.y;
    shape.length = rect.high.y - rect.low.y;
    if (warp.warped()) {
        shape.low = std::max(slope.low, kLeastShare * slope.high);
        shape.slope = slope.slope;
        shape.widening = 1.0 / warp.n;
    }
    return shape;
}

} // namespace

TsmSegments segmentTsm(const FitInput& input, std::uint32_t count)
{
    constexpr int kSteps = 60; // halvings in double precision
    const Warp warp = fitTsm(input);
    TsmSegments found;
    found.along = warp.along;
    const Trapezoid shape = trapezoidOf(input, found.along, slopeOfView(input), warp);
    if (!(shape.length > 0.0)) {
        return found;
    }
    double low = 0.0;
    double high = std::sqrt(shape.length * (1.0 + shape.widening * shape.length)) / shape.low; // the error of one
                                                                                               // segment
    for (int step = 0; step < kSteps; ++step) {
        const double e = 0.5 * (low + high);
        double end = 0.0;
        for (std::uint32_t i = 0; i < count && end < shape.length; ++i) {
            end = shape.endFrom(end, e);
        }
        (end < shape.length ? low : high) = e;
    }
    double end = 0.0;
    found.ends.push_back(shape.nearest);
    for (std::uint32_t i = 0; i + 1 < count; ++i) {
        end = shape.endFrom(end, high);
        found.ends.push_back(shape.nearest + end);
    }
    found.ends.push_back(shape.nearest + shape.length);
    return found;
}

} // namespace gnomon
