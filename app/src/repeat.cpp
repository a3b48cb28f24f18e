// SPDX-License-Identifier: Apache-2.0
#include "repeat.h"

#include "app/command_line.h"

#include <fmt/format.h>

#include <algorithm>

namespace gnomon::app {
namespace {

bool goesWithoutSaying(const Setting& setting, const Settings& settings, const std::string& value)
{
    static const Settings defaults = defaultSettings();
    const auto usual = defaults.values.find(setting.key);
    return (usual != defaults.values.end() && usual->second == value) || !isUsed(setting, settings);
}

void addOption(std::vector<std::string>& words, const Setting& setting, const std::string& value)
{
    if (!setting.own_option) {
        words.push_back("--set");
        words.push_back(fmt::format("{}={}", setting.key, value));
        return;
    }
    // A value may begin with a minus, which is no option behind an equals sign.
    words.push_back(setting.type == SettingType::flag ? fmt::format("--{}", setting.key)
                                                      : fmt::format("--{}={}", setting.key, value));
}

bool isPlain(char c)
{
    constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=.,/:@%";
    return kPlain.find(c) != std::string_view::npos;
}

} // namespace

std::vector<std::string> argumentsOf(const Settings& settings, std::uint32_t subcommand)
{
    const auto subcommands = app::subcommands();
    const auto row = std::find_if(subcommands.begin(), subcommands.end(),
                                  [&](const Subcommand& one) { return one.bit == subcommand; });
    std::vector<std::string> words{std::string(row->name), settings.scene};
    Settings there = settings;
    there.subcommand = subcommand;
    bool has_technique = false;
    for (const Setting& setting : settingTable()) {
        if (setting.group == SettingGroup::technique) {
            if (!has_technique) {
                words.push_back("--technique=" + describeTechnique(there));
                has_technique = true;
            }
            continue;
        }
        const auto value = there.values.find(setting.key);
        if (value == there.values.end() || (setting.subcommands & subcommand) == 0 || setting.command_line_only ||
            goesWithoutSaying(setting, there, value->second)) {
            continue;
        }
        if (!setting.repeatable) {
            addOption(words, setting, value->second);
            continue;
        }
        std::string_view rest = value->second;
        while (!rest.empty()) {
            const std::size_t end = std::min(rest.find(setting.separator), rest.size());
            addOption(words, setting, std::string(rest.substr(0, end)));
            rest.remove_prefix(std::min(end + setting.separator.size(), rest.size()));
        }
    }
    return words;
}

std::string shellText(const std::vector<std::string>& words)
{
    std::string text;
    for (const std::string& word : words) {
        text += text.empty() ? "" : " ";
        if (!word.empty() && std::all_of(word.begin(), word.end(), isPlain)) {
            text += word;
            continue;
        }
        text += '\'';
        for (const char c : word) {
            text += c == '\'' ? std::string("'\\''") : std::string(1, c);
        }
        text += '\'';
    }
    return text;
}

} // namespace gnomon::app
