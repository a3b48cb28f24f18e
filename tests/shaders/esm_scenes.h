// SPDX-License-Identifier: Apache-2.0
// Shadow maps with an exact answer, for esm: a receiver, an occluder above it, and something far behind it.
#pragma once
#include "cpu_map.h"

#include <gnomon/shared/pcf_weights.h>

#include <string>

namespace gnomon::test {

constexpr int kSceneTexels = 96;

/// Depths in [0, 1] as functions of the place in texels.
struct EsmScene {
    std::string name;
    glm::dvec2 slope;                               // of the receiver, per texel
    std::function<bool(double x, double y)> table;  // is the receiver here
    std::function<bool(double x, double y)> shaded; // by an occluder at 0.3
    double behind;                                  // depth where the receiver is not

    [[nodiscard]] double receiver(double x, double y) const
    {
        return 0.6 + slope.x * (x - 48.0) + slope.y * (y - 48.0);
    }
    [[nodiscard]] double depth(double x, double y) const
    {
        return shaded(x, y) ? 0.3 : table(x, y) ? receiver(x, y) : behind;
    }
};

inline std::vector<EsmScene> esmScenes()
{
    const auto edge = [](double x, double y) {
        return x + 0.13 * y < 62.0;
    };
    const auto everywhere = [](double, double) {
        return true;
    };
    const auto half = [](double x, double y) {
        return y - 0.3 * x < 30.0;
    };
    const auto band = [](double x, double y) {
        return x + 0.5 * y < 60.0 && x > 20.0;
    };
    const auto slats = [](double x, double y) {
        return std::fmod(x + y, 13.0) < 3.0;
    };
    return {{"an edge over a far floor", {0.0, 0.0}, edge, half, 0.9},
            {"an edge over a near floor", {0.0, 0.0}, edge, half, 0.63},
            {"a slope", {0.002, 0.001}, everywhere, band, 0.9},
            {"a steep slope", {0.006, 0.003}, everywhere, band, 1.0},
            {"a slope's edge over a far floor", {0.002, 0.001}, edge, half, 0.9},
            {"slats over an edge", {0.0, 0.0}, edge, slats, 0.9}};
}

/// Separable Gaussian blur of one number a texel, clamped to the edge.
inline std::vector<double> blurred(const std::vector<double>& from, double sigma)
{
    const int radius = static_cast<int>(std::ceil(3.0 * sigma));
    double sum = 0.0;
    for (int i = -radius; i <= radius; ++i) {
        sum += std::exp(-0.5 * i * i / (sigma * sigma));
    }
    const auto pass = [&](const std::vector<double>& in, int dx, int dy) {
        std::vector<double> out(in.size());
        for (int k = 0; k < static_cast<int>(in.size()); ++k) {
            for (int i = -radius; i <= radius; ++i) {
                const int x = std::clamp(k % kSceneTexels + i * dx, 0, kSceneTexels - 1);
                const int y = std::clamp(k / kSceneTexels + i * dy, 0, kSceneTexels - 1);
                out[static_cast<std::size_t>(k)] +=
                    std::exp(-0.5 * i * i / (sigma * sigma)) / sum * in[static_cast<std::size_t>(y * kSceneTexels + x)];
            }
        }
        return out;
    };
    return pass(pass(from, 1, 0), 0, 1);
}

/// A number a texel, of what is at its centre.
template <typename Of>
std::vector<double> sceneTexels(Of of)
{
    std::vector<double> out;
    for (int k = 0; k < kSceneTexels * kSceneTexels; ++k) {
        out.push_back(of(k % kSceneTexels + 0.5, k / kSceneTexels + 0.5));
    }
    return out;
}

inline MomentImage imageOf(const std::vector<double>& texels)
{
    MomentImage image(kSceneTexels, kSceneTexels);
    for (int k = 0; k < kSceneTexels * kSceneTexels; ++k) {
        image.at(k % kSceneTexels, k / kSceneTexels) = glm::dvec4(texels[static_cast<std::size_t>(k)]);
    }
    return image;
}

} // namespace gnomon::test
