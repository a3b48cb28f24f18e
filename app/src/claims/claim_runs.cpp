// SPDX-License-Identifier: Apache-2.0
#include "claim_runs.h"

#include "app/command_line.h"
#include "findings.h"
#include "streams.h"
#include "subcommands.h"

#include <gnomon/error.h>

#include <fmt/format.h>

#include <cassert>
#include <cerrno>
#include <cstdlib>
#include <limits>
#include <system_error>

namespace gnomon::app {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

Json findBy(const Settings& settings)
{
    switch (settings.subcommand) {
    case kCompare:
        return findByComparing(settings);
    case kBench:
        return findByTiming(settings);
    case kPlan:
        return findByPlanning(settings);
    case kMetrics:
        return findByMeasuring(settings);
    default:
        (void)runRender(settings);
        return nullptr;
    }
}

/// Pictures by name are in one folder, whatever it is.
void moveInto(const std::filesystem::path& folder, Settings& settings)
{
    for (std::string* name : {&settings.output, &settings.test_image, &settings.truth_image}) {
        if (!name->empty()) {
            *name = (folder / *name).string();
        }
    }
}

} // namespace

std::vector<std::string> argumentsOf(std::string_view command)
{
    std::vector<std::string> words(1);
    bool quoted = false;
    for (const char c : command) {
        if (c == '"') {
            quoted = !quoted;
        } else if (c == ' ' && !quoted) {
            words.emplace_back();
        } else {
            words.back() += c;
        }
    }
    assert(words.front() == "gnomon");
    words.erase(words.begin());
    return words;
}

void ClaimRuns::add(std::string_view command, const ClaimRun& run)
{
    runs_.push_back({command, &run});
}

const ClaimRun& ClaimRuns::at(std::size_t run) const
{
    return *runs_.at(run).run;
}

const Json& ClaimRuns::resultOf(std::size_t run, std::string_view technique) const
{
    const Settings& settings = at(run).settings;
    const std::string name = describeTechnique(parseTechnique(settings, technique));
    for (const Json& result : json(run).at("results")) {
        if (result.at("technique") == name) {
            return result;
        }
    }
    throw Error(fmt::format("reading the result of `{}`", runs_[run].command),
                fmt::format("it has no technique \"{}\"", technique), "the table of claims is wrong");
}

double ClaimRuns::of(std::size_t run, std::string_view technique, const char* pointer) const
{
    return numberAt(resultOf(run, technique), pointer).value_or(kNothing);
}

double ClaimRuns::passMs(std::size_t run, std::string_view technique, std::string_view pass) const
{
    for (const Json& one : resultOf(run, technique).at("passes")) {
        if (one.at("name") == pass) {
            return numberAt(one, "/ms").value_or(kNothing);
        }
    }
    return kNothing;
}

double ClaimRuns::shadowMs(std::size_t run, std::string_view technique) const
{
    return of(run, technique, "/time_ms/maps") + of(run, technique, "/time_ms/mask");
}

double ClaimRuns::ratio(std::string_view technique, std::string_view other, const char* pointer) const
{
    return of(technique, pointer) / of(other, pointer);
}

double ClaimRuns::number(std::size_t run, const char* pointer) const
{
    return numberAt(json(run), pointer).value_or(kNothing);
}

ClaimRunner::ClaimRunner(const Settings& shared) : shared_(shared) {}

ClaimRunner::~ClaimRunner()
{
    std::error_code ignored; // there is nobody to tell
    if (!folder_.empty()) {
        std::filesystem::remove_all(folder_, ignored);
    }
}

const ClaimRun& ClaimRunner::run(std::string_view command)
{
    const auto known = runs_.find(command);
    if (known != runs_.end()) {
        return *known->second;
    }
    auto made = std::make_unique<ClaimRun>(make(command));
    return *runs_.emplace(std::string(command), std::move(made)).first->second;
}

std::filesystem::path ClaimRunner::folder()
{
    if (folder_.empty()) {
        std::string name = (std::filesystem::temp_directory_path() / "gnomon_claims.XXXXXX").string();
        if (::mkdtemp(name.data()) == nullptr) {
            throw Error("making a folder for pictures, " + name, std::generic_category().message(errno));
        }
        folder_ = name;
    }
    return folder_;
}

ClaimRun ClaimRunner::make(std::string_view command)
{
    std::vector<std::string> arguments = argumentsOf(command);
    ClaimRun run{parseCommandLine(arguments).settings, nullptr};
    for (const std::string_view key : {"gpu", "validate"}) {
        const auto value = shared_.values.find(key);
        if (value != shared_.values.end() && isUsed(*findSetting(key), run.settings)) {
            applySetting(run.settings, key, value->second);
        }
    }
    if (run.settings.subcommand == kRender || run.settings.subcommand == kMetrics) {
        moveInto(folder(), run.settings);
    }
    const NoNotices silence; // they would be the same ones again and again
    run.json = findBy(run.settings);
    return run;
}

} // namespace gnomon::app
