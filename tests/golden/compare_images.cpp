// SPDX-License-Identifier: Apache-2.0
#include "compare_images.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

namespace gnomon::golden {
namespace {

float pixelDifference(const ImageF& a, const ImageF& b, std::uint32_t x, std::uint32_t y)
{
    float largest = 0.0F;
    for (std::uint32_t c = 0; c < a.channels; ++c) {
        largest = std::max(largest, std::abs(a.pixel(x, y)[c] - b.pixel(x, y)[c]));
    }
    return largest;
}

bool finite(const ImageF& image)
{
    return std::all_of(image.values.begin(), image.values.end(), [](float v) { return std::isfinite(v); });
}

} // namespace

Verdict compare(const ImageF& actual, const ImageF& wanted, const Tolerance& tolerance)
{
    Verdict verdict;
    std::ostringstream why;
    if (actual.width != wanted.width || actual.height != wanted.height || actual.channels != wanted.channels) {
        why << "it is " << actual.width << "x" << actual.height << " with " << actual.channels
            << " channels instead of " << wanted.width << "x" << wanted.height << " with " << wanted.channels;
    } else if (!finite(actual) || !finite(wanted)) {
        why << "it has values that are not finite";
    } else {
        std::size_t differing = 0;
        for (std::uint32_t y = 0; y < actual.height; ++y) {
            for (std::uint32_t x = 0; x < actual.width; ++x) {
                const float difference = pixelDifference(actual, wanted, x, y);
                verdict.largest = std::max(verdict.largest, difference);
                differing += difference > tolerance.small ? 1 : 0;
            }
        }
        verdict.share = static_cast<float>(differing) / static_cast<float>(actual.width * actual.height);
        if (verdict.largest > tolerance.largest) {
            why << "a pixel differs by " << verdict.largest << ", more than " << tolerance.largest << "; ";
        }
        if (verdict.share > tolerance.share) {
            why << "a share of " << verdict.share << " of the pixels differs by more than " << tolerance.small
                << ", more than " << tolerance.share;
        }
    }
    verdict.why = why.str();
    verdict.same = verdict.why.empty();
    return verdict;
}

Image8 differenceImage(const ImageF& actual, const ImageF& wanted)
{
    Image8 image(actual.width, actual.height, 1);
    for (std::uint32_t y = 0; y < actual.height; ++y) {
        for (std::uint32_t x = 0; x < actual.width; ++x) {
            const float shown = std::min(pixelDifference(actual, wanted, x, y) * 4.0F, 1.0F);
            *image.pixel(x, y) = static_cast<std::uint8_t>(std::lround(shown * 255.0F));
        }
    }
    return image;
}

ImageF shifted(const ImageF& image, int dx, int dy)
{
    ImageF moved(image.width, image.height, image.channels);
    const int right = static_cast<int>(image.width) - 1;
    const int bottom = static_cast<int>(image.height) - 1;
    for (int y = 0; y <= bottom; ++y) {
        for (int x = 0; x <= right; ++x) {
            const float* from = image.pixel(static_cast<std::uint32_t>(std::clamp(x - dx, 0, right)),
                                            static_cast<std::uint32_t>(std::clamp(y - dy, 0, bottom)));
            std::copy_n(from, image.channels,
                        moved.pixel(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)));
        }
    }
    return moved;
}

Image8 to8Bit(const ImageF& image)
{
    Image8 bytes(image.width, image.height, image.channels);
    std::transform(image.values.begin(), image.values.end(), bytes.values.begin(),
                   [](float v) { return static_cast<std::uint8_t>(std::lround(std::clamp(v, 0.0F, 1.0F) * 255.0F)); });
    return bytes;
}

ImageF toFloat(const Image8& image)
{
    ImageF floats(image.width, image.height, image.channels);
    std::transform(image.values.begin(), image.values.end(), floats.values.begin(),
                   [](std::uint8_t v) { return static_cast<float>(v) / 255.0F; });
    return floats;
}

} // namespace gnomon::golden
