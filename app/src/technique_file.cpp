// SPDX-License-Identifier: Apache-2.0
#include "technique_text.h"

#include "setting_values.h"

#include "files/files.h"

#include <fmt/format.h>

#include <algorithm>

namespace gnomon::app {
namespace {

constexpr std::uint64_t kMostBytes = 256 * 1024;
constexpr std::size_t kMostTechniques = 1000;
constexpr std::size_t kLongestTechnique = 1000; // bytes; all settings of one together are fewer

/// Without what follows a #, and without blanks at both ends, of which the \r of other systems is one.
std::string_view contentOf(std::string_view line)
{
    constexpr std::string_view kBlanks = " \t\r";
    line = line.substr(0, line.find('#'));
    const std::size_t first = line.find_first_not_of(kBlanks);
    return first == std::string_view::npos ? std::string_view()
                                           : line.substr(first, line.find_last_not_of(kBlanks) + 1 - first);
}

/// The message for a line that cannot be a technique; empty where it may be one.
std::string_view whatIsWrong(std::string_view technique)
{
    if (technique.size() > kLongestTechnique) {
        return "a line this long is no technique";
    }
    if (std::ranges::any_of(technique, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; })) {
        return "a line with control characters is no technique";
    }
    if (technique.find(',') != std::string_view::npos) {
        return "a line has one technique, and no commas";
    }
    return technique.front() == '@' ? "a file of techniques names no other" : std::string_view();
}

void applyLine(Settings& settings, const Setting& setting, std::string_view technique, const std::string& place)
{
    if (const std::string_view wrong = whatIsWrong(technique); !wrong.empty()) {
        throw UsageError(fmt::format("{}: {}", place, wrong));
    }
    if (settings.techniques.size() >= kMostTechniques) {
        throw UsageError(fmt::format("{}: more than {} techniques", place, kMostTechniques));
    }
    try {
        applySetting(settings, setting, technique);
    } catch (const UsageError& error) {
        throw UsageError(fmt::format("{}: {}", place, error.what()));
    }
    settings.technique_places.emplace(technique, place);
}

} // namespace

void applyTechniqueFile(Settings& settings, std::string_view file)
{
    const Setting& setting = *findSetting("techniques");
    const std::string text = readWholeFile(std::filesystem::path(file), kMostBytes, "list of techniques");
    std::size_t number = 0;
    std::size_t found = 0;
    for (const std::string_view line : split(text, '\n')) {
        ++number;
        if (const std::string_view technique = contentOf(line); !technique.empty()) {
            applyLine(settings, setting, technique, fmt::format("{}:{}", file, number));
            ++found;
        }
    }
    if (found == 0) {
        throw UsageError(fmt::format("--techniques: {} has no technique in it", file));
    }
}

} // namespace gnomon::app
