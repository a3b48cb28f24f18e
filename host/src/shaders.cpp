// SPDX-License-Identifier: Apache-2.0
#include "shaders.h"

#include "gnomon_host_spirv.h"

#include <algorithm>
#include <cassert>
#include <iterator>

namespace gnomon::host {

std::span<const std::uint32_t> shaderWords(const vulkan::ShaderHook& hook, std::string_view name)
{
    const auto* const found =
        std::find(std::begin(spirv::names_of_gnomon_host_spirv), std::end(spirv::names_of_gnomon_host_spirv), name);
    assert(found != std::end(spirv::names_of_gnomon_host_spirv));
    if (hook.words != nullptr) {
        if (const std::span<const std::uint32_t> other = hook.words(hook.user, *found); !other.empty()) {
            return other;
        }
    }
    return *spirv::all_of_gnomon_host_spirv[found - std::begin(spirv::names_of_gnomon_host_spirv)];
}

} // namespace gnomon::host
