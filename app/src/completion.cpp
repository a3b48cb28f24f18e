// SPDX-License-Identifier: Apache-2.0
// `gnomon completion`: a shell's script, and the answer to it.
#include "completion.h"

#include "app/command_line.h"
#include "app/preset.h"
#include "app/scripted_path.h"
#include "completion_scene.h"
#include "files/files.h"
#include "list.h"
#include "streams.h"
#include "subcommands.h"
#include "technique_text.h"

#include "worlds/worlds.h"

#include <gnomon/choices.h>

#include <fmt/format.h>

#include <algorithm>

namespace gnomon::app {
namespace {

/// Collects the candidates that have a given start.
struct Answer {
    Completion completion;
    std::string before; // the text in the word before the part that is completed: "pcf+", "--filter="
    std::string start;  // the start of the part that is completed

    void add(std::string_view word, std::string_view description = {})
    {
        if (word.starts_with(start)) {
            completion.candidates.push_back({before + std::string(word), std::string(description)});
        }
    }
    /// The part goes on after the first of these characters from the right: what is before it is kept.
    void keepUpTo(char separator)
    {
        if (const std::size_t at = start.rfind(separator); at != std::string::npos) {
            before += start.substr(0, at + 1);
            start.erase(0, at + 1);
        }
    }
};

std::string_view summaryOf(std::string_view choice, std::string_view name)
{
    const ChoiceValue* const row = findChoice(choice, name);
    return row != nullptr ? row->summary : std::string_view();
}

/// Adds the values that the setting itself lists, without looking at the scene or the disk.
void addValues(Answer& answer, const Setting& setting)
{
    if (setting.choices != nullptr) {
        for (const std::string_view name : setting.choices()) {
            answer.add(name, summaryOf(setting.key, name));
        }
    } else if (setting.type == SettingType::flag) {
        answer.add("0");
        answer.add("1");
    }
    if (!setting.none_text.empty()) {
        answer.add(setting.none_text);
    }
}

void addKeys(Answer& answer, bool (*is_one)(const Setting&))
{
    for (const Setting& setting : settingTable()) {
        if (is_one(setting)) {
            answer.add(fmt::format("{}=", setting.key), setting.doc);
        }
    }
}

/// Adds candidates after the last + of a technique: a value of a choice that has none yet, or KEY=.
void addTechniqueParts(Answer& answer)
{
    answer.completion.goes_on = true;
    answer.keepUpTo('+');
    if (const std::size_t equals = answer.start.find('='); equals != std::string::npos) {
        const Setting* const setting = findSetting(answer.start.substr(0, equals));
        if (setting != nullptr && setting->group == SettingGroup::technique) {
            answer.keepUpTo('=');
            addValues(answer, *setting);
        }
        return;
    }
    for (const ChoiceValue& row : choiceValues()) {
        const bool is_taken = std::ranges::any_of(choiceValues(), [&](const ChoiceValue& other) {
            return other.choice == row.choice &&
                   fmt::format("+{}", answer.before).find(fmt::format("+{}+", other.name)) != std::string::npos;
        });
        if (row.choice != "light" && !is_taken) {
            answer.add(row.name, row.summary);
        }
    }
    addKeys(answer, [](const Setting& setting) {
        return setting.group == SettingGroup::technique && setting.key != "technique" &&
               !findChoice(setting.key, "auto");
    });
}

void addPresets(Answer& answer)
{
    for (const Preset& preset : presets()) {
        answer.add(preset.name, preset.summary);
    }
    answer.completion.files = "json";
}

void addScenes(Answer& answer)
{
    for (const worlds::World& world : worlds::all()) {
        answer.add(world.name, world.summary);
    }
    answer.completion.files = "gltf glb";
}

/// Values of settings that are texts.
void addTexts(Answer& answer, std::string_view key, std::span<const std::string> words)
{
    if (key == "technique") {
        addTechniqueParts(answer);
    } else if (key == "techniques") {
        answer.keepUpTo(',');
        if (answer.before.empty()) {
            answer.add("all", "every filter, and pcf with every kernel");
        }
        addTechniqueParts(answer);
    } else if (key == "camera" || key == "light" || key == "animation") {
        for (const std::string& name : namesInScene(key, words)) {
            answer.add(name);
        }
    } else if (key == "path") {
        for (const std::string_view name : pathNames()) {
            answer.add(name);
        }
        answer.completion.files = "json";
    } else if (key == "gpu") {
        answer.add("software", "the software rasteriser");
    } else if (key == "sweep") {
        answer.completion.goes_on = true;
        addKeys(answer, [](const Setting& setting) {
            const bool is_number = setting.type == SettingType::integer || setting.type == SettingType::real;
            return is_number && setting.group != SettingGroup::result && (setting.subcommands & kCompare) != 0;
        });
    } else if (key == "bias") {
        answer.add("auto");
        answer.add("none");
    } else {
        answer.completion.files = key == "out"                        ? "png exr"
                                  : key == "draw"                     ? "svg"
                                  : key == "report"                   ? "/"
                                  : key == "json" || key == "against" ? "json"
                                                                      : "";
    }
}

void addValueOf(Answer& answer, std::string_view key, std::span<const std::string> words, const Subcommand& subcommand)
{
    if (key == "preset") {
        addPresets(answer);
        return;
    }
    if (key == "set") {
        const std::size_t equals = answer.start.find('=');
        if (equals != std::string::npos) {
            const std::string set = answer.start.substr(0, equals);
            answer.before += answer.start.substr(0, equals + 1);
            answer.start.erase(0, equals + 1);
            addValueOf(answer, set, words, subcommand);
            return;
        }
        answer.completion.goes_on = true;
        for (const Setting& setting : settingTable()) {
            if ((setting.subcommands & subcommand.bit) != 0 && !setting.command_line_only) {
                answer.add(fmt::format("{}=", setting.key), setting.doc);
            }
        }
        return;
    }
    if (const Setting* setting = findSetting(key)) {
        if (setting->type == SettingType::text) {
            addTexts(answer, key, words);
        } else {
            addValues(answer, *setting);
        }
    }
}

void addOptions(Answer& answer, const Subcommand& subcommand)
{
    for (const Setting& setting : settingTable()) {
        if (setting.own_option && (setting.subcommands & subcommand.bit) != 0) {
            answer.add(fmt::format("--{}", setting.key), setting.doc);
        }
    }
    if ((subcommand.bit & kFrames) != 0) {
        answer.add("--set", "any other setting, as KEY=VALUE");
        answer.add("--preset", "a JSON file of settings, or a built-in one");
    }
    answer.add("--help", "the options of this subcommand");
}

void addWords(Answer& answer, const Subcommand& subcommand)
{
    if ((subcommand.bit & kFrames) != 0) {
        addScenes(answer);
    } else if (subcommand.bit == kMetrics) {
        answer.completion.files = "png exr";
    } else if (subcommand.bit == kList) {
        for (const ListedName& listed_name : listedNames()) {
            answer.add(listed_name.name, listed_name.summary);
        }
    } else if (subcommand.bit == kCompletion) {
        for (const std::string_view shell : shellNames()) {
            answer.add(shell);
        }
    }
}

void addSubcommands(Answer& answer)
{
    for (const Subcommand& subcommand : subcommands()) {
        answer.add(subcommand.name, subcommand.summary);
    }
}

/// The key of an option that takes the next word as its value; empty where it is none.
std::string_view keyOfOption(std::string_view word)
{
    if (word == "-o") {
        return "out";
    }
    if (!word.starts_with("--")) {
        return {};
    }
    const std::string_view key = word.substr(2);
    const Setting* const setting = findSetting(key);
    const bool takes_one = setting != nullptr && setting->own_option && setting->type != SettingType::flag;
    return takes_one || key == "set" || key == "preset" ? key : std::string_view();
}

void answerLine(Answer& answer, const Subcommand& subcommand, std::span<const std::string> words)
{
    const std::string& previous = words[words.size() - 2];
    const std::size_t equals = answer.start.find('=');
    if (answer.start.starts_with("--") && equals != std::string::npos) {
        const std::string option = answer.start.substr(0, equals);
        answer.before = answer.start.substr(0, equals + 1);
        answer.start.erase(0, equals + 1);
        addValueOf(answer, keyOfOption(option), words, subcommand);
    } else if (const std::string_view key = keyOfOption(previous); words.size() > 2 && !key.empty()) {
        addValueOf(answer, key, words, subcommand);
        if (key == "json") { // its file may be left out
            addWords(answer, subcommand);
        }
    } else if (answer.start.starts_with("-")) {
        addOptions(answer, subcommand);
    } else {
        addWords(answer, subcommand);
    }
}

} // namespace

Completion completionOf(std::span<const std::string> words)
{
    Answer answer;
    answer.start = words.empty() ? "" : words.back();
    if (words.size() <= 1) {
        addSubcommands(answer);
        answer.add("help", "the options of a subcommand");
        answer.add("--help", "this program's subcommands");
        answer.add("--version", "this program's version");
    } else if (words[0] == "help") {
        addSubcommands(answer);
    } else {
        const auto all = subcommands();
        const auto found = std::ranges::find(all, std::string_view(words[0]), &Subcommand::name);
        if (found != all.end()) {
            answerLine(answer, *found, words);
        }
    }
    return answer.completion;
}

std::string completionText(const Completion& completion)
{
    const auto is_line = [](std::string_view text) {
        return std::ranges::none_of(text, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; });
    };
    std::string text;
    for (const Candidate& candidate : completion.candidates) {
        if (is_line(candidate.word) && !candidate.word.starts_with(":")) { // names of files may be anything
            text +=
                fmt::format("{}\t{}\n", candidate.word, is_line(candidate.description) ? candidate.description : "");
        }
    }
    if (!completion.files.empty()) {
        text += fmt::format(":files\t{}\n", completion.files);
    }
    return text + (completion.goes_on ? ":nospace\n" : "");
}

int runCompletion(const Settings& settings)
{
    if (settings.topic.empty() && !settings.typed.empty()) {
        writeStdout(completionText(completionOf(settings.typed)));
        return 0;
    }
    const auto shells = shellNames();
    const std::vector<std::string_view> names(shells.begin(), shells.end());
    if (settings.topic.empty()) {
        throw UsageError(fmt::format("completion needs a shell: {}", listed(names)));
    }
    if (std::ranges::find(names, settings.topic) == names.end()) {
        throw UsageError(fmt::format("completion: there is no shell \"{}\"{}; it has {}", settings.topic,
                                     suggestion(settings.topic, names), listed(names)));
    }
    if (!settings.typed.empty()) {
        throw UsageError("completion takes a shell or, after --, the words of a line; give one");
    }
    writeStdout(completionScript(settings.topic));
    return 0;
}

} // namespace gnomon::app
