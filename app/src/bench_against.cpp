// SPDX-License-Identifier: Apache-2.0
#include "bench_against.h"

#include "compare_table.h"

#include <gnomon/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace gnomon::app {
namespace {

constexpr std::string_view kWholeFrame = "frame";
constexpr std::string_view kPlanStage = "plan"; // on the CPU

Json row(const std::string& technique, std::string_view pass)
{
    return {{"technique", technique}, {"pass", pass}};
}

/// Adds the counters that changed. `in_both`: a counter that only one run has is not compared.
void compareCounts(Json& counters, const std::string& technique, std::string_view pass, const Counts& before,
                   const Counts& now, bool in_both)
{
    std::set<std::string> names;
    for (const Counts* counts : {&before, &now}) {
        for (const auto& [name, count] : *counts) {
            names.insert(name);
        }
    }
    for (const std::string& name : names) {
        const auto was = before.find(name);
        const auto is = now.find(name);
        if (in_both && (was == before.end() || is == now.end())) {
            counters["not_compared"] = true; // one of the devices does not count it
            continue;
        }
        const std::uint64_t was_count = was == before.end() ? 0 : was->second;
        const std::uint64_t is_count = is == now.end() ? 0 : is->second;
        if (was_count == is_count) {
            continue;
        }
        Json line = row(technique, pass);
        line["counter"] = name;
        line["before"] = was_count;
        line["now"] = is_count;
        line["factor"] =
            was_count == 0 ? Json(nullptr) : Json(static_cast<double>(is_count) / static_cast<double>(was_count));
        counters[is_count > was_count ? "grew" : "shrank"].push_back(std::move(line));
    }
}

void compareTimes(Json& times, const std::string& technique, std::string_view pass, const RelativeTime& before,
                  const RelativeTime& now)
{
    if (!before.median || !now.median || !before.iqr || !now.iqr) {
        return;
    }
    times["judged"] = true;
    const double growth = *now.median - *before.median;
    if (std::abs(growth) <= std::max(*before.iqr, *now.iqr)) {
        return;
    }
    Json line = row(technique, pass);
    line["before"] = *before.median;
    line["now"] = *now.median;
    line["factor"] = *before.median > 0.0 ? Json(*now.median / *before.median) : Json(nullptr);
    times[growth > 0.0 ? "grew" : "shrank"].push_back(std::move(line));
}

void compareTechnique(Json& counters, Json& times, const TechniqueFigures& before, const TechniqueFigures& now)
{
    compareCounts(counters, now.name, kWholeFrame, before.counts, now.counts, true);
    compareTimes(times, now.name, kWholeFrame, before.frame, now.frame);
    compareTimes(times, now.name, kPlanStage, before.plan, now.plan);
    static const PassFigures kNone;
    for (const PassFigures& pass : now.passes) {
        const auto same = std::ranges::find(before.passes, pass.name, &PassFigures::name);
        const bool in_both = same != before.passes.end();
        compareCounts(counters, now.name, pass.name, in_both ? same->counts : kNone.counts, pass.counts, in_both);
        if (in_both) {
            compareTimes(times, now.name, pass.name, same->time, pass.time);
            times["not_compared"] = times["not_compared"].get<bool>() || !same->time.median || !pass.time.median;
        }
    }
    for (const PassFigures& pass : before.passes) {
        if (std::ranges::find(now.passes, pass.name, &PassFigures::name) == now.passes.end()) {
            compareCounts(counters, now.name, pass.name, pass.counts, kNone.counts, false);
        }
    }
}

/// The techniques of `from` that `other` lacks.
Json onlyIn(const BenchFigures& from, const BenchFigures& other)
{
    Json names = Json::array();
    for (const TechniqueFigures& technique : from.techniques) {
        if (std::ranges::find(other.techniques, technique.name, &TechniqueFigures::name) == other.techniques.end()) {
            names.push_back(technique.name);
        }
    }
    return names;
}

std::string factorCell(const Json& line)
{
    return cell(numberAt(line, "/factor"), 3);
}

std::string shrunkLine(const Json& lists, std::string_view what)
{
    return fmt::format("{} that have shrunk: {}\n", what, lists.at("shrank").size());
}

std::string countersTable(const Json& counters)
{
    const Json& grew = counters.at("grew");
    if (grew.empty()) {
        return "no counter has grown; " + shrunkLine(counters, "counters");
    }
    TextTable table{{"counters that have grown", "pass", "counter", "before", "now", "factor"}, {}};
    for (const Json& line : grew) {
        table.rows.push_back({textAt(line, "/technique"), textAt(line, "/pass"), textAt(line, "/counter"),
                              line.at("before").dump(), line.at("now").dump(), factorCell(line)});
    }
    return fittedTableText(table) + shrunkLine(counters, "counters");
}

std::string timesTable(const Json& times)
{
    if (!times.at("judged").get<bool>()) {
        return "times are not compared: one frame of each technique has no spread (--repetitions)\n";
    }
    const std::string shrank = shrunkLine(times, "times");
    if (times.at("grew").empty()) {
        return "no time has grown by more than it spreads; " + shrank;
    }
    TextTable table{{"times that have grown, by the frame without shadows", "pass", "before", "now", "factor"}, {}};
    for (const Json& line : times.at("grew")) {
        table.rows.push_back({textAt(line, "/technique"), textAt(line, "/pass"), cell(numberAt(line, "/before"), 3),
                              cell(numberAt(line, "/now"), 3), factorCell(line)});
    }
    return fittedTableText(table) + shrank;
}

std::string listLine(std::string_view title, const Json& names)
{
    std::string text;
    for (const Json& name : names) {
        text += (text.empty() ? "" : ", ") + name.get<std::string>();
    }
    return text.empty() ? text : fmt::format("{}: {}\n", title, text);
}

} // namespace

