// SPDX-License-Identifier: Apache-2.0
#include "shot_parts.h"

#include "contestants.h"

#include <gnomon/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace gnomon::app {
namespace {

constexpr std::size_t kMostNamed = 4;

/// "mesh a is open: 3 of its edges have one triangle; mesh b is blended; and 7 more".
std::string listOf(const host::VolumeFaults& faults)
{
    std::string text;
    for (std::size_t i = 0; i < std::min(kMostNamed, faults.sentences.size()); ++i) {
        text += (i > 0 ? "; " : "") + faults.sentences[i];
    }
    if (faults.sentences.size() > kMostNamed) {
        text += fmt::format("; and {} more", faults.sentences.size() - kMostNamed);
    }
    return text;
}

} // namespace

void requireClosedCasters(Shot& shot, const Settings& settings)
{
    if (settings.truth && settings.subcommand != kCompare) {
        return; // traced alone
    }
    bool refuses = false;
    bool skips = false;
    for (const Settings& technique : hasManyTechniques(settings) ? contestants(settings) : std::vector{settings}) {
        const bool counts = !hasMaps(technique.shadow);
        refuses = refuses || (counts && technique.shadow.volumes.open == OpenCasters::refuse);
        skips = skips || (counts && technique.shadow.volumes.open == OpenCasters::skip);
    }
    if (!refuses && !skips) {
        return;
    }
    const host::VolumeFaults faults = host::volumeFaults(shot.scene, shot.state);
    if (faults.objects == 0) {
        return;
    }
    if (refuses) {
        throw Error("counting shadow volumes of " + settings.scene, listOf(faults),
                    "leave such casters out by volumes.open=skip, or choose a filter with maps");
    }
    shot.notices.push_back(fmt::format("filter volumes leaves out {} of {} objects: {}", faults.objects,
                                       shot.state.objects.size(), listOf(faults)));
}

void noteFinless(Shot& shot, const Settings& settings)
{
    if (settings.truth && settings.subcommand != kCompare) {
        return;
    }
    const std::vector<Settings> techniques =
        hasManyTechniques(settings) ? contestants(settings) : std::vector{settings};
    const bool draws = std::ranges::any_of(
        techniques, [](const Settings& technique) { return filterOf(technique.shadow) == Filter::smoothies; });
    const host::VolumeFaults faults = draws ? host::finFaults(shot.scene, shot.state) : host::VolumeFaults{};
    if (faults.objects > 0) {
        shot.notices.push_back(fmt::format(
            "filter smoothies has no fins for {} of {} objects, whose shadows stay as sharp as pcf has them: {}",
            faults.objects, shot.state.objects.size(), listOf(faults)));
    }
}

} // namespace gnomon::app
