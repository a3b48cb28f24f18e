// SPDX-License-Identifier: Apache-2.0
// Masks that the tests of the metrics are made of.
#pragma once

#include "lab/metrics/error.h"

#include <cstdint>
#include <random>

namespace gnomon::lab::test {

inline ImageF constantMask(std::uint32_t width, std::uint32_t height, float value)
{
    return ImageF(width, height, 1, value);
}

/// The same numbers on every machine, which the standard library promises of its engines but not its distributions.
class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    double uniform() { return static_cast<double>(engine_() >> 11) * 0x1.0p-53; }
    std::uint32_t below(std::uint32_t end) { return static_cast<std::uint32_t>(engine_() % end); }

private:
    std::mt19937_64 engine_;
};

/// Values all over [0, 1].
inline ImageF noiseMask(std::uint32_t width, std::uint32_t height, std::uint64_t seed)
{
    Random random(seed);
    ImageF mask(width, height, 1);
    for (float& value : mask.values) {
        value = static_cast<float>(random.uniform());
    }
    return mask;
}

/// Each pixel counts with probability `share`.
inline Counted countSome(std::uint32_t width, std::uint32_t height, double share, std::uint64_t seed)
{
    Random random(seed);
    Counted counted(width, height, 1);
    for (std::uint8_t& value : counted.values) {
        value = random.uniform() < share ? 1 : 0;
    }
    return counted;
}

} // namespace gnomon::lab::test
