// SPDX-License-Identifier: Apache-2.0
#include "app/command_line.h"

#include "app/preset.h"
#include "contestants.h"
#include "files/files.h"
#include "technique_text.h"
#include "topics.h"
#include "worlds/worlds.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <deque>

namespace gnomon::app {
namespace {

const Subcommand& findSubcommand(const std::string& name)
{
    std::vector<std::string_view> names;
    for (const Subcommand& subcommand : subcommands()) {
        names.push_back(subcommand.name);
        if (subcommand.name == name) {
            return subcommand;
        }
    }
    if (isListed(name)) {
        throw UsageError(fmt::format("{0} is no subcommand; `gnomon list {0}` tells about it", name));
    }
    throw UsageError(
        fmt::format("there is no subcommand \"{}\"{}; it is one of {}", name, suggestion(name, names), listed(names)));
}

[[noreturn]] void refuseOption(const Subcommand& subcommand, const std::string& argument)
{
    const std::string name = argument.substr(0, argument.find('='));
    std::vector<std::string> options{"--help"};
    if ((subcommand.bit & kFrames) != 0) {
        options.insert(options.end(), {"--set", "--preset"});
    } else if (name == "--set" || name == "--preset") {
        throw UsageError(fmt::format("{} is not an option of {}", name, subcommand.name));
    }
    for (const Setting& setting : settingTable()) {
        if (fmt::format("--{}", setting.key) == name) {
            throw UsageError(setting.own_option && (setting.subcommands & subcommand.bit) == 0
                                 ? fmt::format("{} is not an option of {}", name, subcommand.name)
                                 : fmt::format("{} is set by --set {}=VALUE", name, setting.key));
        }
        if (setting.own_option && (setting.subcommands & subcommand.bit) != 0) {
            options.push_back(spelled(setting));
        }
    }
    throw UsageError(fmt::format("there is no option {}{}; see `gnomon {} --help`", name,
                                 suggestion(name, {options.begin(), options.end()}), subcommand.name));
}

/// The command line's options in the order given, CLI11 doing the splitting.
struct Parsed {
    std::vector<std::string> words; // neither options nor their values: scene, images, names
    std::vector<std::string> typed; // completion: what is after "--"
    std::vector<std::string> sets;
    std::vector<std::string> presets;
    std::deque<std::pair<const Setting*, std::vector<std::string>>> options;
    bool help = false;
};

/// An option that may be given again and again and takes one value each time, so that a scene may follow it.
void addValues(CLI::App& cli, const std::string& name, std::vector<std::string>& values)
{
    cli.add_option(name, values)
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->allow_extra_args(false);
}

bool takesWords(const Subcommand& subcommand)
{
    return (subcommand.bit & (kFrames | kMetrics | kList | kCompletion)) != 0;
}

void addOptions(CLI::App& cli, const Subcommand& subcommand, Parsed& parsed)
{
    for (const Setting& setting : settingTable()) {
        if (!setting.own_option || (setting.subcommands & subcommand.bit) == 0 || setting.key == "json") {
            continue;
        }
        auto& values = parsed.options.emplace_back(&setting, std::vector<std::string>{}).second;
        const std::string name = setting.letter == 0 ? fmt::format("--{}", setting.key)
                                                     : fmt::format("--{},-{}", setting.key, setting.letter);
        if (setting.type == SettingType::flag) {
            cli.add_flag_callback(name, [&values] { values.emplace_back("1"); });
        } else {
            addValues(cli, name, values);
        }
    }
    if ((subcommand.bit & kFrames) != 0) {
        addValues(cli, "--set", parsed.sets);
        addValues(cli, "--preset", parsed.presets);
    }
    if (takesWords(subcommand)) {
        cli.add_option("words", parsed.words)->expected(-1);
    }
    cli.add_flag("-h,--help", parsed.help);
    cli.allow_extras();
}

/// A word after --json that is neither its file nor what the subcommand works on, nor another option.
bool isStrayFile(std::string_view word, const Subcommand& subcommand)
{
    if (subcommand.bit == kMetrics) {
        return !word.starts_with("-") && !hasExtension(word, ".png") && !hasExtension(word, ".exr");
    }
    if (subcommand.bit == kList) {
        return !word.starts_with("-") && !isListed(word);
    }
    if (subcommand.bit == kGpus || subcommand.bit == kCalibrate) {
        return false; // it takes no words, which is said of any
    }
    return !word.starts_with("-") && !hasExtension(word, ".gltf") && !hasExtension(word, ".glb") &&
           worlds::find(word) == nullptr;
}

bool isJsonFile(std::string_view word)
{
    return word == "-" || (hasExtension(word, ".json") && !word.starts_with("--"));
}

/// --json's FILE may be left out, which no parser can tell from a scene that follows: a value is "-" or ends in .json.
std::vector<std::string> takeJson(std::span<const std::string> arguments, const Subcommand& subcommand,
                                  std::optional<std::string>& json)
{
    std::vector<std::string> rest;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const std::string& argument = arguments[i];
        if ((findSetting("json")->subcommands & subcommand.bit) == 0 ||
            (argument != "--json" && !argument.starts_with("--json="))) {
            rest.push_back(argument);
            continue;
        }
        if (json) {
            throw UsageError("--json is given twice");
        }
        if (argument != "--json") {
            json = argument.substr(argument.find('=') + 1);
        } else if (i + 1 < arguments.size() && isJsonFile(arguments[i + 1])) {
            json = arguments[++i];
        } else if (i + 1 < arguments.size() && isStrayFile(arguments[i + 1], subcommand)) {
            throw UsageError(fmt::format("--json: \"{0}\" is no {1}, and a file for JSON must end in .json or be given "
                                         "as --json={0}",
                                         arguments[i + 1],
                                         subcommand.bit == kMetrics ? "image"
                                         : subcommand.bit == kList  ? "name that list has"
                                                                    : "scene"));
        } else {
            json = "-";
        }
    }
    return rest;
}

/// An option that may be given without its value, which no parser can tell from a scene that follows: the next word is
/// its value only if it is one of those that it takes.
std::vector<std::string> withBareValues(std::vector<std::string> arguments)
{
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const Setting* const setting =
            arguments[i].starts_with("--") ? findSetting(std::string_view(arguments[i]).substr(2)) : nullptr;
        if (setting == nullptr || setting->bare_text.empty()) {
            continue;
        }
        const auto values = setting->choices();
        const bool has_value = i + 1 < arguments.size() && std::ranges::find(values, arguments[i + 1]) != values.end();
        if (!has_value) {
            arguments[i] += fmt::format("={}", setting->bare_text);
        }
    }
    return arguments;
}

