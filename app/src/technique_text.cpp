// SPDX-License-Identifier: Apache-2.0
// A technique in one word, "hard+map-size=1024": how it is read and how it is written down.
#include "technique_text.h"

#include "setting_values.h"

#include <gnomon/choices.h>

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::app {
namespace {

constexpr std::string_view kAuto = "auto";
constexpr std::string_view kSmoothies = "smoothies"; // a filter, and a way to soften others

const ChoiceValue* findTechniqueValue(std::string_view name)
{
    for (const ChoiceValue& row : choiceValues()) {
        if (row.choice != "light" && row.name == name) { // smoothies means the filter
            return &row;
        }
    }
    return nullptr;
}

/// The pieces that + joins in a technique. `auto` alone stands for the value of partition and fit, and of the filter
/// where no other one is named. `smoothies` stands for the filter where neither another one nor `auto` is named, else
/// for soften's value.
std::vector<std::string_view> piecesOf(std::string_view text)
{
    const std::vector<std::string_view> written = split(text, '+');
    const bool names_filter = std::any_of(written.begin(), written.end(), [](std::string_view piece) {
        const bool is_one_of_two = piece == kAuto || piece == kSmoothies;
        const ChoiceValue* const row = is_one_of_two ? nullptr : findTechniqueValue(piece);
        return piece.starts_with("filter=") || (row != nullptr && row->choice == "filter");
    });
    const bool softens = names_filter || std::ranges::find(written, kAuto) != written.end();
    std::vector<std::string_view> pieces;
    for (const std::string_view piece : written) {
        if (piece != kAuto) {
            pieces.push_back(piece != kSmoothies ? piece : softens ? "soften=smoothies" : "filter=smoothies");
            continue;
        }
        pieces.insert(pieces.end(), {"partition=auto", "fit=auto"});
        if (!names_filter) {
            pieces.push_back("filter=auto");
        }
    }
    return pieces;
}

/// One piece as a setting and its value.
TechniquePart partOf(std::string_view text, std::string_view piece)
{
    if (const std::size_t equals = piece.find('='); equals != std::string_view::npos) {
        const std::string_view key = piece.substr(0, equals);
        const Setting* setting = findSetting(key);
        if (setting == nullptr) {
            refuseKey(key);
        }
        if (setting->group != SettingGroup::technique || key == "technique") {
            throw UsageError(fmt::format("technique \"{}\": {} is no part of a technique; give it as {}", text, key,
                                         spelled(*setting)));
        }
        return {key, piece.substr(equals + 1)};
    }
    if (const ChoiceValue* row = findTechniqueValue(piece)) {
        return {row->choice, row->name};
    }
    std::vector<std::string_view> names;
    for (const ChoiceValue& known : choiceValues()) {
        if (known.choice != "light") {
            names.push_back(known.name);
        }
    }
    throw UsageError(fmt::format("technique \"{}\": there is no \"{}\"{}; a technique is values of the choices and "
                                 "KEY=VALUE joined by +, see `gnomon list`",
                                 text, piece, suggestion(piece, names)));
}

/// The border that nobody asked for.
double usualBorder(ShadowOptions options)
{
    options.border_texels.reset();
    const Resolution resolution = resolve(options);
    return resolution ? resolution->border_texels() : 0.0;
}

/// Whether a setting says what would hold without it, or what another one says already.
bool goesWithoutSaying(const Settings& settings, const Setting& setting, const std::string& value)
{
    static const Settings defaults = [] {
        Settings made = defaultSettings();
        completeTechnique(made);
        return made;
    }();
    // "pcf" alone says too little in a table of results.
    if (setting.key == "pcf.kernel" && filterOf(settings.shadow) == Filter::pcf) {
        return false;
    }
    if (setting.key == "map-format") {
        return formatOf(settings.shadow) == filterTraits(filterOf(settings.shadow))->formats.front();
    }
    if (setting.key == "border") {
        return !settings.shadow.border_texels || *settings.shadow.border_texels == usualBorder(settings.shadow);
    }
    if (setting.key == "bias" && value == "none") { // then its parts say it
        const auto part = settings.values.lower_bound("bias.");
        return part != settings.values.end() && part->first.starts_with("bias.");
    }
    if (setting.key == "lvsm.placement" &&
        (settings.values.contains("lvsm.splits") || settings.values.contains("lvsm.world"))) {
        return true;
    }
    const auto usual = defaults.values.find(setting.key);
    return usual != defaults.values.end() && usual->second == value;
}

} // namespace

std::vector<TechniquePart> techniqueParts(std::string_view text)
{
    std::vector<TechniquePart> parts;
    if (text.find(',') != std::string_view::npos && text.find("bias=") == std::string_view::npos) {
        throw UsageError(fmt::format("technique \"{}\": it is one, without commas; --techniques takes several", text));
    }
    for (const std::string_view piece : piecesOf(text)) {
        const TechniquePart part = partOf(text, piece);
        for (const TechniquePart& other : parts) {
            if (other.key == part.key) {
                throw UsageError(fmt::format("technique \"{}\" gives {} twice", text, part.key));
            }
        }
        parts.push_back(part);
    }
    return parts;
}

void applyTechnique(Settings& settings, std::string_view text)
{
    std::vector<std::string_view> seen;
    for (const auto& [key, value] : techniqueParts(text)) {
        for (const std::string_view other : placementPartners(key)) {
            if (std::find(seen.begin(), seen.end(), other) != seen.end()) {
                requireOnePlacement(settings, key, value, other);
            }
        }
        seen.push_back(key);
        applySetting(settings, key, value);
    }
}

void requireTechnique(const Settings& settings, std::string_view text)
{
    Settings alone = defaultSettings();
    applyTechnique(alone, text);
    const auto differs = [&](std::string_view key) {
        const auto wanted = alone.values.find(key);
        const auto found = settings.values.find(key);
        return wanted != alone.values.end() && (found == settings.values.end() || found->second != wanted->second);
    };
    for (const auto& [key, value] : techniqueParts(text)) {
        const bool has_parts = key == "bias";
        const bool contradicted = differs(key) || (has_parts && std::ranges::any_of(alone.values, [&](const auto& row) {
                                                       return row.first.starts_with("bias.") && differs(row.first);
                                                   }));
        if (contradicted) {
            throw UsageError(fmt::format("technique \"{}\" says {}={}, and another option says otherwise; give one",
                                         text, key, value));
        }
    }
}

std::vector<std::string> partsWithoutEffect(const Settings& technique, std::string_view text)
{
    std::vector<std::string> sentences;
    for (const auto& [key, value] : techniqueParts(text)) {
        const Setting& setting = *findSetting(key);
        if (!isUsed(setting, technique)) {
            sentences.push_back(
                fmt::format("technique \"{}\": {} has an effect only with {}", text, key, setting.used_when));
        }
    }
    return sentences;
}

Settings parseTechnique(const Settings& base, std::string_view text)
{
    Settings settings = base;
    applyTechnique(settings, text);
    completeTechnique(settings);
    return settings;
}

std::string describeTechnique(const Settings& settings)
{
    std::string text(nameOf(filterOf(settings.shadow)));
    for (const Setting& setting : settingTable()) {
        const auto value = settings.values.find(setting.key);
        if (setting.group != SettingGroup::technique || setting.key == "filter" || value == settings.values.end() ||
            !isUsed(setting, settings) || goesWithoutSaying(settings, setting, value->second)) {
            continue;
        }
        text += isChoice(setting.key) && value->second != kAuto ? fmt::format("+{}", value->second)
                                                                : fmt::format("+{}={}", setting.key, value->second);
    }
    return text;
}

} // namespace gnomon::app
