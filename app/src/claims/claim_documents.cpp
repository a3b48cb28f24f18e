// SPDX-License-Identifier: Apache-2.0
#include "claim.h"

#include <array>

namespace gnomon::app {

std::string_view nameOf(Verdict verdict)
{
    constexpr std::string_view kNames[] = {"holds", "partly", "does not hold"};
    return kNames[static_cast<std::size_t>(verdict)];
}

std::span<const ClaimDocument> claimDocuments()
{
    static const std::array documents{
        ClaimDocument{"2011",
                      "A. Marinescu, \"Achieving real-time soft shadows using layered variance shadow maps (LVSM) in a "
                      "real-time strategy (RTS) game\"",
                      claimsOf2011()},
        ClaimDocument{"2006", "T. Forsyth, \"Extremely Practical Shadows\", GDC", claimsOf2006()},
        ClaimDocument{"2014", "Kite & Lightning, \"Variance Shadow Maps\"", claimsOf2014()},
        ClaimDocument{"2010", "P. Fortier, \"Shadow maps for moving light sources\", IceFall Games", claimsOf2010()},
        ClaimDocument{"2005", "A. S. Shastry, \"Soft-Edged Shadows\"", claimsOf2005()},
    };
    return documents;
}

std::vector<const Claim*> claimsNamed(std::string_view id_or_year)
{
    std::vector<const Claim*> named;
    for (const ClaimDocument& document : claimDocuments()) {
        for (const Claim& claim : document.claims) {
            if (claim.id == id_or_year || document.year == id_or_year) {
                named.push_back(&claim);
            }
        }
    }
    return named;
}

} // namespace gnomon::app
