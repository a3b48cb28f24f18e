// SPDX-License-Identifier: Apache-2.0
// Based on: J. Hammersley, "Monte Carlo methods for solving multivariable problems", 1960 (the points of a set);
// R. Cranley and T. Patterson, "Randomization of number theoretic methods for multiple integration", 1976 (their
// random shift).
#include "pixel_points.h"

#include "random_bits.h"
#include "smooth_surface.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

namespace gnomon::truth {
namespace {

constexpr std::uint32_t kPointsOfSet = kPixelPoints / kSampleSets;
static_assert(std::has_single_bit(kPointsOfSet));

} // namespace

std::optional<Receiver> receiverOn(const SceneGeometry& geometry, const View& view, const CameraRays::Seen& seen)
{
    const std::optional<Triangle> triangle = geometry.triangle(seen.object, seen.triangle);
    if (!triangle || !geometry.part(seen.object).receives) {
        return {};
    }
    Receiver receiver;
    receiver.object = seen.object;
    receiver.triangle = seen.triangle;
    receiver.normal = glm::dot(seen.normal, triangle->front) < 0.0 ? -triangle->front : triangle->front;
    const glm::dvec3 rel = view.eye_ws + seen.point - geometry.originWs();
    receiver.rel = offSurface(rel, *triangle, receiver.normal);
    const SmoothPoint smooth =
        smoothPoint(*triangle, geometry.vertexNormals(seen.object, seen.triangle), rel, receiver.normal);
    receiver.smooth_normal = smooth.normal;
    receiver.lifted_rel = receiver.rel + smooth.normal * smooth.lift_m;
    receiver.lifts = smooth.lift_m > 0.0;
    return receiver;
}

Options optionsOfPoint(const Options& options)
{
    Options of_point = options;
    const std::uint32_t share = options.samples / kPixelPoints / kSampleSets * kSampleSets;
    of_point.samples = std::max(share, kSampleSets);
    return of_point;
}

std::uint32_t raysPerPixel(const Options& options)
{
    const bool over_pixels = options.pixels == PixelTruth::area;
    const Options each = over_pixels ? optionsOfPoint(options) : options;
    return (over_pixels ? kPixelPoints : 1U) * (options.kind == Kind::area ? each.samples : 1U);
}

glm::dvec2 pointInPixel(std::uint64_t seed, std::uint64_t pixel, std::uint32_t set, std::uint32_t index)
{
    constexpr std::uint64_t kOfPixels = 0x706978656C73ULL; // not the numbers that the light's disc is turned by
    const std::uint64_t bits = randomBits(seed ^ kOfPixels, pixel * kSampleSets + set + 1);
    const glm::dvec2 shift(static_cast<double>(bits >> 32) * 0x1p-32,
                           static_cast<double>(bits & 0xFFFFFFFFU) * 0x1p-32);
    std::uint32_t reversed = 0; // bits, so that each row and each column of the pixel has one point
    for (std::uint32_t bit = 1; bit < kPointsOfSet; bit *= 2) {
        reversed = 2 * reversed + ((index & bit) != 0 ? 1 : 0);
    }
    return glm::fract(shift + glm::dvec2(index, reversed) / static_cast<double>(kPointsOfSet));
}

ShadowRays::Result traceOverPixel(const SceneGeometry& geometry, const View& view, const CameraRays& camera,
                                  const ShadowRays& shadow_rays, std::uint64_t seed, const glm::uvec2& pixel)
{
    const std::uint64_t number = std::uint64_t{pixel.y} * view.size_px.x + pixel.x;
    ShadowRays::Result result;
    result.first_blocker_m = std::numeric_limits<double>::infinity();
    std::array<double, kSampleSets> sums{};
    std::array<std::uint32_t, kSampleSets> counts{};
    for (std::uint32_t set = 0; set < kSampleSets; ++set) {
        for (std::uint32_t i = 0; i < kPointsOfSet; ++i) {
            const auto seen = camera.trace(glm::dvec2(pixel) + pointInPixel(seed, number, set, i));
            auto receiver = seen ? receiverOn(geometry, view, *seen) : std::nullopt;
            if (!receiver) {
                continue;
            }
            receiver->pixel = (number * kSampleSets + set) * kPointsOfSet + i;
            const ShadowRays::Result one = shadow_rays.trace(*receiver);
            sums[set] += one.visibility;
            ++counts[set];
            result.first_blocker_m = std::min(result.first_blocker_m, one.first_blocker_m);
            result.rays += one.rays;
        }
    }
    double sum = 0.0;
    std::uint32_t count = 0;
    for (std::uint32_t set = 0; set < kSampleSets; ++set) {
        sum += sums[set];
        count += counts[set];
    }
    if (count == 0) {
        return result;
    }
    result.visibility = sum / count;
    for (std::uint32_t set = 0; set < kSampleSets; ++set) {
        sums[set] = counts[set] > 0 ? sums[set] / counts[set] : result.visibility;
    }
    result.standard_error = standardError(sums);
    return result;
}

} // namespace gnomon::truth
