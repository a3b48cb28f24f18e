// SPDX-License-Identifier: Apache-2.0
#include "contestants.h"

#include <gnomon/choices.h>

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace gnomon::app {
namespace {

constexpr std::string_view kAll[] = {"hard",
                                     "pcf+pcf.kernel=2x2",
                                     "pcf+pcf.kernel=3x3",
                                     "pcf+pcf.kernel=5x5",
                                     "pcf+pcf.kernel=7x7",
                                     "pcf+pcf.kernel=poisson",
                                     "pcf+pcf.kernel=vogel"};

} // namespace

bool namesOneTechnique(const Settings& settings)
{
    return std::any_of(settings.named.begin(), settings.named.end(),
                       [](const std::string& key) { return key == "filter" || key.starts_with("pcf."); });
}

std::vector<std::string> techniqueList(const Settings& settings)
{
    if (settings.techniques.empty() && namesOneTechnique(settings)) {
        std::string text(nameOf(settings.plan.technique.filter)); // the options say the rest
        if (settings.plan.technique.filter == Filter::pcf) {
            text += fmt::format("+pcf.kernel={}", nameOf(settings.filter.pcf_kernel));
        }
        return {text};
    }
    if (settings.techniques.empty() || settings.techniques.front() == "all") {
        return {std::begin(kAll), std::end(kAll)};
    }
    return settings.techniques;
}

std::vector<Settings> contestants(const Settings& settings)
{
    if (settings.techniques.empty() && namesOneTechnique(settings)) {
        return {settings};
    }
    const std::vector<std::string> texts = techniqueList(settings);
    std::vector<Settings> made;
    for (const std::string& text : texts) {
        made.push_back(parseTechnique(settings, text));
        for (std::size_t i = 0; i + 1 < made.size(); ++i) {
            if (describeTechnique(made[i]) == describeTechnique(made.back())) {
                throw UsageError(fmt::format("--techniques: {} and {} are the same technique", texts[i], text));
            }
        }
    }
    return made;
}

} // namespace gnomon::app
