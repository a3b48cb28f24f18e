// SPDX-License-Identifier: Apache-2.0
// `gnomon man`: the manual page in roff's man macros, made from the tables that the command line is read by.
#include "app/command_line.h"
#include "setting_values.h"
#include "streams.h"
#include "subcommands.h"
#include "topics.h"
#include "wrap_text.h"

#include <fmt/format.h>

#include <span>
#include <utility>

namespace gnomon::app {
namespace {

/// Text that roff shows as it is: a minus is one and no hyphen, so that lines can be copied into a shell.
std::string roff(std::string_view text)
{
    constexpr std::string_view kSpecial = "\\-'`^~";
    constexpr std::string_view kEscapes[] = {"\\e", "\\-", "\\(aq", "\\(ga", "\\(ha", "\\(ti"};
    std::string escaped(text.starts_with(".") ? "\\&" : "");
    for (const char c : text) {
        const std::size_t i = kSpecial.find(c);
        escaped += i == std::string_view::npos ? std::string(1, c) : kEscapes[i];
    }
    return escaped;
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

std::string factsText(const Setting& setting)
{
    std::string text(setting.doc);
    const auto add = [&text](bool is_there, const std::string& sentence) {
        text += !is_there ? "" : (text.ends_with('.') ? " " : ". ") + sentence;
    };
    const bool has_range = setting.min < setting.max;
    add(setting.choices != nullptr, setting.choices == nullptr ? "" : "One of " + joined(setting.choices(), ", "));
    add(has_range, rangeText(setting));
    add(!has_range && !setting.unit.empty(), fmt::format("In {}", setting.unit));
    add(!setting.default_text.empty(), fmt::format("Default: {}", setting.default_text));
    add(!setting.used_when.empty(), fmt::format("Has an effect with {}", setting.used_when));
    add(true, fmt::format("For {}.", joined(subcommandsOf(setting), ", ")));
    return text;
}

std::string optionsText()
{
    std::string options;
    std::string settings;
    for (const Setting& setting : settingTable()) {
        if (setting.own_option) {
            options += entry(optionText(setting), factsText(setting));
        } else {
            settings += entry(fmt::format("{}={}", setting.key, setting.form.empty() ? "0|1" : setting.form),
                              factsText(setting));
        }
    }
    return heading("OPTIONS") + options +
           entry("--set KEY=VALUE", "Any setting, of those below too. Given again and again.") +
           entry("--preset NAME|FILE", "A JSON object of settings, built in or in a file. Options win over presets.") +
           entry("-h, --help", "The options of a subcommand.") + heading("SETTINGS") +
           paragraph("These have no option of their own. --set and presets take them; so do techniques, except those "
                     "of the picture.") +
           settings;
}

/// A section's topics, choices as headings.
std::string topicsText(std::string_view section)
{
    std::string text;
    for (const Topic& topic : topics()) {
        if (topic.section == section) {
            text += topic.name == topic.choice ? fmt::format(".SS {}\n", roff(topic.name))
                                               : entry(topic.name, topic.summary);
        }
    }
    return text;
}

using Entries = std::span<const std::pair<std::string_view, std::string_view>>;

std::string entriesText(std::string_view name, Entries entries)
{
    std::string text = heading(name);
    for (const auto& [tag, what] : entries) {
        text += entry(tag, what);
    }
    return text;
}

constexpr Entries::value_type kStatus[] = {
    {"0", "Success."},
    {"1", "A failure, with one line on standard error. Also: counters of bench --against have grown."},
    {"2", "Wrong usage, with one line on standard error. Options that are known and change nothing are told there too, "
          "but refused with --strict alone."},
    {"129, 130, 143", "Ended by SIGHUP, SIGINT or SIGTERM. What was complete by then stays."},
    {"141", "The reader of standard output, or of a pipe that is written to, has closed it."},
};
constexpr Entries::value_type kEnvironment[] = {
    {"XDG_CACHE_HOME", "Where the folder gnomon/truth is that keeps ray-traced truths, 4 GiB at most; without it "
                       "~/.cache. --no-cache leaves it alone."},
    {"VK_ICD_FILENAMES, VK_DRIVER_FILES", "Read by the Vulkan loader: which drivers there are."},
};
constexpr Entries::value_type kFiles[] = {
    {"*.gltf, *.glb", "Scenes, of glTF 2.0."},
    {"gnomon.png", "The picture of render without --out; gnomon_frames with --frames."},
};
constexpr Entries::value_type kExamples[] = {
    {"gnomon render rts --camera camp -o camp.png", "A picture of a built-in world."},
    {"gnomon render model.glb --technique pcf+sdsm+lispsm+map-size=1024", "A file, by a technique in one word."},
    {"gnomon render rts --truth area --mask --light sun -o truth.png", "What is true, ray traced."},
    {"gnomon compare rts --techniques hard,pcf,vsm --report report", "A page of pictures and a table of errors."},
    {"gnomon compare rts --techniques @mine.txt --json mine.json", "The techniques of a file, one a line."},
    {"gnomon bench rts --technique pcf+cascades", "What each pass of a frame takes."},
    {"gnomon gpus", "This machine's GPUs: what each can, and what is left out on it."},
    {"gnomon list msm", "A value's settings, rules and source."},
    {"source <(gnomon completion bash)", "Completion for this shell; zsh and fish have theirs too."},
};

std::string manualPage()
{
    std::string text = fmt::format(".\\\" Made by `gnomon man` from the program's own tables.\n"
                                   ".TH GNOMON 1 \"\" \"gnomon {}\" \"User Commands\"\n",
                                   GNOMON_VERSION);
    text += heading("NAME") + roff("gnomon - real-time soft shadows: draw, measure, plan and time them") + "\n" +
            heading("SYNOPSIS") + ".B gnomon\n.I SUBCOMMAND\n.RI [ SCENE ]\n.RI [ options ]\n" +
            heading("DESCRIPTION") +
            "gnomon draws scenes with shadow maps of many kinds, holds them against ray-traced truth and says what "
            "they\ncost.\n" +
            paragraph("SCENE is a .gltf or .glb file or a built-in world by its name; without one it is rts. JSON goes "
                      "to the file that --json names or to standard output, and then nothing else goes there; notices "
                      "and progress go to standard error. After -- nothing is an option.") +
            heading("SUBCOMMANDS");
    for (const Subcommand& subcommand : subcommands()) {
        text += entry(fmt::format("{} {}", subcommand.name, subcommand.arguments), subcommand.summary);
    }
    return text + optionsText() + heading("TECHNIQUES") +
           paragraph("A technique is a value each of six choices. In one word they are joined by + in any order, with "
                     "KEY=VALUE of settings: pcf+sdsm+lispsm+map-size=1024. What does not go together is refused with "
                     "the reason; gnomon list prints the rules, and gnomon list NAME all there is to a value.") +
           topicsText("choices") + heading("PRESETS") + topicsText("presets") + heading("WORLDS") +
           paragraph("Built-in scenes, in the place of a file:") + topicsText("worlds") +
           entriesText("EXIT STATUS", kStatus) + entriesText("ENVIRONMENT", kEnvironment) +
           entriesText("FILES", kFiles) + entriesText("EXAMPLES", kExamples) + heading("SEE ALSO") +
           paragraph("docs/cli.md has the contract that scripts may rely on, docs/techniques a page for each "
                     "technique.");
}

} // namespace

int runMan(const Settings& /*settings*/)
{
    writeStdout(manualPage());
    return 0;
}

} // namespace gnomon::app
