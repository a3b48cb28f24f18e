// SPDX-License-Identifier: Apache-2.0
#include "functions.h"

#include <gnomon/error.h>

#include <cassert>

namespace gnomon::vulkan {
namespace {

template <class Function>
void require(Function function, const char* name)
{
    if (function == nullptr) {
        throw Error("look up the Vulkan functions", std::string("the driver has no vk") + name,
                    "use a driver with Vulkan 1.3");
    }
}

} // namespace

Functions loadFunctions(const DeviceView& view)
{
    assert(view.get_instance_proc_addr != nullptr);
    Functions f;
#define GNOMON_LOAD(name)                                                                                              \
    f.name = reinterpret_cast<PFN_vk##name>(view.get_instance_proc_addr(view.instance, "vk" #name));                   \
    require(f.name, #name);
    GNOMON_INSTANCE_FUNCTIONS(GNOMON_LOAD)
#undef GNOMON_LOAD
    // Device-level addresses skip the loader's dispatch on every call.
#define GNOMON_LOAD(name)                                                                                              \
    f.name = reinterpret_cast<PFN_vk##name>(f.GetDeviceProcAddr(view.device, "vk" #name));                             \
    require(f.name, #name);
    GNOMON_DEVICE_FUNCTIONS(GNOMON_LOAD)
#undef GNOMON_LOAD
    if (view.debug_labels) {
#define GNOMON_LOAD(name)                                                                                              \
    f.name = reinterpret_cast<PFN_vk##name>(view.get_instance_proc_addr(view.instance, "vk" #name));
        GNOMON_DEBUG_FUNCTIONS(GNOMON_LOAD)
#undef GNOMON_LOAD
    }
    return f;
}

} // namespace gnomon::vulkan
