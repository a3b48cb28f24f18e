// SPDX-License-Identifier: Apache-2.0
// Settings of a technique: the rows of the library's option table (gnomon/option_table.h) as settings of the program.
// The library has their keys, ranges, units and defaults; this file has only what the program adds.
#include "setting_rows.h"
#include "setting_values.h"
#include "technique_text.h"

#include <gnomon/choices.h>
#include <gnomon/option_table.h>

#include <fmt/format.h>

#include <algorithm>

namespace gnomon::app {
namespace {

SettingType typeOf(OptionType type)
{
    switch (type) {
    case OptionType::flag:
        return SettingType::flag;
    case OptionType::integer:
        return SettingType::integer;
    case OptionType::real:
        return SettingType::real;
    case OptionType::choice:
        return SettingType::choice;
    case OptionType::numbers:
        return SettingType::numbers;
    }
    return SettingType::text;
}

Setting settingOf(const OptionRow& row, std::string_view default_text)
{
    Setting setting;
    setting.key = row.key;
    setting.group = SettingGroup::technique;
    setting.type = typeOf(row.type);
    setting.form = row.form;
    setting.unit = row.unit;
    setting.default_text = default_text;
    setting.min = row.min;
    setting.max = row.max;
    setting.count = row.count;
    if (row.type == OptionType::numbers) {
        setting.between = '/'; // lists of distances or depths, as 10/40
    }
    setting.choices = row.choices;
    setting.none_text = row.none_text;
    setting.doc = row.doc;
    setting.own_option = row.own_option;
    setting.used_when = row.used_when;
    setting.option = &row;
    return setting;
}

/// Reads PART=VALUE of --bias; `seen` has the parts before it.
void applyBiasPart(Settings& s, std::string_view whole, std::string_view part, std::vector<std::string_view>& seen)
{
    const std::size_t equals = part.find('=');
    const Setting* setting =
        equals == std::string_view::npos ? nullptr : findSetting(fmt::format("bias.{}", part.substr(0, equals)));
    if (setting == nullptr) {
        throw UsageError(
            fmt::format("--bias: \"{}\" is not auto, none or constant=M,slope=S,normal=T,receiver-plane=0|1", whole));
    }
    if (std::find(seen.begin(), seen.end(), setting->key) != seen.end()) {
        throw UsageError(fmt::format("--bias: \"{}\" gives {} twice", whole, part.substr(0, equals)));
    }
    seen.push_back(setting->key);
    applyValue(s, *setting, parseValue(*setting, part.substr(equals + 1)));
}

/// auto | none | constant=M,slope=S,normal=T,receiver-plane=0|1, whose parts are settings of their own.
void applyBias(Settings& s, const SettingValue& v)
{
    s.shadow.bias = BiasOptions{};
    if (v.text == "auto") {
        return;
    }
    s.shadow.bias.automatic = false;
    if (v.text == "none") {
        return;
    }
    std::vector<std::string_view> seen;
    for (const std::string_view part : split(v.text, ',')) {
        applyBiasPart(s, v.text, part, seen);
    }
}

Setting biasSetting()
{
    Setting setting;
    setting.key = "bias";
    setting.group = SettingGroup::technique;
    setting.form = "BIAS";
    setting.default_text = "auto";
    setting.doc = "auto, none or constant=M,slope=S,normal=T,receiver-plane=0|1";
    setting.used = [](const Settings& s) {
        return findOption("bias.constant")->used(s.shadow); // a rule for one of its parts holds for all
    };
    setting.used_when = findOption("bias.constant")->used_when;
    setting.offers = [] {
        return std::vector<Offer>{{"auto", ""}, {"none", ""}};
    };
    setting.apply = applyBias;
    return setting;
}

/// Several settings in one word, as `compare` prints them.
Setting techniqueSetting()
{
    Setting setting;
    setting.key = "technique";
    setting.group = SettingGroup::technique;
    setting.form = "TECHNIQUE";
    setting.doc = "values of the choices and KEY=VALUE: pcf+sdsm+map-size=1024";
    setting.apply = [](Settings& s, const SettingValue& v) {
        applyTechnique(s, v.text);
        for (const TechniquePart& part : techniqueParts(v.text)) {
            s.named.emplace(part.key);
        }
        s.named.emplace("technique");
    };
    return setting;
}

} // namespace

void addTechniqueRows(std::vector<Setting>& table)
{
    static const std::vector<std::string> defaults = [] {
        std::vector<std::string> texts;
        for (const OptionRow& row : optionTable()) {
            texts.push_back(textOf(row, row.get(ShadowOptions{})));
        }
        return texts;
    }();
    table.push_back(techniqueSetting());
    for (std::size_t i = 0; i < optionTable().size(); ++i) {
        const OptionRow& row = optionTable()[i];
        if (row.key == "bias.constant") { // the first of its parts
            table.push_back(biasSetting());
        }
        table.push_back(settingOf(row, defaults[i]));
    }
}

} // namespace gnomon::app
