// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::app {

/// The names that --camera, --light or --animation (`key`) may take in the scene that the line names, else in rts.
/// Nothing for a scene that cannot be read, or takes too long to.
[[nodiscard]] std::vector<std::string> namesInScene(std::string_view key, std::span<const std::string> words);

} // namespace gnomon::app
