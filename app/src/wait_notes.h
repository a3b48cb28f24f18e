// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lab/waits.h"

#include <optional>
#include <string>

namespace gnomon::app {

/// A note that lights waited for their maps to be drawn, and for how long; nothing where none did.
[[nodiscard]] std::optional<std::string> waitNote(const lab::Waits& waits);

} // namespace gnomon::app
