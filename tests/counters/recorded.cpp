// SPDX-License-Identifier: Apache-2.0
#include "recorded.h"

#include "bench_against.h"

#include <fstream>
#include <stdexcept>

namespace gnomon::counters {
namespace {

using app::Json;

constexpr const char* kFrame = "frame"; // what no pass has by itself

app::Counts countsOf(const Json& json)
{
    app::Counts counts;
    for (const auto& [name, count] : json.items()) {
        counts[name] = count.get<std::uint64_t>();
    }
    return counts;
}

Json jsonOf(const app::Counts& counts)
{
    Json json = Json::object();
    for (const auto& [name, count] : counts) {
        json[name] = count;
    }
    return json;
}

app::TechniqueFigures techniqueOf(const std::string& name, const Json& passes)
{
    app::TechniqueFigures technique;
    technique.name = name;
    for (const auto& [pass, counts] : passes.items()) {
        if (pass == kFrame) {
            technique.counts = countsOf(counts);
        } else {
            technique.passes.push_back({pass, {}, countsOf(counts)});
        }
    }
    return technique;
}

std::string techniqueText(const app::TechniqueFigures& technique)
{
    std::string text = "      " + Json(technique.name).dump() + ": {\n";
    for (const app::PassFigures& pass : technique.passes) {
        text += "        " + Json(pass.name).dump() + ": " + jsonOf(pass.counts).dump() + ",\n";
    }
    return text + "        \"" + kFrame + "\": " + jsonOf(technique.counts).dump() + "\n      }";
}

void addChanges(std::vector<std::string>& lines, const Json& counters, const char* verb)
{
    for (const Json& line : counters) {
        const auto text = [&](const char* key) {
            return line.at(key).get<std::string>();
        };
        std::string change = text("technique") + ", " + text("pass") + ": " + text("counter") + " has " + verb +
                             " from " + line.at("before").dump() + " to " + line.at("now").dump();
        if (line.at("factor").is_number()) {
            change += ", times " + line.at("factor").dump();
        }
        lines.push_back(std::move(change));
    }
}

} // namespace

Recorded readRecorded(const std::string& file)
{
    std::ifstream in(file);
    if (!in) {
        throw std::runtime_error("there is no " + file);
    }
    const Json json = Json::parse(in);
    Recorded recorded;
    recorded.driver = json.at("driver");
    for (const auto& [view, techniques] : json.at("views").items()) {
        Techniques& of_view = recorded.views[view];
        for (const auto& [name, passes] : techniques.items()) {
            of_view.push_back(techniqueOf(name, passes));
        }
    }
    return recorded;
}

std::string recordedText(const Recorded& recorded, const std::vector<std::string>& order)
{
    std::string views;
    for (const std::string& name : order) {
        const auto view = recorded.views.find(name);
        if (view == recorded.views.end()) {
            continue;
        }
        std::string techniques;
        for (const app::TechniqueFigures& technique : view->second) {
            techniques += (techniques.empty() ? "" : ",\n") + techniqueText(technique);
        }
        views += (views.empty() ? "" : ",\n") + ("    " + Json(name).dump()) + ": {\n" + techniques + "\n    }";
    }
    return "{\n  \"driver\": " + Json(recorded.driver).dump() + ",\n  \"views\": {\n" + views + "\n  }\n}\n";
}

std::vector<std::string> changes(const Techniques& recorded, const Techniques& now)
{
    app::BenchFigures before;
    before.techniques = recorded;
    app::BenchFigures after;
    after.techniques = now;
    const Json against = app::againstJson(before, after);
    std::vector<std::string> lines;
    addChanges(lines, against.at("counters").at("grew"), "grown");
    addChanges(lines, against.at("counters").at("shrank"), "shrunk");
    for (const Json& name : against.at("only_before")) {
        lines.push_back(name.get<std::string>() + " is recorded and not run");
    }
    for (const Json& name : against.at("only_now")) {
        lines.push_back(name.get<std::string>() + " is not recorded");
    }
    return lines;
}

} // namespace gnomon::counters
