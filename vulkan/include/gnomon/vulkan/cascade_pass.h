// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gnomon/options.h>

namespace gnomon::vulkan {

using gnomon::CascadePass;
using gnomon::nameOf;

} // namespace gnomon::vulkan
