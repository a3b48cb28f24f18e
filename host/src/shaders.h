// SPDX-License-Identifier: Apache-2.0
// The host's shaders by name. Only this file knows where their words come from.
#pragma once

#include <gnomon/vulkan/device_view.h>

#include <cstdint>
#include <span>
#include <string_view>

namespace gnomon::host {

/// SPIR-V of a file of host/shaders, by its name ("tone.frag"), or the module that `hook` has in its place.
/// Precondition: there is one.
[[nodiscard]] std::span<const std::uint32_t> shaderWords(const vulkan::ShaderHook& hook, std::string_view name);

} // namespace gnomon::host
