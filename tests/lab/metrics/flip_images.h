// SPDX-License-Identifier: Apache-2.0
// Pairs of pictures made by formula, the same on every machine: what FLIP's expected values were worked out for.
#pragma once

#include "image/image.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace gnomon::lab::flip_images {

struct Pair {
    ImageF reference; // linear RGB in [0, 1]
    ImageF test;
};

/// Values in {0, 1/255, ..., 1}; Numerical Recipes' linear congruential generator.
class Noise {
public:
    explicit Noise(std::uint32_t start) : state_(start) {}
    float next()
    {
        state_ = state_ * 1664525u + 1013904223u;
        return static_cast<float>(state_ >> 24u) / 255.0F;
    }

private:
    std::uint32_t state_;
};

inline ImageF uniform(std::uint32_t width, std::uint32_t height, float r, float g, float b)
{
    ImageF image(width, height, 3);
    for (std::size_t i = 0; i < image.values.size(); i += 3) {
        image.values[i] = r;
        image.values[i + 1] = g;
        image.values[i + 2] = b;
    }
    return image;
}

inline void setGrey(ImageF& image, std::uint32_t x, std::uint32_t y, float value)
{
    std::fill_n(image.pixel(x, y), 3, value);
}

/// A grey ramp; in the test its right half is lighter, which makes an edge.
inline Pair rampWithStep()
{
    Pair pair{uniform(128, 96, 0, 0, 0), uniform(128, 96, 0, 0, 0)};
    for (std::uint32_t y = 0; y < 96; ++y) {
        for (std::uint32_t x = 0; x < 128; ++x) {
            const float value = static_cast<float>(x) / 255.0F;
            setGrey(pair.reference, x, y, value);
            setGrey(pair.test, x, y, x < 64 ? value : value + 0.25F);
        }
    }
    return pair;
}

/// Tiles of 16 pixels in mixed colours; in the test each second tile has its channels rotated.
inline Pair colouredTiles()
{
    Pair pair{uniform(128, 96, 0, 0, 0), uniform(128, 96, 0, 0, 0)};
    for (std::uint32_t y = 0; y < 96; ++y) {
        for (std::uint32_t x = 0; x < 128; ++x) {
            const std::uint32_t tile = (y / 16) * 8 + x / 16;
            Noise noise(tile * 7919u + 1u);
            const float rgb[3] = {noise.next(), noise.next(), noise.next()};
            for (std::uint32_t channel = 0; channel < 3; ++channel) {
                pair.reference.pixel(x, y)[channel] = rgb[channel];
                pair.test.pixel(x, y)[channel] = rgb[(channel + tile % 2) % 3];
            }
        }
    }
    return pair;
}

/// Tiles of 8 pixels, each a corner of the RGB cube: filtered, their borders leave the cube and are clamped.
inline Pair saturatedTiles()
{
    Pair pair{uniform(64, 64, 0, 0, 0), uniform(64, 64, 0, 0, 0)};
    for (std::uint32_t y = 0; y < 64; ++y) {
        for (std::uint32_t x = 0; x < 64; ++x) {
            const std::uint32_t corner = x / 8;
            const std::uint32_t other = y / 8;
            for (std::uint32_t channel = 0; channel < 3; ++channel) {
                pair.reference.pixel(x, y)[channel] = static_cast<float>(corner >> channel & 1u);
                pair.test.pixel(x, y)[channel] = static_cast<float>((corner ^ other) >> channel & 1u);
            }
        }
    }
    return pair;
}

/// Coloured noise against other coloured noise.
inline Pair colouredNoise()
{
    Pair pair{uniform(128, 96, 0, 0, 0), uniform(128, 96, 0, 0, 0)};
    Noise of_reference(12345u);
    Noise of_test(67890u);
    for (std::size_t i = 0; i < pair.reference.values.size(); ++i) {
        pair.reference.values[i] = of_reference.next();
        pair.test.values[i] = of_test.next();
    }
    return pair;
}

/// Thin lines and single dots on grey that the test lacks.
inline Pair linesAndDots()
{
    Pair pair{uniform(128, 96, 0.2F, 0.2F, 0.2F), uniform(128, 96, 0.2F, 0.2F, 0.2F)};
    for (std::uint32_t y = 0; y < 96; ++y) {
        for (std::uint32_t x = 0; x < 128; ++x) {
            const bool line = x == 20 || y == 30 || x == y + 40;
            const bool dot = x % 32 == 16 && y % 32 == 16;
            if (line || dot) {
                setGrey(pair.reference, x, y, line ? 0.0F : 1.0F);
            }
        }
    }
    return pair;
}

/// A shadow mask: a disc with a penumbra 12 pixels wide against a hard one made of blocks of 4 pixels.
inline Pair shadowOfDisc()
{
    Pair pair{uniform(128, 96, 1, 1, 1), uniform(128, 96, 1, 1, 1)};
    const auto visible = [](int x, int y, int width) {
        const float distance = std::sqrt(static_cast<float>((x - 60) * (x - 60) + (y - 50) * (y - 50)));
        return std::clamp((distance - 30.0F) / static_cast<float>(width) + 0.5F, 0.0F, 1.0F);
    };
    for (std::uint32_t y = 0; y < 96; ++y) {
        for (std::uint32_t x = 0; x < 128; ++x) {
            setGrey(pair.reference, x, y, visible(static_cast<int>(x), static_cast<int>(y), 12));
            const float hard = visible(static_cast<int>(x / 4 * 4 + 2), static_cast<int>(y / 4 * 4 + 2), 1);
            setGrey(pair.test, x, y, hard < 0.5F ? 0.0F : 1.0F);
        }
    }
    return pair;
}

/// Smaller than every filter.
inline Pair tiny()
{
    Pair pair{uniform(7, 5, 0, 0, 0), uniform(7, 5, 0, 0, 0)};
    Noise noise(99u);
    for (std::size_t i = 0; i < pair.reference.values.size(); ++i) {
        pair.reference.values[i] = noise.next();
        pair.test.values[i] = noise.next();
    }
    return pair;
}

} // namespace gnomon::lab::flip_images
