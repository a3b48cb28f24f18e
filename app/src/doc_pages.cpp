// SPDX-License-Identifier: Apache-2.0
#include "doc_pages.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace gnomon::app {
namespace {

constexpr const char* kTheChoices = "docs/architecture.md";
constexpr const char* kTheProgram = "docs/cli.md";

std::string techniquePage(std::string_view name)
{
    return fmt::format("docs/techniques/{}.md", name);
}

/// Keys, or what stands before their dot, that are not named as a value is.
constexpr std::array<std::pair<std::string_view, std::string_view>, 23> kTechniquePages{{
    {"quality", "auto"},
    {"step", "sun-steps"},
    {"bias", "bias"},
    {"caster-faces", "bias"},
    {"caster-cull", "bias"},
    {"translucent", "translucent"},
    {"mask-size", "half-mask"},
    {"draw-budget", "atlas"},
    {"max-layers", "atlas"},
    {"soften", "blur"},
    {"msaa", "filterable"},
    {"blur", "filterable"},
    {"map-sampling", "filterable"},
    {"anisotropy", "filterable"},
    {"level-depth", "filterable"},
    {"depth-metric", "filterable"},
    {"depth-remap", "filterable"},
    {"min-variance", "filterable"},
    {"derivative-variance", "filterable"},
    {"penumbra", "filterable"},
    {"bleeding", "filterable"},
    {"log-space", "filterable"},
    {"map-format", "filterable"},
}};

} // namespace

std::string pageOf(const ChoiceValue& value)
{
    if (value.choice == "light") {
        return "docs/scenes.md";
    }
    if (value.name.starts_with("step-")) {
        return techniquePage("sun-steps");
    }
    constexpr std::array<std::string_view, 4> kPlain{"single", "uniform", "none", "free"};
    return std::ranges::find(kPlain, value.name) != kPlain.end() ? kTheChoices : techniquePage(value.name);
}

std::string pageOf(const Setting& setting)
{
    if (setting.group != SettingGroup::technique) {
        return setting.key.starts_with("path") ? "docs/paths.md" : kTheProgram;
    }
    const std::string_view topic = setting.key.substr(0, setting.key.find('.'));
    const bool is_choice =
        std::ranges::any_of(choiceValues(), [&setting](const ChoiceValue& row) { return row.choice == setting.key; });
    if (is_choice) {
        return kTheChoices;
    }
    for (const auto& [key, page] : kTechniquePages) {
        if (key == topic) {
            return techniquePage(page);
        }
    }
    for (const ChoiceValue& row : choiceValues()) {
        if (row.name == topic) {
            return pageOf(row);
        }
    }
    return kTheProgram;
}

std::string pageOfPreset(std::string_view name)
{
    constexpr std::array<std::string_view, 5> kDocuments{"shastry-2005", "rts-2011", "icefall-2010", "esm-2008",
                                                         "startopia-2006"};
    return std::ranges::find(kDocuments, name) != kDocuments.end() ? techniquePage(name) : kTheProgram;
}

} // namespace gnomon::app
