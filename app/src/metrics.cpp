// SPDX-License-Identifier: Apache-2.0
// `gnomon metrics`: how far one image is from another, without a scene.
#include "result_json.h"
#include "streams.h"
#include "subcommands.h"

#include "files/files.h"
#include "image/image_io.h"
#include "image/srgb.h"
#include "lab/metrics/error.h"
#include "lab/metrics/flip.h"

#include <gnomon/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <numeric>
#include <string_view>
#include <utility>

namespace gnomon::app {
namespace {

struct ImageMetrics {
    std::string_view interpretation; // the meaning that the values were taken to have
    std::uint32_t channels = 0;      // that were compared: 1 or 3
    lab::ErrorNumbers error;         // over all values of all channels
    double ssim = 0.0;
    double flip = 0.0;
    std::uint64_t counted = 0; // pixels
};

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

/// 3 or 4 channels; else grey, with or without alpha.
bool isColour(const ImageF& image)
{
    return image.channels >= 3;
}

/// Grey values are linear visibility; `encoded` colours are sRGB-encoded, others linear. Colours' rmse, mae, bias and
/// p99 are of the values as stored, ssim is of their Rec. 709 luminance, flip of the linear colours. Alpha is ignored.
/// Precondition: same size, at least one pixel, both grey or both colour, all values finite.
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

ImageF readFinite(const std::string& file)
{
    ImageF image = readImage(file);
    const auto wrong =
        std::find_if(image.values.begin(), image.values.end(), [](float value) { return !std::isfinite(value); });
    if (wrong != image.values.end()) {
        const auto pixel = static_cast<std::size_t>(wrong - image.values.begin()) / image.channels;
        throw Error("measuring " + file, fmt::format("pixel ({}, {}) holds {}, which is no finite number",
                                                     pixel % image.width, pixel / image.width, *wrong));
    }
    return image;
}

/// By its first bytes, as readImage() tells, not by its name.
bool holdsExr(const std::string& file)
{
    constexpr std::string_view kMagic = "\x76\x2f\x31\x01";
    std::array<char, kMagic.size()> start{};
    std::ifstream(file, std::ios::binary).read(start.data(), start.size());
    return std::string_view(start.data(), start.size()) == kMagic;
}

Json metricsJson(const ImageMetrics& metrics, const Settings& settings, const ImageF& image)
{
    return {{"version", GNOMON_VERSION},
            {"test", settings.test_image},
            {"truth", settings.truth_image},
            {"size_px", {image.width, image.height}},
            {"channels", metrics.channels},
            {"interpretation", metrics.interpretation},
            {"error",
             {{"rmse", metrics.error.rmse},
              {"mae", metrics.error.mae},
              {"bias", metrics.error.bias},
              {"p99", metrics.error.p99},
              {"ssim", metrics.ssim},
              {"flip", metrics.flip}}},
            {"pixels", {{"counted", metrics.counted}}},
            {"units",
             {{"error", metrics.channels == 1 ? "visibility, 0 to 1"
                                              : "values as stored, ssim of their luminance, flip of the colours"},
              {"pixels", "pixels"}}}};
}

std::string metricsText(const ImageMetrics& metrics, const Settings& settings, const ImageF& image)
{
    return fmt::format("{} against {}, {}x{}, {}\n"
                       "rmse {:.6f}  mae {:.6f}  bias {:+.6f}  p99 {:.6f}  ssim {:.6f}  flip {:.6f}\n",
                       settings.test_image, settings.truth_image, image.width, image.height, metrics.interpretation,
                       metrics.error.rmse, metrics.error.mae, metrics.error.bias, metrics.error.p99, metrics.ssim,
                       metrics.flip);
}

/// The images in memory and how far apart they are.
struct MeasuredImages {
    ImageF test;
    ImageMetrics metrics;
};

MeasuredImages measureFiles(const Settings& settings)
{
    ImageF test = readFinite(settings.test_image);
    const ImageF truth = readFinite(settings.truth_image);
    if (test.width != truth.width || test.height != truth.height) {
        throw Error(
            fmt::format("measuring {} against {}", settings.test_image, settings.truth_image),
            fmt::format("one has {}x{} pixels, the other {}x{}", test.width, test.height, truth.width, truth.height));
    }
    if (isColour(test) != isColour(truth)) {
        throw Error(fmt::format("measuring {} against {}", settings.test_image, settings.truth_image),
                    "one is grey, the other is in colour");
    }
    if (isColour(test) && holdsExr(settings.test_image) != holdsExr(settings.truth_image)) {
        throw Error(fmt::format("measuring {} against {}", settings.test_image, settings.truth_image),
                    "a PNG holds encoded colours, an EXR linear ones", "take two of one kind");
    }
    const ImageMetrics metrics = measureImages(test, truth, !holdsExr(settings.test_image));
    for (const double number :
         {metrics.error.rmse, metrics.error.mae, metrics.error.bias, metrics.error.p99, metrics.ssim, metrics.flip}) {
        if (!std::isfinite(number)) {
            throw Error(fmt::format("measuring {} against {}", settings.test_image, settings.truth_image),
                        "their values are too large for the error numbers");
        }
    }
    return {std::move(test), metrics};
}

} // namespace

int runMetrics(const Settings& settings)
{
    if (!settings.json.empty() && settings.json != "-") {
        requireWritable(settings.json);
    }
    const MeasuredImages measured = measureFiles(settings);
    if (settings.json.empty()) {
        writeStdout(metricsText(measured.metrics, settings, measured.test));
    } else {
        writeResult(settings.json, jsonText(metricsJson(measured.metrics, settings, measured.test)));
    }
    return 0;
}

} // namespace gnomon::app
