// SPDX-License-Identifier: Apache-2.0
// The shader modules of classic techniques, as Device wants to know them.
#pragma once

#include "device.h"

#include <gnomon_classic_spirv.h>

namespace gnomon::vulkan {

[[nodiscard]] inline ShaderList classicModules()
{
    return {spirv::all_of_gnomon_classic_spirv, spirv::names_of_gnomon_classic_spirv};
}

} // namespace gnomon::vulkan
