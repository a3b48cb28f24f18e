// SPDX-License-Identifier: Apache-2.0
// A claim of one of the documents that this project began with, as data: what is claimed, how it is tried, when it
// holds.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

namespace gnomon::app {

class ClaimRuns;

enum class Verdict : std::uint8_t { holds, partly, fails };
/// "holds", "partly", "does not hold".
[[nodiscard]] std::string_view nameOf(Verdict verdict);

inline constexpr double kNoBound = std::numeric_limits<double>::infinity();

/// One number that a claim is held against. It holds from `least` to `most`, both included; a NaN never does.
struct ClaimPart {
    std::string_view what;              // "acne with a least variance of 0.0001"
    std::string_view unit;              // "of that without"
    double (*figure)(const ClaimRuns&); // of the claim's commands
    double least = -kNoBound;
    double most = kNoBound;
};

struct Claim {
    std::string_view id;    // the document's year and a name: "2006-duel"
    std::string_view claim; // in our own words
    /// What one types to see the numbers; none: the figures are worked out from the library's own arithmetic. Commands
    /// of several claims that are the same are run once.
    std::vector<std::string_view> commands;
    std::vector<ClaimPart> parts; // one at least
    Verdict verdict;              // that is recorded: all parts hold, some, or none
    bool quick;                   // takes seconds and depends on no clock
    std::string_view why;         // one sentence or two
};

struct ClaimDocument {
    std::string_view year;
    std::string_view source; // author and title
    std::span<const Claim> claims;
};
/// In the order of the documents.
[[nodiscard]] std::span<const ClaimDocument> claimDocuments();
/// The claim of that id, or all of the document of that year. Empty when there is neither.
[[nodiscard]] std::vector<const Claim*> claimsNamed(std::string_view id_or_year);

// A file each.
[[nodiscard]] std::span<const Claim> claimsOf2011(); // A. Marinescu
[[nodiscard]] std::span<const Claim> claimsOf2006(); // T. Forsyth
[[nodiscard]] std::span<const Claim> claimsOf2014(); // Kite & Lightning
[[nodiscard]] std::span<const Claim> claimsOf2010(); // P. Fortier
[[nodiscard]] std::span<const Claim> claimsOf2005(); // A. S. Shastry

} // namespace gnomon::app
