// SPDX-License-Identifier: Apache-2.0
// The claims of the documents: what is recorded of them is what comes out, and the table is sound.
#include "folder.h"
#include "process.h"

#include "app/command_line.h"
#include "claims/claim_report.h"
#include "claims/try_claims.h"
#include "claims/worked_out.h"

#include <gnomon/error.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace gnomon::app {
namespace {

test::Ran inFolder(const std::vector<std::string>& arguments)
{
    const test::Folder folder;
    return test::gnomon(arguments, {.folder = folder.path()});
}

std::vector<const Claim*> allClaims()
{
    std::vector<const Claim*> all;
    for (const ClaimDocument& document : claimDocuments()) {
        for (const Claim& claim : document.claims) {
            all.push_back(&claim);
        }
    }
    return all;
}

TEST(Claims, HaveNamesOfTheirOwnAndAllThatATableNeeds)
{
    std::set<std::string_view> names;
    for (const ClaimDocument& document : claimDocuments()) {
        EXPECT_FALSE(document.claims.empty()) << document.year;
        for (const Claim& claim : document.claims) {
            EXPECT_TRUE(names.insert(claim.id).second) << claim.id;
            EXPECT_TRUE(claim.id.starts_with(document.year)) << claim.id;
            EXPECT_FALSE(claim.claim.empty()) << claim.id;
            EXPECT_FALSE(claim.why.empty()) << claim.id;
            EXPECT_FALSE(claim.parts.empty()) << claim.id;
            EXPECT_TRUE(claim.verdict != Verdict::partly || claim.parts.size() > 1) << claim.id;
            EXPECT_EQ(claimsNamed(claim.id), std::vector<const Claim*>{&claim});
            for (const ClaimPart& part : claim.parts) {
                EXPECT_LE(part.least, part.most) << claim.id;
                EXPECT_TRUE(std::isfinite(part.least) || std::isfinite(part.most)) << claim.id;
            }
        }
    }
    EXPECT_GE(names.size(), 40U);
    EXPECT_TRUE(claimsNamed("2006-no-such-claim").empty());
    EXPECT_TRUE(claimsNamed("").empty());
}

/// Also of those that take minutes, and what a reader pastes is what was run.
TEST(Claims, HaveCommandsThatTheProgramTakes)
{
    for (const Claim* claim : allClaims()) {
        for (const std::string_view command : claim->commands) {
            ASSERT_TRUE(command.starts_with("gnomon ")) << claim->id;
            const Command parsed = parseCommandLine(argumentsOf(command));
            EXPECT_EQ(parsed.kind, Command::Kind::run) << command;
            EXPECT_EQ(command.find("../shared"), std::string_view::npos) << "needs more than the program: " << command;
        }
    }
}

TEST(Claims, DependOnNoClockWhereTheyAreQuick)
{
    for (const Claim* claim : allClaims()) {
        for (const std::string_view command : claim->commands) {
            EXPECT_FALSE(claim->quick && command.starts_with("gnomon bench")) << claim->id;
        }
    }
}

TEST(Claims, CommandsArePartedAsAShellDoes)
{
    const std::vector<std::string> expected{"compare", "ring", "--light", "lantern 2"};
    EXPECT_EQ(argumentsOf("gnomon compare ring --light \"lantern 2\""), expected);
}

Claim madeUp(Verdict recorded, double figure)
{
    static double said = 0.0;
    said = figure;
    return {.id = "made-up",
            .claim = "one is at most one half",
            .commands = {},
            .parts = {{"a figure", "m", [](const ClaimRuns&) { return said; }, 0.0, 0.5},
                      {"another", "", [](const ClaimRuns&) { return 0.0; }, 0.0, 0.5}},
            .verdict = recorded,
            .quick = true,
            .why = "It is not."};
}

TEST(Claims, HoldInAllPartsInSomeOrInNone)
{
    const Settings settings = defaultSettings();
    ClaimRunner runner(settings);
    EXPECT_EQ(tryClaim(madeUp(Verdict::holds, 0.5), runner).verdict, Verdict::holds);
    EXPECT_EQ(tryClaim(madeUp(Verdict::holds, 0.6), runner).verdict, Verdict::partly);
    EXPECT_EQ(tryClaim(madeUp(Verdict::holds, std::nan("")), runner).verdict, Verdict::partly);
    Claim none = madeUp(Verdict::fails, 0.6);
    none.parts.pop_back();
    EXPECT_EQ(tryClaim(none, runner).verdict, Verdict::fails);
}

TEST(Claims, ThatComeOutOtherwiseAreAFailure)
{
    const Settings settings = defaultSettings();
    ClaimRunner runner(settings);
    const Claim right = madeUp(Verdict::partly, 0.6);
    EXPECT_NO_THROW(requireRecordedVerdicts(std::vector{tryClaim(right, runner)}));
    const Claim wrong = madeUp(Verdict::holds, 0.6);
    const std::vector<TriedClaim> tried{tryClaim(wrong, runner)};
    EXPECT_NE(claimsText(tried).find("recorded: holds"), std::string::npos);
    EXPECT_EQ(claimsJson(tried)["claims"][0]["as_recorded"], false);
    try {
        requireRecordedVerdicts(tried);
        FAIL() << "a verdict that is not the recorded one passed";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("made-up (partly now, holds recorded)"), std::string::npos)
            << error.what();
    }
}

