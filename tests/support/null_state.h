// SPDX-License-Identifier: Apache-2.0
// The state of the null driver's functions.
#pragma once

#include "null_driver.h"

#include <cstdlib>
#include <memory>
#include <span>
#include <vector>

namespace gnomon::test {

/// An allocator that bypasses operator new: the driver's memory is not the library's, and must not fail in its place
/// (FailingAllocation).
template <class T>
struct DriversMemory {
    using value_type = T;
    DriversMemory() = default;
    template <class U>
    explicit DriversMemory(const DriversMemory<U>&)
    {
    }
    [[nodiscard]] T* allocate(std::size_t count)
    {
        void* const memory = std::malloc(count * sizeof(T));
        if (memory == nullptr) {
            std::abort();
        }
        return static_cast<T*>(memory);
    }
    void deallocate(T* memory, std::size_t) noexcept { std::free(memory); }
    friend bool operator==(const DriversMemory&, const DriversMemory&) { return true; }
};
template <class T>
using DriversVector = std::vector<T, DriversMemory<T>>;

/// Whatever a handle that is not dispatchable points to. It stays when it is destroyed, so that a later use shows.
struct NullObject {
    NullObject() = default;
    ~NullObject() { std::free(mapped); }
    NullObject(const NullObject&) = delete;
    NullObject& operator=(const NullObject&) = delete;

    VkDeviceSize size = 0;        // memory, buffers, images
    void* mapped = nullptr;       // memory
    std::uint32_t heap = 0;       // memory
    NullObject* memory = nullptr; // of a buffer or an image
    VkDeviceSize offset = 0;      // there
    /// The objects that are in use when this one is: a view's image, a descriptor set's pool and the objects written to
    /// it.
    DriversVector<NullObject*> parts;
    std::uint32_t slots = 0; // a bit for each whose pending commands use it
    bool destroyed = false;
};

struct NullDriver::Impl {
    NullLimits limits;
    NullCounts counts;
    std::vector<NullEvent> events;
    DriversVector<DriversVector<NullObject>> objects; // one in each, which stays where it is
    std::uint32_t slot = 0;
    const char* hidden = nullptr;
    std::uint32_t api_version = VK_API_VERSION_1_3;
    VkFormatFeatureFlags hidden_features = 0;
    bool claims_all = false;
    std::uint64_t fallible_calls = 0;
    std::uint64_t failing_call = 0; // 0: none
    VkResult failure = VK_SUCCESS;
    DriversVector<VkDeviceSize> heap_used;

    /// Counts a use of something that the device lacks.
    void lackIf(bool lacking) { counts.lacking += lacking ? 1 : 0; }
    [[nodiscard]] VkFormatFeatureFlags featuresOf(VkFormat format) const;
    void checkShader(std::span<const std::uint32_t> words);
    void checkImage(const VkImageCreateInfo& info);
    void checkPipeline(const VkGraphicsPipelineCreateInfo& info);
    void checkPipeline(const VkComputePipelineCreateInfo&) {}
    void checkLayout(const VkDescriptorSetLayoutCreateInfo& info);

    /// A command of the current slot uses it. Allocates nothing.
    void use(NullObject* object);
    void destroy(NullObject* object);
    void log(const NullEvent& event);
    /// Each function that may fail calls it first and returns its result unless that is VK_SUCCESS.
    [[nodiscard]] VkResult outcome();
};

template <class Handle>
[[nodiscard]] NullObject* objectOf(Handle handle)
{
    return reinterpret_cast<NullObject*>(handle);
}

template <class Handle>
[[nodiscard]] Handle makeObject(NullDriver::Impl& driver)
{
    driver.objects.emplace_back(1);
    return reinterpret_cast<Handle>(driver.objects.back().data());
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
