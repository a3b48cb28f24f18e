// SPDX-License-Identifier: Apache-2.0
// How the maps of one light's cascades are drawn. They are the same either way, bit for bit.
#pragma once

#include <cstdint>
#include <string_view>

namespace gnomon::vulkan {

enum class CascadePass : std::uint8_t {
    automatic, // as `each`
    each,      // every map in a pass of its own
    layered,   // one pass for those that viewsTogether() puts together: what casts in a map is drawn to its layer
};

[[nodiscard]] constexpr std::string_view nameOf(CascadePass pass)
{
    return pass == CascadePass::automatic ? "auto"
           : pass == CascadePass::each    ? "each"
           : pass == CascadePass::layered ? "layered"
                                          : "?";
}

} // namespace gnomon::vulkan
