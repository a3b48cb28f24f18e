// SPDX-License-Identifier: Apache-2.0
#include "contestants.h"

#include <gnomon/choices.h>

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace gnomon::app {
namespace {

constexpr std::string_view kPcfKernels[] = {"2x2", "3x3", "5x5", "7x7", "poisson", "vogel"};

/// Every filter, `pcf` by each kernel that is not a variant of another. Not `auto`, which is one of them, and not
/// volumes, which many a scene's casters are too open for.
std::vector<std::string> allTexts()
{
    std::vector<std::string> texts;
    for (const ChoiceValue& row : choiceValues()) {
        const auto filter = static_cast<Filter>(row.value);
        if (row.choice != "filter" || filter == Filter::automatic || filter == Filter::volumes) {
            continue;
        }
        if (filter != Filter::pcf) {
            texts.emplace_back(row.name);
            continue;
        }
        for (const std::string_view kernel : kPcfKernels) {
            texts.push_back(fmt::format("pcf+pcf.kernel={}", kernel));
        }
    }
    return texts;
}

bool isAll(const Settings& settings)
{
    return settings.techniques.empty() || settings.techniques.front() == "all";
}

/// The techniques of `all` that can have the requested format. Ids and fins allow fewer options than depths do.
std::vector<std::string> allOf(const Settings& settings)
{
    std::vector<std::string> texts;
    for (const std::string& text : allTexts()) {
        const std::string name = text.substr(0, text.find('+'));
        const auto filter = static_cast<Filter>(findChoice("filter", name)->value);
        const bool stores = !settings.shadow.format || !refusal(filter, *settings.shadow.format);
        ShadowOptions wanted = settings.shadow;
        wanted.technique.filter = filter;
        const bool is_particular = filterTraits(filter)->ids || filter == Filter::smoothies;
        if (stores && (!is_particular || resolve(wanted))) {
            texts.push_back(text);
        }
    }
    return texts;
}

} // namespace

bool namesOneTechnique(const Settings& settings)
{
    return std::any_of(settings.named.begin(), settings.named.end(), [](const std::string& key) {
        return key == "technique" || key == "filter" || key.starts_with("pcf.");
    });
}

bool hasManyTechniques(const Settings& settings)
{
    return (settings.subcommand & (kBench | kCompare)) != 0 &&
           (!settings.techniques.empty() || !namesOneTechnique(settings));
}

std::vector<std::string> techniqueList(const Settings& settings)
{
    if (settings.techniques.empty() && namesOneTechnique(settings)) {
        std::string text(nameOf(filterOf(settings.shadow))); // the options say the rest
        if (filterOf(settings.shadow) == Filter::pcf) {
            text += fmt::format("+pcf.kernel={}", nameOf(settings.shadow.pcf.kernel));
        }
        return {text};
    }
    return isAll(settings) ? allOf(settings) : settings.techniques;
}

std::vector<Settings> contestants(const Settings& settings)
{
    if (settings.techniques.empty() && namesOneTechnique(settings)) {
        return {settings};
    }
    std::vector<Settings> made;
    std::map<std::string, std::string> texts; // by what it comes to
    for (const std::string& text : techniqueList(settings)) {
        try {
            made.push_back(parseTechnique(settings, text));
            const auto [same, is_new] = texts.emplace(describeTechnique(made.back()), text);
            if (!is_new) {
                throw UsageError(fmt::format("--techniques: {} and {} are the same technique", same->second, text));
            }
        } catch (const UsageError& error) {
            const auto place = settings.technique_places.find(text);
            if (place == settings.technique_places.end()) {
                throw;
            }
            throw UsageError(fmt::format("{}: {}", place->second, error.what()));
        }
    }
    return made;
}

} // namespace gnomon::app
