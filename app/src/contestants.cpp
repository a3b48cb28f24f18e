// SPDX-License-Identifier: Apache-2.0
#include "contestants.h"

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

std::vector<Settings> contestants(const Settings& settings)
{
    if (settings.techniques.empty() && namesOneTechnique(settings)) {
        return {settings};
    }
    std::vector<std::string> texts = settings.techniques;
    if (texts.empty() || texts.front() == "all") {
        texts.assign(std::begin(kAll), std::end(kAll));
    }
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
