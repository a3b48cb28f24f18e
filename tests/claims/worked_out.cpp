// SPDX-License-Identifier: Apache-2.0
// Prints the figures of claims that need no picture, as JSON, for tools/claims.py: they come from the library's own
// arithmetic, in double precision, or from what a document prints.
#define GNOMON_REAL double
#include <gnomon/shared/depth_metric.h>
#include <gnomon/shared/moments.h>
#include <gnomon/shared/paired_depth.h>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <limits>
#include <numbers>
#include <string_view>

namespace gnomon {
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

/// The spacing of floats at `depth`, which is below 1.
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

/// How much more of [0, 1] one metre takes with planes at 1 and 100 m than at 1 and 10,000 m.
double precisionOfTightPlanes()
{
    const auto metre = [](double far_m) {
        return shared::depthMetricLinear(2.0, 1.0, far_m) - shared::depthMetricLinear(1.0, 1.0, far_m);
    };
    return metre(100.0) / metre(10000.0);
}

/// The deviation of depth that two moments in single precision cannot tell from none, as a share of the range.
double deviationLostByMoments()
{
    return std::sqrt(shared::varianceOfRounding(kStepOfSingle));
}

// The largest difference, in metres, between a distance interpolated over a triangle 20 m across and the distance
// itself, the triangle being some 10 m from the light: to the light's plane, to its place, and a lamp's clip-space z.

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

/// The largest error of Chebyshev's bound for one occluder over one receiver, both parallel to the map, whatever share
/// of the texel is covered.
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

/// Texels per degree at the edge of a map of so wide a field of view, by those in its middle.
double densityAtEdge(double fov_deg)
{
    const double cosine = std::cos(glm::radians(fov_deg / 2.0)); // of d tan(a) / d a
    return 1.0 / (cosine * cosine);
}

/// One step of depth of `bits` bits at the far plane, in metres, with near 0.1 m and far 1000 m.
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

/// By how much a step of depth grows when depth is moved into the half from 0.5 to 1: of codes of 16 bits.
double coarserInUpperHalf()
{
    constexpr double kCodes = 65536.0;
    double used = 0.0; // codes from 0.5 to 1
    for (double code = 0.0; code < kCodes; code += 1.0) {
        used += code / (kCodes - 1.0) >= 0.5 ? 1.0 : 0.0;
    }
    return kCodes / used;
}

/// By how much a step of floats at a share of the range grows when depth is moved into the half from 0.5 to 1.
double coarserInUpperHalf(double depth)
{
    return floatStepAt(0.5 + 0.5 * depth) / 0.5 / floatStepAt(depth);
}

/// By how much a least variance against rounding shrinks, as a deviation, when depth is stored in -1 to 1.
double finerBySign()
{
    const double step = 0x1p-11; // of halves, which are what floats of a map are short of
    const auto deviation = [&](int flags) {
        return std::sqrt(shared::varianceOfRounding(step)) / shared::momentScale(flags);
    };
    return deviation(0) / deviation(shared::kMomentRemap);
}

/// The largest error of depth in two bytes, in steps of 16 bits, as the document packs them.
double errorOfPublishedBytes()
{
    return worstOfBytes([](double depth) {
        const double scale = depth * 255.0;
        return asByte(std::floor(scale) / 255.0) + asByte(scale - std::floor(scale)) / 255.0;
    });
}

/// The same, as ours are.
double errorOfBytes()
{
    return worstOfBytes([](double depth) {
        const glm::dvec2 bytes = shared::depthToBytes(depth);
        return shared::depthFromBytes(asByte(bytes.x), asByte(bytes.y));
    });
}

/// The fifteen taps of the published blur: the sum of their weights, their centre in pixels, and the weight of the
/// right side divided by that of the left.
struct PublishedBlur {
    double sum = 0.0;
    double centre_px = 0.0;
    double sides = 0.0;
};

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

/// Texels between the published taps of a kernel, whose offsets are divided by w, `distance_m` metres from the lamp.
double publishedTapsApart(double distance_m)
{
    return 1.0 / distance_m; // w is the depth along the lamp's axis
}

struct Figure {
    std::string_view name;
    double value;
};

void print()
{
    const PublishedBlur blur = publishedBlur();
    const Figure figures[] = {
        {"precision_of_tight_planes", precisionOfTightPlanes()},
        {"step_of_floats_below_1", floatStepAt(1.0)},
        {"step_of_floats_below_1024", floatStepAt(1024.0)},
        {"deviation_lost_by_moments", deviationLostByMoments()},
        {"error_of_plane_distance_m", errorOfPlaneDistance()},
        {"error_of_place_distance_m", errorOfPlaceDistance()},
        {"error_of_clip_depth_m", errorOfClipDepth()},
        {"error_of_planar_bound", errorOfPlanarBound()},
        {"density_at_edge_of_120_degrees", densityAtEdge(120.0)},
        {"step_of_24_bits_m", stepOfBits(24)},
        {"step_of_24_bits_in_z_over_w_m", stepOfBitsInZOverW(24)},
        {"coarser_codes_in_upper_half", coarserInUpperHalf()},
        {"coarser_floats_in_upper_half_far", coarserInUpperHalf(0.99)},
        {"coarser_floats_in_upper_half_near", coarserInUpperHalf(0.1)},
        {"finer_by_sign", finerBySign()},
        {"error_of_published_bytes", errorOfPublishedBytes()},
        {"error_of_bytes", errorOfBytes()},
        {"published_blur_sum", blur.sum},
        {"published_blur_centre_px", blur.centre_px},
        {"published_blur_sides", blur.sides},
        {"published_taps_apart_at_10_m", publishedTapsApart(10.0)},
    };
    std::cout << std::setprecision(std::numeric_limits<double>::max_digits10);
    char before = '{';
    for (const Figure& figure : figures) {
        std::cout << before << "\n  \"" << figure.name << "\": " << figure.value;
        before = ',';
    }
    std::cout << "\n}\n";
}

} // namespace
} // namespace gnomon

int main()
{
    gnomon::print();
}
