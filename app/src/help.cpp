// SPDX-License-Identifier: Apache-2.0
// Help, made from the setting table. A screen is 40 lines of 100 columns; a test holds it to that.
#include "app/command_line.h"

#include "worlds/worlds.h"

#include <fmt/format.h>

#include <algorithm>

namespace gnomon::app {
namespace {

constexpr std::size_t kColumn = 30;

std::string line(const std::string& left, const std::string& right)
{
    return fmt::format("  {:<{}}{}{}\n", left, kColumn, left.size() < kColumn ? "" : "  ", right);
}

std::string programHelp()
{
    std::string text = "Usage: gnomon SUBCOMMAND [SCENE] [options]\n"
                       "Real-time soft shadows: draw them, measure them, plan them, time them.\n\nSubcommands:\n";
    for (const Subcommand& subcommand : subcommands()) {
        text += line(std::string(subcommand.name), std::string(subcommand.summary));
    }
    std::vector<std::string_view> worlds(worlds::all().size());
    std::ranges::transform(worlds::all(), worlds.begin(), &worlds::World::name);
    text += fmt::format("\nSCENE is a .gltf or .glb file or a built-in world:\n{}; without one it is rts.\n",
                        listed(worlds));
    return text + "\n`gnomon SUBCOMMAND --help` shows its options, `gnomon list` the choices of a technique and more,\n"
                  "`gnomon --version` the version. Exit status: 0 success, 1 failure, 2 wrong usage.\n";
}

/// Two options that go together share a line.
struct Pair {
    std::string_view first;
    std::string_view second;
    std::string_view left;
    std::string_view right; // with both defaults
};
constexpr Pair kPairs[] = {
    {"eye", "target", "--eye x,y,z --target x,y,z", "where the camera is, and what it looks at"},
    {"fov", "ortho", "--fov DEG --ortho HEIGHT", "vertical angle of view, or metres of an orthographic one"},
    {"technique", "techniques", "--technique T --techniques LIST",
     "one: pcf+sdsm+map-size=1024; or several: hard,pcf; all; @FILE"},
    {"validate", "strict", "--validate --strict",
     "a message of Vulkan's validation, or an option without effect, fails"},
    {"frames", "fps", "--frames A-B --fps N", "frames A to B, N a second ({1}); frame F is at --time plus F / N"},
    {"repetitions", "warmup", "--repetitions N --warmup N",
     "timed frames of each technique ({0}), those before them ({1})"},
    {"ground", "up-axis", "--ground WHEN --up-axis AXIS",
     "a ground (auto: under files without one); what is up in a file ({1})"},
    {"blended", "override-material", "--blended AS --override-material NAME",
     "blended: coverage or stained; one material: none or diffuse"},
    {"map-size", "texels", "--map-size N --texels N", "side of a map ({0}); texels of a light's maps together ({1})"},
    {"sun-angle", "light-size", "--sun-angle DEG --light-size M",
     "across: of suns, of lamps; else their own, or 0.53 and 0"},
    {"truth", "samples", "--truth KIND --samples N", "hard: a ray to the light's centre; area: N over all of it ({1})"},
};

std::string optionLine(const Setting& setting, const Subcommand& subcommand)
{
    for (const Pair& pair : kPairs) {
        if ((findSetting(pair.first)->subcommands & findSetting(pair.second)->subcommands & subcommand.bit) == 0) {
            continue;
        }
        if (setting.key == pair.first) {
            return line(std::string(pair.left), fmt::format(fmt::runtime(pair.right), setting.default_text,
                                                            findSetting(pair.second)->default_text));
        }
        if (setting.key == pair.second) {
            return {};
        }
    }
    std::string right(setting.doc);
    if (setting.type != SettingType::flag && !setting.default_text.empty()) {
        right += fmt::format(" ({})", setting.default_text);
    }
    return line(optionText(setting), right);
}

} // namespace

std::string optionText(const Setting& setting)
{
    const std::string letter = setting.letter == 0 ? "" : fmt::format("-{}, ", setting.letter);
    const std::string form = setting.type == SettingType::flag ? "" : fmt::format(" {}", setting.form);
    return fmt::format("{}--{}{}", letter, setting.key, form);
}

std::vector<std::string_view> subcommandsOf(const Setting& setting)
{
    std::vector<std::string_view> names;
    for (const Subcommand& subcommand : subcommands()) {
        if ((setting.subcommands & subcommand.bit) != 0) {
            names.push_back(subcommand.name);
        }
    }
    return names;
}

std::string helpText(const Subcommand* subcommand)
{
    if (subcommand == nullptr) {
        return programHelp();
    }
    std::string text =
        fmt::format("Usage: gnomon {} {}\n{}\n", subcommand->name, subcommand->arguments, subcommand->summary);
    std::string choices;
    for (const Setting& setting : settingTable()) {
        if (!setting.own_option || (setting.subcommands & subcommand->bit) == 0) {
            continue;
        }
        // The choices share a line: their values fill `gnomon list`.
        if (setting.group == SettingGroup::technique && (isChoice(setting.key) || setting.key == "quality")) {
            choices += (choices.empty() ? "" : " ") + fmt::format("--{}", setting.key);
            continue;
        }
        if (!choices.empty() && setting.group == SettingGroup::technique) {
            text += line(choices, "one value each");
            choices.clear();
        }
        text += optionLine(setting, *subcommand);
    }
    if ((subcommand->bit & kFrames) != 0) {
        text += line("--set KEY=VALUE", "any other setting; `gnomon list settings` shows them");
        text += line("--preset NAME|FILE", "a JSON file of settings, or a built-in one");
    }
    return text + line("-h, --help", "this text; defaults are in brackets");
}

} // namespace gnomon::app
