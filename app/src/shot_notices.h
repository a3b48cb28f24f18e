// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/shot.h"

#include <optional>
#include <string_view>

namespace gnomon::app {

/// Why the technique gives the light no shadow; the ray tracer takes every light.
[[nodiscard]] std::optional<std::string_view> refusalOf(const host::ShadedLight& light, const Settings& settings);

/// Adds to Shot::notices the facts that people should know before they look at the result.
void noteWhatSurprises(Shot& shot, const Settings& settings);

} // namespace gnomon::app
