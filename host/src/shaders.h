// SPDX-License-Identifier: Apache-2.0
// The host's shaders by name. The one place that knows where their words come from.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace gnomon::host {

/// SPIR-V of a file of host/shaders, by its name ("tone.frag"); for as long as the program runs. Precondition: there is
/// one.
[[nodiscard]] std::span<const std::uint32_t> shaderWords(std::string_view name);

} // namespace gnomon::host
