// SPDX-License-Identifier: Apache-2.0
// `gnomon man`: the manual page in roff's man macros, made from the tables that the command line is read by.
#include "app/command_line.h"
#include "app/preset.h"
#include "list_details.h"
#include "streams.h"
#include "subcommands.h"
#include "wrap_text.h"

#include "worlds/worlds.h"

#include <gnomon/choices.h>

#include <fmt/format.h>

#include <array>
#include <utility>

namespace gnomon::app {
namespace {

/// Text that roff shows as it is: a minus is one and no hyphen, so that lines can be copied into a shell.
std::string roff(std::string_view text)
{
    std::string escaped;
    for (const char c : text) {
        switch (c) {
        case '\\':
            escaped += "\\e";
            break;
        case '-':
            escaped += "\\-";
            break;
        case '\'':
            escaped += "\\(aq";
            break;
        case '`':
            escaped += "\\(ga";
            break;
        case '^':
            escaped += "\\(ha";
            break;
        case '~':
            escaped += "\\(ti";
            break;
        default:
            escaped += c;
        }
    }
    return escaped.starts_with(".") ? "\\&" + escaped : escaped;
}

std::string heading(std::string_view name)
{
    return fmt::format(".SH {}\n", name);
}

std::string entry(std::string_view tag, std::string_view text)
{
    return fmt::format(".TP\n.B {}\n{}\n", roff(tag), roff(text));
}

std::string paragraph(std::string_view text)
{
    return fmt::format(".PP\n{}\n", roff(text));
}

std::string factsOf(const Setting& setting)
{
    std::string text(setting.doc);
    const auto add = [&text](const std::string& sentence) {
        text += (text.ends_with('.') ? " " : ". ") + sentence;
    };
    if (setting.choices != nullptr) {
        add(fmt::format("One of {}", joined(setting.choices(), ", ")));
    }
    if (setting.min < setting.max) {
        add(fmt::format("{} to {}{}{}", setting.min, setting.max, setting.unit.empty() ? "" : " ", setting.unit));
    } else if (!setting.unit.empty()) {
        add(fmt::format("In {}", setting.unit));
    }
    if (!setting.default_text.empty()) {
        add(fmt::format("Default: {}", setting.default_text));
    }
    if (!setting.used_when.empty()) {
        add(fmt::format("Has an effect with {}", setting.used_when));
    }
    std::string names;
    for (const Subcommand& subcommand : subcommands()) {
        if ((setting.subcommands & subcommand.bit) != 0) {
            names += fmt::format("{}{}", names.empty() ? "" : ", ", subcommand.name);
        }
    }
    add(fmt::format("For {}.", names));
    return text;
}

std::string optionsText()
{
    std::string text = heading("OPTIONS");
    for (const Setting& setting : settingTable()) {
        if (setting.own_option) {
            const bool has_value = setting.type != SettingType::flag;
            text += entry(fmt::format("{}--{}{}{}", setting.key == "out" ? "-o, " : "", setting.key,
                                      has_value ? " " : "", has_value ? setting.form : std::string_view()),
                          factsOf(setting));
        }
    }
    text += entry("--set KEY=VALUE", "Any setting, of those below too. Given again and again.");
    text += entry("--preset NAME|FILE", "A JSON object of settings, built in or in a file. Options win over presets.");
    text += entry("-h, --help", "The options of a subcommand.");
    text += heading("SETTINGS") +
            paragraph("These have no option of their own. --set and presets take them; so do techniques, "
                      "except those of the picture.");
    for (const Setting& setting : settingTable()) {
        if (!setting.own_option) {
            text +=
                entry(fmt::format("{}={}", setting.key, setting.form.empty() ? "0|1" : setting.form), factsOf(setting));
        }
    }
    return text;
}

std::string subcommandsText()
{
    std::string text = heading("SUBCOMMANDS");
    for (const Subcommand& subcommand : subcommands()) {
        text += entry(fmt::format("{} {}", subcommand.name, subcommand.arguments), subcommand.summary);
    }
    return text;
}

std::string techniquesText()
{
    std::string text = heading("TECHNIQUES");
    text +=
        paragraph("A technique is a value each of six choices. In one word they are joined by + in any order, with "
                  "KEY=VALUE of settings: pcf+sdsm+lispsm+map-size=1024. What does not go together is refused with the "
                  "reason; gnomon list prints the rules, and gnomon list NAME all there is to a value.");
    std::string_view choice;
    for (const ChoiceValue& row : choiceValues()) {
        if (row.choice != choice) {
            choice = row.choice;
            text += fmt::format(".SS {}\n", roff(choice));
        }
        text += entry(row.name, row.summary);
    }
    return text;
}

std::string presetsAndWorlds()
{
    std::string text = heading("PRESETS");
    for (const Preset& preset : presets()) {
        text += entry(preset.name, preset.summary);
    }
    text += heading("WORLDS") + paragraph("Built-in scenes, in the place of a file:");
    for (const worlds::World& world : worlds::all()) {
        text += entry(world.name, world.summary);
    }
    return text;
}

std::string aroundText()
{
    std::string text = heading("EXIT STATUS");
    text += entry("0", "Success.");
    text += entry("1", "A failure, with one line on standard error. Also: counters of bench --against have grown.");
    text +=
        entry("2", "Wrong usage, with one line on standard error. Options that are known and change nothing are told "
                   "there too, but refused with --strict alone.");
    text += entry("129, 130, 143", "Ended by SIGHUP, SIGINT or SIGTERM. What was complete by then stays.");
    text += entry("141", "The reader of standard output, or of a pipe that is written to, has closed it.");
    text += heading("ENVIRONMENT");
    text += entry("XDG_CACHE_HOME", "Where the folder gnomon/truth is that keeps ray-traced truths, 4 GiB at most; "
                                    "without it ~/.cache. --no-cache leaves it alone.");
    text += entry("VK_ICD_FILENAMES, VK_DRIVER_FILES", "Read by the Vulkan loader: which drivers there are.");
    text += heading("FILES");
    text += entry("*.gltf, *.glb", "Scenes, of glTF 2.0.");
    text += entry("gnomon.png", "The picture of render without --out; gnomon_frames with --frames.");
    text += heading("EXAMPLES");
    constexpr std::array<std::pair<std::string_view, std::string_view>, 9> kExamples{{
        {"gnomon render rts --camera camp -o camp.png", "A picture of a built-in world."},
        {"gnomon render model.glb --technique pcf+sdsm+lispsm+map-size=1024", "A file, by a technique in one word."},
        {"gnomon render rts --truth area --mask --light sun -o truth.png", "What is true, ray traced."},
        {"gnomon compare rts --techniques hard,pcf,vsm --report report", "A page of pictures and a table of errors."},
        {"gnomon compare rts --techniques @mine.txt --json mine.json", "The techniques of a file, one a line."},
        {"gnomon bench rts --technique pcf+cascades", "What each pass of a frame takes."},
        {"gnomon gpus", "This machine's GPUs: what each can, and what is left out on it."},
        {"gnomon list msm", "A value's settings, rules and source."},
        {"source <(gnomon completion bash)", "Completion for this shell; zsh and fish have theirs too."},
    }};
    for (const auto& [command, what] : kExamples) {
        text += entry(command, what);
    }
    return text;
}

std::string manualPage()
{
    std::string text = ".\\\" Made by `gnomon man` from the program's own tables.\n";
    text += fmt::format(".TH GNOMON 1 \"\" \"gnomon {}\" \"User Commands\"\n", GNOMON_VERSION);
    text += heading("NAME") + roff("gnomon - real-time soft shadows: draw, measure, plan and time them") + "\n";
    text += heading("SYNOPSIS");
    text += ".B gnomon\n.I SUBCOMMAND\n.RI [ SCENE ]\n.RI [ options ]\n";
    text += heading("DESCRIPTION");
    text += "gnomon draws scenes with shadow maps of many kinds, holds them against ray-traced truth and says what "
            "they\ncost.\n";
    text +=
        paragraph("SCENE is a .gltf or .glb file or a built-in world by its name; without one it is rts. JSON goes to "
                  "the file that --json names or to standard output, and then nothing else goes there; notices and "
                  "progress go to standard error. After -- nothing is an option.");
    text += subcommandsText() + optionsText() + techniquesText() + presetsAndWorlds() + aroundText();
    text +=
        heading("SEE ALSO") +
        paragraph("docs/cli.md has the contract that scripts may rely on, docs/techniques a page for each technique.");
    return text;
}

} // namespace

int runMan(const Settings& /*settings*/)
{
    writeStdout(manualPage());
    return 0;
}

} // namespace gnomon::app
