// SPDX-License-Identifier: Apache-2.0
// Changes to a picture's settings, each of which is taken or refused as the command line would. No window, no GPU.
#pragma once

#include "app/settings.h"
#include "host/view.h"

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::app::view {

/// Settings with a change, or why it cannot be.
struct Edited {
    std::optional<Settings> settings;
    std::string refusal; // where there are none
};

/// Pairs of a setting's key and its text, applied in this order. An empty text takes a setting back to its default.
using Changes = std::vector<std::pair<std::string_view, std::string>>;
/// Precondition: the keys are in the table.
[[nodiscard]] Edited edited(const Settings& settings, const Changes& changes);
/// Settings that were put together otherwise, if `render` would draw by them.
[[nodiscard]] Edited checked(Settings settings);
/// With all of the technique at its default.
[[nodiscard]] Settings withoutTechnique(Settings settings);
/// As if a technique in one word were given in the place of the present one.
[[nodiscard]] Edited withTechnique(const Settings& settings, std::string_view text);

/// The settings of `gnomon view` as those of the `gnomon render` that draws the same.
[[nodiscard]] Settings asRender(Settings settings);

/// Its place and direction, in words that lead back to the same eye, to the last bit.
[[nodiscard]] Changes changesTo(const host::Eye& eye);
/// "x,y,z", likewise.
[[nodiscard]] std::string textOf(const glm::dvec3& vector);

/// Is a setting's text only what follows from others, as completeTechnique() notes it, and was never asked for?
[[nodiscard]] bool isNotedOnly(const Settings& settings, std::string_view key);

/// Must the scene be loaded and uploaded anew?
[[nodiscard]] bool changesScene(const Settings& from, const Settings& to);
/// Must what draws it be made anew, and not only another picture be drawn? Of the same scene.
[[nodiscard]] bool changesRenderer(const Settings& from, const Settings& to);

} // namespace gnomon::app::view
