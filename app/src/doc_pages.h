// SPDX-License-Identifier: Apache-2.0
// Which page of the documents tells more.
#pragma once

#include "app/settings.h"

#include <gnomon/choices.h>

#include <string>

namespace gnomon::app {

/// "docs/techniques/msm.md", in the source tree and where the documents are installed.
[[nodiscard]] std::string pageOf(const ChoiceValue& value);
[[nodiscard]] std::string pageOf(const Setting& setting);
/// The page of a built-in preset; those that stand for a document have a page of their own.
[[nodiscard]] std::string pageOfPreset(std::string_view name);

} // namespace gnomon::app
