// SPDX-License-Identifier: Apache-2.0
#include "recorded_stages.h"

#include <nlohmann/json.hpp>

#include <fstream>
#include <iterator>

namespace gnomon::compiled {
namespace {

using Json = nlohmann::json;

/// In this order in the file.
constexpr const char* kHeld[] = {"VGPRs",     "SGPRs",         "waves",         "instructions", "code bytes",
                                 "LDS bytes", "spilled VGPRs", "spilled SGPRs", "scratch bytes"};

/// The figures without zeros at the end, which most stages have.
Json jsonOf(const Figures& figures)
{
    Json json = Json::array();
    for (const char* name : kHeld) {
        json.push_back(figures.at(name));
    }
    while (!json.empty() && json.back() == 0) {
        json.erase(json.end() - 1);
    }
    return json;
}

Figures figuresOf(const Json& json)
{
    Figures figures;
    for (std::size_t i = 0; i < std::size(kHeld); ++i) {
        figures[kHeld[i]] = i < json.size() ? json[i].get<std::uint64_t>() : 0;
    }
    return figures;
}

} // namespace

RecordedStages readRecorded(const std::string& file)
{
    RecordedStages recorded;
    std::ifstream in(file);
    if (!in) {
        return recorded;
    }
    const Json json = Json::parse(in);
    recorded.driver = json.at("driver");
    for (const auto& [name, chips] : json.at("stages").items()) {
        for (const auto& [chip, figures] : chips.items()) {
            recorded.chips[chip][name] = figuresOf(figures);
        }
    }
    return recorded;
}

std::string recordedText(const RecordedStages& recorded)
{
    std::map<std::string, Json> stages;
    for (const auto& [chip, of_chip] : recorded.chips) {
        for (const auto& [name, figures] : of_chip) {
            stages[name][chip] = jsonOf(figures);
        }
    }
    std::string lines;
    for (const auto& [name, chips] : stages) {
        lines += (lines.empty() ? "    " : ",\n    ") + Json(name).dump() + ": " + chips.dump();
    }
    return "{\n  \"driver\": " + Json(recorded.driver).dump() + ",\n  \"figures\": " + Json(kHeld).dump() +
           ",\n  \"stages\": {\n" + lines + "\n  }\n}\n";
}

std::vector<std::string> changes(const CompiledStages& recorded, const CompiledStages& now)
{
    std::vector<std::string> lines;
    for (const auto& [name, figures] : recorded) {
        const auto found = now.find(name);
        if (found == now.end()) {
            lines.push_back(name + " is recorded and not made");
            continue;
        }
        for (const auto& [figure, before] : figures) {
            const std::uint64_t after = found->second.at(figure);
            if (after != before) {
                lines.push_back(name + ": " + figure + (after > before ? " has grown" : " has shrunk") + " from " +
                                std::to_string(before) + " to " + std::to_string(after));
            }
        }
    }
    for (const auto& [name, figures] : now) {
        if (!recorded.contains(name)) {
            lines.push_back(name + " is not recorded");
        }
    }
    return lines;
}

} // namespace gnomon::compiled
