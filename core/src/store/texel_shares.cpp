// SPDX-License-Identifier: Apache-2.0
#include "store/texel_shares.h"

#include <algorithm>
#include <tuple>

namespace gnomon {
namespace {

/// Texels that doubling takes.
double costOf(const TexelClaim& claim)
{
    return 3.0 * claim.maps * claim.side * claim.side;
}

} // namespace

/// A want comes before a use. Among two that gain alike the first comes first.
bool TexelShares::comesLater(const Turn& a, const Turn& b)
{
    return std::tuple(a.wanted, a.gain, b.claim) < std::tuple(b.wanted, b.gain, a.claim);
}

/// Enters a claim for its next doubling, if that is of use.
void TexelShares::enter(std::span<const TexelClaim> claims, std::uint32_t claim)
{
    const TexelClaim& one = claims[claim];
    const double staying = one.before >= 2 * one.side ? one.staying : 1.0;
    const double enough = kTooSmallSide * one.side / staying;
    const bool wanted = one.wanted > enough;
    if (2 * one.side > one.largest || (!wanted && one.useful <= enough)) {
        return;
    }
    constexpr double kLeastWeight = 1e-30;
    const double keeps = wanted ? staying : staying * staying * staying; // as much of a side: gains are by its cube
    const double gain = std::max(kLeastWeight, one.weight) * keeps / (one.side * costOf(one));
    turns_.push_back({wanted, gain, claim});
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
        const std::uint32_t next = turns_.back().claim;
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
