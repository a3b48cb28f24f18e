// SPDX-License-Identifier: Apache-2.0
// Based on: G. Steele, D. Lea, C. Flood, "Fast splittable pseudorandom number generators", 2014.
#pragma once

#include <cstdint>

namespace gnomon::truth {

/// Equal for equal arguments, as if at random for different ones.
[[nodiscard]] constexpr std::uint64_t randomBits(std::uint64_t seed, std::uint64_t number)
{
    constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15ULL;
    constexpr auto mix = [](std::uint64_t x) {
        x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ULL;
        x = (x ^ (x >> 27)) * 0x94D049BB133111EBULL;
        return x ^ (x >> 31);
    };
    return mix(mix(seed + kGolden) + number * kGolden);
}

} // namespace gnomon::truth
