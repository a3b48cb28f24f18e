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

/// Rows of a picture.
struct Rows {
    std::size_t first = 0;
    std::size_t end = 0;
    [[nodiscard]] std::size_t count() const { return end - first; }
};

/// The opponent planes of a picture in colour, or in grey light.
OpponentPlanes opponentPlanes(const ImageF& image, Rows rows)
{
    const std::size_t width = image.width;
    OpponentPlanes planes{{width, rows.count()}, {width, rows.count()}, {width, rows.count()}};
    const bool coloured = image.channels == 3;
    for (std::size_t i = 0; i < planes.y.values.size(); ++i) {
        const float* rgb = image.values.data() + image.channels * (rows.first * width + i);
        const Opponent colour = opponentFromLinear(clampToCube({rgb[0], rgb[coloured ? 1 : 0], rgb[coloured ? 2 : 0]}));
        planes.y.values[i] = colour.y;
        planes.cx.values[i] = colour.cx;
        planes.cz.values[i] = colour.cz;
    }
    return planes;
}

/// The planes as the eye resolves them at its distance.
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

Plane colourDifference(const OpponentPlanes& test, const OpponentPlanes& reference, const ContrastFilters& filters)
{
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
Plane featureDifference(Plane test_y, Plane reference_y, const FeatureKernels& kernels)
{
    const Features of_test = findFeatures(luminancePlane(std::move(test_y)), kernels);
    const Features of_reference = findFeatures(luminancePlane(std::move(reference_y)), kernels);
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

/// The filters of one distance, and how far they reach.
struct Eye {
    ContrastFilters contrast;
    FeatureKernels features;
    std::size_t reach = 0; // rows

    explicit Eye(double pixels_per_degree)
        : contrast(contrastFilters(pixels_per_degree)), features(featureKernels(pixels_per_degree)),
          reach(features.smooth.size() / 2)
    {
        for (const ContrastFilter* filter : {&contrast.achromatic, &contrast.red_green, &contrast.blue_yellow}) {
            for (const Lobe& lobe : filter->lobes) {
                reach = std::max(reach, lobe.kernel.size() / 2);
            }
        }
    }
};

// (F11) dE = dE_c^(1 - dE_f): a difference of features makes a difference of colours stand out.
void differRows(const ImageF& test, const ImageF& reference, const Eye& eye, Rows rows, ImageF& result)
{
    // With as many rows around them as the filters reach, these rows come out as they would of the whole picture.
    const Rows wide{rows.first - std::min(rows.first, eye.reach),
                    std::min<std::size_t>(rows.end + eye.reach, test.height)};
    OpponentPlanes of_test = opponentPlanes(test, wide);
    OpponentPlanes of_reference = opponentPlanes(reference, wide);
    const Plane colour = colourDifference(of_test, of_reference, eye.contrast);
    const Plane feature = featureDifference(std::move(of_test.y), std::move(of_reference.y), eye.features);
    for (std::size_t y = rows.first; y < rows.end; ++y) {
        const double* colours = colour.row(y - wide.first);
        const double* features = feature.row(y - wide.first);
        for (std::size_t x = 0; x < result.width; ++x) {
            result.values[y * result.width + x] = static_cast<float>(std::pow(colours[x], 1.0 - features[x]));
        }
    }
}

/// Strip by strip, because the planes of a whole picture would take a hundred and more bytes a pixel. Strips of 128
/// rows cost a sixth more time at the usual distance, those of four times the filters' reach at most half as much
/// again.
ImageF differences(const ImageF& test, const ImageF& reference, double pixels_per_degree)
{
    assert(test.width == reference.width && test.height == reference.height);
    assert(pixels_per_degree >= kFlipLeastPixelsPerDegree && pixels_per_degree <= kFlipMostPixelsPerDegree);
    ImageF result(test.width, test.height, 1);
    if (result.values.empty()) {
        return result;
    }
    const Eye eye(pixels_per_degree);
    const std::size_t strip = std::max<std::size_t>(128, 4 * eye.reach);
    for (std::size_t first = 0; first < result.height; first += strip) {
        differRows(test, reference, eye, {first, std::min<std::size_t>(first + strip, result.height)}, result);
    }
    return result;
}

} // namespace

ImageF flipMap(const ImageF& test, const ImageF& reference, double pixels_per_degree)
{
    assert(test.channels == 3 && reference.channels == 3);
    return differences(test, reference, pixels_per_degree);
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
    const ImageF map = differences(seen, truth, pixels_per_degree);
    double sum = 0.0;
    for (std::size_t i = 0; i < map.values.size(); ++i) {
        if (counted.values[i] != 0) {
            sum += map.values[i];
        }
    }
    return sum / static_cast<double>(count);
}

} // namespace gnomon::lab
