// SPDX-License-Identifier: Apache-2.0
// Compiled alone: it has the library's arithmetic in double precision.
#define GNOMON_REAL double
#include "worked_out.h"

#include <gnomon/shared/depth_metric.h>
#include <gnomon/shared/moments.h>
#include <gnomon/shared/paired_depth.h>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gnomon::app {
namespace {

constexpr double kStepOfSingle = 0x1p-24; // of floats just below 1
constexpr double kNear_m = 0.1;
constexpr double kFar_m = 1000.0;

/// The largest difference between `f` of a point and `f` of the corners interpolated, over a grid on a triangle.
template <typename F>
double worstInterpolation(const F& f)
{
    const glm::dvec3 corners[] = {{-8.0, -9.0, 11.0}, {12.0, -7.0, 9.0}, {1.0, 10.0, 14.0}};
    constexpr int kSteps = 20;
    double worst = 0.0;
    for (int i = 0; i <= kSteps; ++i) {
        for (int j = 0; i + j <= kSteps; ++j) {
            const double a = double(i) / kSteps;
            const double b = double(j) / kSteps;
            const double c = 1.0 - a - b;
            const glm::dvec3 p = a * corners[0] + b * corners[1] + c * corners[2];
            const double interpolated = a * f(corners[0]) + b * f(corners[1]) + c * f(corners[2]);
            worst = std::max(worst, std::abs(interpolated - f(p)));
        }
    }
    return worst;
}

/// Of the spacing of floats at `depth`; below 1.
double floatStepAt(double depth)
{
    const auto at = static_cast<float>(depth);
    return static_cast<double>(at) - static_cast<double>(std::nextafterf(at, 0.0F));
}

double gaussian(double x, double sigma)
{
    return std::exp(-x * x / (2.0 * sigma * sigma)) / std::sqrt(2.0 * std::numbers::pi * sigma * sigma);
}

/// As a target of 8 bits keeps it.
double asByte(double value)
{
    return std::floor(value * 255.0 + 0.5) / 255.0;
}

template <typename Code>
double worstOfBytes(const Code& code)
{
    constexpr int kSteps = 1'000'000;
    double worst = 0.0;
    for (int i = 0; i < kSteps; ++i) {
        const double depth = double(i) / kSteps;
        worst = std::max(worst, std::abs(code(depth) - depth));
    }
    return worst * 65535.0;
}

} // namespace

double precisionOfTightPlanes()
{
    const auto metre = [](double far_m) {
        return shared::depthMetricLinear(2.0, 1.0, far_m) - shared::depthMetricLinear(1.0, 1.0, far_m);
    };
    return metre(100.0) / metre(10000.0);
}

double stepOfFloats()
{
    return floatStepAt(1.0);
}

double deviationLostByMoments()
{
    return std::sqrt(shared::varianceOfRounding(kStepOfSingle));
}

double errorOfPlaneDistance()
{
    const glm::dvec4 plane(glm::normalize(glm::dvec3(0.3, -0.5, 0.8)), 2.0);
    return worstInterpolation([&](const glm::dvec3& p) { return shared::depthMetricPlane(p, plane); });
}

double errorOfPlaceDistance()
{
    return worstInterpolation([](const glm::dvec3& p) { return glm::length(p); });
}

double errorOfClipDepth()
{
    return worstInterpolation([](const glm::dvec3& p) { return kFar_m / (kFar_m - kNear_m) * (p.z - kNear_m); });
}

double errorOfPlanarBound()
{
    constexpr double kOccluder = 0.3;
    constexpr double kReceiver = 0.7;
    double worst = 0.0;
    for (int i = 1; i < 100; ++i) {
        const double lit = i / 100.0;
        const double m1 = (1.0 - lit) * kOccluder + lit * kReceiver;
        const double m2 = (1.0 - lit) * kOccluder * kOccluder + lit * kReceiver * kReceiver;
        worst = std::max(worst, std::abs(shared::chebyshevBound(m1, m2, kReceiver, 0.0) - lit));
    }
    return worst;
}

double densityAtEdge(double fov_deg)
{
    const double cosine = std::cos(glm::radians(fov_deg / 2.0)); // of d tan(a) / d a
    return 1.0 / (cosine * cosine);
}

double stepOfBits(int bits)
{
    return std::exp2(-bits) * (kFar_m - kNear_m);
}

double stepOfBitsInZOverW(int bits)
{
    const double slope =
        kNear_m * kFar_m / ((kFar_m - kNear_m) * kFar_m * kFar_m); // of z / w by metres, at the far plane
    return std::exp2(-bits) / slope;
}

double coarserInUpperHalf()
{
    constexpr double kCodes = 65536.0;
    double used = 0.0; // codes from 0.5 to 1
    for (double code = 0.0; code < kCodes; code += 1.0) {
        used += code / (kCodes - 1.0) >= 0.5 ? 1.0 : 0.0;
    }
    return kCodes / used;
}

double coarserInUpperHalf(double depth)
{
    return floatStepAt(0.5 + 0.5 * depth) / 0.5 / floatStepAt(depth);
}

double finerBySign()
{
    const double step = 0x1p-11; // of halves, which are what floats of a map are short of
    const auto deviation = [&](int flags) {
        return std::sqrt(shared::varianceOfRounding(step)) / shared::momentScale(flags);
    };
    return deviation(0) / deviation(shared::kMomentRemap);
}

double errorOfPublishedBytes()
{
    return worstOfBytes([](double depth) {
        const double scale = depth * 255.0;
        return asByte(std::floor(scale) / 255.0) + asByte(scale - std::floor(scale)) / 255.0;
    });
}

double errorOfBytes()
{
    return worstOfBytes([](double depth) {
        const glm::dvec2 bytes = shared::depthToBytes(depth);
        return shared::depthFromBytes(asByte(bytes.x), asByte(bytes.y));
    });
}

PublishedBlur publishedBlur()
{
    double right = 0.0;
    double left = 0.0;
    double moment = 0.0;
    for (int i = 1; i < 15; i += 2) {
        const double to_right = 2.0 * gaussian(i, 3.0);
        const double to_left = 2.0 * gaussian(i + 1.0, 3.0);
        right += to_right;
        left += to_left;
        moment += i * (to_right - to_left);
    }
    const double sum = gaussian(0.0, 2.0) + right + left;
    return {sum, moment / sum, right / left};
}

double publishedTapsApart(double distance_m)
{
    return 1.0 / distance_m; // w is the depth along the lamp's axis
}

double stepOfFloatsBelow(double metres)
{
    return floatStepAt(metres);
}

} // namespace gnomon::app
