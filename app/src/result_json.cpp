// SPDX-License-Identifier: Apache-2.0
#include "result_json.h"

#include "app/command_line.h"
#include "setting_values.h"
#include "streams.h"
#include "subcommands.h"

#include "files/files.h"

namespace gnomon::app {
namespace {

Json typed(const Setting& setting, const std::string& text)
{
    if (!setting.none_text.empty() && text == setting.none_text) {
        return text;
    }
    switch (setting.type) {
    case SettingType::flag:
        return text == "1" || text == "true" || text == "on" || text == "yes";
    case SettingType::integer:
        return toInteger(text).value_or(0);
    case SettingType::real:
        return toNumber(text).value_or(0.0);
    case SettingType::numbers: {
        Json numbers = Json::array();
        for (const std::string_view piece : split(text, setting.between)) {
            numbers.push_back(toNumber(piece).value_or(0.0));
        }
        return numbers;
    }
    case SettingType::choice:
    case SettingType::size:
    case SettingType::range:
    case SettingType::text:
        break;
    }
    return text;
}

std::string_view nameOf(SettingType type)
{
    constexpr std::string_view kNames[] = {"flag", "integer", "real", "choice", "numbers", "size", "range", "text"};
    return kNames[static_cast<std::size_t>(type)];
}

} // namespace

Json settingsJson(const Settings& settings, std::uint32_t subcommand)
{
    Json json;
    for (const Setting& setting : settingTable()) {
        const auto value = settings.values.find(setting.key);
        if (value != settings.values.end() && (setting.subcommands & subcommand) != 0 && !setting.command_line_only) {
            const bool is_list = setting.repeatable && setting.separator == " ";
            json[std::string(setting.key)] = is_list ? Json(split(value->second, ' ')) : typed(setting, value->second);
        }
    }
    return json;
}

std::optional<double> numberAt(const Json& json, const char* pointer)
{
    const Json::json_pointer place(pointer);
    return json.contains(place) && json.at(place).is_number() ? std::optional(json.at(place).get<double>())
                                                              : std::nullopt;
}

const std::string& textAt(const Json& json, const char* pointer)
{
    return json.at(Json::json_pointer(pointer)).get_ref<const std::string&>();
}

Json choicesJson(const Technique& technique)
{
    return {{"partition", gnomon::nameOf(technique.partition)},
            {"fit", gnomon::nameOf(technique.fit)},
            {"filter", gnomon::nameOf(technique.filter)},
            {"soften", gnomon::nameOf(technique.soften)},
            {"motion", gnomon::nameOf(technique.motion)}};
}

Json settingJson(const Setting& setting)
{
    Json json{{"key", setting.key}, {"type", nameOf(setting.type)}, {"doc", setting.doc}};
    if (!setting.unit.empty()) {
        json["unit"] = setting.unit;
    }
    if (!setting.default_text.empty()) {
        json["default"] = typed(setting, std::string(setting.default_text));
    }
    if (setting.min < setting.max) {
        json["min"] = setting.min;
        json["max"] = setting.max;
    }
    if (setting.choices != nullptr) {
        json["values"] = setting.choices();
    }
    if (!setting.used_when.empty()) {
        json["used_with"] = setting.used_when;
    }
    json["option"] = setting.own_option;
    json["subcommands"] = subcommandsOf(setting);
    return json;
}

std::string jsonText(const Json& json)
{
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void writeResult(const std::string& file, std::string_view text)
{
    if (file.empty() || file == "-") {
        writeStdout(text);
    } else {
        writeFile(file, text);
    }
}

} // namespace gnomon::app
