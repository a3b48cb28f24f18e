// SPDX-License-Identifier: Apache-2.0
// How maps that want more texels than there are share them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon {

/// No map has fewer texels on a side because others need room.
inline constexpr std::uint32_t kSmallestMap = 16;

/// A side that is so little too small is good enough.
inline constexpr double kTooSmallSide = 1.05;

/// The texels that one or several maps of one side ask for, and get.
struct TexelClaim {
    double weight = 0.0;                   // > 0: the error of the picture, times the side
    double wanted = 0.0;                   // texels on a side: all have as many before one has more
    double useful = 0.0;                   // texels beyond which nothing is gained; less than wanted: it wants no more
    std::uint32_t largest = 0;             // side that it may have at most; what it gets is this, halved some times
    std::uint32_t smallest = kSmallestMap; // and is not less than this, if that is not
    std::uint32_t maps = 1;                // number of maps of that side
    std::uint32_t before = 0;              // side that it got in the frame before; 0: it was not there
    double staying = 1.3;   // so much more that counts than another one, because another one is a map drawn anew
    std::uint32_t side = 0; // that it gets
};

/// The edge of a shadow is off by about a texel, so a map of side s errs by weight / s. Doubling s gains weight / 2s
/// for 3 s^2 texels. All begin with the smallest side, and the one that gains most for its texels is doubled, until all
/// have what they want. The rest is shared in the same way, until more is of no use. Takes n log n steps for n
/// claims, and nothing from the heap once warm.
class TexelShares {
public:
    void share(std::span<TexelClaim> claims, double texels);

private:
    /// A next doubling.
    struct Turn {
        bool wanted = false;     // and not just of use
        double gain = 0.0;       // per texel
        std::uint32_t claim = 0; // whose it is
    };
    [[nodiscard]] static bool comesLater(const Turn& a, const Turn& b);
    void enter(std::span<const TexelClaim> claims, std::uint32_t claim);

    std::vector<Turn> turns_; // a heap
};

} // namespace gnomon
