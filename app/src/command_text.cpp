// SPDX-License-Identifier: Apache-2.0
#include "command_text.h"

#include "setting_values.h"

#include <fmt/format.h>

#include <cassert>

namespace gnomon::app {
namespace {

bool isPlain(std::string_view text)
{
    constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-._/+=,:@%";
    return !text.empty() && text.find_first_not_of(kPlain) == std::string_view::npos;
}

/// Whether a technique's text or the sweep's point says it already, or nothing needs to.
bool isLeftOut(const Setting& setting, std::uint32_t subcommand)
{
    return (setting.subcommands & subcommand) == 0 || setting.command_line_only ||
           setting.group == SettingGroup::technique || setting.key == "techniques" || setting.key == "sweep";
}

void addOption(std::vector<std::string>& words, const Setting& setting, std::string_view value)
{
    if (!setting.own_option || (setting.type == SettingType::flag && value != "1")) {
        words.insert(words.end(), {"--set", fmt::format("{}={}", setting.key, value)});
        return;
    }
    if (setting.type == SettingType::flag) {
        words.push_back(fmt::format("--{}", setting.key));
        return;
    }
    // A value may begin with a minus, so it is joined to its option.
    for (const std::string_view piece :
         setting.repeatable ? split(value, setting.separator.front()) : std::vector<std::string_view>{value}) {
        words.push_back(fmt::format("--{}={}", setting.key, piece));
    }
}

} // namespace

std::string shellWord(std::string_view text)
{
    if (isPlain(text)) {
        return std::string(text);
    }
    std::string word = "'";
    for (const char c : text) {
        word += c == '\'' ? std::string("'\\''") : std::string(1, c);
    }
    return word + "'";
}

std::string shellText(std::span<const std::string> words)
{
    std::string text = "gnomon";
    for (const std::string& word : words) {
        text += " " + shellWord(word);
    }
    return text;
}

std::vector<std::string> commandWords(const Settings& settings, std::uint32_t subcommand, std::string_view technique)
{
    static const Settings defaults = defaultSettings();
    assert(subcommand == kRender || subcommand == kCompare || subcommand == kBench);
    const bool draws = subcommand == kRender;
    const bool looks_like_an_option = settings.scene.starts_with("-");
    std::vector<std::string> words{draws                    ? "render"
                                   : subcommand == kCompare ? "compare"
                                                            : "bench",
                                   (looks_like_an_option ? "./" : "") + settings.scene};
    for (const Setting& setting : settingTable()) {
        const auto value = settings.values.find(setting.key);
        if (value == settings.values.end() || isLeftOut(setting, subcommand) || (draws && !isUsed(setting, settings))) {
            continue;
        }
        const auto usual = defaults.values.find(setting.key);
        if (usual == defaults.values.end() || usual->second != value->second) {
            addOption(words, setting, value->second);
        }
    }
    words.push_back(fmt::format("--technique{}={}", draws ? "" : "s", technique));
    return words;
}

std::string commandText(const Settings& settings, std::uint32_t subcommand, std::string_view technique)
{
    return shellText(commandWords(settings, subcommand, technique));
}

} // namespace gnomon::app
