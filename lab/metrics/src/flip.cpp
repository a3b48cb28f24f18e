// SPDX-License-Identifier: Apache-2.0
// Based on: P. Andersson, J. Nilsson, T. Akenine-Moeller, M. Oskarsson, K. Astroem, M. D. Fairchild, "FLIP: A
// Difference Evaluator for Alternating Images", 2020. Pictures come in as linear light, where the paper's are sRGB.
#include "lab/metrics/flip.h"

#include "flip_colour.h"
#include "flip_filters.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace gnomon::lab {
namespace {

using namespace flip_parts;

constexpr double kFeatureExponent = 0.5; // q_f

struct OpponentPlanes {
    Plane y;
    Plane cx;
    Plane cz;
};

OpponentPlanes opponentPlanes(const ImageF& image)
{
    OpponentPlanes planes{{image.width, image.height}, {image.width, image.height}, {image.width, image.height}};
    for (std::size_t i = 0; i < planes.y.values.size(); ++i) {
        const float* rgb = image.values.data() + 3 * i;
        const Opponent colour = opponentFromLinear(clampToCube({rgb[0], rgb[1], rgb[2]}));
        planes.y.values[i] = colour.y;
        planes.cx.values[i] = colour.cx;
        planes.cz.values[i] = colour.cz;
    }
    return planes;
}

/// What the eye resolves of a picture at its distance.
OpponentPlanes resolvedPlanes(const OpponentPlanes& planes, const ContrastFilters& filters)
{
    return {applyFilter(planes.y, filters.achromatic), applyFilter(planes.cx, filters.red_green),
            applyFilter(planes.cz, filters.blue_yellow)};
}

// (F3) Channels filtered apart can give a colour that no monitor shows, so it is clamped before its L*a*b* is taken.
HuntLab perceivedColour(const OpponentPlanes& resolved, std::size_t i)
{
    const Opponent colour{resolved.y.values[i], resolved.cx.values[i], resolved.cz.values[i]};
    return huntLabFromLinear(clampToCube(linearFromOpponent(colour)));
}

Plane colourDifference(const OpponentPlanes& test, const OpponentPlanes& reference, double pixels_per_degree)
{
    const ContrastFilters filters = contrastFilters(pixels_per_degree);
    const OpponentPlanes resolved_test = resolvedPlanes(test, filters);
    const OpponentPlanes resolved_reference = resolvedPlanes(reference, filters);
    const Redistribution redistribute;
    Plane difference(test.y.width, test.y.height);
    for (std::size_t i = 0; i < difference.values.size(); ++i) {
        difference.values[i] =
            redistribute(hyab(perceivedColour(resolved_test, i), perceivedColour(resolved_reference, i)));
    }
    return difference;
}

Plane luminancePlane(Plane y)
{
    for (double& value : y.values) {
        value = luminance(value);
    }
    return y;
}

// (F10) (max(| |edge| - |edge'| |, | |point| - |point'| |) / sqrt(2))^q_f, of the unfiltered luminance.
Plane featureDifference(OpponentPlanes test, OpponentPlanes reference, double pixels_per_degree)
{
    const FeatureKernels kernels = featureKernels(pixels_per_degree);
    const Features of_test = findFeatures(luminancePlane(std::move(test.y)), kernels);
    const Features of_reference = findFeatures(luminancePlane(std::move(reference.y)), kernels);
    Plane difference(of_test.edge.width, of_test.edge.height);
    for (std::size_t i = 0; i < difference.values.size(); ++i) {
        const double edge = std::abs(of_test.edge.values[i] - of_reference.edge.values[i]);
        const double point = std::abs(of_test.point.values[i] - of_reference.point.values[i]);
        // A point can reach sqrt(2), and by rounding pass it, which would turn the exponent of (F11) negative.
        const double share = std::min(std::max(edge, point) / std::numbers::sqrt2, 1.0);
        difference.values[i] = std::pow(share, kFeatureExponent);
    }
    return difference;
}

ImageF greyPicture(const ImageF& mask)
{
    ImageF picture(mask.width, mask.height, 3);
    for (std::size_t i = 0; i < mask.values.size(); ++i) {
        std::fill_n(picture.values.data() + 3 * i, 3, mask.values[i]);
    }
    return picture;
}

} // namespace

// (F11) dE = dE_c^(1 - dE_f): a difference of features makes a difference of colours stand out.
ImageF flipMap(const ImageF& test, const ImageF& reference, double pixels_per_degree)
{
    assert(test.channels == 3 && reference.channels == 3);
    assert(test.width == reference.width && test.height == reference.height);
    assert(pixels_per_degree >= kFlipLeastPixelsPerDegree && pixels_per_degree <= kFlipMostPixelsPerDegree);
    ImageF result(test.width, test.height, 1);
    if (result.values.empty()) {
        return result;
    }
    OpponentPlanes of_test = opponentPlanes(test);
    OpponentPlanes of_reference = opponentPlanes(reference);
    const Plane colour = colourDifference(of_test, of_reference, pixels_per_degree);
    const Plane feature = featureDifference(std::move(of_test), std::move(of_reference), pixels_per_degree);
    for (std::size_t i = 0; i < result.values.size(); ++i) {
        result.values[i] = static_cast<float>(std::pow(colour.values[i], 1.0 - feature.values[i]));
    }
    return result;
}

std::optional<double> flip(const ImageF& test, const ImageF& truth, const Counted& counted, double pixels_per_degree)
{
    assert(test.channels == 1 && truth.channels == 1 && counted.channels == 1);
    assert(test.width == truth.width && test.height == truth.height);
    assert(test.width == counted.width && test.height == counted.height);
    ImageF seen = truth;
    std::size_t count = 0;
    for (std::size_t i = 0; i < seen.values.size(); ++i) {
        if (counted.values[i] != 0) {
            seen.values[i] = test.values[i];
            ++count;
        }
    }
    if (count == 0) {
        return std::nullopt;
    }
    const ImageF map = flipMap(greyPicture(seen), greyPicture(truth), pixels_per_degree);
    double sum = 0.0;
    for (std::size_t i = 0; i < map.values.size(); ++i) {
        if (counted.values[i] != 0) {
            sum += map.values[i];
        }
    }
    return sum / static_cast<double>(count);
}

} // namespace gnomon::lab