void requireComparable(const BenchFigures& earlier, const Json& head, const std::vector<std::string>& techniques)
{
    const std::string tried = fmt::format("comparing with {}", earlier.file);
    const Sight sight = sightOf(Json::parse(jsonText(head))); // numbers and texts as they come back from a file
    for (const Sight* one : {&sight, &earlier.sight}) {
        for (const auto& [key, value] : *one) {
            const auto mine = sight.find(key);
            const auto theirs = earlier.sight.find(key);
            if (theirs == earlier.sight.end()) {
                continue; // it was not to be chosen then
            }
            if (mine == sight.end() || mine->second != theirs->second) {
                throw Error(tried, fmt::format("it was measured with another \"{}\"", key),
                            "counts and times of another picture say nothing; run both with the same options");
            }
        }
    }
    const bool any = std::ranges::any_of(techniques, [&](const std::string& name) {
        return std::ranges::find(earlier.techniques, name, &TechniqueFigures::name) != earlier.techniques.end();
    });
    if (!any) {
        throw Error(tried,
                    fmt::format("it has none of these techniques; its first is {}", earlier.techniques.front().name),
                    "name one that it has with --techniques, and give the same settings: they are part of the name");
    }
}

Json againstJson(const BenchFigures& earlier, const BenchFigures& now)
{
    const Json lists{{"grew", Json::array()}, {"shrank", Json::array()}, {"not_compared", false}};
    Json counters = lists;
    Json times{{"judged", false}};
    times.update(lists);
    for (const TechniqueFigures& technique : now.techniques) {
        const auto before = std::ranges::find(earlier.techniques, technique.name, &TechniqueFigures::name);
        if (before != earlier.techniques.end()) {
            compareTechnique(counters, times, *before, technique);
        }
    }
    return {{"file", earlier.file},
            {"device", earlier.device},
            {"counters", std::move(counters)},
            {"times", std::move(times)},
            {"only_before", onlyIn(earlier, now)},
            {"only_now", onlyIn(now, earlier)}};
}

std::string againstText(const Json& against)
{
    const auto partial = [&](const char* what, std::string_view sentence) {
        return against.at(what).at("not_compared").get<bool>() ? fmt::format("{}\n", sentence) : std::string();
    };
    return fmt::format("\nagainst {}\n", textAt(against, "/file")) + countersTable(against.at("counters")) +
           partial("counters", "some counters are not compared: they are not measured on one of the devices") +
           timesTable(against.at("times")) +
           partial("times", "some times of passes are not compared: they are not measured on one of the devices") +
           listLine("not in this run", against.at("only_before")) +
           listLine("not in the earlier run", against.at("only_now"));
}

void requireNoGrowth(const Json& against)
{
    const Json& grew = against.at("counters").at("grew");
    if (!grew.empty()) {
        const Json& first = grew.front();
        throw Error(fmt::format("comparing with {}", textAt(against, "/file")),
                    fmt::format("counters that have grown: {}, the first is {} of {} in {}: {} before, {} now",
                                grew.size(), textAt(first, "/counter"), textAt(first, "/pass"),
                                textAt(first, "/technique"), first.at("before").dump(), first.at("now").dump()));
    }
}

} // namespace gnomon::app
