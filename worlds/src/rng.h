// SPDX-License-Identifier: Apache-2.0
// Random numbers and noise that give the same world on every compiler and library. Based on: M. O'Neill, "PCG: A
// Family of Simple Fast Space-Efficient Statistically Good Algorithms for Random Number Generation", 2014 (PCG32);
// K. Perlin, "An Image Synthesizer", 1985 (value noise on a lattice).
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <cstdint>

namespace gnomon::worlds {

inline constexpr float kPi = 3.14159265F;
inline constexpr float kTau = 6.28318531F;

class Rng {
public:
    explicit Rng(std::uint64_t seed, std::uint64_t stream = 0) : increment_((stream << 1U) | 1U)
    {
        next();
        state_ += seed;
        next();
    }
    std::uint32_t next()
    {
        const std::uint64_t old = state_;
        state_ = old * 6364136223846793005ULL + increment_;
        const auto shifted = static_cast<std::uint32_t>(((old >> 18U) ^ old) >> 27U);
        const auto turn = static_cast<std::uint32_t>(old >> 59U);
        return (shifted >> turn) | (shifted << ((32U - turn) & 31U));
    }
    /// In [0, 1).
    float unit() { return static_cast<float>(next() >> 8U) * (1.0F / 16777216.0F); }
    float range(float low, float high) { return low + (high - low) * unit(); }
    std::uint32_t below(std::uint32_t n)
    {
        return static_cast<std::uint32_t>((static_cast<std::uint64_t>(next()) * n) >> 32U);
    }
    /// On the unit sphere.
    glm::vec3 direction()
    {
        const float y = range(-1.0F, 1.0F);
        const float turn = range(0.0F, kTau);
        const float r = std::sqrt(1.0F - y * y);
        return {r * std::cos(turn), y, r * std::sin(turn)};
    }

private:
    std::uint64_t state_ = 0;
    std::uint64_t increment_;
};

inline std::uint32_t hash(std::uint32_t x)
{
    x ^= x >> 16U;
    x *= 0x7FEB352DU;
    x ^= x >> 15U;
    x *= 0x846CA68BU;
    return x ^ (x >> 16U);
}

/// In [0, 1), of a lattice point.
inline float hashUnit(std::int32_t x, std::int32_t y, std::uint32_t seed)
{
    const std::uint32_t h = hash(static_cast<std::uint32_t>(x) * 0x8DA6B343U ^
                                 static_cast<std::uint32_t>(y) * 0xD8163841U ^ seed * 0xCB1AB31FU);
    return static_cast<float>(h >> 8U) * (1.0F / 16777216.0F);
}

inline float smooth(float t)
{
    return t * t * (3.0F - 2.0F * t);
}

inline float smoothstep(float low, float high, float x)
{
    const float t = (x - low) / (high - low);
    return smooth(t < 0.0F ? 0.0F : (t > 1.0F ? 1.0F : t));
}

/// Value noise in [-1, 1]. It repeats after `period` cells where that is above 0.
inline float noise(glm::vec2 p, std::uint32_t seed, std::int32_t period = 0)
{
    const float fx = std::floor(p.x);
    const float fy = std::floor(p.y);
    const float u = smooth(p.x - fx);
    const float v = smooth(p.y - fy);
    auto x0 = static_cast<std::int32_t>(fx);
    auto y0 = static_cast<std::int32_t>(fy);
    std::int32_t x1 = x0 + 1;
    std::int32_t y1 = y0 + 1;
    if (period > 0) {
        const auto wrap = [period](std::int32_t i) {
            return ((i % period) + period) % period;
        };
        x0 = wrap(x0);
        x1 = wrap(x1);
        y0 = wrap(y0);
        y1 = wrap(y1);
    }
    const float a = hashUnit(x0, y0, seed);
    const float b = hashUnit(x1, y0, seed);
    const float c = hashUnit(x0, y1, seed);
    const float d = hashUnit(x1, y1, seed);
    const float top = a + (b - a) * u;
    const float bottom = c + (d - c) * u;
    return 2.0F * (top + (bottom - top) * v) - 1.0F;
}

/// Octaves of noise, each twice as fine and half as strong; about [-1, 1].
inline float fractal(glm::vec2 p, int octaves, std::uint32_t seed, std::int32_t period = 0)
{
    float sum = 0.0F;
    float strength = 0.5F;
    for (int i = 0; i < octaves; ++i) {
        sum += strength * noise(p, seed + static_cast<std::uint32_t>(i), period);
        p *= 2.0F;
        period *= 2;
        strength *= 0.5F;
    }
    return sum;
}

/// Sine of a number of whole turns. A polynomial of our own (worst error 2e-4): thousands are wanted per frame, and
/// libraries disagree in the last bits.
inline float sineOfTurns(float turns)
{
    const float x = turns - std::floor(turns + 0.5F); // [-0.5, 0.5]
    const float folded = x > 0.25F ? 0.5F - x : (x < -0.25F ? -0.5F - x : x);
    const float s = folded * folded;
    return folded * (6.28318531F + s * (-41.3417F + s * (81.6052F + s * -76.7F)));
}
inline float cosineOfTurns(float turns)
{
    return sineOfTurns(turns + 0.25F);
}

} // namespace gnomon::worlds
