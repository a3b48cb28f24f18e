// SPDX-License-Identifier: Apache-2.0
#include "image_metrics.h"

#include "image/srgb.h"
#include "lab/metrics/flip.h"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace gnomon::app {
namespace {

/// The first `count` channels side by side: a colour's values become pixels of their own, one row as long as three.
ImageF flattened(const ImageF& image, std::uint32_t count)
{
    ImageF flat(image.width * count, image.height, 1);
    auto out = flat.values.begin();
    for (std::size_t i = 0; i < image.values.size(); i += image.channels) {
        out = std::copy_n(image.values.begin() + static_cast<std::ptrdiff_t>(i), count, out);
    }
    return flat;
}

/// Rec. ITU-R BT.709: Y' of the values as stored.
ImageF luminance(const ImageF& image)
{
    ImageF grey(image.width, image.height, 1);
    for (std::size_t i = 0; i < grey.values.size(); ++i) {
        const float* rgb = image.values.data() + i * image.channels;
        grey.values[i] = 0.2126F * rgb[0] + 0.7152F * rgb[1] + 0.0722F * rgb[2];
    }
    return grey;
}

ImageF linearRgb(const ImageF& image, bool encoded)
{
    ImageF rgb(image.width, image.height, 3);
    for (std::size_t i = 0; i < rgb.values.size(); ++i) {
        const float value = image.values[i / 3 * image.channels + i % 3];
        rgb.values[i] = encoded ? static_cast<float>(decodeSrgb(double{value})) : value;
    }
    return rgb;
}

double meanOf(const ImageF& image)
{
    return std::accumulate(image.values.begin(), image.values.end(), 0.0) / static_cast<double>(image.values.size());
}

} // namespace

bool isColour(const ImageF& image)
{
    return image.channels >= 3;
}

ImageMetrics measureImages(const ImageF& test, const ImageF& truth, bool encoded)
{
    assert(test.width == truth.width && test.height == truth.height && isColour(test) == isColour(truth));
    ImageMetrics metrics;
    const bool colour = isColour(test);
    metrics.channels = colour ? 3 : 1;
    metrics.counted = std::uint64_t{test.width} * test.height;
    const ImageF test_values = flattened(test, metrics.channels);
    const ImageF truth_values = flattened(truth, metrics.channels);
    metrics.error = *lab::errorNumbers(test_values, truth_values, lab::countAll(test_values.width, test_values.height));
    const lab::Counted all = lab::countAll(test.width, test.height);
    if (!colour) {
        metrics.interpretation = "grey values as linear visibility";
        metrics.ssim = *lab::ssim(test_values, truth_values, all);
        metrics.flip = *lab::flip(test_values, truth_values, all);
    } else {
        metrics.interpretation = encoded ? "sRGB-encoded colours" : "linear colours";
        metrics.ssim = *lab::ssim(luminance(test), luminance(truth), all);
        metrics.flip = meanOf(lab::flipMap(linearRgb(test, encoded), linearRgb(truth, encoded)));
    }
    return metrics;
}

} // namespace gnomon::app
