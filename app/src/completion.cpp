// SPDX-License-Identifier: Apache-2.0
// `gnomon completion`: a shell's script, and the answer to it.
#include "completion.h"

#include "app/command_line.h"
#include "files/files.h"
#include "streams.h"
#include "subcommands.h"
#include "technique_text.h"
#include "topics.h"

#include <gnomon/error.h>

#include <fmt/format.h>

#include <algorithm>

namespace gnomon::app {
namespace {

/// Collects the candidates that have a given start.
struct Answer {
    const Subcommand* subcommand = nullptr;
    std::span<const std::string> words;
    Completion completion;
    std::string before; // the text in the word before the part that is completed: "pcf+", "--filter="
    std::string start;  // the start of the part that is completed

    void add(std::string_view word, std::string_view description = {})
    {
        if (word.starts_with(start)) {
            completion.candidates.push_back({before + std::string(word), std::string(description)});
        }
    }
    /// The part goes on after the character at this place: what is up to it is kept.
    void keepUpTo(std::size_t at)
    {
        if (at != std::string::npos) {
            before += start.substr(0, at + 1);
            start.erase(0, at + 1);
        }
    }
};

bool hasIt(const Setting& setting, const Subcommand& subcommand)
{
    return (setting.subcommands & subcommand.bit) != 0;
}

/// Adds the topics of a section; of an empty one all, each name once.
void addTopics(Answer& answer, std::string_view section)
{
    std::set<std::string_view> names;
    for (const Topic& topic : topics()) {
        if ((section.empty() || topic.section == section) && names.insert(topic.name).second) {
            answer.add(topic.name, topic.summary);
        }
    }
}

void addKeys(Answer& answer, bool (*is_one)(const Setting&, const Subcommand&))
{
    answer.completion.goes_on = true;
    for (const Setting& setting : settingTable()) {
        if (is_one(setting, *answer.subcommand)) {
            answer.add(fmt::format("{}=", setting.key), setting.doc);
        }
    }
}

/// Adds the values that the setting itself lists, without looking at the scene.
void addValues(Answer& answer, const Setting& setting)
{
    for (const Offer& offer : setting.offers != nullptr ? setting.offers() : std::vector<Offer>()) {
        answer.add(offer.value, offer.doc);
    }
    for (const std::string_view name :
         setting.choices != nullptr ? setting.choices() : std::vector<std::string_view>()) {
        const ChoiceValue* const row = findChoice(setting.key, name);
        answer.add(name, row != nullptr ? row->summary : std::string_view());
    }
    if (setting.type == SettingType::flag) {
        answer.add("0");
        answer.add("1");
    }
    if (!setting.none_text.empty()) {
        answer.add(setting.none_text);
    }
    answer.completion.files = setting.files;
}

/// Adds candidates after the last + of a technique: a value of a choice that has none yet, or KEY=.
void addTechniqueParts(Answer& answer)
{
    answer.completion.goes_on = true;
    answer.keepUpTo(answer.start.rfind('+'));
    if (const std::size_t equals = answer.start.find('='); equals != std::string::npos) {
        const Setting* const setting = findSetting(answer.start.substr(0, equals));
        if (setting != nullptr && setting->group == SettingGroup::technique) {
            answer.keepUpTo(answer.start.rfind('='));
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
    addKeys(answer, [](const Setting& setting, const Subcommand&) {
        return setting.group == SettingGroup::technique && setting.key != "technique" &&
               !findChoice(setting.key, "auto");
    });
}

/// Names of what the setting chooses in the scene that the line names, else in rts. Nothing for a scene that cannot be
/// read, or takes too long to.
void addNamesInScene(Answer& answer, const Setting& setting)
{
    constexpr std::uint64_t kMostBytes = 32U << 20U; // larger files are not read, so that nobody waits long
    scene::Limits limits;
    limits.max_file_bytes = kMostBytes;
    limits.max_total_bytes = kMostBytes;
    const auto named = std::ranges::find_if(answer.words.begin(), answer.words.end() - 1, [](const std::string& word) {
        return worlds::find(word) != nullptr || hasExtension(word, ".gltf") || hasExtension(word, ".glb");
    });
    try {
        const scene::Scene scene = worlds::load(named == answer.words.end() - 1 ? "rts" : *named, 1, limits);
        std::set<std::string> names{""};
        for (const std::string& name : setting.names_in(scene)) {
            if (names.insert(name).second) {
                answer.add(name);
            }
        }
    } catch (const Error&) { // the line itself will say so once it is run
    }
}

void addValueOf(Answer& answer, std::string_view key)
{
    const Setting* const setting = findSetting(key);
    if (key == "preset") {
        addTopics(answer, "presets");
        answer.completion.files = "json";
    } else if (const std::size_t equals = answer.start.find('='); key == "set" && equals != std::string::npos) {
        const std::string set = answer.start.substr(0, equals);
        answer.keepUpTo(equals);
        addValueOf(answer, set);
    } else if (key == "set") {
        addKeys(answer, [](const Setting& one, const Subcommand& subcommand) {
            return hasIt(one, subcommand) && !one.command_line_only;
        });
    } else if (key == "technique") {
        addTechniqueParts(answer);
    } else if (key == "techniques") {
        answer.keepUpTo(answer.start.rfind(','));
        if (answer.before.empty()) {
            addValues(answer, *setting);
        }
        addTechniqueParts(answer);
    } else if (key == "sweep") {
        addKeys(answer, [](const Setting& one, const Subcommand&) { return canBeSwept(one); });
    } else if (setting != nullptr && setting->names_in != nullptr) {
        addNamesInScene(answer, *setting);
    } else if (setting != nullptr) {
        addValues(answer, *setting);
    }
}

void addOptions(Answer& answer)
{
    for (const Setting& setting : settingTable()) {
        if (setting.own_option && hasIt(setting, *answer.subcommand)) {
            answer.add(fmt::format("--{}", setting.key), setting.doc);
        }
    }
    if ((answer.subcommand->bit & kFrames) != 0) {
        answer.add("--set", "any other setting, as KEY=VALUE");
        answer.add("--preset", "a JSON file of settings, or a built-in one");
    }
    answer.add("--help", "the options of this subcommand");
}

void addWords(Answer& answer)
{
    const std::uint32_t bit = answer.subcommand->bit;
    if ((bit & kFrames) != 0) {
        addTopics(answer, "worlds");
        answer.completion.files = "gltf glb";
    } else if (bit == kMetrics) {
        answer.completion.files = "png exr";
    } else if (bit == kList) {
        addTopics(answer, "");
    } else if (bit == kCompletion) {
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
    for (const Setting& setting : settingTable()) {
        if (setting.own_option && setting.type != SettingType::flag &&
            (word == fmt::format("--{}", setting.key) || word == fmt::format("-{}", setting.letter))) {
            return setting.key;
        }
    }
    return word == "--set" || word == "--preset" ? word.substr(2) : std::string_view();
}

void answerLine(Answer& answer)
{
    const std::string& previous = answer.words[answer.words.size() - 2];
    const std::size_t equals = answer.start.find('=');
    if (answer.start.starts_with("--") && equals != std::string::npos) {
        const std::string option = answer.start.substr(0, equals);
        answer.keepUpTo(equals);
        addValueOf(answer, keyOfOption(option));
    } else if (const std::string_view key = keyOfOption(previous); answer.words.size() > 2 && !key.empty()) {
        addValueOf(answer, key);
        if (key == "json") { // its file may be left out
            addWords(answer);
        }
    } else if (answer.start.starts_with("-")) {
        addOptions(answer);
    } else {
        addWords(answer);
    }
}

} // namespace

Completion completionOf(std::span<const std::string> words)
{
    Answer answer;
    answer.words = words;
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
            answer.subcommand = &*found;
            answerLine(answer);
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