/// Takes the words after "--", which are no options whatever they look like.
void takeWords(std::span<const std::string> words, const Subcommand& subcommand, Parsed& parsed)
{
    if (subcommand.bit == kCompletion) {
        parsed.typed.assign(words.begin(), words.end());
    } else if (takesWords(subcommand)) {
        parsed.words.insert(parsed.words.end(), words.begin(), words.end());
    } else if (!words.empty()) {
        throw UsageError(fmt::format("{} takes no argument \"{}\"", subcommand.name, words.front()));
    }
}

void parseWithCli(const Subcommand& subcommand, std::vector<std::string> arguments, Parsed& parsed)
{
    CLI::App cli;
    cli.set_help_flag();
    addOptions(cli, subcommand, parsed);
    std::reverse(arguments.begin(), arguments.end()); // CLI11 takes them from the back
    try {
        cli.parse(arguments);
    } catch (const CLI::ArgumentMismatch& error) { // it begins with the option's name
        const std::string_view text = error.what();
        throw UsageError(
            fmt::format("{} needs a value; see `gnomon {} --help`", text.substr(0, text.find(':')), subcommand.name));
    } catch (const CLI::ParseError& error) {
        std::string line = error.what();
        std::replace(line.begin(), line.end(), '\n', ' ');
        throw UsageError(line);
    }
    for (const std::string& extra : cli.remaining()) {
        if (extra.starts_with("-") && extra.size() > 1) {
            refuseOption(subcommand, extra);
        }
        throw UsageError(fmt::format("{} takes no argument \"{}\"", subcommand.name, extra));
    }
}

Parsed parse(std::span<const std::string> arguments, const Subcommand& subcommand, std::optional<std::string>& json)
{
    const auto end = std::find(arguments.begin(), arguments.end(), "--");
    const auto count = static_cast<std::size_t>(end - arguments.begin());
    Parsed parsed;
    parseWithCli(subcommand, withBareValues(takeJson(arguments.first(count), subcommand, json)), parsed);
    if (end != arguments.end()) {
        takeWords(arguments.subspan(count + 1), subcommand, parsed);
    }
    return parsed;
}

void applyImages(Settings& settings, const std::vector<std::string>& images)
{
    if (images.size() != 2) {
        throw UsageError(fmt::format("metrics takes two images, the test and the truth; {} given",
                                     images.size() == 1 ? "one is" : fmt::format("{} are", images.size())));
    }
    settings.test_image = images[0];
    settings.truth_image = images[1];
}

/// The words that are no options. A scene of a preset gives way.
void applyWords(Settings& settings, const Parsed& parsed, const Subcommand& subcommand)
{
    if (subcommand.bit == kMetrics) {
        applyImages(settings, parsed.words);
        return;
    }
    const bool is_scene = (subcommand.bit & kFrames) != 0;
    if (subcommand.bit == kCompare && parsed.words.size() > 1) {
        settings.scenes = parsed.words;
    } else if (parsed.words.size() > 1) {
        throw UsageError(fmt::format("\"{}\" is one argument too many: the {} is \"{}\"", parsed.words[1],
                                     is_scene                        ? "scene"
                                     : subcommand.bit == kCompletion ? "shell"
                                                                     : "name",
                                     parsed.words[0]));
    }
    if (!parsed.words.empty()) {
        (is_scene ? settings.scene : settings.topic) = parsed.words.front();
    }
    settings.typed = parsed.typed;
}

