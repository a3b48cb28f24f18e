// SPDX-License-Identifier: Apache-2.0
// Tries claims: runs what they name, works out their figures, and says whether they hold.
#pragma once

#include "claim.h"
#include "claim_runs.h"

#include <span>
#include <vector>

namespace gnomon::app {

struct TriedPart {
    double figure = 0.0;
    bool holds = false;
};

struct TriedClaim {
    const Claim* claim = nullptr;
    std::vector<TriedPart> parts; // as the claim's
    Verdict verdict = Verdict::fails;
    double seconds = 0.0; // what it took, less what another claim had run already

    [[nodiscard]] bool asRecorded() const { return verdict == claim->verdict; }
};

/// Throws what the claim's commands throw.
[[nodiscard]] TriedClaim tryClaim(const Claim& claim, ClaimRunner& runner);

/// Throws Error that names the claims whose verdict is not the recorded one, if there are any.
void requireRecordedVerdicts(std::span<const TriedClaim> tried);

} // namespace gnomon::app
