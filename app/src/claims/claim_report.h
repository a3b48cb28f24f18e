// SPDX-License-Identifier: Apache-2.0
// What came of claims, for the terminal, as JSON and as the tables of docs/claims.md.
#pragma once

#include "result_json.h"
#include "try_claims.h"

#include <span>
#include <string>
#include <vector>

namespace gnomon::app {

/// A figure as people read it: three digits that count.
[[nodiscard]] std::string figureText(double figure);
/// "acne 0.12 of that without", a part each.
[[nodiscard]] std::vector<std::string> figureTexts(const TriedClaim& tried);

[[nodiscard]] std::string claimsText(std::span<const TriedClaim> tried);
[[nodiscard]] Json claimsJson(std::span<const TriedClaim> tried);
/// A heading, a table and the commands of each document of which a claim was tried.
[[nodiscard]] std::string claimsMarkdown(std::span<const TriedClaim> tried);
/// All that are recorded, tried or not: {"id", "document", "claim", "commands", "quick", "recorded", "why"}.
[[nodiscard]] Json recordedClaimsJson();

} // namespace gnomon::app
