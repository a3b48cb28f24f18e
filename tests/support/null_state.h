// SPDX-License-Identifier: Apache-2.0
// What the null driver's functions work on.
#pragma once

#include "null_driver.h"

#include <cstdlib>
#include <memory>
#include <vector>

namespace gnomon::test {

/// Whatever a handle that is not dispatchable points to. It stays when it is destroyed, so that a later use shows.
struct NullObject {
    NullObject() = default;
    ~NullObject() { std::free(mapped); }
    NullObject(const NullObject&) = delete;
    NullObject& operator=(const NullObject&) = delete;

    VkDeviceSize size = 0;        // memory, buffers, images
    void* mapped = nullptr;       // memory
    NullObject* memory = nullptr; // of a buffer or an image
    VkDeviceSize offset = 0;      // there
    /// What is used when this is: of a view its image, of a descriptor set its pool and what was written to it.
    std::vector<NullObject*> parts;
    std::uint32_t slots = 0; // a bit for each whose pending commands use it
    bool destroyed = false;
};

struct NullDriver::Impl {
    NullLimits limits;
    NullCounts counts;
    std::vector<NullEvent> events;
    std::vector<std::unique_ptr<NullObject>> objects;
    std::uint32_t slot = 0;
    const char* hidden = nullptr;
    std::uint32_t api_version = VK_API_VERSION_1_3;
    VkFormatFeatureFlags hidden_features = 0;

    /// A command of the current slot uses it. Allocates nothing.
    void use(NullObject* object);
    void destroy(NullObject* object);
    void log(const NullEvent& event);
};

template <class Handle>
[[nodiscard]] NullObject* objectOf(Handle handle)
{
    return reinterpret_cast<NullObject*>(handle);
}

template <class Handle>
[[nodiscard]] Handle makeObject(NullDriver::Impl& driver)
{
    driver.objects.push_back(std::make_unique<NullObject>());
    return reinterpret_cast<Handle>(driver.objects.back().get());
}

/// Every dispatchable handle is the address of a NullDriver::Impl, so that no function needs a global.
template <class Handle>
[[nodiscard]] NullDriver::Impl& driverOf(Handle handle)
{
    return *reinterpret_cast<NullDriver::Impl*>(handle);
}

inline constexpr std::size_t kMostNullEvents = 65536;

struct NullEntry {
    const char* name;
    PFN_vkVoidFunction function;
};
/// The assignment to the function's own type checks the signature; taking a template's address picks its parameters.
#define GNOMON_NULL(name, function)                                                                                    \
    gnomon::test::NullEntry                                                                                            \
    {                                                                                                                  \
        "vk" #name, reinterpret_cast<PFN_vkVoidFunction>(static_cast<PFN_vk##name>(function))                          \
    }
/// The functions that record commands.
[[nodiscard]] std::span<const NullEntry> nullCommandEntries();

PFN_vkVoidFunction VKAPI_CALL nullInstanceProcAddr(VkInstance instance, const char* name);

} // namespace gnomon::test
