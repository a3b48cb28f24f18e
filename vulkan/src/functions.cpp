// SPDX-License-Identifier: Apache-2.0
#include "functions.h"

#include <gnomon/error.h>

namespace gnomon::vulkan {
namespace {

constexpr const char* kLookingUp = "look up the Vulkan functions";

/// A driver of Vulkan 1.3 hides what is newer than what its instance was made for.
[[noreturn]] void refuseWithout(const char* name, const Functions& f, const DeviceView& view)
{
    VkPhysicalDeviceProperties properties{};
    if (f.GetPhysicalDeviceProperties != nullptr) {
        f.GetPhysicalDeviceProperties(view.physical_device, &properties);
    }
    if (properties.apiVersion >= VK_API_VERSION_1_3) {
        throw Error(kLookingUp,
                    std::string("the driver has Vulkan 1.3, but the instance gives no vk") + name +
                        ": its apiVersion is too low",
                    "make the instance with VkApplicationInfo::apiVersion of VK_API_VERSION_1_3 or later");
    }
    throw Error(kLookingUp, std::string("the driver has no vk") + name, "use a driver with Vulkan 1.3");
}

} // namespace

Functions loadFunctions(const DeviceView& view)
{
    if (view.get_instance_proc_addr == nullptr || view.instance == VK_NULL_HANDLE ||
        view.physical_device == VK_NULL_HANDLE || view.device == VK_NULL_HANDLE) {
        throw Error(kLookingUp, "the DeviceView has no instance, physical device, device or get_instance_proc_addr",
                    "fill in all four");
    }
    if ((view.memory.allocate == nullptr) != (view.memory.release == nullptr)) {
        throw Error("allocate by the host's memory hooks", "one of the two is null", "give both, or none");
    }
    Functions f;
#define GNOMON_LOAD(name)                                                                                              \
    f.name = reinterpret_cast<PFN_vk##name>(view.get_instance_proc_addr(view.instance, "vk" #name));                   \
    if (f.name == nullptr) {                                                                                           \
        refuseWithout(#name, f, view);                                                                                 \
    }
    GNOMON_INSTANCE_FUNCTIONS(GNOMON_LOAD)
#undef GNOMON_LOAD
    // Device-level addresses skip the loader's dispatch on every call.
#define GNOMON_LOAD(name)                                                                                              \
    f.name = reinterpret_cast<PFN_vk##name>(f.GetDeviceProcAddr(view.device, "vk" #name));                             \
    if (f.name == nullptr) {                                                                                           \
        refuseWithout(#name, f, view);                                                                                 \
    }
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
