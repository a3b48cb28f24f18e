// SPDX-License-Identifier: Apache-2.0
// How maps share texels.
#include "store/texel_shares.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace gnomon {
namespace {

double texelsOf(const std::vector<TexelClaim>& claims)
{
    double sum = 0.0;
    for (const TexelClaim& one : claims) {
        sum += static_cast<double>(one.maps) * one.side * one.side;
    }
    return sum;
}

TexelClaim claim(double weight, double wanted, double useful)
{
    TexelClaim one;
    one.weight = weight;
    one.wanted = wanted;
    one.useful = useful;
    one.largest = 1024;
    return one;
}

TEST(TexelShares, GiveAllWhatTheyWantWhereThereIsRoom)
{
    std::vector<TexelClaim> claims{claim(1.0, 100.0, 0.0), claim(5.0, 500.0, 0.0), claim(0.01, 10.0, 0.0)};
    TexelShares().share(claims, 1e9);
    EXPECT_EQ(claims[0].side, 128U);
    EXPECT_EQ(claims[1].side, 512U);
    EXPECT_EQ(claims[2].side, kSmallestMap);
}

TEST(TexelShares, GiveNobodyMoreThanHeWantsBeforeAllHaveIt)
{
    // The first owes the picture a thousand times as much, and both want 256.
    std::vector<TexelClaim> claims{claim(1000.0, 256.0, 1024.0), claim(1.0, 256.0, 1024.0)};
    TexelShares().share(claims, 2.0 * 256.0 * 256.0);
    EXPECT_EQ(claims[0].side, 256U);
    EXPECT_EQ(claims[1].side, 256U);
}

TEST(TexelShares, ShareWhatIsLeftUntilMoreIsOfNoUse)
{
    std::vector<TexelClaim> claims{claim(1000.0, 64.0, 512.0), claim(1.0, 64.0, 128.0)};
    TexelShares().share(claims, 1e9);
    EXPECT_EQ(claims[0].side, 512U);
    EXPECT_EQ(claims[1].side, 128U);
    // Room for one doubling goes to the map that the picture owes most to.
    TexelShares().share(claims, 64.0 * 64.0 + 128.0 * 128.0);
    EXPECT_EQ(claims[0].side, 128U);
    EXPECT_EQ(claims[1].side, 64U);
}

TEST(TexelShares, LetAMapStayThatCouldBeABitSmaller)
{
    TexelClaim one = claim(1.0, 120.0, 0.0);
    TexelClaim before = one;
    before.before = 256; // would want 128 anew, and 120 * 1.3 is more
    std::vector<TexelClaim> claims{one, before};
    TexelShares().share(claims, 1e9);
    EXPECT_EQ(claims[0].side, 128U);
    EXPECT_EQ(claims[1].side, 256U);
}

TEST(TexelShares, KeepToTheirRoomAndBounds)
{
    std::mt19937 random(7);
    const auto below = [&](double most) {
        return most * static_cast<double>(random()) / 4294967296.0;
    };
    TexelShares shares;
    for (int i = 0; i < 2000; ++i) {
        std::vector<TexelClaim> claims(1 + random() % 20);
        double least = 0.0;
        for (TexelClaim& one : claims) {
            one = claim(below(10.0), below(2000.0), below(4000.0));
            one.largest = 16U << (random() % 8);
            one.maps = 1U + static_cast<std::uint32_t>(random() % 6);
            least += 1024.0 * one.maps; // a side of less than 32 is not halved
        }
        const double room = least + below(1e6);
        shares.share(claims, room);
        EXPECT_LE(texelsOf(claims), room);
        for (const TexelClaim& one : claims) {
            EXPECT_GE(one.side, std::min(one.smallest, one.largest));
            EXPECT_LE(one.side, one.largest);
        }
    }
}

} // namespace
} // namespace gnomon