TEST(Claims, OfATechniqueThatWasNotRunAreAnErrorOfTheTable)
{
    const Settings settings = defaultSettings();
    ClaimRunner runner(settings);
    const std::string_view command = "gnomon compare planes --preset plain --camera side --size 16x9 --truth hard "
                                     "--repetitions 1 --warmup 0 --map-size 16 --techniques hard";
    ClaimRuns runs;
    runs.add(command, runner.run(command));
    EXPECT_GT(runs.of("hard", "/error/rmse"), 0.0);
    EXPECT_TRUE(std::isnan(runs.of("hard", "/error/no_such_number")));
    EXPECT_THROW((void)runs.of("pcf", "/error/rmse"), Error);
    EXPECT_EQ(&runner.run(command), &runner.run(command)) << "a command that several claims name is run once";
}

TEST(ClaimFigures, AreReadable)
{
    EXPECT_EQ(figureText(0.0), "0");
    EXPECT_EQ(figureText(101.0), "101");
    EXPECT_EQ(figureText(0.78431), "0.784");
    EXPECT_EQ(figureText(5.96e-8), "6e-08");
    EXPECT_EQ(figureText(2.0), "2");
    EXPECT_EQ(figureText(-0.00703), "-0.00703");
    EXPECT_EQ(figureText(std::nan("")), "-");
}

TEST(ClaimFigures, ThatAreWorkedOutAreTheKnownOnes)
{
    EXPECT_NEAR(precisionOfTightPlanes(), 101.0, 1e-9);
    EXPECT_EQ(stepOfFloats(), 0x1p-24);
    EXPECT_NEAR(densityAtEdge(120.0), 4.0, 1e-12);
    EXPECT_NEAR(stepOfBits(24), 5.96e-5, 1e-7);
    EXPECT_NEAR(stepOfBitsInZOverW(24), 0.596, 0.001);
    EXPECT_NEAR(publishedBlur().sum, 1.067, 0.001);
    EXPECT_NEAR(publishedBlur().sum * publishedBlur().sum, 1.137, 0.002);
    EXPECT_NEAR(publishedBlur().centre_px, 0.41, 0.01);
    EXPECT_EQ(coarserInUpperHalf(), 2.0);
}

/// Those that take seconds, in one run, because they share commands. `gnomon claims` tries the others.
TEST(ClaimsProgram, FindsOfQuickOnesWhatIsRecorded)
{
    const test::Ran ran = inFolder({"claims", "--quick", "--validate", "--json"});
    EXPECT_EQ(ran.status, 0) << ran.err;
    const auto json = nlohmann::json::parse(ran.out);
    std::vector<std::string_view> quick;
    for (const Claim* claim : allClaims()) {
        if (claim->quick) {
            quick.push_back(claim->id);
        }
    }
    ASSERT_EQ(json["claims"].size(), quick.size());
    for (std::size_t i = 0; i < quick.size(); ++i) {
        const auto& claim = json["claims"][i];
        EXPECT_EQ(claim["id"], quick[i]);
        EXPECT_TRUE(claim["as_recorded"]) << claim.dump(2);
        for (const auto& part : claim["parts"]) {
            EXPECT_TRUE(part["figure"].is_number()) << claim.dump(2);
        }
    }
}

TEST(ClaimsProgram, WritesTextJsonAndMarkdown)
{
    const test::Ran text = inFolder({"claims", "2011-range", "2005-gaussian"});
    EXPECT_EQ(text.status, 0) << text.err;
    EXPECT_NE(text.out.find("2011-range"), std::string::npos);
    EXPECT_NE(text.out.find("2 claims in 0 s: 1 hold, 0 partly, 1 do not"), std::string::npos) << text.out;
    const test::Ran markdown = inFolder({"claims", "--markdown", "2011-range", "2011-octree"});
    EXPECT_EQ(markdown.status, 0) << markdown.err;
    EXPECT_NE(markdown.out.find("| `2011-range` | "), std::string::npos) << markdown.out;
    EXPECT_NE(markdown.out.find("# 2011-octree\ngnomon plan "), std::string::npos) << markdown.out;
    const test::Ran year = inFolder({"claims", "--quick", "--json", "2014", "2011-range"});
    const auto of_year = nlohmann::json::parse(year.out)["claims"];
    EXPECT_GT(of_year.size(), 2U);
    for (const auto& claim : of_year) {
        EXPECT_TRUE(claim["document"] == "2014" || claim["id"] == "2011-range") << claim;
    }
    const test::Ran json = inFolder({"claims", "--json", "2011-range"});
    EXPECT_EQ(nlohmann::json::parse(json.out)["claims"][0]["recorded"], "holds");
}

TEST(ClaimsProgram, RefusesWhatItCannotTry)
{
    const auto refused = [](const std::vector<std::string>& arguments) {
        const test::Ran ran = inFolder(arguments);
        EXPECT_EQ(ran.status, 2) << ran.err;
        EXPECT_EQ(ran.errorLines().size(), 1U) << ran.err;
        return ran.err;
    };
    EXPECT_NE(refused({"claims", "2011-rang"}).find("did you mean \"2011-range\"?"), std::string::npos);
    EXPECT_NE(refused({"claims", "--quick", "2010-blend-cost"}).find("leaves none"), std::string::npos);
    EXPECT_NE(refused({"claims", "--json", "--markdown", "2011-range"}).find("give one"), std::string::npos);
    EXPECT_NE(refused({"claims", "--map-size", "64"}).find("not an option of claims"), std::string::npos);
    EXPECT_NE(refused({"claims", "--json", "figures"}).find("\"figures\" is no claim"), std::string::npos);
}

} // namespace
} // namespace gnomon::app
