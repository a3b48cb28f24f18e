// SPDX-License-Identifier: Apache-2.0
// What the null driver's functions work on.
#pragma once

#include <gnomon/vulkan/null_driver.h>

#include <vector>

namespace gnomon::vulkan {

struct NullDriver::Impl {
    NullLimits limits;
    NullCounts counts;
    std::vector<NullEvent> events;
    std::uint64_t next_handle = 1;
    const char* hidden = nullptr;
    VkFormatFeatureFlags hidden_features = 0;
};

template <class Handle>
Handle freshHandle(NullDriver::Impl& driver)
{
    // NOLINTNEXTLINE(performance-no-int-to-ptr): a handle of this driver is a number and never followed.
    return reinterpret_cast<Handle>(driver.next_handle++ << 4);
}

inline constexpr std::size_t kMostNullEvents = 65536;

/// Every dispatchable handle is the address of a NullDriver::Impl, so that no function needs a global.
PFN_vkVoidFunction VKAPI_CALL nullInstanceProcAddr(VkInstance instance, const char* name);

} // namespace gnomon::vulkan
