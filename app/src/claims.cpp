// SPDX-License-Identifier: Apache-2.0
// `gnomon claims`: tries what the documents that this project began with claim, and says what holds.
#include "claims/claim_report.h"
#include "claims/try_claims.h"
#include "interrupt.h"
#include "progress.h"
#include "streams.h"
#include "subcommands.h"

#include "files/files.h"

#include <fmt/format.h>

#include <algorithm>

namespace gnomon::app {
namespace {

[[noreturn]] void refuseName(std::string_view name)
{
    std::vector<std::string_view> names;
    for (const ClaimDocument& document : claimDocuments()) {
        names.push_back(document.year);
        for (const Claim& claim : document.claims) {
            names.push_back(claim.id);
        }
    }
    throw UsageError(
        fmt::format("there is no claim \"{}\"{}; `gnomon list claims` has them all", name, suggestion(name, names)));
}

/// Those that were named, else all; with --quick only quick ones of them.
std::vector<const Claim*> chosenClaims(const Settings& settings)
{
    std::vector<const Claim*> chosen;
    for (const std::string& name : settings.claims) {
        const std::vector<const Claim*> named = claimsNamed(name);
        if (named.empty()) {
            refuseName(name);
        }
        for (const Claim* claim : named) {
            if (std::ranges::find(chosen, claim) == chosen.end()) { // a year and one of its claims
                chosen.push_back(claim);
            }
        }
    }
    if (settings.claims.empty()) {
        for (const ClaimDocument& document : claimDocuments()) {
            for (const Claim& claim : document.claims) {
                chosen.push_back(&claim);
            }
        }
    }
    if (settings.quick) {
        std::erase_if(chosen, [](const Claim* claim) { return !claim->quick; });
    }
    if (chosen.empty()) {
        throw UsageError("--quick leaves none of these claims: none of them takes seconds only");
    }
    return chosen;
}

} // namespace

int runClaims(const Settings& settings)
{
    if (settings.markdown && !settings.json.empty()) {
        throw UsageError("--markdown and --json both say how the table is written; give one");
    }
    const std::vector<const Claim*> claims = chosenClaims(settings);
    if (!settings.json.empty() && settings.json != "-") {
        requireWritable(settings.json);
    }
    ClaimRunner runner(settings);
    std::vector<TriedClaim> tried;
    {
        Progress progress("trying claims", claims.size());
        for (const Claim* claim : claims) {
            tried.push_back(tryClaim(*claim, runner));
            progress.step();
        }
    }
    requireNotInterrupted();
    if (!settings.json.empty()) {
        writeResult(settings.json, jsonText(claimsJson(tried)));
    } else {
        writeStdout(settings.markdown ? claimsMarkdown(tried) : claimsText(tried));
    }
    requireRecordedVerdicts(tried);
    return 0;
}

} // namespace gnomon::app
