// SPDX-License-Identifier: Apache-2.0
// soften=blur on the CPU, by the arithmetic that the GPU runs; in double precision where the includer
// defines GNOMON_REAL so.
#pragma once

#include "scene.h"

#include <gnomon/options.h>

#include <gnomon/shared/discs.h>
#include <gnomon/shared/screen_blur.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace gnomon::test {

inline constexpr VkExtent2D kScreen{160, 101}; // no multiple of 2 or 4
inline constexpr int kWidth = static_cast<int>(kScreen.width);
inline constexpr int kHeight = static_cast<int>(kScreen.height);

/// Values between 0 and 1 that are stored in eight bits.
struct Plane {
    int width = 0;
    int height = 0;
    std::vector<double> values;

    Plane(int width_in, int height_in)
        : width(width_in), height(height_in), values(static_cast<std::size_t>(width_in * height_in))
    {
    }
    [[nodiscard]] double& at(int x, int y)
    {
        return values[static_cast<std::size_t>(std::clamp(y, 0, height - 1) * width + std::clamp(x, 0, width - 1))];
    }
    [[nodiscard]] double at(int x, int y) const { return const_cast<Plane*>(this)->at(x, y); }
    /// As a sampler reads it.
    [[nodiscard]] double between(double x, double y) const
    {
        const double u = std::clamp(x, 0.5, width - 0.5) - 0.5;
        const double v = std::clamp(y, 0.5, height - 0.5) - 0.5;
        const int i = static_cast<int>(u);
        const int j = static_cast<int>(v);
        return glm::mix(glm::mix(at(i, j), at(i + 1, j), u - i), glm::mix(at(i, j + 1), at(i + 1, j + 1), u - i),
                        v - j);
    }
    void store(int x, int y, double value) { at(x, y) = std::round(std::clamp(value, 0.0, 1.0) * 255.0) / 255.0; }
};

/// The pass on the CPU.
class SoftenReference {
public:
    SoftenReference(const Picture& picture, const Camera& camera, const ScreenBlurOptions& blur)
        : picture_(picture), camera_(camera), blur_(blur), scale_(static_cast<int>(pixelsPerTexel(blur.size))),
          aware_(blur.edges == ScreenEdges::aware)
    {
    }