/// --technique: given parts are as good as options of their own, but that they are told as parts.
void noteParts(Settings& settings, std::string_view text)
{
    if (settings.given.contains("technique")) {
        throw UsageError("--technique is given twice");
    }
    settings.technique = text;
    for (const TechniquePart& part : techniqueParts(text)) {
        settings.given.emplace(part.key, false);
    }
}

void applyGiven(Settings& settings, const Setting& setting, std::string_view text, const Subcommand& subcommand)
{
    if ((setting.subcommands & subcommand.bit) == 0) {
        throw UsageError(fmt::format("{} is not a setting of {}", setting.key, subcommand.name));
    }
    // A preset's camera gives way. validateSettings() refuses two ways that the command line itself gave.
    const bool both_ways = setting.key == "camera" ? settings.given.contains("eye") || settings.given.contains("target")
                                                   : settings.given.contains("camera");
    if (!both_ways) {
        replaceCamera(settings, setting.key);
    }
    if ((setting.key == "techniques" || setting.key == "technique") && !settings.given.contains("techniques")) {
        forgetTechniques(settings);
    }
    for (const std::string_view other : placementPartners(setting.key)) {
        if (settings.given.contains(other)) {
            requireOnePlacement(settings, setting.key, text, other);
        }
    }
    if (setting.key == "techniques" && text.starts_with('@')) {
        applyTechniqueFile(settings, text.substr(1));
    } else {
        applySetting(settings, setting, text);
    }
    if (setting.key == "technique") {
        noteParts(settings, text);
    }
    settings.given[std::string(setting.key)] = true;
    settings.named.emplace(setting.key);
}

void applyAll(Settings& settings, const Parsed& parsed, const Subcommand& subcommand)
{
    for (const std::string& preset : parsed.presets) {
        applyPreset(settings, preset, subcommand.bit);
    }
    applyWords(settings, parsed, subcommand);
    for (const auto& [setting, values] : parsed.options) {
        // With two files the first would silently stay empty.
        if (values.size() > 1 && setting->group == SettingGroup::result && !setting->repeatable &&
            setting->type == SettingType::text) {
            throw UsageError(fmt::format("{} is given twice", spelled(*setting)));
        }
        for (const std::string& value : values) {
            applyGiven(settings, *setting, value, subcommand);
        }
    }
    for (const std::string& text : parsed.sets) {
        const std::size_t equals = text.find('=');
        if (equals == std::string::npos) {
            throw UsageError(fmt::format("--set: \"{}\" is not KEY=VALUE", text));
        }
        const std::string key = text.substr(0, equals);
        if (findSetting(key) == nullptr) {
            refuseKey(key);
        }
        applyGiven(settings, *findSetting(key), std::string_view(text).substr(equals + 1), subcommand);
    }
}

void requireNoMore(std::span<const std::string> arguments, std::size_t most)
{
    if (arguments.size() > most) {
        throw UsageError(fmt::format("{}: \"{}\" is one argument too many", arguments[0], arguments[most]));
    }
}

} // namespace

Command parseCommandLine(std::span<const std::string> arguments)
{
    Command command;
    if (arguments.empty() || arguments[0] == "--help" || arguments[0] == "-h" || arguments[0] == "help") {
        command.kind = Command::Kind::help;
        const bool of_subcommand = !arguments.empty() && arguments[0] == "help";
        requireNoMore(arguments, of_subcommand ? 2 : 1);
        if (arguments.size() > 1) {
            command.subcommand = &findSubcommand(arguments[1]);
        }
        return command;
    }
    if (arguments[0] == "--version") {
        command.kind = Command::Kind::version;
        requireNoMore(arguments, 1);
        return command;
    }
    if (arguments[0].starts_with("-")) {
        throw UsageError(fmt::format("{}: a subcommand comes first; see `gnomon --help`", arguments[0]));
    }
    command.subcommand = &findSubcommand(arguments[0]);
    std::optional<std::string> json;
    const Parsed parsed = parse(arguments.subspan(1), *command.subcommand, json);
    if (parsed.help) {
        command.kind = Command::Kind::help;
        return command;
    }
    command.settings = defaultSettings();
    command.settings.subcommand = command.subcommand->bit;
    if (command.subcommand->bit == kCompare) {
        applySetting(command.settings, "truth", "area");
    }
    applyAll(command.settings, parsed, *command.subcommand);
    if (json) {
        applyGiven(command.settings, *findSetting("json"), *json, *command.subcommand);
    }
    if ((command.subcommand->bit & kFrames) != 0 && !hasManyTechniques(command.settings)) {
        completeTechnique(command.settings);
    }
    if (!command.settings.technique.empty()) {
        requireTechnique(command.settings, command.settings.technique);
    }
    validateSettings(command.settings);
    command.notices = optionsWithoutEffect(command.settings);
    return command;
}

} // namespace gnomon::app
