// SPDX-License-Identifier: Apache-2.0
// How maps that want more texels than there are share them.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace gnomon {

/// No map has fewer texels on a side because others need room.
inline constexpr std::uint32_t kSmallestMap = 16;

/// A side that is so little too small is good enough.
inline constexpr double kTooSmallSide = 1.05;

/// What one or several maps of one side ask for, and get.
struct TexelClaim {
    double weight = 0.0;                   // > 0: the error of the picture, times the side
    double wanted = 0.0;                   // texels on a side, beyond which nothing is gained
    std::uint32_t largest = 0;             // side that it may have at most; what it gets is this, halved some times
    std::uint32_t smallest = kSmallestMap; // and is not less than this, if that is not
    std::uint32_t maps = 1;                // of that side each
    std::uint32_t before = 0;              // side that it got in the frame before; 0: it was not there
    double staying = 1.3;   // so much more that counts than another one, because another one is a map drawn anew
    std::uint32_t side = 0; // that it gets
};

/// The edge of a shadow is off by about a texel, so a map of side s errs by weight / s. Doubling s gains weight / 2s
/// for 3 s^2 texels. All begin with the smallest side, and the one that gains most for its texels is doubled, until all
/// have what they want or no texels are left. Takes n log n steps for n claims, and nothing from the heap once warm.
class TexelShares {
public:
    void share(std::span<TexelClaim> claims, double texels);

private:
    /// Gain per texel of the next doubling, and whose it is.
    using Turn = std::pair<double, std::uint32_t>;
    void enter(std::span<const TexelClaim> claims, std::uint32_t claim);

    std::vector<Turn> turns_; // a heap
};

} // namespace gnomon