    [[nodiscard]] Plane of(const Plane& mask) const
    {
        const bool twice = blur_.kernel != ScreenKernel::poisson && blur_.passes == 2;
        Plane made = pass(mask, 1, {1.0, 0.0});
        if (twice) {
            made = pass(made, scale_, {0.0, 1.0});
        }
        return spread(made, mask);
    }

private:
    [[nodiscard]] std::size_t indexOf(glm::ivec2 pixel) const
    {
        return static_cast<std::size_t>(pixel.y * kWidth + pixel.x);
    }
    [[nodiscard]] bool isBackground(glm::ivec2 pixel) const { return picture_.object_plus_one[indexOf(pixel)] == 0; }
    [[nodiscard]] glm::ivec2 pixelOf(glm::ivec2 texel) const
    {
        return {std::min(shared::pixelOfTexel(texel.x, scale_), kWidth - 1),
                std::min(shared::pixelOfTexel(texel.y, scale_), kHeight - 1)};
    }
    [[nodiscard]] double shareOf(glm::ivec2 from, glm::ivec2 to) const
    {
        if (isBackground(to)) {
            return 0.0;
        }
        const glm::dvec3 n = picture_.normal[indexOf(from)];
        const glm::dvec3 p = picture_.position[indexOf(from)];
        const glm::dmat4 world_from_ndc = glm::inverse(camera_.clip_from_world);
        const double w = (camera_.clip_from_world * glm::dvec4(p, 1.0)).w;
        const double pixel_m = glm::length(glm::dvec3(world_from_ndc[0])) * (2.0 / kWidth) * w;
        const double off = std::abs(glm::dot(n, picture_.position[indexOf(to)] - p)) / pixel_m;
        return shared::screenDepthShare(off) * shared::screenNormalShare(glm::dot(n, picture_.normal[indexOf(to)]));
    }
    [[nodiscard]] glm::dvec3 tap(int i, glm::dvec2 direction, glm::dvec2 texel) const
    {
        const double strength = static_cast<double>(blur_.strength_px);
        if (blur_.kernel == ScreenKernel::poisson) {
            const double angle = shared::interleavedGradientNoise(shared::real2(texel + 0.5)) * 6.2831853;
            const glm::dvec2 at = glm::dvec2(shared::kPoissonPoints[i]) * shared::kScreenDiscRadius * strength;
            return {at.x * std::cos(angle) - at.y * std::sin(angle), at.x * std::sin(angle) + at.y * std::cos(angle),
                    1.0};
        }
        if (blur_.taps == ScreenTaps::published) {
            return {direction * shared::publishedPlace(i) * strength, shared::publishedWeight(i)};
        }
        const int from_middle = i - shared::screenTapsAside(scale_);
        return {direction * shared::screenTapPlace(from_middle, scale_) * strength,
                shared::screenTapWeight(static_cast<int>(blur_.kernel), from_middle, scale_)};
    }
    [[nodiscard]] int tapCount() const
    {
        if (blur_.kernel == ScreenKernel::poisson) {
            return static_cast<int>(blur_.points);
        }
        return blur_.taps == ScreenTaps::published ? shared::kPublishedTaps : 2 * shared::screenTapsAside(scale_) + 1;
    }
    [[nodiscard]] double texelOf(const Plane& source, int source_scale, glm::ivec2 texel, glm::dvec2 direction) const
    {
        const glm::dvec2 middle = (glm::dvec2(texel) + 0.5) * double(scale_) / double(source_scale);
        const glm::ivec2 pixel = pixelOf(texel);
        const glm::ivec2 own = source_scale == 1 ? pixel : texel;
        if (aware_ && isBackground(pixel)) {
            return source.at(own.x, own.y);
        }
        double sum = 0.0;
        double weights = 0.0;
        for (int i = 0; i < tapCount(); ++i) {
            const glm::dvec3 t = tap(i, direction, texel);
            const glm::dvec2 off = glm::dvec2(t) / double(source_scale);
            if (aware_) {
                const glm::ivec2 there =
                    glm::clamp(own + glm::ivec2(glm::dvec2(shared::nearestPixel(off.x), shared::nearestPixel(off.y))),
                               glm::ivec2(0), glm::ivec2(source.width, source.height) - 1);
                const double weight = t.z * shareOf(pixel, source_scale == 1 ? there : pixelOf(there));
                sum += weight * source.at(there.x, there.y);
                weights += weight;
            } else {
                sum += t.z * source.between(middle.x + off.x, middle.y + off.y);
                weights += t.z;
            }
        }
        const bool published = blur_.taps == ScreenTaps::published;
        return published ? sum : weights > 1e-3 ? sum / weights : source.at(own.x, own.y);
    }
    [[nodiscard]] Plane pass(const Plane& source, int source_scale, glm::dvec2 direction) const
    {
        Plane out((kWidth + scale_ - 1) / scale_, (kHeight + scale_ - 1) / scale_);
        for (int y = 0; y < out.height; ++y) {
            for (int x = 0; x < out.width; ++x) {
                out.store(x, y, texelOf(source, source_scale, {x, y}, direction));
            }
        }
        return out;
    }
    [[nodiscard]] double spreadTo(glm::ivec2 pixel, const Plane& from, double before) const
    {
        if (!aware_) {
            return from.between((pixel.x + 0.5) / scale_, (pixel.y + 0.5) / scale_);
        }
        if (isBackground(pixel)) {
            return before;
        }
        const glm::dvec2 place = (glm::dvec2(pixel) - double(scale_ / 2)) / double(scale_);
        const glm::dvec2 part = place - glm::floor(place);
        double sum = 0.0;
        double weights = 0.0;
        for (int i = 0; i < 4; ++i) {
            const glm::ivec2 corner(i & 1, i >> 1);
            const glm::ivec2 texel = glm::clamp(glm::ivec2(glm::floor(place)) + corner, glm::ivec2(0),
                                                glm::ivec2(from.width, from.height) - 1);
            const glm::dvec2 near = glm::mix(1.0 - part, part, glm::dvec2(corner));
            const double weight = near.x * near.y * shareOf(pixel, pixelOf(texel));
            sum += weight * from.at(texel.x, texel.y);
            weights += weight;
        }
        return weights > 0.01 ? sum / weights : before;
    }
    [[nodiscard]] Plane spread(const Plane& from, const Plane& mask) const
    {
        Plane out = mask;
        for (int y = 0; y < kHeight && scale_ > 1; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                out.store(x, y, spreadTo({x, y}, from, mask.at(x, y)));
            }
        }
        return scale_ > 1 ? out : from;
    }

    const Picture& picture_;
    const Camera& camera_;
    ScreenBlurOptions blur_;
    int scale_;
    bool aware_;
};

} // namespace gnomon::test
