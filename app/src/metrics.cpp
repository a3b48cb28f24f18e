// SPDX-License-Identifier: Apache-2.0
// `gnomon metrics`: how far one image is from another, without a scene.
#include "image_metrics.h"
#include "result_json.h"
#include "streams.h"
#include "subcommands.h"

#include "files/files.h"
#include "image/image_io.h"

#include <gnomon/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <string_view>
#include <utility>

namespace gnomon::app {
namespace {

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
