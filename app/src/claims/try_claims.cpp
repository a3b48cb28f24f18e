// SPDX-License-Identifier: Apache-2.0
#include "try_claims.h"

#include <gnomon/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <string>

namespace gnomon::app {
namespace {

Verdict verdictOf(const std::vector<TriedPart>& parts)
{
    const auto holding = std::count_if(parts.begin(), parts.end(), [](const TriedPart& part) { return part.holds; });
    if (holding == 0) {
        return Verdict::fails;
    }
    return static_cast<std::size_t>(holding) == parts.size() ? Verdict::holds : Verdict::partly;
}

} // namespace

TriedClaim tryClaim(const Claim& claim, ClaimRunner& runner)
{
    const auto begin = std::chrono::steady_clock::now();
    ClaimRuns runs;
    for (const std::string_view command : claim.commands) {
        runs.add(command, runner.run(command));
    }
    TriedClaim tried;
    tried.claim = &claim;
    for (const ClaimPart& part : claim.parts) {
        const double figure = part.figure(runs);
        tried.parts.push_back({figure, figure >= part.least && figure <= part.most});
    }
    tried.verdict = verdictOf(tried.parts);
    tried.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return tried;
}

void requireRecordedVerdicts(std::span<const TriedClaim> tried)
{
    std::string names;
    std::size_t count = 0;
    for (const TriedClaim& one : tried) {
        if (!one.asRecorded()) {
            names += fmt::format("{}{} ({} now, {} recorded)", names.empty() ? "" : ", ", one.claim->id,
                                 nameOf(one.verdict), nameOf(one.claim->verdict));
            ++count;
        }
    }
    if (count != 0) {
        throw Error("trying claims",
                    fmt::format("{} of {} have another verdict than is recorded: {}", count, tried.size(), names));
    }
}

} // namespace gnomon::app
