// SPDX-License-Identifier: Apache-2.0
// The filters of FLIP: the eye's resolution of each opponent channel, and its sense of edges and points. Based on: P.
// Andersson et al., "FLIP: A Difference Evaluator for Alternating Images", 2020.
#pragma once

#include <cstddef>
#include <vector>

namespace gnomon::lab::flip_parts {

/// One channel in double precision: FLIP takes roots of differences of sums, where single precision shows.
struct Plane {
    std::size_t width = 0;
    std::size_t height = 0;
    std::vector<double> values; // width * height

    Plane(std::size_t w, std::size_t h) : width(w), height(h), values(w * h, 0.0) {}
    [[nodiscard]] double* row(std::size_t y) { return values.data() + y * width; }
    [[nodiscard]] const double* row(std::size_t y) const { return values.data() + y * width; }
};

/// Weights of 2 r + 1 neighbouring pixels, the pixel itself in the middle.
using Kernel = std::vector<double>;

/// A filter of the plane that is a kernel along x times a kernel along y. Beyond the border the nearest pixel counts.
[[nodiscard]] Plane filterAlongX(const Plane& plane, const Kernel& kernel);
[[nodiscard]] Plane filterAlongY(const Plane& plane, const Kernel& kernel);

/// A sum of round Gaussians, each with its share of the sum; the shares add up to 1.
struct Lobe {
    Kernel kernel; // adds up to 1
    double share = 1.0;
};
struct ContrastFilter {
    std::vector<Lobe> lobes;
};

/// The contrast sensitivity of the eye by channel, as filters.
struct ContrastFilters {
    ContrastFilter achromatic;
    ContrastFilter red_green;
    ContrastFilter blue_yellow;
};
[[nodiscard]] ContrastFilters contrastFilters(double pixels_per_degree);
[[nodiscard]] Plane applyFilter(const Plane& plane, const ContrastFilter& filter);

/// A Gaussian and its derivatives. Positive weights of a derivative add up to 1 and negative ones to -1.
struct FeatureKernels {
    Kernel smooth; // adds up to 1
    Kernel edge;   // first derivative
    Kernel point;  // second derivative
};
[[nodiscard]] FeatureKernels featureKernels(double pixels_per_degree);

/// How strong an edge and a point each pixel is, in any direction; [0, sqrt(2)] for luminance in [0, 1].
struct Features {
    Plane edge;
    Plane point;
};
[[nodiscard]] Features findFeatures(const Plane& luminance, const FeatureKernels& kernels);

} // namespace gnomon::lab::flip_parts
