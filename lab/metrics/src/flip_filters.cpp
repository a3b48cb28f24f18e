// SPDX-License-Identifier: Apache-2.0
// Based on: P. Andersson, J. Nilsson, T. Akenine-Moeller, M. Oskarsson, K. Astroem, M. D. Fairchild, "FLIP: A
// Difference Evaluator for Alternating Images", 2020, spatial filtering and feature detection. The paper's filters are
// two-dimensional; each is separable or a sum of two that are, and is applied so.
#include "flip_filters.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace gnomon::lab::flip_parts {
namespace {

// a sqrt(pi / b) exp(-pi^2 r^2 / b) at a distance of r degrees: the Fourier transform of a Gaussian fitted to the
// contrast sensitivity of a channel. `b` in square degrees.
struct Sensitivity {
    double a;
    double b;
};
constexpr Sensitivity kAchromatic{1.0, 0.0047};
constexpr Sensitivity kRedGreen{1.0, 0.0053};
constexpr Sensitivity kBlueYellow[2]{{34.1, 0.04}, {13.5, 0.025}};
constexpr double kWidest = kBlueYellow[0].b; // sets the reach of all, three standard deviations of the widest

constexpr double kFeatureWidth_deg = 0.082; // w, from the positive to the negative extreme of the edge kernel

double sumOf(const Kernel& kernel)
{
    double sum = 0.0;
    for (const double weight : kernel) {
        sum += weight;
    }
    return sum;
}

void addScaled(const double* from, double weight, std::size_t count, double* to)
{
    for (std::size_t i = 0; i < count; ++i) {
        to[i] += weight * from[i];
    }
}

// (F2) g(r) = sum over lobes of a sqrt(pi / b) exp(-pi^2 r^2 / b), r = pixels / pixels_per_degree, divided by its sum
// over the pixels. The sum of a lobe's round Gaussian is the square of its kernel's sum, which gives its share.
template <std::size_t Count>
ContrastFilter contrastFilter(const Sensitivity (&sensitivities)[Count], double pixels_per_degree)
{
    constexpr double kPi = std::numbers::pi;
    const int radius = static_cast<int>(std::ceil(3.0 * std::sqrt(kWidest / (2.0 * kPi * kPi)) * pixels_per_degree));
    ContrastFilter filter;
    double total = 0.0;
    for (const Sensitivity& sensitivity : sensitivities) {
        Lobe lobe;
        for (int i = -radius; i <= radius; ++i) {
            const double distance_deg = i / pixels_per_degree;
            lobe.kernel.push_back(std::exp(-kPi * kPi * distance_deg * distance_deg / sensitivity.b));
        }
        const double sum = sumOf(lobe.kernel);
        for (double& weight : lobe.kernel) {
            weight /= sum;
        }
        lobe.share = sensitivity.a * std::sqrt(kPi / sensitivity.b) * sum * sum;
        total += lobe.share;
        filter.lobes.push_back(std::move(lobe));
    }
    for (Lobe& lobe : filter.lobes) {
        lobe.share /= total;
    }
    return filter;
}

/// Divides the positive weights by their sum and the negative ones by theirs, so that flat light gives 0 and the
/// strongest response is 1.
void balance(Kernel& kernel)
{
    double positive = 0.0;
    double negative = 0.0;
    for (const double weight : kernel) {
        (weight > 0.0 ? positive : negative) += std::abs(weight);
    }
    for (double& weight : kernel) {
        weight /= weight > 0.0 ? positive : negative;
    }
}

/// (F9) The length of (response along x, response along y).
Plane strength(const Plane& along_x, const Plane& along_y)
{
    Plane result(along_x.width, along_x.height);
    for (std::size_t i = 0; i < result.values.size(); ++i) {
        const double x = along_x.values[i];
        const double y = along_y.values[i];
        result.values[i] = std::sqrt(x * x + y * y);
    }
    return result;
}

} // namespace

Plane filterAlongX(const Plane& plane, const Kernel& kernel)
{
    Plane result(plane.width, plane.height);
    const std::size_t radius = kernel.size() / 2;
    std::vector<double> extended(plane.width + 2 * radius);
    for (std::size_t y = 0; y < plane.height; ++y) {
        const double* from = plane.row(y);
        const auto inner = extended.begin() + static_cast<std::ptrdiff_t>(radius);
        std::fill(extended.begin(), inner, from[0]);
        const auto right = std::copy_n(from, plane.width, inner);
        std::fill(right, extended.end(), from[plane.width - 1]);
        for (std::size_t tap = 0; tap < kernel.size(); ++tap) {
            addScaled(extended.data() + tap, kernel[tap], plane.width, result.row(y));
        }
    }
    return result;
}

Plane filterAlongY(const Plane& plane, const Kernel& kernel)
{
    Plane result(plane.width, plane.height);
    const auto radius = static_cast<std::ptrdiff_t>(kernel.size() / 2);
    const auto last = static_cast<std::ptrdiff_t>(plane.height) - 1;
    for (std::ptrdiff_t y = 0; y <= last; ++y) {
        for (std::ptrdiff_t tap = -radius; tap <= radius; ++tap) {
            const auto from = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(y + tap, 0, last));
            addScaled(plane.row(from), kernel[static_cast<std::size_t>(tap + radius)], plane.width,
                      result.row(static_cast<std::size_t>(y)));
        }
    }
    return result;
}

ContrastFilters contrastFilters(double pixels_per_degree)
{
    return {contrastFilter({kAchromatic}, pixels_per_degree), contrastFilter({kRedGreen}, pixels_per_degree),
            contrastFilter(kBlueYellow, pixels_per_degree)};
}

Plane applyFilter(const Plane& plane, const ContrastFilter& filter)
{
    Plane result(plane.width, plane.height);
    for (const Lobe& lobe : filter.lobes) {
        const Plane blurred = filterAlongY(filterAlongX(plane, lobe.kernel), lobe.kernel);
        addScaled(blurred.values.data(), lobe.share, blurred.values.size(), result.values.data());
    }
    return result;
}

// (F8) G(x) = exp(-x^2 / (2 s^2)), edges -x G(x), points (x^2 / s^2 - 1) G(x), s half the feature's width.
FeatureKernels featureKernels(double pixels_per_degree)
{
    const double deviation_px = 0.5 * kFeatureWidth_deg * pixels_per_degree;
    const int radius = static_cast<int>(std::ceil(3.0 * deviation_px));
    FeatureKernels kernels;
    for (int i = -radius; i <= radius; ++i) {
        const double scaled = i / deviation_px;
        const double gaussian = std::exp(-0.5 * scaled * scaled);
        kernels.smooth.push_back(gaussian);
        kernels.edge.push_back(-i * gaussian);
        kernels.point.push_back((scaled * scaled - 1.0) * gaussian);
    }
    const double sum = sumOf(kernels.smooth);
    for (double& weight : kernels.smooth) {
        weight /= sum;
    }
    balance(kernels.edge);
    balance(kernels.point);
    return kernels;
}

Features findFeatures(const Plane& luminance, const FeatureKernels& kernels)
{
    const Plane smooth_x = filterAlongX(luminance, kernels.smooth);
    const auto response = [&](const Kernel& derivative) {
        return strength(filterAlongY(filterAlongX(luminance, derivative), kernels.smooth),
                        filterAlongY(smooth_x, derivative));
    };
    return {response(kernels.edge), response(kernels.point)};
}

} // namespace gnomon::lab::flip_parts
