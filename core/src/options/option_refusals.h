// SPDX-License-Identifier: Apache-2.0
// Options that cannot go together.
#ifndef GNOMON_CORE_OPTION_REFUSALS_H
#define GNOMON_CORE_OPTION_REFUSALS_H

#include <gnomon/options.h>

#include <optional>
#include <string>

namespace gnomon {

/// A sentence that names the option, what is in its way and what to do; nothing if the options go together. The lights
/// that they are for are not looked at.
std::optional<std::string> refusalOfOptions(const ShadowOptions& options);

} // namespace gnomon

#endif
