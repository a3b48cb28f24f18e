// SPDX-License-Identifier: Apache-2.0
// Options that are known, were given, and change nothing beside the others. They harm nothing, so they are told and the
// run goes on; --strict refuses them. Contradictions are validateSettings()'s to refuse.
#include "app/settings.h"

#include "contestants.h"
#include "technique_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace gnomon::app {
namespace {

/// Each of --path's frames is drawn once, and a sweep measures no time.
std::optional<std::string> whyNotTimed(const Settings& settings)
{
    if (settings.subcommand != kCompare && settings.subcommand != kBench) {
        return std::nullopt;
    }
    if (!settings.path.empty()) {
        return "with --path, which draws each frame once";
    }
    if (settings.sweep) {
        return "with --sweep, which measures no time";
    }
    return std::nullopt;
}

/// Why a setting has no effect in any of `techniques`; nothing where it has one.
std::optional<std::string> whyNot(const Setting& setting, const Settings& settings,
                                  const std::vector<Settings>& techniques)
{
    if (settings.subcommand == kRender && settings.truth && setting.group == SettingGroup::technique) {
        return "has no effect with --truth, which draws no shadow map";
    }
    if (setting.key == "repetitions" || setting.key == "warmup") {
        if (const auto why = whyNotTimed(settings)) {
            return fmt::format("has no effect {}", *why);
        }
    }
    if (setting.key == "aa" && settings.mask && settings.anti_aliasing == host::AntiAliasing::fxaa) {
        return "fxaa has an effect only on a picture, not with --mask";
    }
    const bool used =
        std::ranges::any_of(techniques, [&setting](const Settings& technique) { return isUsed(setting, technique); });
    return used ? std::nullopt : std::optional(fmt::format("has an effect only with {}", setting.used_when));
}

/// Tells of parts without effect in --technique and in the techniques of a list. `render --truth` draws no map, so it
/// has no parts to check.
void tellParts(const Settings& settings, const std::vector<Settings>& techniques, std::vector<std::string>& told)
{
    const auto tell = [&](const Settings& technique, std::string_view text) {
        for (std::string& sentence : partsWithoutEffect(technique, text)) {
            tellNoEffect(settings, told, std::move(sentence));
        }
    };
    if (!settings.technique.empty() && !(settings.subcommand == kRender && settings.truth)) {
        tell(settings, settings.technique);
    }
    if (hasManyTechniques(settings)) {
        const std::vector<std::string> texts = techniqueList(settings);
        for (std::size_t i = 0; i < texts.size(); ++i) {
            tell(techniques[i], texts[i]);
        }
    }
}

} // namespace

void tellNoEffect(const Settings& settings, std::vector<std::string>& told, std::string sentence)
{
    if (settings.strict) {
        throw UsageError(sentence);
    }
    if (std::find(told.begin(), told.end(), sentence) == told.end()) {
        told.push_back(std::move(sentence));
    }
}

std::vector<std::string> optionsWithoutEffect(const Settings& settings)
{
    const std::vector<Settings> techniques =
        hasManyTechniques(settings) ? contestants(settings) : std::vector{settings};
    std::vector<std::string> told;
    for (const Setting& setting : settingTable()) {
        const auto given = settings.given.find(setting.key);
        if (given == settings.given.end() || !given->second) {
            continue;
        }
        if (const auto why = whyNot(setting, settings, techniques)) {
            tellNoEffect(settings, told, fmt::format("{} {}", spelled(setting), *why));
        }
    }
    tellParts(settings, techniques, told);
    return told;
}

} // namespace gnomon::app
