// SPDX-License-Identifier: Apache-2.0
#include "store/texel_shares.h"

#include <algorithm>

namespace gnomon {
namespace {

/// Of two that gain alike the first comes first.
bool comesLater(const std::pair<double, std::uint32_t>& a, const std::pair<double, std::uint32_t>& b)
{
    return a.first != b.first ? a.first < b.first : a.second > b.second;
}

/// Texels that doubling takes.
double costOf(const TexelClaim& claim)
{
    return 3.0 * claim.maps * claim.side * claim.side;
}

} // namespace

/// Enters a claim for its next doubling, if it wants one.
void TexelShares::enter(std::span<const TexelClaim> claims, std::uint32_t claim)
{
    const TexelClaim& one = claims[claim];
    const bool had = one.before >= 2 * one.side;
    if (2 * one.side > one.largest || one.wanted <= kTooSmallSide * one.side / (had ? one.staying : 1.0)) {
        return;
    }
    constexpr double kLeastWeight = 1e-30;
    const double gain = std::max(kLeastWeight, one.weight) * (had ? one.staying : 1.0) / (one.side * costOf(one));
    turns_.emplace_back(gain, claim);
    std::ranges::push_heap(turns_, comesLater);
}

void TexelShares::share(std::span<TexelClaim> claims, double texels)
{
    turns_.clear();
    for (std::uint32_t i = 0; i < claims.size(); ++i) {
        TexelClaim& claim = claims[i];
        claim.side = claim.largest;
        while (claim.side >= 2 * claim.smallest) {
            claim.side /= 2;
        }
        texels -= costOf(claim) / 3.0;
        enter(claims, i);
    }
    while (!turns_.empty()) {
        std::ranges::pop_heap(turns_, comesLater);
        const std::uint32_t next = turns_.back().second;
        turns_.pop_back();
        if (costOf(claims[next]) > texels) { // nor will it be less than that later
            continue;
        }
        texels -= costOf(claims[next]);
        claims[next].side *= 2;
        enter(claims, next);
    }
}

} // namespace gnomon
