// SPDX-License-Identifier: Apache-2.0
// Based on: H. Vogel, "A better way to construct the sunflower head", 1979 (the points of a set); R. Cranley and
// T. Patterson, "Randomization of number theoretic methods for multiple integration", 1976 (a random shift modulo 1,
// and the error from several of them).
#include "light_samples.h"

#include "random_bits.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace gnomon::truth {

std::vector<DiscPoint> makeDiscSet(std::uint32_t count)
{
    // In (area, angle) these are the points (i / n, frac(i * golden ratio)): one in each of n rings of the same area,
    // and as evenly around as any sequence of angles can be. A map from the square that keeps areas takes them to the
    // disc.
    struct Numbered {
        double area;
        double turns;
    };
    std::vector<Numbered> points;
    for (std::uint32_t i = 0; i < count; ++i) {
        const double turns = i * (std::numbers::phi - 1.0);
        points.push_back({(i + 0.5) / count, turns - std::floor(turns)});
    }
    // Rays that are traced together then go the same way.
    std::sort(points.begin(), points.end(), [](const Numbered& a, const Numbered& b) { return a.turns < b.turns; });
    std::vector<DiscPoint> set;
    for (const Numbered& point : points) {
        const double angle = 2.0 * std::numbers::pi * point.turns;
        set.push_back({static_cast<float>(point.area),
                       {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))}});
    }
    return set;
}

DiscShift shiftOf(std::uint64_t seed, std::uint64_t pixel, std::uint32_t set)
{
    const std::uint64_t key = randomBits(seed, pixel * kSampleSets + set + 1);
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(key >> 40) * 0x1p-24;
    return {static_cast<float>(key & 0xFFFFFFU) * 0x1p-24F,
            {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))}};
}

DiscPoint moved(const DiscPoint& point, const DiscShift& shift)
{
    const float area = point.area + shift.area;
    return {area >= 1.0F ? area - 1.0F : area,
            {point.direction.x * shift.turn.x - point.direction.y * shift.turn.y,
             point.direction.x * shift.turn.y + point.direction.y * shift.turn.x}};
}

double standardError(std::span<const double, kSampleSets> estimates)
{
    const double mean = std::accumulate(estimates.begin(), estimates.end(), 0.0) / kSampleSets;
    double squares = 0.0;
    for (const double estimate : estimates) {
        squares += (estimate - mean) * (estimate - mean);
    }
    return std::sqrt(squares / ((kSampleSets - 1) * kSampleSets));
}

} // namespace gnomon::truth
