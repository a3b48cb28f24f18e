// SPDX-License-Identifier: Apache-2.0
// The recorded figures of every pipeline (recorded.json), and the changes since.
#pragma once

#include "pipeline_ear.h"

#include <map>
#include <string>
#include <vector>

namespace gnomon::compiled {

struct RecordedStages {
    std::string driver;                          // "Mesa 22.3.6"
    std::map<std::string, CompiledStages> chips; // by name: NAVI21
};

/// Empty where there is no such file.
[[nodiscard]] RecordedStages readRecorded(const std::string& file);
/// A line for each stage and chip, so that a diff shows changes. Figures that are 0 everywhere are left out.
[[nodiscard]] std::string recordedText(const RecordedStages& recorded);

/// A line for each figure that is another one, and for each stage that only one of them has.
[[nodiscard]] std::vector<std::string> changes(const CompiledStages& recorded, const CompiledStages& now);

} // namespace gnomon::compiled
