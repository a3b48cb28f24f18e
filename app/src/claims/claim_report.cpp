// SPDX-License-Identifier: Apache-2.0
#include "claim_report.h"

#include "compare_table.h"
#include "technique_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gnomon::app {
namespace {

std::string boundText(const ClaimPart& part)
{
    if (part.least == -kNoBound) {
        return fmt::format("at most {}", figureText(part.most));
    }
    if (part.most == kNoBound) {
        return fmt::format("at least {}", figureText(part.least));
    }
    return fmt::format("{} to {}", figureText(part.least), figureText(part.most));
}

const ClaimDocument& documentOf(const Claim& claim)
{
    const auto documents = claimDocuments();
    const auto found = std::find_if(documents.begin(), documents.end(), [&](const ClaimDocument& document) {
        return std::any_of(document.claims.begin(), document.claims.end(),
                           [&](const Claim& other) { return other.id == claim.id; });
    });
    return found == documents.end() ? documents.front() : *found; // a claim of a test's own is in none
}

Json boundJson(double bound)
{
    return std::isfinite(bound) ? Json(bound) : Json(nullptr);
}

Json partJson(const ClaimPart& part, const TriedPart& tried)
{
    return {{"what", part.what},
            {"figure", numberJson(tried.figure)},
            {"unit", part.unit},
            {"least", boundJson(part.least)},
            {"most", boundJson(part.most)},
            {"holds", tried.holds}};
}

Json recordJson(const Claim& claim)
{
    return {{"id", claim.id},       {"document", documentOf(claim).year},
            {"claim", claim.claim}, {"commands", claim.commands},
            {"quick", claim.quick}, {"recorded", nameOf(claim.verdict)},
            {"why", claim.why}};
}

/// A cell's text may not end the cell.
std::string cellText(std::string_view text)
{
    std::string escaped;
    for (const char c : text) {
        escaped += c == '|' ? std::string("\\|") : std::string(1, c);
    }
    return escaped;
}

std::string markdownRow(const TriedClaim& tried)
{
    std::string figures;
    for (const std::string& text : figureTexts(tried)) {
        figures += (figures.empty() ? "" : "; ") + text;
    }
    const Claim& claim = *tried.claim;
    return fmt::format("| `{}` | {} | {} | **{}** | {} |\n", claim.id, cellText(claim.claim), cellText(figures),
                       nameOf(tried.verdict), cellText(claim.why));
}

std::string markdownOf(const ClaimDocument& document, std::span<const TriedClaim> tried)
{
    std::string rows;
    std::string commands;
    for (const TriedClaim& one : tried) {
        if (documentOf(*one.claim).year != document.year) {
            continue;
        }
        rows += markdownRow(one);
        if (!one.claim->commands.empty()) {
            commands += fmt::format("# {}\n", one.claim->id);
        }
        for (const std::string_view command : one.claim->commands) {
            commands += fmt::format("{}\n", command);
        }
    }
    if (rows.empty()) {
        return {};
    }
    return fmt::format("## {}, {}\n\n| name | claim | our figures | verdict | why |\n|---|---|---|---|---|\n{}{}\n",
                       document.source, document.year, rows,
                       commands.empty() ? "" : fmt::format("\n```\n{}```\n", commands));
}

} // namespace

std::string figureText(double figure)
{
    if (!std::isfinite(figure)) {
        return std::string(kNoNumber);
    }
    if (figure == 0.0) {
        return "0";
    }
    const double size = std::abs(figure);
    if (size < 1e-4 || size >= 1e6) {
        return fmt::format("{:.2g}", figure);
    }
    constexpr int kDigits = 3;
    const int before = static_cast<int>(std::floor(std::log10(size))) + 1;
    std::string text = fmt::format("{:.{}f}", figure, std::clamp(kDigits - before, 0, 6));
    if (text.find('.') != std::string::npos) {
        text.erase(text.find_last_not_of('0') + 1);
        if (text.ends_with('.')) {
            text.pop_back();
        }
    }
    return text;
}

std::vector<std::string> figureTexts(const TriedClaim& tried)
{
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < tried.parts.size(); ++i) {
        const ClaimPart& part = tried.claim->parts[i];
        texts.push_back(fmt::format("{} {}{}{}", part.what, figureText(tried.parts[i].figure),
                                    part.unit.empty() ? "" : " ", part.unit));
    }
    return texts;
}

std::string claimsText(std::span<const TriedClaim> tried)
{
    std::string text;
    double seconds = 0.0;
    for (const TriedClaim& one : tried) {
        const Claim& claim = *one.claim;
        text += fmt::format("{:<26} {:<13} {:>6.1f} s  {}\n", claim.id, nameOf(one.verdict), one.seconds, claim.claim);
        const std::vector<std::string> figures = figureTexts(one);
        for (std::size_t i = 0; i < figures.size(); ++i) {
            text += fmt::format("{:>50}{} ({}: {})\n", "", figures[i], boundText(claim.parts[i]),
                                one.parts[i].holds ? "holds" : "does not");
        }
        if (!one.asRecorded()) {
            text += fmt::format("{:>50}recorded: {}\n", "", nameOf(claim.verdict));
        }
        seconds += one.seconds;
    }
    const auto count = [&](Verdict verdict) {
        return std::count_if(tried.begin(), tried.end(), [=](const TriedClaim& one) { return one.verdict == verdict; });
    };
    return text + fmt::format("{} claims in {:.0f} s: {} hold, {} partly, {} do not\n", tried.size(), seconds,
                              count(Verdict::holds), count(Verdict::partly), count(Verdict::fails));
}

Json claimsJson(std::span<const TriedClaim> tried)
{
    Json json{{"version", GNOMON_VERSION}, {"claims", Json::array()}};
    for (const TriedClaim& one : tried) {
        Json row = recordJson(*one.claim);
        row["verdict"] = nameOf(one.verdict);
        row["as_recorded"] = one.asRecorded();
        row["seconds"] = numberJson(one.seconds);
        row["parts"] = Json::array();
        for (std::size_t i = 0; i < one.parts.size(); ++i) {
            row["parts"].push_back(partJson(one.claim->parts[i], one.parts[i]));
        }
        json["claims"].push_back(row);
    }
    return json;
}

std::string claimsMarkdown(std::span<const TriedClaim> tried)
{
    std::string text;
    for (const ClaimDocument& document : claimDocuments()) {
        text += markdownOf(document, tried);
    }
    return text;
}

Json recordedClaimsJson()
{
    Json rows = Json::array();
    for (const ClaimDocument& document : claimDocuments()) {
        for (const Claim& claim : document.claims) {
            rows.push_back(recordJson(claim));
        }
    }
    return rows;
}

} // namespace gnomon::app
